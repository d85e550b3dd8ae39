#!/usr/bin/env python3
"""Writes the tables of ../results.md from the files in data/, so that no number is copied by hand.

    tables.py           writes every table in its place, between <!-- table NAME --> and <!-- end -->
    tables.py --check   only looks whether the page says what the data say; fails where it does not
    tables.py --record STUDY COMMIT
                        enters a study's cost, and the commit that made it, in data/provenance.csv
    tables.py --tuning FOLDER
                        enters the runs of a finished `./run tune`, in data/tuning-TASK-SOURCE.csv
    tables.py --figures STUDY FOLDER
                        takes the figures that the page shows of a study from its report in FOLDER

data/STUDY.runs.csv is what `gene-clocks export --runs` wrote, data/STUDY.contrast.csv and
data/STUDY.paired.csv what `gene-clocks contrast` wrote with --csv and --paired-csv; `./run results`
makes all three.
"""

import argparse
import csv
import json
import pathlib
import re
import shutil
import sqlite3
import statistics
import sys

HERE = pathlib.Path(__file__).resolve().parent
PAGE = HERE.parent / "results.md"


class Unfit(Exception):
    """The page or the data are not as they must be."""


def read(name):
    path = HERE / "data" / name
    try:
        with path.open(newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    except OSError as error:
        raise Unfit(f"{path}: {error.strerror}") from error


def quantile(values, probability):
    """Hyndman and Fan's type 7, as in the reports."""
    if len(values) == 1:
        return values[0]
    return statistics.quantiles(values, n=1000, method="inclusive")[round(1000 * probability) - 1]


def number(value, decimals):
    text = f"{value:,.{decimals}f}".replace(",", "\u202f")
    return text.replace("-", "\u2212") if float(f"{value:.{decimals}f}") else text.lstrip("-")


def signed(value, decimals):
    return ("+" if value > 0 else "") + number(value, decimals)


def p_value(text):
    value = float(text)
    return "< 0.001" if value < 0.001 else f"{value:.3f}"


class Arm:
    """The runs of one arm, and how it compares with its baseline (None for a baseline)."""

    def __init__(self, name, runs, contrast):
        self.name, self.runs, self.contrast = name, runs, contrast
        self.source, self.task, self.profile = (
            runs[0][key] for key in ("source", "task", "profile"))

    def values(self, column):
        return [float(run[column]) for run in self.runs if run[column]]

    def total(self, column):
        return sum(self.values(column))

    def ratio(self, part, whole):
        """Of all runs together; None where there is nothing to divide by."""
        divisor = self.total(whole)
        return self.total(part) / divisor if divisor else None


def arms(study):
    """The arms of a study in its order."""
    rows = {row["arm"]: row for row in read(f"{study}.contrast.csv")}
    runs = {}
    for run in read(f"{study}.runs.csv"):
        runs.setdefault(run["arm"], []).append(run)
    return [Arm(name, of_arm, rows.get(name)) for name, of_arm in runs.items()]


# Columns: a heading, and what an arm has to say under it.

def median(column, decimals):
    return lambda arm: number(statistics.median(arm.values(column)), decimals)


def middle(column, decimals):
    """Median and middle half."""
    def cell(arm):
        values = arm.values(column)
        low, high = quantile(values, 0.25), quantile(values, 0.75)
        return (f"{number(statistics.median(values), decimals)} "
                f"({number(low, decimals)}–{number(high, decimals)})")
    return cell


def share(part, whole, decimals=2):
    """Per cent, over all runs together."""
    def cell(arm):
        value = arm.ratio(part, whole)
        return "–" if value is None else number(100 * value, decimals)
    return cell


def rate(part, whole, per, decimals):
    def cell(arm):
        value = arm.ratio(part, whole)
        return "–" if value is None else number(per * value, decimals)
    return cell


def of_contrast(text):
    return lambda arm: text(arm.contrast) if arm.contrast else "–"


def shift(row):
    return (f"{signed(float(row['shift']), 1)} [{signed(float(row['shift_lower']), 1)}, "
            f"{signed(float(row['shift_upper']), 1)}]")


def effect(row):
    return (f"{float(row['effect']):.2f} [{float(row['effect_lower']):.2f}, "
            f"{float(row['effect_upper']):.2f}]")


NAME = ("arm", lambda arm: f"`{arm.name}`")
SOURCE = ("marking", lambda arm: f"`{arm.source}`")
FITNESS = ("*f_c*, median (middle half)", middle("f_c", 1))
RUNS = ("runs", lambda arm: str(len(arm.runs)))
TESTS = [
    ("identical runs", of_contrast(lambda row: f"{row['identical']} of {row['pairs']}")),
    ("shift [95 %]", of_contrast(shift)),
    ("A [95 %]", of_contrast(effect)),
    ("*p* difference", of_contrast(lambda row: p_value(row["difference_p_corrected"]))),
    ("*p* equivalence", of_contrast(lambda row: p_value(row["equivalence_p_corrected"]))),
    ("verdict", of_contrast(lambda row: row["verdict"])),
]
BRIEFLY = [TESTS[0], TESTS[1], TESTS[-1]]
POWER = ("power", of_contrast(lambda row: f"{float(row['power_equivalence']):.2f}"))
ORDER = [
    ("against cause, %", share("cause_inverted", "caused_pairs")),
    ("against time, %", share("time_inverted", "timed_pairs")),
    ("within genomes, %", share("genome_inverted", "genome_pairs")),
]
COLLISIONS = [
    ("same innovation, %", share("same_collisions", "genes")),
    ("different innovations, %", share("different_collisions", "genes")),
]
HOMOLOGY = [
    ("missed homologies per alignment", rate("missed_homologies", "alignments", 1, 3)),
    ("false ones", rate("false_homologies", "alignments", 1, 3)),
]
HEARD = ("messages heard in 1000 cycles", rate("messages_received", "robot_steps", 1000, 1))
CONCURRENT = ("concurrent pairs, %",
              lambda arm: number(100 * (1 - arm.ratio("caused_pairs", "pairs")), 1))
ADDED = ("elements added", median("added_elements", 1))
UNMATCHED = ("unmatched genes per alignment",
             lambda arm: number((arm.total("disjoint") + arm.total("excess")) /
                                arm.total("alignments"), 1))
MATINGS = ("matings per 100 births", share("matings", "births", 1))
BYTES = [
    ("bytes of a broadcast", rate("bytes_sent", "messages_sent", 1, 0)),
    ("of these the stamp", rate("stamp_bytes", "messages_sent", 1, 2)),
]


def table(rows, columns):
    lines = ["| " + " | ".join(heading for heading, _ in columns) + " |",
             "|" + " --- |" * len(columns)]
    lines += ["| " + " | ".join(cell(arm) for _, cell in columns) + " |" for arm in rows]
    return "\n".join(lines)


def provenance():
    rows = read("provenance.csv")
    columns = [
        ("study", lambda row: f"`{row['study']}`"),
        ("runs", lambda row: row["runs"]),
        ("robot-steps, 10⁹", lambda row: number(float(row["robot_steps"]) / 1e9, 1)),
        ("processor time, min", lambda row: number(float(row["cpu_seconds"]) / 60, 1)),
        ("commit", lambda row: f"`{row['commit']}`"),
        ("finished", lambda row: row["finished_at"]),
    ]
    return table(rows, columns)


TABLES = {"provenance": provenance}


def tables_of(study, name, columns, tasks=("navigation", "collection"), but=None):
    """A table for each task; without the arms whose names have `but`, a pattern, in them."""
    for task in tasks:
        key = f"{name} {task}" if len(tasks) > 1 else name
        TABLES[key] = lambda task=task: table(
            [arm for arm in arms(study)
             if arm.task == task and not (but and re.search(but, arm.name))], columns)


NAVIGATION = ("navigation",)
tables_of("markings", "markings fitness", [SOURCE, FITNESS, *TESTS])
tables_of("markings", "markings order", [SOURCE, *ORDER, *COLLISIONS, *HOMOLOGY])
tables_of("markings", "markings cost", [SOURCE, MATINGS, *BYTES,
                                        ("largest counter", median("stamp_largest", 0))])
tables_of("drift", "drift", [NAME, FITNESS, *ORDER, *BRIEFLY], tasks=NAVIGATION,
          but="drift-ppm-(100|1000)$")
tables_of("loss", "loss", [NAME, FITNESS, *ORDER, *BRIEFLY], tasks=NAVIGATION)
tables_of("encounters", "encounters", [NAME, FITNESS, HEARD, CONCURRENT, ORDER[0], ORDER[2], *BRIEFLY],
          tasks=NAVIGATION)
tables_of("swarm-size", "swarm-size", [NAME, FITNESS, *ORDER, *BRIEFLY], tasks=NAVIGATION)
tables_of("reboots", "reboots", [NAME, FITNESS, *ORDER[:1], *COLLISIONS, *BRIEFLY], tasks=NAVIGATION)
tables_of("late-joiners", "late-joiners", [NAME, FITNESS, *ORDER, *BRIEFLY], tasks=NAVIGATION)
tables_of("population", "population", [NAME, FITNESS, MATINGS, *BRIEFLY], tasks=NAVIGATION)
tables_of("growth", "growth", [NAME, FITNESS, ADDED, UNMATCHED, MATINGS, *HOMOLOGY, *BRIEFLY],
          tasks=NAVIGATION)
tables_of("mating", "mating", [NAME, FITNESS, MATINGS, *HOMOLOGY, *TESTS], tasks=NAVIGATION)
tables_of("tuned", "tuned", [NAME, FITNESS, MATINGS, *TESTS])
tables_of("parents", "parents", [NAME, FITNESS, MATINGS, *TESTS])
tables_of("operators", "operators", [NAME, FITNESS, MATINGS, *TESTS])
tables_of("equal-weights", "equal-weights", [NAME, FITNESS, *BRIEFLY])
tables_of("markings-other-profiles", "other profiles", [NAME, FITNESS, *TESTS])

def tested(text):
    return lambda row: "–" if row["verdict"] == "identical" else text(row)


def paired_of(study):
    """The table "paired STUDY": what a sweep says as a whole, seed by seed."""
    rows = read(f"{study}.paired.csv")
    several_tasks = len({row["task"] for row in rows}) > 1
    several_profiles = len({row["profile"] for row in rows}) > 1
    columns = [
        ("change", lambda row: f"`{row['first_arm']}`" if row["arms"] == "1" and
         " " in row["change"] else f"`{row['change']}`"),
        ("arms × seeds", lambda row: f"{row['arms']} × {row['seeds']}"),
        ("identical runs", lambda row: number(100 * int(row["identical"]) /
                                              (int(row["arms"]) * int(row["seeds"])), 0) + " %"),
        ("baseline", lambda row: number(float(row["baseline_mean"]), 1)),
        ("difference [95 %]", lambda row: (
            f"{signed(float(row['difference']), 1)} [{signed(float(row['difference_lower']), 1)}, "
            f"{signed(float(row['difference_upper']), 1)}]")),
        ("*p* difference", tested(lambda row: p_value(row["difference_p_corrected"]))),
        ("*p* equivalence", tested(lambda row: p_value(row["equivalence_p_corrected"]))),
        ("power", tested(lambda row: f"{float(row['power_equivalence']):.2f}")),
        ("verdict", lambda row: row["verdict"]),
    ]
    if several_profiles:
        columns.insert(0, ("profile", lambda row: f"`{row['profile']}`"))
    if several_tasks:
        columns.insert(0, ("task", lambda row: row["task"]))
    return table(rows, columns)


for swept in ("drift", "drift-replication", "loss", "loss-replication", "encounters", "swarm-size", "reboots", "late-joiners", "population",
              "mating", "growth", "operators", "equal-weights", "markings-other-profiles", "tuned"):
    TABLES[f"paired {swept}"] = lambda swept=swept: paired_of(swept)

def paired_markings():
    """Seed by seed from the runs alone: 256 are enough for the normal distribution."""
    normal = statistics.NormalDist()
    rows = []
    for task in ("navigation", "collection"):
        of_task = [arm for arm in arms("markings") if arm.task == task]
        baseline = {run["seed"]: float(run["f_c"]) for run in of_task[0].runs}
        for arm in of_task[1:]:
            differences = [float(run["f_c"]) - baseline[run["seed"]] for run in arm.runs]
            mean = statistics.fmean(differences)
            error = statistics.stdev(differences) / len(differences) ** 0.5
            reach = normal.inv_cdf(0.975) * error
            p = p_value(2 * normal.cdf(-abs(mean) / error)) if error else "–"
            rows.append((task, arm.source, f"{signed(mean, 1)} [{signed(mean - reach, 1)}, "
                         f"{signed(mean + reach, 1)}]", p))
    columns = [("task", lambda row: row[0]), ("marking", lambda row: f"`{row[1]}`"),
               ("difference [95 %]", lambda row: row[2]), ("*p*, uncorrected", lambda row: row[3])]
    return table(rows, columns)


TABLES["paired markings"] = paired_markings


def tunings():
    """How far the tunings of a task for its two markings went the same way."""
    rows = []
    for task in ("navigation", "collection"):
        made = [{(run["assignments"], run["seed"]): run["f_c"] for run in read(f"tuning-{task}-{source}.csv")}
                for source in ("gene-clock", "timestamp")]
        common = made[0].keys() & made[1].keys()
        rows.append((task, *map(len, made), len(common),
                     sum(made[0][run] == made[1][run] for run in common)))
    headings = ("task", "runs for gene clocks", "for timestamps", "in common", "same *f_c*")
    return table(rows, [(heading, lambda row, i=i: str(row[i])) for i, heading in enumerate(headings)])


TABLES["tunings"] = tunings


def same_runs():
    """Markings that are the same runs as gene clocks, and as each other, seed by seed."""
    rows = []
    for task in ("navigation", "collection"):
        hashes = {arm.source: {run["seed"]: run["trajectory_hash"] for run in arm.runs}
                  for arm in arms("markings") if arm.task == task}
        for one, other in (("timestamp", "hybrid-logical-clock"),
                           ("gene-clock-no-merge", "congruence-class"), ("gene-clock", "timestamp")):
            same = sum(hashes[one][seed] == hashes[other][seed] for seed in hashes[one])
            rows.append((task, f"`{one}` and `{other}`", f"{same} of {len(hashes[one])}"))
    headings = ("task", "markings", "pairs of runs that are the same")
    return table(rows, [(heading, lambda row, i=i: row[i]) for i, heading in enumerate(headings)])


TABLES["same runs"] = same_runs


def disjoint():
    """Disjoint genes per alignment where messages are lost, over all losses."""
    rows = []
    for study in ("loss", "loss-replication"):
        for source in ("gene-clock", "gene-clock-no-merge"):
            of_source = [arm for arm in arms(study) if arm.source == source]
            counts = [sum(arm.total(column) for arm in of_source) for column in ("disjoint", "alignments")]
            rows.append((f"`{study}`", f"`{source}`", number(counts[0] / counts[1], 2)))
    headings = ("study", "marking", "disjoint genes per alignment")
    return table(rows, [(heading, lambda row, i=i: row[i]) for i, heading in enumerate(headings)])


TABLES["disjoint"] = disjoint

PROVENANCE = ("study", "runs", "robot_steps", "cpu_seconds", "commit", "finished_at")


def record(study, commit):
    runs = read(f"{study}.runs.csv")
    row = {"study": study, "runs": len(runs), "commit": commit,
           "robot_steps": sum(int(run["robot_steps"]) for run in runs),
           "cpu_seconds": round(sum(float(run["cpu_seconds"]) for run in runs), 1),
           "finished_at": max(run["finished_at"] for run in runs)}
    path = HERE / "data" / "provenance.csv"
    others = [old for old in read(path.name) if old["study"] != study] if path.exists() else []
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, PROVENANCE, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted([*others, row], key=lambda entry: entry["study"]))


