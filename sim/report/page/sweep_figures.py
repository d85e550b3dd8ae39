"""Draws what arms do as settings vary: lines over one number, heat maps over two settings."""

import itertools
import math
import textwrap
from dataclasses import dataclass

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

import figures
import palette
import quantities
import study_groups
import wording
from study_figures import finish, wrap

SERIES_IN_A_PANEL = 4
PANELS_AT_MOST = 24
DECADES = 20.0  # largest over smallest value from which on an axis is logarithmic
NEAREST = 0.06  # of the axis: where values are nearer to each other, they stand in even steps
VERDICT_MARKS = {"equivalent": "equiv.", "small": "small", "different": "differs", "undecided": "undec."}


@dataclass(frozen=True)
class Series:
    """The arms of one line, by the level of the setting that is varied."""

    label: str
    look: palette.Look
    arms: dict


@dataclass(frozen=True)
class Panel:
    """The arms of one heat map, by the levels of its two settings."""

    label: str
    arms: dict  # by (row, column)


class Lines:
    """One number varies; there is a line for each source or choice."""

    def __init__(self, group, factor):
        self.group = group
        self.factor = group.factors[factor]
        arms = {}
        for arm in group.arms:
            rest = arm.levels[:factor] + arm.levels[factor + 1:]
            arms.setdefault((arm.source, rest), {})[arm.levels[factor]] = arm
        self.series = []
        for i, members in enumerate(arms.values()):
            first = next(iter(members.values()))
            is_named = len(arms) > 1
            self.series.append(Series(first.treatment if is_named else "", first.look if first.treatment
                                      else palette.other(i), members))
        values = [level[0] for level in self.factor["levels"]]
        positive = [value for value in values if value > 0]
        self.is_even = False
        self.is_logarithmic = (min(values) >= 0 and len(positive) > 1
                               and max(positive) / min(positive) >= DECADES)
        self.places = [self._place(value, positive) for value in values]
        gaps = [after - before for before, after in zip(self.places, self.places[1:])]
        if gaps and min(gaps) < NEAREST * sum(gaps):
            self.is_even, self.is_logarithmic = True, False
            self.places = list(range(len(values)))

    def _place(self, value, positive):
        """Where a value stands. On a logarithmic axis zero has a place of its own at the left."""
        if not self.is_logarithmic:
            return value
        smallest, largest = math.log10(min(positive)), math.log10(max(positive))
        return math.log10(value) if value else smallest - max(0.6, 0.2 * (largest - smallest))

    def draw(self, axes, quantity, series):
        width = (max(self.places) - min(self.places)) or 1.0
        for i, one in enumerate(series):
            shift = 0.014 * width * (i - (len(series) - 1) / 2)
            points = [(self.places[level] + shift, quantity.of(arm))
                      for level, arm in sorted(one.arms.items()) if quantity.of(arm) is not None]
            if not points:
                continue
            axes.vlines([x for x, _ in points], [y[0] for _, y in points], [y[2] for _, y in points],
                        color=one.look.colour, linewidth=1.1, alpha=0.7)
            axes.plot([x for x, _ in points], [y[1] for _, y in points], color=one.look.colour,
                      linestyle=one.look.line, marker=one.look.marker, markersize=4.2,
                      markeredgewidth=0, linewidth=1.3)
        self._label_axis(axes, width)

    def _label_axis(self, axes, width):
        points = axes.get_position().width * axes.figure.get_figwidth() * 72
        shown = []
        for level, place in reversed(list(enumerate(self.places))):
            label = study_groups.level_value(self.factor, level)
            needed = (len(label) + 1.5) * 4.6 / points * width
            if not shown or shown[-1][0] - place >= needed:
                shown.append((place, label))
        axes.set_xticks([place for place, _ in shown], [label for _, label in shown])
        axes.set_xticks(self.places, minor=True)
        axes.set_xlim(min(self.places) - 0.06 * width, max(self.places) + 0.06 * width)
        has_break = self.is_logarithmic and 0 in [level[0] for level in self.factor["levels"]]
        if has_break:
            ordered = sorted(self.places)
            axes.plot([(ordered[0] + ordered[1]) / 2], [0], marker=(2, 0, -20), markersize=7,
                      markeredgewidth=3, color="white", transform=axes.get_xaxis_transform(),
                      clip_on=False, zorder=9)
            axes.plot([(ordered[0] + ordered[1]) / 2], [0], marker=(2, 0, -20), markersize=7,
                      color=figures.MUTED, transform=axes.get_xaxis_transform(), clip_on=False,
                      zorder=10)

    @property
    def axis_words(self):
        """What a caption says about the horizontal axis."""
        words = f" {wording.escaped(study_groups.axis_label(self.factor))}: {self.factor['description']}."
        if self.is_logarithmic:
            has_zero = 0 in [level[0] for level in self.factor["levels"]]
            words += f" The horizontal axis is logarithmic{', zero apart' if has_zero else ''}."
        if self.is_even:
            words += " The horizontal axis has even steps from value to value."
        return words

    def handles(self, series):
        return [Line2D([], [], color=one.look.colour, linestyle=one.look.line, marker=one.look.marker,
                       markersize=4.2, markeredgewidth=0, label=figures.literal(one.label))
                for one in series if one.label]


