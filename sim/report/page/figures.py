"""Draws the paper's Figures 3 to 11 from the numbers in report.json, which it only reads.

Each draw function returns a Matplotlib figure. `published` are entries of an exhibit's `ranges`, in
the units of the vertical axis.
"""

import io
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (after the choice of backend)
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402
from matplotlib.ticker import FuncFormatter, MaxNLocator  # noqa: E402
from PIL import Image  # noqa: E402  (comes with Matplotlib)

import palette  # noqa: E402
import wording  # noqa: E402

ORIGIN_LABELS = {"ours": "ours", "reference": "ref.", "paper": "paper"}
ORIGIN_MARKERS = {"ours": "o", "reference": "D", "paper": "^"}
ORIGIN_LINES = {"ours": "-", "reference": "-", "paper": (0, (1, 1))}
INK, MUTED = "#1b1f24", "#5f6670"

WIDTH_INCHES = 6.5
DOTS_PER_INCH = 200  # as in figures.mplstyle
REFERENCE_CYCLE = 10_000


def use_style():
    matplotlib.rcdefaults()
    plt.style.use(str(Path(__file__).with_name("figures.mplstyle")))


def save(figure, path):
    """Writes path.svg and path.png: the same bytes for the same numbers."""
    figure.get_layout_engine().execute(figure)
    figure.set_layout_engine("none")  # laid out once, not anew for each file
    figure.savefig(path.with_suffix(".svg"), metadata={"Date": None, "Creator": None})
    with io.BytesIO() as drawn:
        figure.savefig(drawn, format="png", metadata={"Software": None})
        image = Image.open(drawn).convert("RGB").quantize(256, dither=Image.Dither.NONE)
        image.save(path.with_suffix(".png"), optimize=True, dpi=(DOTS_PER_INCH, DOTS_PER_INCH))
    plt.close(figure)


def literal(text):
    """A text for a figure that is no formula, whatever it holds."""
    return text.replace("$", r"\$")


def draw_curves(comparison, cycles, curve, label, end_measure, end_label, published, top=None):
    """Median and interquartile band over time; beside them, how the runs end and others' ended."""
    early, late = [], []
    for entry in published:
        (early if entry["measure"] == "swarm_fitness_at_10000" else late).append(entry)
    columns = 1 + len({entry["origin"] for entry in late})
    figure, (axes, side) = plt.subplots(
        1, 2, sharey=True, figsize=(WIDTH_INCHES, 3.5),
        gridspec_kw={"width_ratios": [3.3, columns / 3]})
    arms = comparison["arms"]
    for arm in arms:
        draw_curve(axes, arm, curve, palette.SOURCES[arm["source"]])
    if cycles >= REFERENCE_CYCLE:
        for entry in early:
            _draw_interval(axes, REFERENCE_CYCLE + 0.007 * cycles * _side(entry["source"]), entry)
    axes.set(xlabel="Control cycle", ylabel=label, xlim=(0, cycles))
    axes.xaxis.set_major_formatter(thousands)
    axes.xaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
    if top is not None:
        axes.set_ylim(0, top)
    _draw_ends(side, arms, end_measure, late)
    side.set_title(end_label, color=MUTED)
    draw_head(figure, _method_handles(arms) + _origin_handles(published))
    return figure


def draw_measures(comparison, panels, published):
    """Box plots of the paper's four measures, in two rows of two.

    panels: (measure, title, axis label, whether the axis starts at zero) for each.
    """
    figure, grid = plt.subplots(2, 2, figsize=(WIDTH_INCHES, 5.4))
    for axes, (measure, title, label, from_zero) in zip(grid.flat, panels):
        _draw_boxes(axes, comparison["arms"], measure,
                    [entry for entry in published if entry["measure"] == measure])
        axes.set_title(title)
        axes.set_ylabel(label)
        axes.yaxis.set_major_formatter(thousands)
        if from_zero:
            axes.set_ylim(bottom=-0.03 * axes.get_ylim()[1])
    draw_head(figure, _origin_handles(published))
    return figure


def draw_sizes(panels):
    """Box plots of controller size, one panel for each (comparison, title, published)."""
    figure, grid = plt.subplots(1, len(panels), figsize=(WIDTH_INCHES, 3.4), squeeze=False)
    for axes, (comparison, title, published) in zip(grid.flat, panels):
        _draw_boxes(axes, comparison["arms"], "controller_size", published)
        axes.set_title(title)
        axes.set_ylabel("Neurons and connections")
    draw_head(figure, _origin_handles([entry for panel in panels for entry in panel[2]]))
    return figure


def _side(source):
    """On which side of a shared place a method stands."""
    return -1 if source == "gene-clock" else 1


def draw_curve(axes, arm, curve, look):
    numbers = arm["curves"][curve]
    axes.fill_between(arm["cycles"], numbers["lower_quartile"], numbers["upper_quartile"],
                      color=look.colour, alpha=0.2, linewidth=0)
    axes.plot(arm["cycles"], numbers["median"], color=look.colour, linestyle=look.line)


