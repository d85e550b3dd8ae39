#!/usr/bin/env python3
"""Tunes odNEAT's parameters with irace, as the paper did (section 4.1)."""

import argparse
import datetime
import fcntl
import json
import os
import shlex
import signal
import statistics
import sys
import time
from pathlib import Path

import elites_study
import irace
import target_runner
from run_record import open_record
from simulator import InputError, Simulator, flat

ROOT = Path(__file__).resolve().parents[2]
EXIT_FAILURE, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 1, 2, 130

# The published tuning took its cost, minus f_c, from the last 8 % of a run; --set changes it.
COST_SETTING = "measures.accumulated_share=0.08"

EPILOG = """\
The same command again goes on where a tuning was stopped, by Ctrl-C or a power cut.

Examples:
  ./run tune --task navigation --source timestamp
  ./run tune --task collection --source gene-clock --seed 2 --threads 1
  gene-clocks study results/tuning/navigation-timestamp-mended-1200-1/elites.toml
"""


def whole(low, high):
    def read(text):
        value = int(text)
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text} is not between {low} and {high}")
        return value
    read.__name__ = "whole number"
    return read


def read_arguments(words):
    parser = argparse.ArgumentParser(prog="./run tune", description=__doc__, epilog=EPILOG,
                                     allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--task", required=True, help="navigation or collection")
    parser.add_argument("--source", default="gene-clock",
                        help="what marks new genes, as for `gene-clocks run` (gene-clock)")
    parser.add_argument("--profile", default="mended",
                        help="where the settings start: a built-in profile, or a .toml file (mended)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="assignments",
                        help="changes one setting that is not tuned; may be repeated")
    parser.add_argument("--budget", type=whole(irace.MINIMUM_BUDGET, 1_000_000), default=1200, metavar="N",
                        help=f"number of runs, {irace.MINIMUM_BUDGET} or more (1200, the paper's)")
    parser.add_argument("--seed", type=whole(1, 2**31 - 1), default=1, metavar="N",
                        help="of irace's own draws (1)")
    parser.add_argument("--threads", type=whole(1, 1024), default=len(os.sched_getaffinity(0)), metavar="N",
                        help="runs made at a time (one for each processor)")
    parser.add_argument("--folder", type=Path, help="for the results (results/tuning/...)")
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/gene-clocks",
                        help="gene-clocks, where it is not build/release/gene-clocks")
    return parser.parse_args(words)


def absolute(name):
    """Names of files count from where the command was given, not from where irace works."""
    return os.path.abspath(name) if name.endswith(".toml") else name


class Tuning:
    """What is tuned, checked; nothing is written."""

    def __init__(self, arguments):
        self.task, self.source = arguments.task, arguments.source
        self.profile = absolute(arguments.profile)
        self.budget, self.seed = arguments.budget, arguments.seed
        start = ["--task", self.task, "--source", self.source, "--profile", self.profile]
        own = [word for text in arguments.assignments for word in ("--set", self._assignment(text))]
        self.simulator = Simulator(arguments.program.resolve(),
                                   [*start, "--set", COST_SETTING, *own])
        self.settings = self.simulator.settings()
        published = flat(Simulator(arguments.program.resolve(), start).settings())
        self.changed_settings = {key: value for key, value in flat(self.settings).items()
                                 if value != published[key] and not key.startswith("measures.")}
        for end in (0, 1):
            self.simulator.settings(*(word for key, ends in irace.ranges().items()
                                      for word in ("--set", f"{key}={ends[end]}")))
        name = "-".join([self.task, self.source, Path(self.profile).stem, str(self.budget), str(self.seed)])
        self.folder = (arguments.folder or ROOT / "results/tuning" / name).resolve()
        self.identity = self._identity()

    @staticmethod
    def _assignment(text):
        key, equals, value = text.partition("=")
        if key in irace.ranges():
            raise InputError(f"--set {text}: {key} is tuned")
        return key + equals + absolute(value)

    def _identity(self):
        """All that the outcome depends on."""
        tuned = {"parameters": irace.ranges(), "seeds": [irace.SEEDS.start, irace.SEEDS.stop],
                 "scenario": (irace.HERE / "scenario.txt").read_text(encoding="utf-8")}
        return {"settings": self.settings, "budget": self.budget, "seed": self.seed, "irace": tuned,
                "irace_version": irace.version(), "program_version": self.simulator.version(),
                "trajectory_hash": self.simulator.probe()}


def lay_out(tuning):
    """Makes the folder, or sees that the one that is there is of the same tuning. Returns its lock."""
    tuning.folder.mkdir(parents=True, exist_ok=True)
    lock = take_lock(tuning.folder)
    place = tuning.folder / "tuning.json"
    if place.exists():
        earlier = json.loads(place.read_text(encoding="utf-8"))
        different = [key for key, value in tuning.identity.items() if earlier.get(key) != value]
        if different:
            raise InputError(f"{tuning.folder}: holds a tuning with another {' and '.join(different)}; "
                             "choose another --folder, or delete this one")
    write(place, json.dumps(tuning.identity, indent=2) + "\n")
    write(tuning.folder / target_runner.TARGET, json.dumps(tuning.simulator.run_command()) + "\n")
    (tuning.folder / target_runner.FAILURE).unlink(missing_ok=True)
    return lock


