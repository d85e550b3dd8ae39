#!/usr/bin/env python3
"""Breaks the code on purpose, in many small ways, and sees that a test notices each.

Every fault of faults.txt and of proofs/kernel/slips.txt is made in a copy of the sources, which is
built and tested until the first test fails: first the one that is meant to notice it, then others,
last the golden trajectories. A fault that none notices, or that no longer fits the sources, makes
this fail; so does one that only a changed trajectory tells, or another test than the list names,
unless the list says so. A run that was interrupted goes on where it stopped.
"""

import argparse
import collections
import difflib
import json
import pathlib
import signal
import sys
import time
from dataclasses import replace

import faults
import plan
from workshop import Failed, Verdict, Workshop, digest

ROOT = pathlib.Path(__file__).resolve().parents[2]
KERNEL = "protocol/include/gene_clocks/kernel.h"
# Quick to compile; assertions are on, also those of the standard library. A warning is no test.
OPTIONS = [
    "-DCMAKE_BUILD_TYPE=",
    "-DCMAKE_C_FLAGS=-O1 -fmax-errors=1",
    "-DCMAKE_CXX_FLAGS=-O1 -fmax-errors=1 -D_GLIBCXX_ASSERTIONS",
    "-DGENE_CLOCKS_WARNINGS_AS_ERRORS=OFF",
    "-DGENE_CLOCKS_BUILD_BENCH=OFF",
]


def every_fault():
    own = pathlib.Path(__file__).with_name("faults.txt")
    reasons = faults.reasons(own)
    everything = [replace(slip, equivalent=reasons.pop(slip.name, ""))
                  for slip in faults.read(ROOT / "proofs/kernel/slips.txt", KERNEL)]
    if reasons:
        raise faults.BrokenList(f"{own.name}: there is no slip {', '.join(reasons)}")
    everything += faults.read(own)
    faults.check(everything, ROOT)
    return everything


def choose(everything, words):
    """The faults whose names begin with one of the words; all that can be noticed without words."""
    if not words:
        return [fault for fault in everything if not fault.equivalent]
    for word in words:
        if not any(fault.name.startswith(word) for fault in everything):
            near = difflib.get_close_matches(word, [fault.name for fault in everything], 1, 0.4)
            raise faults.BrokenList(
                f"no fault begins with '{word}'" + (f"; did you mean '{near[0]}'?" if near else ""))
    return [fault for fault in everything if fault.name.startswith(tuple(words))]


class Record:
    """What was found so far, for a run that is interrupted and goes on."""

    def __init__(self, path, key):
        self.path, self.key, self.verdicts = path, key, {}
        try:
            known = json.loads(path.read_text())
        except (OSError, ValueError):
            return
        if known.get("key") == key:
            self.verdicts = {name: Verdict(*verdict) for name, verdict in known["verdicts"].items()}

    def add(self, name, verdict):
        self.verdicts[name] = verdict
        content = {name: (v.outcome, v.link, v.by, v.is_meant) for name, v in self.verdicts.items()}
        fresh = self.path.with_suffix(".new")
        fresh.write_text(json.dumps({"key": self.key, "verdicts": content}))
        fresh.replace(self.path)


def table(chosen, verdicts):
    """How many faults of each file each link noticed."""
    links = list(dict.fromkeys(["compiler", *(step.link for step in plan.EVERY_STEP)]))
    counts = collections.defaultdict(collections.Counter)
    for fault in chosen:
        counts[fault.file][verdicts[fault.name].link or verdicts[fault.name].outcome] += 1
    columns = [link for link in links if any(count[link] for count in counts.values())]
    rows = [["noticed by", *columns, "faults"]]
    for file, count in counts.items():
        rows.append([file, *(str(count[link] or "") for link in columns), str(count.total())])
    total = sum(counts.values(), collections.Counter())
    rows.append(["all", *(str(total[link]) for link in columns), str(total.total())])
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        yield "  ".join([row[0].ljust(widths[0]),
                         *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:]))])


