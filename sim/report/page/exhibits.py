"""The paper's figures, one by one: what each shows, its file, its caption, its text in words."""

from dataclasses import dataclass
from pathlib import Path

from markupsafe import Markup

import figures
import wording
from inline_svg import inline

TASKS = ("navigation", "collection")


@dataclass(frozen=True)
class Figure:
    """A drawn figure, ready for the page."""

    identifier: str  # unique on the page, and the anchor to it
    number: int  # in the paper
    task: str  # both tasks: empty
    title: str
    caption: Markup
    svg: Markup
    path: str  # of the SVG file, from the page, without its suffix


@dataclass(frozen=True)
class Part:
    """The comparisons that repeat the paper with one profile, in one of its two readings."""

    identifier: str
    role: str
    profile: str
    comparisons: dict  # by task
    figures: list

    def exhibit(self, task, identifier):
        """What the data say about one exhibit of one task; none where the task was not run."""
        if task not in self.comparisons:
            return None
        return next(entry for entry in self.comparisons[task]["exhibits"]
                    if entry["id"] == identifier)


MEASURE_PANELS = (
    ("f_c", "$f_c$: average accumulated swarm fitness", "Energy", False),
    ("f_b", "$f_b$: fixed budget swarm fitness", "Energy", False),
    ("t_f", "$t_f$: time to reach target", "Control cycles", True),
    ("f_a", "$f_a$: accumulated fitness above target", "Energy, sum over samples", True),
)

CURVE_WORDS = Markup("Lines: median over the runs; bands: middle half. Right: middle half and median "
                     "of our runs, and those published. ")


def parts(data, groups, folder):
    """The parts of the report in reading order; draws their figures below `folder`."""
    grouped = {}
    for comparison in _paper_comparisons(data, groups):
        key = (comparison["role"], comparison["profile"])
        grouped.setdefault(key, {}).setdefault(comparison["task"], comparison)
    order = list(wording.ROLES)
    result = []
    for role, profile in sorted(grouped, key=lambda key: order.index(key[0])):
        identifier = role if (role, profile) == first_of(grouped, role) else f"{role}-{Path(profile).stem}"
        part = Part(identifier, role, profile, grouped[role, profile], [])
        (folder / identifier).mkdir(parents=True, exist_ok=True)
        part.figures.extend(_draw(part, folder))
        result.append(part)
    return result


def first_of(grouped, role):
    return next(key for key in grouped if key[0] == role)


def _paper_comparisons(data, groups):
    """Those with the paper's parameters and markings, unless the study varies other settings."""
    for group in groups:
        comparison = data["comparisons"][group.plain["arms"][0]["comparison"]]
        if (not group.factors and comparison["role"] in wording.ROLES
                and any(arm.source in wording.PAPER_SOURCES for arm in group.arms)):
            yield comparison


def is_paper(groups):
    """Whether a study is of nothing but the paper's markings, so that its exhibits come first."""
    return all(not group.factors and arm.source in wording.PAPER_SOURCES
               for group in groups for arm in group.arms)


def _plain(part, task):
    """A comparison's numbers, of the paper's two markings alone."""
    plain = part.comparisons[task].plain()
    return {**plain, "arms": [arm for arm in plain["arms"] if arm["source"] in wording.PAPER_SOURCES]}


def _draw(part, folder):
    """Draws the figures in the paper's order."""
    for kind in (_fitness, _measures, _species, _size):
        for task in TASKS:
            if task in part.comparisons:
                yield kind(part, task, folder)
    yield _sizes(part, folder)


def _fitness(part, task, folder):
    plain = _plain(part, task)
    figure = figures.draw_curves(
        plain, _cycles(plain), "swarm_fitness", "Swarm fitness $F_s$ (energy)", "final_swarm_fitness",
        "last sample", _ranges(part, task, 3), top=_setting(plain, "odneat.energy_maximum"))
    return _finish(part, folder, figure, 3, task, "swarm-fitness", "Swarm fitness over time",
                   CURVE_WORDS + Markup("The markers at cycle 10\u202f000 are the reference system's."),
                   _curve_text(plain, "swarm_fitness", 1))


def _measures(part, task, folder):
    plain = _plain(part, task)
    figure = figures.draw_measures(plain, MEASURE_PANELS, _ranges(part, task, 5))
    caption = ("Boxes: quartiles and median; whiskers: the farthest run within 1.5 times the "
               "box; points: single runs. A <i>t<sub>f</sub></i> at the end of the run means that the "
               "target was never reached. Beside the boxes of <i>f<sub>c</sub></i>: median and "
               "middle half of the reference system.")
    return _finish(part, folder, figure, 5, task, "measures", "The four measures",
                   Markup(caption), _box_text(plain, [panel[0] for panel in MEASURE_PANELS]))