def record_tuning(folder):
    folder = pathlib.Path(folder)
    selection = json.loads((folder / "tuning.json").read_text(encoding="utf-8"))["settings"]
    database = sqlite3.connect(f"file:{folder / 'runs.sqlite'}?mode=ro", uri=True)
    runs = database.execute("SELECT assignments, seed, f_c FROM run ORDER BY assignments, seed")
    path = HERE / "data" / f"tuning-{selection['task']}-{selection['source']}.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("assignments", "seed", "f_c"))
        for assignments, seed, f_c in runs:
            values = json.loads(assignments)
            text = " ".join(f"{key.removeprefix('odneat.')}={values[key]}" for key in sorted(values))
            writer.writerow((text, seed, repr(f_c)))


def take_figures(study, report):
    """FIGURE.png of the report is figures/STUDY-FIGURE.png here."""
    page = PAGE.read_text(encoding="utf-8")
    for name in sorted(set(re.findall(rf"\(results/figures/{re.escape(study)}-([^)]+)\)", page))):
        shutil.copyfile(pathlib.Path(report) / "figures" / name,
                        HERE / "figures" / f"{study}-{name}")


MARKED = re.compile(r"(<!-- table (?P<name>[^>]+?) -->\n).*?(<!-- end -->)", re.DOTALL)