def try_all(chosen, workshop, steps_for, record, say):
    """A verdict on each fault, in turn."""
    known = {fault.name for fault in chosen} & set(record.verdicts)
    if known:
        say(f"{len(known)} of {len(chosen)} are known from a run that was interrupted")
    left = [fault for fault in chosen if fault.name not in known]
    if not left:
        return
    with workshop.locked():
        started = time.monotonic()
        say(f"Control: the copy in {workshop.folder} without a fault")
        workshop.synchronise()
        workshop.configure()
        workshop.control(list(dict.fromkeys(
            step for fault in left for step in steps_for(fault))))
        say(f"Control: all tests pass ({time.monotonic() - started:.0f} s)")
        started = time.monotonic()
        for number, fault in enumerate(left, 1):
            verdict = workshop.judge(fault, steps_for(fault))
            record.add(fault.name, verdict)
            rest_s = (time.monotonic() - started) / number * (len(left) - number)
            say(f"[{len(known) + number:3}/{len(chosen)}, {rest_s / 60:3.0f} min left] "
                f"{verdict.outcome:8} {fault.name}: "
                f"{verdict.link}{', ' if verdict.link else ''}{verdict.by}"
                + (" (another)" if verdict.outcome == "killed" and not verdict.is_meant else ""))


def report(chosen, verdicts, say):
    """The table and the score; whether nothing is left to be done."""
    say("")
    for line in table(chosen, verdicts):
        say(line)
    killed = [fault for fault in chosen if verdicts[fault.name].outcome == "killed"]
    wrong, by_others = [], []
    for fault in chosen:
        verdict = verdicts[fault.name]
        outcome = verdict.outcome
        if outcome == "senseless":
            wrong.append(f"does not compile: {fault.name}: {verdict.by}")
        elif fault.equivalent and outcome == "killed":
            wrong.append(f"not equivalent, though the list says so: {fault.name}")
        elif not fault.equivalent and outcome == "survived":
            wrong.append(f"survived: {fault.name} ({fault.file}: {fault.meaning})")
        elif outcome == "killed" and not verdict.is_meant:
            if verdict.link == faults.GOLDENS:
                wrong.append(f"noticed by the golden trajectories alone: {fault.name}")
            elif fault.meant:
                wrong.append(f"noticed by {verdict.by}, not by {fault.meant}: {fault.name}")
            else:
                by_others.append(f"noticed by another than its file's tests: {fault.name}: {verdict.by}")
    say("")
    for line in by_others + wrong:
        say(line)
    meant = [fault for fault in killed if verdicts[fault.name].is_meant]
    goldens = [fault for fault in meant if fault.meant == faults.GOLDENS]
    say(f"{len(meant)} mutants noticed by the test that is meant to"
        + (f", {len(goldens)} of them by the golden trajectories, which alone can" if goldens else ""))
    say(f"{len(killed)} of {len(chosen)} mutants killed")
    return not wrong


def main(arguments):
    parser = argparse.ArgumentParser(
        prog="./run mutants", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME",
                        help="only faults whose names begin so, such as kernel.h/mint; also those that "
                             "are said to be equivalent, which must then survive")
    parser.add_argument("--list", action="store_true", help="print the faults and stop")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build" / "mutants",
                        help="folder of the copy and its build (default: build/mutants)")
    options = parser.parse_args(arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)

    def say(text):
        print(text, flush=True)

    try:
        everything = every_fault()
        chosen = choose(everything, options.names)
    except faults.BrokenList as problem:
        print(f"mutants: {problem}", file=sys.stderr)
        return 2
    if options.list:
        for fault in chosen if options.names else everything:
            say(fault.name + (f"  (equivalent: {fault.equivalent})" if fault.equivalent else ""))
        return 0
    key = f"{digest(ROOT)} {' '.join(fault.name for fault in chosen)}"
    record = Record(options.work / "record.json", key)
    try:
        try_all(chosen, Workshop(ROOT, options.work, OPTIONS), plan.steps_for, record, say)
    except Failed as problem:
        print(f"mutants: {problem}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f"mutants: interrupted after {len(record.verdicts)} of {len(chosen)}; "
              "the same command goes on from here", file=sys.stderr)
        return 130
    good = report(chosen, record.verdicts, say)
    for fault in everything:
        if fault.equivalent and fault not in chosen:
            say(f"not tried, equivalent: {fault.name}: {fault.equivalent}")
    record.path.unlink(missing_ok=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