class Maps:
    """Two settings vary; there is a heat map for each source and each level of other settings."""

    def __init__(self, group, row, column):
        self.group, self.row, self.column = group, group.factors[row], group.factors[column]
        self.panels, self.left_out = [], []
        grids = {}
        for arm in group.arms:
            rest = tuple(level for i, level in enumerate(arm.levels) if i not in (row, column))
            grids.setdefault((arm.source, rest), {})[arm.levels[row], arm.levels[column]] = arm
        for (source, rest), arms in grids.items():
            if 2 * len(arms) < len(self.row["levels"]) * len(self.column["levels"]):
                self.left_out.extend(arms.values())
                continue
            others = [factor for i, factor in enumerate(group.factors) if i not in (row, column)]
            words = [study_groups.level_label(factor, level) for factor, level in zip(others, rest)]
            if group.plain["baseline_source"] is not None:
                words.insert(0, wording.SOURCES[source])
            self.panels.append(Panel(", ".join(words), arms))

    @property
    def is_of_conditions(self):
        return not (self.row["treatment"] or self.column["treatment"])

    def draw(self, axes, cells, limits, colours, heading):
        """cells: by (row, column), a value and its text. Returns what a colour bar needs."""
        rows, columns = len(self.row["levels"]), len(self.column["levels"])
        values = [[cells.get((i, j), (math.nan, ""))[0] for j in range(columns)] for i in range(rows)]
        mesh = axes.pcolormesh(values, vmin=limits[0], vmax=limits[1], cmap=colours,
                               edgecolors="white", linewidth=1)
        for (i, j), (value, text) in cells.items():
            red, green, blue, _ = mesh.cmap(mesh.norm(value))
            is_dark = 0.299 * red + 0.587 * green + 0.114 * blue < 0.55
            axes.text(j + 0.5, i + 0.5, text, ha="center", va="center", fontsize=7, linespacing=1.1,
                      color=palette.ON_DARK if is_dark else palette.ON_LIGHT)
        axes.set_xticks([j + 0.5 for j in range(columns)], self._labels(self.column))
        axes.set_yticks([i + 0.5 for i in range(rows)], self._labels(self.row))
        axes.set_title(heading, fontsize=8)
        axes.grid(visible=False)
        axes.tick_params(length=0, labelsize=7)
        for spine in axes.spines.values():
            spine.set_visible(False)
        return mesh

    @staticmethod
    def _labels(factor):
        return [figures.literal(textwrap.fill(study_groups.level_value(factor, level), 9))
                for level in range(len(factor["levels"]))]


def sweep_of(group):
    """How a group's settings vary: Lines, Maps, or none where there is nothing to draw."""
    factors = range(len(group.factors))
    numeric = [i for i in factors if group.factors[i]["numeric"]]
    series = len({(arm.source, tuple(arm.levels[i] for i in factors if i not in numeric))
                  for arm in group.arms})
    if len(numeric) == 1 and (len(group.factors) == 1 or (
            series <= 2 * SERIES_IN_A_PANEL and len(group.factors[numeric[0]]["levels"]) > 2)):
        return Lines(group, numeric[0])
    if len(group.factors) < 2:
        return None
    by_size = sorted(factors, key=lambda i: (-len(group.factors[i]["levels"]),
                                             not group.factors[i]["treatment"]))
    maps = Maps(group, *sorted(by_size[:2]))
    return maps if 0 < len(maps.panels) <= PANELS_AT_MOST else None


def fitness(group, folder):
    """Figures of f_c over the settings that vary."""
    sweep = sweep_of(group)
    if isinstance(sweep, Lines):
        yield _fitness_lines(group, sweep, folder)
    elif sweep is not None:
        yield _fitness_maps(group, sweep, folder)
        differences = _difference_maps(group, sweep, folder)
        if differences is not None:
            yield differences


def _title(group, what):
    return f"{what}: {figures.literal(group.title)}, {group.runs} each"