def with_tables(page, tables):
    """The page's text as it is, and as it should be: with each table in its place."""
    old = page.read_text(encoding="utf-8")
    if not MARKED.search(old):
        raise Unfit(f"{page.name}: has no place for a table")

    def fill(match):
        name = match["name"]
        if name not in tables:
            raise Unfit(f"{page.name}: there is no table '{name}'; there are {', '.join(tables)}")
        return match[1] + "\n" + tables[name]() + "\n\n" + match[3]

    return old, MARKED.sub(fill, old)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="change nothing, only compare")
    parser.add_argument("--record", nargs=2, metavar=("STUDY", "COMMIT"),
                        help="enter what a study cost")
    parser.add_argument("--tuning", metavar="FOLDER", help="enter the runs of a tuning")
    parser.add_argument("--figures", nargs=2, metavar=("STUDY", "FOLDER"),
                        help="take the page's figures of a study from its report")
    arguments = parser.parse_args()
    try:
        if arguments.record:
            record(*arguments.record)
            return
        if arguments.tuning:
            record_tuning(arguments.tuning)
            return
        if arguments.figures:
            take_figures(*arguments.figures)
            return
        old, new = with_tables(PAGE, TABLES)
    except (OSError, Unfit, KeyError, ValueError, sqlite3.Error) as error:
        sys.exit(f"tables.py: {error}")
    if arguments.check:
        if old != new:
            sys.exit(f"tables.py: {PAGE.name} does not say what the data say; run tables.py")
        return
    if old != new:
        PAGE.write_text(new, encoding="utf-8")


if __name__ == "__main__":
    main()
