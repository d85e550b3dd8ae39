"""The groups of arms that a study sets side by side: their arms, named by what tells them apart."""

import re
from dataclasses import dataclass
from pathlib import Path

import palette
import wording


@dataclass(frozen=True)
class Arm:
    """An arm, its place in the group and its numbers."""

    name: str  # as the study file gives it
    source: str
    levels: tuple  # by factor
    treatment: str  # label of what is compared; empty where the arms differ in conditions only
    condition: str  # label of what it is compared under; empty where that is the same for all
    numbers: dict  # of the comparison's arm
    look: palette.Look

    @property
    def label(self):
        return ", ".join(filter(None, (self.treatment, self.condition)))


class Group:
    """A group of report.json with what figures and page need of it."""

    def __init__(self, node, data, identifier, parameters):
        self.node = node  # knows where its numbers stand
        self.plain = node.plain()
        self.identifier = identifier
        self.parameters = parameters  # the set, where that tells the group from another
        self.task = self.plain["task"]
        self.factors = self.plain["factors"]
        self.settings = data["comparisons"][self.plain["arms"][0]["comparison"]].plain()["settings"]
        self.arms = [self._arm(entry, data) for entry in self.plain["arms"]]
        self.baseline_of, self.contrast_of = {}, {}
        for kind in ("condition_contrasts", "treatment_contrasts"):  # the latter prevail
            for row in self.plain[kind]:
                self.baseline_of[row["arm"]] = row["baseline"]
                self.contrast_of[row["arm"]] = row

    def _arm(self, entry, data):
        numbers = data["comparisons"][entry["comparison"]]["arms"][entry["arm"]].plain()
        of_treatment, of_condition = [], []
        if self.plain["baseline_source"] is not None:
            of_treatment.append(wording.SOURCES[entry["source"]])
        for factor, level in zip(self.factors, entry["levels"]):
            (of_treatment if factor["treatment"] else of_condition).append(level_label(factor, level))
        return Arm(entry["name"], entry["source"], tuple(entry["levels"]), ", ".join(of_treatment),
                   ", ".join(of_condition), numbers, self._look(entry))

    def _look(self, entry):
        if self.plain["baseline_source"] is not None:
            return palette.SOURCES[entry["source"]]
        position = 0
        for factor, level in zip(self.factors, entry["levels"]):
            if factor["treatment"]:
                position = position * len(factor["levels"]) + level
        return palette.other(position)

    @property
    def title(self):
        """As in 'navigation, profile mended'."""
        words = [wording.TASKS[self.task], f"profile {self.plain['profile']}"]
        if self.parameters:
            words.append(f"set {self.parameters}")
        return ", ".join(words)

    @property
    def runs(self):
        """As in '256 runs' or '3 to 64 runs', for each arm."""
        counts = sorted({arm.numbers["runs"] for arm in self.arms})
        if counts[0] == counts[-1]:
            return f"{counts[0]} run{'s' if counts[0] > 1 else ''}"
        return f"{counts[0]} to {counts[-1]} runs"

    @property
    def conditions(self):
        """The positions of the arms by their condition, in the order of the arms."""
        result = {}
        for position, arm in enumerate(self.arms):
            result.setdefault(arm.condition, []).append(position)
        return result

    @property
    def varied_keys(self):
        return {key for factor in self.factors for key in (factor["key"], *factor["linked_keys"])}

    def is_baseline(self, position):
        return position in self.baseline_of.values()

    def setting(self, key):
        return next(entry["value"] for entry in self.settings if entry["key"] == key)


def factor_name(factor):
    """As in 'drift' of timestamp.drift_ppm: the unit stands with the value."""
    name = factor["key"].rpartition(".")[2]
    for suffix in ("_px", "_cycles", "_ppm", "_deg"):
        name = name.removesuffix(suffix)
    return name.replace("_", " ")


def unit_of(factor):
    """Units that say more than the factor's name does."""
    return factor["unit"] if factor["key"].endswith(("_px", "_cycles", "_ppm", "_deg")) else ""


def axis_label(factor):
    unit = unit_of(factor)
    name = factor_name(factor)
    return f"{name[:1].upper()}{name[1:]}{f' ({unit})' if unit else ''}"


def level_value(factor, level):
    """The value of a level, as a reader writes it; without the unit."""
    value = factor["levels"][level][0]
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else wording.quantity(value)


def level_label(factor, level):
    if not factor["numeric"]:
        value = level_value(factor, level)
        return f"{factor_name(factor)} {value}" if value in ("yes", "no") else value
    unit = unit_of(factor)
    return f"{factor_name(factor)} {level_value(factor, level)}{f' {unit}' if unit else ''}"


def percent(share):
    return f"{wording.quantity(round(100 * share, 6))}\u202f%"


def by_baseline(rows):
    """The rows of a table of contrasts with the same baseline: (its position, rows), in order."""
    result = {}
    for row in rows:
        result.setdefault(int(row["baseline"]), []).append(row)
    return list(result.items())


def by_verdict(group, rows):
    """The arms of contrasts by what was found: (verdict, labels); many of a kind are counted."""
    many = 9
    for verdict in wording.VERDICTS:
        labels = [group.arms[row["arm"]].label for row in rows if row["verdict"] == verdict]
        if len(labels) > many:
            yield verdict, [f"{len(labels)} of {len(rows)} arms"]
        elif labels:
            yield verdict, labels


def read_groups(data):
    """All groups, each with an identifier of its own that files and anchors are named by."""
    groups, taken = [], set()
    kinds = [(node["task"], node["profile"]) for node in data["groups"]]
    for node in data["groups"]:
        profile = Path(node["profile"]).stem
        is_split = kinds.count((node["task"], node["profile"])) > 1
        parameters = node["parameters"] if is_split else ""
        stem = "-".join(filter(None, (node["task"], profile, parameters)))
        stem = re.sub(r"[^A-Za-z0-9]+", "-", stem).strip("-")
        identifier, count = stem, 1
        while identifier in taken:
            count += 1
            identifier = f"{stem}-{count}"
        taken.add(identifier)
        groups.append(Group(node, data, identifier, parameters))
    return groups