def _draw_interval(axes, x, entry):
    """A middle half as a bar with ends, its median (where known) as a marker."""
    colour = palette.SOURCES[entry["source"]].colour
    origin = entry["origin"]
    axes.vlines(x, entry["lower"], entry["upper"], color=colour, linewidth=1.4,
                linestyle=ORIGIN_LINES[origin], zorder=4)
    axes.plot([x, x], [entry["lower"], entry["upper"]], linestyle="none", marker="_",
              markersize=5, color=colour, zorder=4)
    if entry["median"] is not None:
        axes.plot([x], [entry["median"]], linestyle="none", marker=ORIGIN_MARKERS[origin],
                  markersize=5, markeredgewidth=1.3, color=colour, zorder=5,
                  markerfacecolor=colour if origin == "ours" else "white")


def _draw_ends(axes, arms, measure, published):
    entries = [{**_middle_half(arm["measures"][measure]), "source": arm["source"], "origin": "ours"}
               for arm in arms if arm["measures"][measure] is not None] + published
    columns = [origin for origin in ORIGIN_LABELS
               if any(entry["origin"] == origin for entry in entries)]
    for entry in entries:
        _draw_interval(axes, columns.index(entry["origin"]) + 0.16 * _side(entry["source"]), entry)
    axes.set_xticks(range(len(columns)), [ORIGIN_LABELS[origin] for origin in columns])
    axes.set_xlim(-0.5, len(columns) - 0.5)
    axes.tick_params(axis="both", length=0, labelleft=False)
    axes.spines["left"].set_visible(False)


def _middle_half(summary):
    return {"lower": summary["lower_quartile"], "median": summary["median"],
            "upper": summary["upper_quartile"]}


def _draw_boxes(axes, arms, measure, published):
    labels = []
    for position, arm in enumerate(arms):
        labels.append(wording.SOURCES[arm["source"]])
        summary = arm["measures"][measure]
        if summary is None:
            continue
        colour = palette.SOURCES[arm["source"]].colour
        line = {"color": colour, "linewidth": 1.2}
        axes.bxp([box_numbers(summary)],
                 positions=[position], widths=0.42, showfliers=False, manage_ticks=False,
                 boxprops=line, whiskerprops=line, capprops=line,
                 medianprops={"color": colour, "linewidth": 2.2})
        axes.plot([position + spread(i) for i in range(summary["count"])], summary["values"],
                  linestyle="none", marker=palette.SOURCES[arm["source"]].marker, markersize=2.6,
                  markeredgewidth=0, alpha=0.45, color=colour, zorder=1)
        theirs = [entry for entry in published if entry["source"] == arm["source"]]
        for i, entry in enumerate(theirs):
            _draw_interval(axes, position + 0.32 + 0.1 * i, entry)
    axes.set_xticks(range(len(labels)), labels)
    axes.set_xlim(-0.6, len(labels) - 0.4)
    axes.tick_params(axis="x", length=0)


def box_numbers(summary):
    """As Matplotlib's bxp wants them."""
    return {"med": summary["median"], "q1": summary["lower_quartile"],
            "q3": summary["upper_quartile"], "whislo": summary["lower_whisker"],
            "whishi": summary["upper_whisker"]}


def spread(i):
    """Where the i-th point stands across its box: evenly spread, and the same every time."""
    golden_ratio = 0.6180339887498949
    return 0.34 * ((i * golden_ratio) % 1.0 - 0.5)


def _method_handles(arms):
    handles = [Line2D([], [], color=palette.SOURCES[arm["source"]].colour, linestyle=palette.SOURCES[arm["source"]].line,
                      label=f"{wording.SOURCES[arm['source']]} ({arm['runs']} runs)")
               for arm in arms]
    return handles + [middle_half_handle()]


def middle_half_handle():
    return Patch(facecolor=MUTED, alpha=0.25, label="middle half of the runs")


def _origin_handles(published):
    return [Line2D([], [], color=MUTED, marker=ORIGIN_MARKERS[origin], markersize=5,
                   markerfacecolor="white", linestyle=ORIGIN_LINES[origin], linewidth=1.4, label=label)
            for origin, label in (("reference", "reference system"), ("paper", "paper's text"))
            if any(entry["origin"] == origin for entry in published)]


def draw_head(figure, handles, title="", columns=3):
    """Title and legend at the top of the figure, in room that is kept for them."""
    heading = figure.text(0.008, 1.0 - 0.05 / figure.get_figheight(), title, va="top", fontweight="bold")
    if heading.get_window_extent().xmax > figure.bbox.xmax:
        heading.set_text(title.replace(": ", ":\n", 1))
    title_inches = 0.25 + 0.15 * heading.get_text().count("\n") if title else 0.0
    rows = (len(handles) + columns - 1) // columns
    height = 1.0 - (title_inches + rows * 0.21) / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0.0, 0.0, 1.0, height), h_pad=0.07, w_pad=0.07)
    if handles:
        top = 1.0 - title_inches / figure.get_figheight()
        figure.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.0, top), ncols=columns,
                      columnspacing=1.6, borderaxespad=0.1)


thousands = FuncFormatter(lambda value, _: wording.number(value, 0))