def take_lock(folder):
    """A descriptor that irace and its runs inherit: the folder is in use until the last has ended."""
    lock = os.open(folder / "lock", os.O_CREAT | os.O_RDWR)
    for _ in range(50):  # those of a tuning that was just stopped may need a moment to end
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return lock
        except BlockingIOError:
            time.sleep(0.1)
    raise InputError(f"{folder}: a tuning is at work in it")


def write(path, text):
    """All of it or nothing."""
    unfinished = path.with_name(path.name + ".unfinished")
    unfinished.write_text(text, encoding="utf-8")
    unfinished.replace(path)


class Progress:
    """Tells how far a tuning is: a line that is written over on a terminal, else one for each tenth."""

    def __init__(self, budget, finished):
        self._budget, self._at_start, self._told = budget, finished, None
        self._start = time.monotonic()
        self._is_watched = sys.stderr.isatty()

    def tell(self, finished):
        if finished == self._told or not self._is_watched and not self._is_due(finished):
            return
        self._told = finished
        passed = time.monotonic() - self._start
        text = f"{finished} of {self._budget} runs, {clock(passed)}"
        if finished > self._at_start:
            left = max(0, self._budget - finished) * passed / (finished - self._at_start)
            text += f", about {clock(left)} left"
        print(f"\r\033[K{text}" if self._is_watched else text, end="" if self._is_watched else "\n",
              file=sys.stderr, flush=True)

    def end(self):
        if self._is_watched and self._told is not None:
            print(file=sys.stderr)

    def _is_due(self, finished):
        return self._told is None or finished * 10 // self._budget > self._told * 10 // self._budget


def clock(seconds):
    return str(datetime.timedelta(seconds=round(seconds)))


def race(tuning, threads, lock):
    """Runs irace to its end, or goes on with it. Returns it."""
    with open_record(tuning.folder / target_runner.RECORD) as record:
        progress = Progress(tuning.budget, record.count())
        progress.tell(record.count())
        tuner = irace.Irace(tuning.folder, budget=tuning.budget, seed=tuning.seed, threads=threads,
                            inherited=lock)
        try:
            while (status := tuner.wait(1)) is None:
                progress.tell(record.count())
            progress.tell(record.count())
        finally:
            tuner.stop()
            progress.end()
    failure = tuning.folder / target_runner.FAILURE
    if failure.exists():
        raise irace.TunerError(f"a run failed: {failure.read_text(encoding='utf-8').strip()}")
    if status != 0:
        log = tuning.folder / "irace.log"
        words = log.read_text(encoding="utf-8", errors="replace").splitlines()[-5:]
        raise irace.TunerError("\n".join([f"irace failed (see {log}):", *words]))
    return tuner


def write_elites(tuning, tuner, words):
    """Writes elites.toml and returns what to say about it, as lines."""
    elites, used = tuner.elites()
    table = []
    with open_record(tuning.folder / target_runner.RECORD) as record:
        for rank, elite in enumerate(elites, 1):
            values = record.values_of(elite)
            parameters = " ".join(f"{key.removeprefix('odneat.')}={value}" for key, value in elite.items())
            table.append(f"elite-{rank}: mean f_c {statistics.fmean(values):.2f} of {len(values)} runs; "
                         f"{parameters}")
        cost = f"{used} runs used, {record.count()} made, {clock(record.cpu_seconds())} of processor time"
    comment = [
        f"Elite configurations of irace, best first: {tuning.task}, {tuning.source}.",
        "",
        *table,
        "",
        "f_c as the tuner saw it, over the last "
        f"{100 * tuning.settings['measures']['accumulated_share']:g} % of a run; it flatters, since the",
        "elites were chosen by it. To see what they are worth, on seeds that the tuning has not seen:",
        "  gene-clocks study elites.toml",
        "",
        f"Made by: {shlex.join(['./run', 'tune', *words])}",
        f"budget {tuning.budget}, seed {tuning.seed}, irace {tuning.identity['irace_version']}, "
        f"gene-clocks {tuning.identity['program_version']}",
        cost,
    ]
    text = elites_study.study_text(tuning.task, tuning.source, tuning.profile, tuning.changed_settings,
                                   elites, comment)
    study = tuning.folder / "elites.toml"
    write(study, text)
    try:
        tuning.simulator.ask(["study", str(study), "--dry-run"])
    except InputError as error:
        raise irace.TunerError(f"a study that cannot be read was written: {error}") from error
    return [*table, cost, f"Study of the elites: {study}"]


def tune(words):
    arguments = read_arguments(words)
    tuning = Tuning(arguments)
    lock = lay_out(tuning)
    print(f"Tuning in {tuning.folder}", file=sys.stderr)
    tuner = race(tuning, arguments.threads, lock)
    for line in write_elites(tuning, tuner, words):
        print(line)


def main(words):
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        tune(words)
    except KeyboardInterrupt:
        print("Stopped; the same command goes on from here.", file=sys.stderr)
        return EXIT_INTERRUPTED
    except InputError as error:
        print(f"tune: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except (irace.TunerError, OSError) as error:
        print(f"tune: {error}", file=sys.stderr)
        return EXIT_FAILURE
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
