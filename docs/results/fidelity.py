#!/usr/bin/env python3
"""Writes the tables of ../deviations.md: every figure of the paper and of its reference beside ours.

    fidelity.py             writes the tables in their places
    fidelity.py --check     only looks whether the page says what the data say; fails where it does not
    fidelity.py --record FOLDER...
                            enters what `./run reproduce --as-printed` wrote: FOLDER/report.json
"""

import argparse
import csv
import json
import pathlib
import sys

from tables import Unfit, number, read, table, with_tables

HERE = pathlib.Path(__file__).resolve().parent
PAGE = HERE.parent / "deviations.md"
COLUMNS = ("task", "parameters", "origin", "source", "measure", "lower", "median", "upper", "ours",
           "ours_lower", "ours_upper", "runs")
MEASURES = {  # name and decimals
    "f_c": ("f_c", 1), "swarm_fitness_at_10000": ("F_s at cycle 10 000", 1),
    "final_swarm_fitness": ("F_s at the end", 1), "species": ("species", 2),
    "added_elements": ("added elements", 2)}
SOURCES = {"gene-clock": "Gene Clocks", "timestamp": "timestamps"}


def rows_of(report):
    """A row for each published range that our runs can be judged by."""
    for comparison in report["comparisons"]:
        arms = {arm["source"]: arm for arm in comparison["arms"]}
        seen = set()  # some ranges stand in more than one figure of the paper
        for exhibit in comparison["exhibits"]:
            for judged in exhibit["ranges"]:
                key = (judged["origin"], judged["source"], judged["measure"])
                if key in seen or judged["ours"] is None:
                    continue
                seen.add(key)
                summary = arms[judged["source"]]["measures"][judged["measure"]]
                yield {"task": comparison["task"], "parameters": comparison["parameters"],
                       "origin": judged["origin"], "source": judged["source"],
                       "measure": judged["measure"], "lower": judged["lower"],
                       "median": "" if judged["median"] is None else judged["median"],
                       "upper": judged["upper"], "ours": summary["median"],
                       "ours_lower": summary["lower_quartile"],
                       "ours_upper": summary["upper_quartile"], "runs": summary["count"]}


def record(folders):
    rows = [row for folder in folders
            for row in rows_of(json.loads((pathlib.Path(folder) / "report.json").read_text("utf-8")))]
    rows = list({tuple(row[key] for key in COLUMNS[:5]): row for row in rows}.values())
    rows.sort(key=lambda row: tuple(row[key] for key in COLUMNS[:5]))
    with (HERE / "data/fidelity.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def is_outside(row):
    return not float(row["lower"]) <= float(row["ours"]) <= float(row["upper"])


def span(row, decimals, prefix=""):
    """Median and middle half; the range alone where no median is known."""
    low, high = (number(float(row[prefix + key]), decimals) for key in ("lower", "upper"))
    middle = row["ours"] if prefix else row["median"]
    return f"{number(float(middle), decimals)} ({low}–{high})" if middle else f"{low}–{high}"


def figures(task, parameters):
    """Every figure of a task and parameter set, for both methods."""
    def cells():
        rows = [row for row in read("fidelity.csv")
                if (row["task"], row["parameters"]) == (task, parameters)]
        rows.sort(key=lambda row: (list(MEASURES).index(row["measure"]), row["origin"],
                                   list(SOURCES).index(row["source"])))
        if not rows:
            raise Unfit(f"data/fidelity.csv: nothing about {task} with set {parameters}")
        return table(rows, [
            ("measure", lambda row: MEASURES[row["measure"]][0]),
            ("method", lambda row: SOURCES[row["source"]]),
            ("here", lambda row: span(row, MEASURES[row["measure"]][1], "ours_")),
            ("published by", lambda row: row["origin"]),
            ("its figure", lambda row: span(row, MEASURES[row["measure"]][1])),
            ("our median", lambda row: "**outside**" if is_outside(row) else "within")])
    return cells


AS_RUN = {"navigation": "B", "collection": "C"}  # the sets that the published runs had


def outside():
    """How many figures lie outside, and which."""
    parts = []
    for words, is_as_run in (("As it was run", True), ("As printed", False)):
        rows = [row for row in read("fidelity.csv")
                if (AS_RUN[row["task"]] == row["parameters"]) == is_as_run]
        names = [f"- {MEASURES[row['measure']][0]} in {row['task']}, {SOURCES[row['source']]}: "
                 f"{number(float(row['ours']), MEASURES[row['measure']][1])}, where the "
                 f"{row['origin']} has {span(row, MEASURES[row['measure']][1])}"
                 for row in rows if is_outside(row)]
        parts.append("\n".join([f"{words}, {len(names)} of {len(rows)} figures lie outside:", "",
                                *names]))
    return "\n\n".join(parts)


TABLES = {"outside": outside, "navigation B": figures("navigation", "B"),
          "collection C": figures("collection", "C"), "navigation A": figures("navigation", "A"),
          "collection B": figures("collection", "B")}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="change nothing, only compare")
    parser.add_argument("--record", nargs="+", metavar="FOLDER", help="enter these reports' figures")
    arguments = parser.parse_args()
    try:
        if arguments.record:
            record(arguments.record)
            return
        old, new = with_tables(PAGE, TABLES)
    except (OSError, Unfit, KeyError, ValueError) as error:
        sys.exit(f"fidelity.py: {error}")
    if arguments.check and old != new:
        sys.exit(f"fidelity.py: {PAGE.name} does not say what the data say; run fidelity.py")
    if not arguments.check and old != new:
        PAGE.write_text(new, encoding="utf-8")


if __name__ == "__main__":
    main()