def _words(sweep):
    if isinstance(sweep, Lines):
        return study_groups.factor_name(sweep.factor)
    return f"{study_groups.factor_name(sweep.row)} and {study_groups.factor_name(sweep.column)}"


def _fitness_lines(group, lines, folder):
    series = lines.series
    together = len(series) <= SERIES_IN_A_PANEL
    shown = [series] if together else [[series[0], one] for one in series[1:]]
    columns = 1 if together else 3
    rows = -(-len(shown) // columns)
    figure, grid = plt.subplots(rows, columns, sharex=True, sharey=True, squeeze=False,
                                figsize=(figures.WIDTH_INCHES, (3.1 if together else 1.9) * rows + 0.7))
    for axes, members in zip(grid.flat, shown):
        lines.draw(axes, quantities.FITNESS, members)
        axes.tick_params(labelbottom=True)
        if not together:
            axes.set_title(wrap(members[-1].label, 30), fontsize=8)
    for axes in list(grid.flat)[len(shown):]:
        axes.remove()
    figure.supxlabel(figures.literal(study_groups.axis_label(lines.factor)), fontsize=9)
    figure.supylabel("$f_c$ (energy)", fontsize=9)
    title = _title(group, f"$f_c$ by {figures.literal(_words(lines))}")
    figures.draw_head(figure, lines.handles(series if together else series[:1]), title)
    caption = "Points: median over the runs; vertical lines: middle half." + lines.axis_words
    text = " ".join(f"{arm.label or arm.name}, {quantities.FITNESS.text(arm)}." for arm in group.arms)
    return finish(group, folder, figure, "f_c-sweep", f"Fitness by {_words(lines)}", caption,
                  text.replace("$f_c$", "f c"))


def _fitness_maps(group, maps, folder):
    medians = [quantities.FITNESS.median(arm) for panel in maps.panels for arm in panel.arms.values()]
    limits = (min(medians), max(medians))
    decimals = 0 if limits[1] - limits[0] > 30 else 1

    def cells(panel):
        return {place: (value, wording.number(value, decimals)) for place, arm in panel.arms.items()
                for value in [quantities.FITNESS.median(arm)]}

    figure = _draw_maps(maps, cells, limits, "cividis", "$f_c$ (energy)",
                        _title(group, f"$f_c$ by {figures.literal(_words(maps))}"))
    caption = "In each cell: the median over the runs." + _words_beside(maps)
    text = " ".join(f"{arm.label}, {quantities.FITNESS.text(arm)}." for arm in group.arms)
    return finish(group, folder, figure, "f_c-map", f"Fitness by {_words(maps)}", caption,
                  text.replace("$f_c$", "f c"))


def _words_beside(maps):
    words = "".join(f" {wording.escaped(study_groups.axis_label(factor))}: {factor['description']}."
                    for factor in (maps.row, maps.column))
    if not maps.left_out:
        return words
    arms = "; ".join(f"{arm.label or arm.name}, {wording.number(quantities.FITNESS.median(arm), 1)}"
                     for arm in maps.left_out)
    return f"{words} Outside the grid: {wording.escaped(arms)}."


def _difference_maps(group, maps, folder):
    """Medians less that of the baseline; none where no arm in the maps has a baseline."""
    kind = "treatment_contrasts" if group.plain["treatment_contrasts"] else "condition_contrasts"
    rows = {id(group.arms[row["arm"]]): row for row in group.plain[kind]}
    panels = [panel for panel in maps.panels
              if any(id(arm) in rows for arm in panel.arms.values())]
    if not panels:
        return None
    largest = max(max(abs(row["median"] - row["baseline_median"]), row["margin"])
                  for row in rows.values())

    def cells(panel):
        return {place: (row["median"] - row["baseline_median"],
                        f"{wording.signed(row['median'] - row['baseline_median'], 1)}\n"
                        f"{VERDICT_MARKS[row['verdict']]}")
                for place, arm in panel.arms.items() for row in [rows.get(id(arm))] if row is not None}

    shown = Maps.__new__(Maps)
    shown.__dict__.update(maps.__dict__, panels=panels)
    figure = _draw_maps(shown, cells, (-largest, largest), "PuOr_r",
                        "energy",
                        _title(group, f"$f_c$ less that of {figures.literal(_baseline(group, kind))}"))
    caption = ("In each cell: the median less the baseline's (see the contrasts "
               "below), and what the contrast found. Cells without one are baselines.")
    text = " ".join(f"{group.arms[row['arm']].label}: "
                    f"median {wording.number(row['median'] - row['baseline_median'], 1)} from "
                    f"{group.arms[row['baseline']].label}; {row['verdict']}." for row in rows.values())
    return finish(group, folder, figure, "f_c-difference", "Difference from the baseline", caption, text)


def _baseline(group, kind):
    """In words: the baseline of the arms in a kind of contrasts."""
    bases = [group.arms[row["baseline"]] for row in group.plain[kind]]
    labels = {base.label for base in bases}
    if len(labels) > 1 and kind == "treatment_contrasts":
        labels = {base.treatment for base in bases}
    return labels.pop() if len(labels) == 1 else "the baseline"


def _draw_maps(maps, cells_of, limits, colours, bar_label, title):
    count = len(maps.panels)
    columns = min(count, 2 if len(maps.column["levels"]) > 3 else 3)
    rows = -(-count // columns)
    height = 0.34 * len(maps.row["levels"]) + 0.5
    figure, grid = plt.subplots(rows, columns, squeeze=False,
                                figsize=(figures.WIDTH_INCHES, height * rows + 0.9))
    colour_map = plt.get_cmap(colours, 33)  # so few that the colour bar stays free of images
    for axes, panel in zip(grid.flat, maps.panels):
        heading = wrap(panel.label, 84 // columns)
        mesh = maps.draw(axes, cells_of(panel), limits, colour_map, heading)
    for axes in list(grid.flat)[count:]:
        axes.remove()
    bar = figure.colorbar(mesh, ax=list(grid.flat)[:count], label=bar_label, aspect=25, pad=0.02,
                          fraction=0.06)
    bar.outline.set_visible(False)
    _label_maps(figure, maps, title)
    return figure


def _label_maps(figure, maps, title):
    figure.supxlabel(figures.literal(study_groups.axis_label(maps.column)), fontsize=9)
    figure.supylabel(figures.literal(study_groups.axis_label(maps.row)), fontsize=9)
    figures.draw_head(figure, [], title)


def chronology(group, sweep, shown, folder):
    """The quantities in `shown` over the settings that vary."""
    if isinstance(sweep, Lines):
        figure = _chronology_lines(group, sweep, shown)
        caption = "Points: median over the runs; vertical lines: middle half." + sweep.axis_words
    else:
        figure = _chronology_maps(group, sweep, shown)
        caption = ("In each cell: the median over the runs. Each panel has a colour scale of its own, "
                   "from zero; panels with nothing but zeros are left out.")
    text = " ".join(f"{arm.label or arm.name}: {', '.join(q.text(arm) for q in shown)}."
                    for arm in group.arms)
    return finish(group, folder, figure, "chronology", "What the marks did", caption, text)


def _chronology_lines(group, lines, shown):
    columns = min(3, len(shown))
    rows = -(-len(shown) // columns)
    figure, grid = plt.subplots(rows, columns, sharex=True, squeeze=False,
                                figsize=(figures.WIDTH_INCHES, 1.9 * rows + 0.8))
    for axes, quantity in zip(grid.flat, shown):
        lines.draw(axes, quantity, lines.series)
        axes.set_title(quantity.title, fontsize=8)
        axes.set_ylabel(quantity.unit, fontsize=8)
        axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]) if axes.get_ylim()[0] < 0 else 0.0)
        axes.tick_params(labelbottom=True, labelsize=7)
    for axes in list(grid.flat)[len(shown):]:
        axes.remove()
    figure.supxlabel(figures.literal(study_groups.axis_label(lines.factor)), fontsize=9)
    figures.draw_head(figure, lines.handles(lines.series), _title(group, "What the marks did"))
    return figure


def _chronology_maps(group, maps, shown):
    wanted = [(panel, quantity) for quantity, panel in itertools.product(shown, maps.panels)
              if any(quantity.median(arm) for arm in panel.arms.values())][:PANELS_AT_MOST]
    columns = 2 if len(maps.column["levels"]) > 3 else 3
    rows = -(-len(wanted) // columns)
    height = 0.27 * len(maps.row["levels"]) + 0.62
    figure, grid = plt.subplots(rows, columns, squeeze=False,
                                figsize=(figures.WIDTH_INCHES, height * rows + 0.7))
    for axes, (panel, quantity) in zip(grid.flat, wanted):
        medians = {place: quantity.median(arm) for place, arm in panel.arms.items()}
        cells = {place: (value, wording.significant(value))
                 for place, value in medians.items() if value is not None}
        words = f"{quantity.title}, {quantity.unit}"
        heading = f"{figures.literal(panel.label)}\n{words}" if panel.label else words
        maps.draw(axes, cells, (0.0, max(value for value, _ in cells.values())),
                  plt.get_cmap("YlGnBu", 32), heading)
    for axes in list(grid.flat)[len(wanted):]:
        axes.remove()
    _label_maps(figure, maps, _title(group, "What the marks did"))
    return figure
