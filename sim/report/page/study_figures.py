"""Draws what every study has: swarm fitness over time, and f_c with the verdicts of the contrasts."""

from dataclasses import dataclass

import matplotlib.pyplot as plt
from markupsafe import Markup
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

import figures
import palette
import wording
from inline_svg import inline
from study_groups import percent

ROWS_OF_A_FIGURE = 48
PANELS_AT_MOST = 48  # more are no longer legible
OWN_ARM = "the arm in the panel's title"
POINTS_AT_MOST = 32  # more runs than this are shown by box and outliers alone


@dataclass(frozen=True)
class Figure:
    """A drawn figure, ready for the page."""

    identifier: str  # unique on the page, and the anchor to it
    title: str
    caption: Markup
    svg: Markup
    path: str  # of the SVG file, from the page, without its suffix


def finish(group, folder, drawing, name, title, caption, text):
    """Saves a figure under the group's name and its own, and makes it ready."""
    stem = f"{group.identifier}-{name}"
    path = folder / stem
    figures.save(drawing, path)
    svg = inline(path.with_suffix(".svg").read_text(encoding="utf-8"), stem, f"{title}. {text}")
    return Figure(stem, title, Markup(caption), Markup(svg), f"{folder.name}/{stem}")


def curves(group, folder):
    """Swarm fitness over time; none where there would be too many panels."""
    panels = _panels(group)
    if len(panels) > PANELS_AT_MOST:
        return None
    title = f"Swarm fitness over time: {figures.literal(group.title)}, {group.runs} each"
    caption = "Lines: median over the runs; bands: middle half."
    if len(panels) > 1:
        caption += " All panels have the same axes."
    return finish(group, folder, _draw_panels(group, panels, title), "swarm-fitness",
                  "Swarm fitness over time", caption, _curves_text(group))


def boxes(group, folder):
    """f_c of every arm, in as many figures as it takes."""
    rows = arm_rows(group)
    parts = [rows[i:i + ROWS_OF_A_FIGURE] for i in range(0, len(rows), ROWS_OF_A_FIGURE)]
    few = all(arm.numbers["runs"] <= POINTS_AT_MOST for arm in group.arms)
    caption = ("Boxes: quartiles and median; whiskers: the farthest run within 1.5 times the box; "
               + ("points: single runs. " if few else "points: runs beyond. ")
               + "Vertical line: median of a row's baseline; band: "
               f"{percent(group.plain['margin_share'])} of it to both sides, the "
               "margin of equivalence. At the right: the verdict of the contrast.")
    for i, part in enumerate(parts):
        suffix = f", part {i + 1} of {len(parts)}" if len(parts) > 1 else ""
        title = f"Average accumulated swarm fitness $f_c$: {figures.literal(group.title)}, {group.runs} each{suffix}"
        name = "f_c" if len(parts) == 1 else f"f_c-{i + 1}"
        yield finish(group, folder, _draw_rows(group, part, title, few), name,
                     f"Average accumulated swarm fitness{suffix}", caption, _rows_text(group, part))


def shown_contrast(group, position):
    """The contrast that a row of an arm shows: "baseline", a contrast of report.json, or none."""
    treatments = {row["arm"]: row for row in group.plain["treatment_contrasts"]}
    if position in treatments:
        return treatments[position]
    if any(row["baseline"] == position for row in treatments.values()):
        return "baseline"
    if group.is_baseline(position):
        return "baseline"
    return group.contrast_of.get(position)


def verdict_words(contrast):
    if contrast == "baseline" or contrast is None:
        return contrast or ""
    if contrast["verdict"] != "different":
        return wording.VERDICTS[contrast["verdict"]]
    return "higher" if contrast["shift"] > 0 else "lower"


def _panels(group):
    """What shares a panel: (title, positions of arms), at most four arms that can be told apart."""
    few = 4
    everything = range(len(group.arms))
    if len(group.arms) <= few:
        return [("", list(everything))]
    conditions = group.conditions
    if len(conditions) > 1 and all(2 <= len(members) <= few for members in conditions.values()):
        return list(conditions.items())
    panels = []
    for position in everything:
        contrast = shown_contrast(group, position)
        if contrast is None:
            panels.append((group.arms[position].label, [position]))
        elif contrast != "baseline":
            panels.append((group.arms[position].label, [contrast["baseline"], position]))
    treatments = {group.arms[members[-1]].treatment for _, members in panels}
    if len(treatments) == 1 and len(conditions) > 1:
        panels = [(group.arms[members[-1]].condition, members) for _, members in panels]
    return panels


