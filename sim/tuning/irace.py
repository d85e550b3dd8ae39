"""irace, the tuner: what it is given, and its process."""

import csv
import json
import os
import signal
import subprocess
import sys
import tomllib
from pathlib import Path

from target_runner import OPTION

HERE = Path(__file__).resolve().parent

# What irace asks for at least for nine parameters: five iterations, each of which takes six
# configurations or more through ten runs or more.
MINIMUM_BUDGET = 300

# The published tuning had a hundred seeds, too. No study can have these: a study's first seed is at
# most 1e15, its number of seeds at most 1e6.
SEEDS = range(2_000_000_000_000_001, 2_000_000_000_000_101)

LOG = "irace.Rdata"
START = "library(irace); invisible(irace.cmdline(c('--scenario', 'scenario.txt')))"


class TunerError(Exception):
    """irace is missing or has failed."""


def version():
    try:
        asked = subprocess.run(
            ["Rscript", "-e", "cat(as.character(packageVersion('irace')), R.version.string, sep=', ')"],
            capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise TunerError("R is not installed (Debian: r-cran-irace)") from error
    if asked.returncode != 0:
        raise TunerError("irace is not installed (Debian: r-cran-irace)")
    return asked.stdout.strip()


def ranges():
    """{"odneat.p_mate": [0.0, 1.0], ...}: whole ends make a whole parameter."""
    tables = tomllib.loads((HERE / "parameters.toml").read_text(encoding="utf-8"))
    return {f"{table}.{name}": ends for table, keys in tables.items() for name, ends in keys.items()}


def parameter_table():
    """The ranges as irace reads them: name, text before the value, type, ends."""
    lines = []
    for key, (low, high) in ranges().items():
        kind = "i" if isinstance(low, int) and isinstance(high, int) else "r"
        lines.append(f'{key} "{OPTION}{key}=" {kind} ({low}, {high})\n')
    return "".join(lines)


def _scenario(entries):
    """A scenario file; numbers and texts are written in R as in JSON."""
    common = (HERE / "scenario.txt").read_text(encoding="utf-8")
    return common + "".join(f"{name} = {json.dumps(value)}\n" for name, value in entries.items())


class Irace:
    """One process of irace with its target runners; its words go to irace.log in the folder."""

    def __init__(self, folder, *, budget, seed, threads, inherited):
        """`inherited`: a file descriptor that stays open until the last of the processes has ended."""
        (folder / "parameters.txt").write_text(parameter_table(), encoding="utf-8")
        (folder / "seeds.txt").write_text("".join(f"{seed}\n" for seed in SEEDS), encoding="utf-8")
        (folder / "scenario.txt").write_text(_scenario({
            "parameterFile": "parameters.txt", "trainInstancesDir": "", "trainInstancesFile": "seeds.txt",
            "targetRunner": str(HERE / "target_runner.py"), "targetRunnerLauncher": sys.executable,
            "targetRunnerLauncherArgs": '-B "{targetRunner}" {targetRunnerArgs}', "logFile": LOG,
            "maxExperiments": budget, "seed": seed, "parallel": threads}), encoding="utf-8")
        self._folder = folder
        with open(folder / "irace.log", "w", encoding="utf-8") as output:
            self._process = subprocess.Popen(
                ["Rscript", "-e", START], cwd=folder, stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT, start_new_session=True, pass_fds=[inherited])

    def wait(self, seconds):
        """The exit status, or None where it still runs after that time."""
        try:
            return self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None

    def stop(self):
        """Ends irace and the runs in progress, not those of others."""
        if self._process.poll() is None:
            os.killpg(self._process.pid, signal.SIGTERM)
            self._process.wait()

    def elites(self):
        """Configurations, best first, {"odneat.p_mate": 0.2, ...}; and the number of runs used."""
        table = self._folder / "elites.csv"
        asked = subprocess.run(["Rscript", str(HERE / "elites.R"), str(self._folder / LOG), str(table)],
                               capture_output=True, text=True, check=False)
        if asked.returncode != 0:
            raise TunerError(f"irace's log cannot be read: {asked.stderr.strip()}")
        with open(table, encoding="utf-8", newline="") as lines:
            elites = [{key: type(ranges()[key][0])(text) for key, text in row.items()}
                      for row in csv.DictReader(lines)]
        return elites, int(asked.stdout)
