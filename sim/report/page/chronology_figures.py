"""Draws what the marks of each arm did: order, collisions, homologies and bytes."""

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

import figures
import palette
import quantities
import sweep_figures
from study_figures import ROWS_OF_A_FIGURE, arm_rows, finish, label_rows

# What shares a panel: its title, its unit, and what is drawn in it, by its name in the legend.
PANELS = (
    ("Pairs of genes sorted against …", "% of pairs",
     {"cause": quantities.CAUSE, "time": quantities.TIME, "time, in a genome": quantities.GENOME}),
    ("Genes with a mark that is taken by …", "% of genes",
     {"the same innovation": quantities.SAME, "another": quantities.DIFFERENT}),
    ("Homologies that are …", "per alignment",
     {"missed": quantities.MISSED, "false": quantities.FALSE}),
    ("Bytes of the clock", "per message", {"stamps": quantities.STAMP}),
)
MARKERS = "os^"


def figures_of(group, folder):
    """The figures of chronology; none where there is nothing but zeros."""
    shown = quantities.present(quantities.CHRONOLOGY, group.arms)
    if not shown:
        return
    sweep = sweep_figures.sweep_of(group)
    if isinstance(sweep, sweep_figures.Lines) and len(sweep.series) <= sweep_figures.SERIES_IN_A_PANEL:
        yield sweep_figures.chronology(group, sweep, shown, folder)
        return
    if isinstance(sweep, sweep_figures.Maps) and sweep.is_of_conditions:
        yield sweep_figures.chronology(group, sweep, shown, folder)
        return
    rows = arm_rows(group)
    parts = [rows[i:i + ROWS_OF_A_FIGURE] for i in range(0, len(rows), ROWS_OF_A_FIGURE)]
    for i, part in enumerate(parts):
        suffix = f", part {i + 1} of {len(parts)}" if len(parts) > 1 else ""
        name = "chronology" if len(parts) == 1 else f"chronology-{i + 1}"
        yield finish(group, folder, _draw(group, part, suffix), name, f"What the marks did{suffix}",
                     "Points: median over the runs; horizontal lines: middle half.",
                     _text(group, part, shown))


def _draw(group, rows, suffix):
    height = 0.185 * len(rows) + 0.95
    figure, grid = plt.subplots(2, 2, sharey=True, figsize=(figures.WIDTH_INCHES, 2 * height + 0.3))
    for axes, (title, unit, drawn) in zip(grid.flat, PANELS):
        handles = []
        for i, (label, quantity) in enumerate(drawn.items()):
            colour, marker = palette.distinct(i).colour, MARKERS[i]
            shift = 0.22 * (i - (len(drawn) - 1) / 2)
            for place, row in enumerate(rows):
                spread = None if isinstance(row, str) else quantity.of(group.arms[row])
                if spread is not None:
                    axes.hlines(place + shift, spread[0], spread[2], color=colour, linewidth=1.2)
                    axes.plot([spread[1]], [place + shift], marker=marker, color=colour,
                              markersize=4, markeredgewidth=0, linestyle="none", clip_on=False)
            handles.append(Line2D([], [], color=colour, marker=marker, markersize=4,
                                  markeredgewidth=0, linewidth=1.2, label=label))
        axes.set_title(title, loc="left", pad=19, fontsize=8.5)
        legend = axes.legend(handles=handles, loc="lower left", bbox_to_anchor=(-0.03, 0.985), ncols=3,
                             fontsize=7, columnspacing=1.0, handlelength=1.5, borderaxespad=0.1)
        legend.set_in_layout(False)  # it takes no width; the title's pad keeps its height
        axes.set_xlabel(unit, fontsize=8)
        axes.set_xlim(left=0.0, right=None if axes.get_xlim()[1] > 1e-9 else 1.0)
        label_rows(axes, group, rows)
    figures.draw_head(figure, [], f"What the marks did: {figures.literal(group.title)}, "
                      f"{group.runs} each{suffix}")
    return figure


def _text(group, rows, shown):
    arms = [group.arms[row] for row in rows if not isinstance(row, str)]
    return " ".join(f"{arm.label or arm.name}: "
                    f"{', '.join(quantity.text(arm) for quantity in shown)}." for arm in arms)