def _species(part, task, folder):
    plain = _plain(part, task)
    figure = figures.draw_curves(
        plain, _cycles(plain), "species", "Species in a local population", "species",
        _share_label(plain), _ranges(part, task, 7))
    return _finish(part, folder, figure, 7, task, "species", "Number of species over time",
                   CURVE_WORDS, _curve_text(plain, "species", 2))


def _size(part, task, folder):
    plain = _plain(part, task)
    figure = figures.draw_curves(
        plain, _cycles(plain), "controller_size", "Neurons and connections", "controller_size",
        _share_label(plain), _size_ranges(part, task))
    return _finish(part, folder, figure, 9, task, "controller-size", "Controller size over time",
                   CURVE_WORDS + _added_words(plain), _curve_text(plain, "controller_size", 2))


def _sizes(part, folder):
    panels = [(_plain(part, task), wording.TASKS[task].capitalize(),
               _size_ranges(part, task)) for task in TASKS if task in part.comparisons]
    caption = Markup("Mean size over the last part of each run, which <i>f<sub>c</sub></i> is taken "
                     "over, too. Beside the boxes: what was published, as in the curves above.")
    text = " ".join(_box_text(panel[0], ["controller_size"]) for panel in panels)
    return _finish(part, folder, figures.draw_sizes(panels), 11, "", "controller-sizes",
                   "Controller size", caption, text)


def _finish(part, folder, figure, number, task, name, title, caption, text):
    """Saves a figure and makes it ready. `number` is the one for navigation."""
    number += task == "collection"
    stem = f"figure-{number:02}-{task + '-' if task else ''}{name}"
    path = folder / part.identifier / stem
    figures.save(figure, path)
    identifier = f"{part.identifier}-figure-{number}"
    svg = inline(path.with_suffix(".svg").read_text(encoding="utf-8"), identifier,
                 f"{title}{', ' + wording.TASKS[task] if task else ''}. {text}")
    return Figure(identifier, number, task, title, caption, Markup(svg),
                  f"{folder.name}/{part.identifier}/{stem}")


def _ranges(part, task, number):
    number += task == "collection"
    return part.exhibit(task, f"figure-{number}").plain()["ranges"]


def _size_ranges(part, task):
    """The published additions as sizes: the initial controller counted in."""
    initial = part.comparisons[task].plain()["arms"][0]["initial_controller_size"]
    shifted = []
    for entry in _ranges(part, task, 9):
        moved = {key: None if entry[key] is None else entry[key] + initial
                 for key in ("lower", "median", "upper")}
        shifted.append({**entry, **moved, "measure": "controller_size"})
    return shifted


def _added_words(comparison):
    initial = wording.number(comparison["arms"][0]["initial_controller_size"], 0)
    return Markup(f"Published additions stand above the initial {initial} elements.")


def _share_label(comparison):
    share = wording.number(100 * _setting(comparison, "measures.accumulated_share"), 0)
    return f"last {share} %"


def _setting(comparison, key):
    return next(entry["value"] for entry in comparison["settings"] if entry["key"] == key)


def _cycles(comparison):
    return _setting(comparison, "run.cycles")


def _curve_text(comparison, curve, decimals):
    sentences = []
    for arm in comparison["arms"]:
        medians = arm["curves"][curve]["median"]
        middle = len(medians) // 2
        at = [f"{wording.number(medians[i], decimals)} at cycle {wording.number(arm['cycles'][i], 0)}"
              for i in (0, middle, -1)]
        sentences.append(f"{wording.SOURCES[arm['source']]}: median {at[0]}, {at[1]}, {at[2]}.")
    return " ".join(sentences)


def _box_text(comparison, measures):
    sentences = []
    for measure in measures:
        decimals = wording.MEASURES[measure][3]
        for arm in comparison["arms"]:
            summary = arm["measures"][measure]
            low, median, high = (wording.number(summary[key], decimals)
                                 for key in ("lower_quartile", "median", "upper_quartile"))
            sentences.append(f"{wording.SOURCES[arm['source']]}, {measure.replace('_', ' ')}: "
                             f"median {median}, middle half {low} to {high}.")
    return " ".join(sentences)