def wrap(label, characters):
    """A label of parts with commas, in lines of so many characters where the parts let it."""
    lines = []
    for part in label.split(", "):
        if lines and len(lines[-1]) + len(part) + 2 <= characters:
            lines[-1] += f", {part}"
        else:
            lines.append(part)
    return figures.literal(",\n".join(lines))


@dataclass(frozen=True)
class _Grid:
    """How panels are laid out."""

    columns: int
    height_inches: float
    heading_characters: int  # that fit above a panel
    heading_points: float


def _grid_of(count):
    if count == 1:
        return _Grid(1, 3.4, 90, 9)
    if count in (2, 4):
        return _Grid(2, 2.4, 44, 8)
    return _Grid(3, 1.85, 30, 8) if count <= 9 else _Grid(4, 1.5, 24, 7)


def _draw_panels(group, panels, title):
    grid = _grid_of(len(panels))
    rows = -(-len(panels) // grid.columns)
    headings = [wrap(heading, grid.heading_characters) for heading, _ in panels]
    lines = max(heading.count("\n") for heading in headings)
    figure, places = plt.subplots(
        rows, grid.columns, sharex=True, sharey=True, squeeze=False,
        figsize=(figures.WIDTH_INCHES, (grid.height_inches + 0.13 * lines) * rows + 0.6))
    looks = {}
    for axes, heading, (_, members) in zip(places.flat, headings, panels):
        for label, look, arm in _looks(group, panels, members):
            looks.setdefault(label, look)
            figures.draw_curve(axes, arm.numbers, "swarm_fitness", look)
        axes.set_title(heading, fontsize=grid.heading_points)
        axes.xaxis.set_major_formatter(figures.thousands)
        axes.xaxis.set_major_locator(MaxNLocator(6 if grid.columns == 1 else 3, steps=[1, 2, 5, 10]))
        axes.set_xlim(0, group.setting("run.cycles"))
        axes.tick_params(labelbottom=True)
    for axes in list(places.flat)[len(panels):]:
        axes.remove()
    figure.supxlabel("Control cycle", fontsize=9)
    figure.supylabel("Swarm fitness $F_s$ (energy)", fontsize=9)
    if OWN_ARM in looks:
        looks[OWN_ARM] = palette.ANY
    handles = [Line2D([], [], color=look.colour, linestyle=look.line, label=figures.literal(label))
               for label, look in looks.items() if label]
    figures.draw_head(figure, handles + [figures.middle_half_handle()], title,
                      columns=2 if max(map(len, looks)) > 28 else 3)
    return figure


def _looks(group, panels, members):
    """Of each arm in a panel: (its label in the legend, its look, the arm)."""
    arms = [group.arms[member] for member in members]
    if len(panels) == 1:
        looks = [arm.look if arm.treatment else palette.other(i) for i, arm in enumerate(arms)]
        return zip([arm.label or arm.name for arm in arms], looks, arms)
    if panels == list(group.conditions.items()):
        return zip([arm.treatment for arm in arms], [arm.look for arm in arms], arms)
    own = arms[-1]
    look = own.look if own.look != palette.baseline() else palette.highlight()
    if len(arms) == 1:
        return [("", look, own)]
    baselines = {held[0] for _, held in panels if len(held) == 2}
    is_shared = own.treatment and all(title == group.arms[held[-1]].condition for title, held in panels)
    label = arms[0].label if len(baselines) == 1 else "its baseline"
    return [(label, palette.baseline(), arms[0]), (own.treatment if is_shared else OWN_ARM, look, own)]


def arm_rows(group):
    """The rows of a figure: positions of arms, and a heading above those of one condition."""
    conditions = group.conditions
    alone = sum(len(members) == 1 for members in conditions.values())
    if len(conditions) == 1 or 2 * alone > len(conditions):
        return list(range(len(group.arms)))
    rows = []
    for condition, members in conditions.items():
        rows.extend([condition or "otherwise", *members])
    return rows


def _draw_rows(group, rows, title, few):
    figure, axes = plt.subplots(figsize=(figures.WIDTH_INCHES, 0.23 * len(rows) + 1.15))
    for place, row in enumerate(rows):
        if not isinstance(row, str):
            _draw_row(axes, group, row, place, few)
    label_rows(axes, group, rows)
    axes.set_xlabel("$f_c$ (energy)")
    handles = [Line2D([], [], color=figures.MUTED, linewidth=1.2, label="baseline's median"),
               Patch(facecolor=figures.MUTED, alpha=0.25, label="margin of equivalence")]
    figures.draw_head(figure, handles if group.contrast_of else [], title)
    return figure


def label_rows(axes, group, rows):
    """Names the rows of a figure, the first one at the top, with headings in bold."""
    has_headings = any(isinstance(row, str) for row in rows)
    labels = []
    for row in rows:
        if not isinstance(row, str):
            arm = group.arms[row]
            row = (arm.treatment if has_headings else arm.label) or arm.name
        labels.append(figures.literal(row))
    axes.set_yticks(range(len(rows)), labels)
    for row, label in zip(rows, axes.get_yticklabels()):
        if isinstance(row, str):
            label.set_fontweight("bold")
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.tick_params(axis="y", length=0, pad=6)
    axes.spines["left"].set_visible(False)
    axes.grid(axis="y", visible=False)
    axes.grid(axis="x", visible=True)


def _draw_row(axes, group, position, place, few):
    arm = group.arms[position]
    summary = arm.numbers["measures"][group.plain["measure"]]
    contrast = shown_contrast(group, position)
    if contrast is not None:
        _draw_margin(axes, group, position if contrast == "baseline" else contrast["baseline"], place)
    colour = arm.look.colour
    line = {"color": colour, "linewidth": 1.1}
    axes.bxp([figures.box_numbers(summary)], positions=[place], widths=0.56, vert=False,
             showfliers=False, manage_ticks=False, boxprops=line, whiskerprops=line, capprops=line,
             medianprops={"color": colour, "linewidth": 2.2})
    values = [value for value in summary["values"]
              if few or not summary["lower_whisker"] <= value <= summary["upper_whisker"]]
    axes.plot(values, [place + (figures.spread(i) if few else 0.0) for i in range(len(values))],
              linestyle="none", marker=arm.look.marker, markersize=2.8, markeredgewidth=0, alpha=0.6,
              color=colour, zorder=3)
    axes.text(1.01, place, verdict_words(contrast), transform=axes.get_yaxis_transform(),
              va="center", fontsize=8, color=figures.MUTED if contrast == "baseline" else figures.INK,
              fontweight="bold" if isinstance(contrast, dict) and contrast["verdict"] == "different"
              else "normal")


def _draw_margin(axes, group, baseline, place):
    median = group.arms[baseline].numbers["measures"][group.plain["measure"]]["median"]
    margin = abs(median) * group.plain["margin_share"]
    axes.fill_betweenx([place - 0.5, place + 0.5], median - margin, median + margin,
                       color=figures.MUTED, alpha=0.16, linewidth=0, zorder=0)
    axes.vlines(median, place - 0.5, place + 0.5, color=figures.MUTED, linewidth=1.0, zorder=1)


def _curves_text(group):
    sentences = []
    for arm in group.arms:
        medians = arm.numbers["curves"]["swarm_fitness"]["median"]
        at = [f"{wording.number(medians[i], 1)} at cycle {wording.number(arm.numbers['cycles'][i], 0)}"
              for i in (0, len(medians) // 2, -1)]
        sentences.append(f"{arm.label or arm.name}: median {at[0]}, {at[1]}, {at[2]}.")
    return " ".join(sentences)


def _rows_text(group, rows):
    sentences = []
    for row in rows:
        if isinstance(row, str):
            continue
        arm = group.arms[row]
        summary = arm.numbers["measures"][group.plain["measure"]]
        low, median, high = (wording.number(summary[key], 1)
                             for key in ("lower_quartile", "median", "upper_quartile"))
        verdict = verdict_words(shown_contrast(group, row))
        sentences.append(f"{arm.label or arm.name}: median {median}, middle half {low} to {high}"
                         f"{f'; {verdict}' if verdict else ''}.")
    return " ".join(sentences)
