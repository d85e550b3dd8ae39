#!/usr/bin/env python3
"""One run for irace: target_runner.py CONFIGURATION INSTANCE SEED RUN_SEED --set=KEY=VALUE...

Started by irace in the folder of the tuning. Prints the cost, minus f_c, of the run with these settings
and that seed: from the record of runs where it is known, else by making the run. Of irace's own numbers
only RUN_SEED, the text of the instance, is used: the same settings and seed give the same run.
"""

import json
import shlex
import subprocess
import sys
from pathlib import Path

from run_record import open_record

OPTION = "--set="
RECORD = "runs.sqlite"
TARGET = "target.json"
FAILURE = "failure.txt"


class RunFailed(Exception):
    pass


def make_run(command):
    """What `gene-clocks run --json` says of one run."""
    finished = subprocess.run(command, capture_output=True, text=True, check=False,
                              stdin=subprocess.DEVNULL)
    try:
        if finished.returncode == 0:
            run = json.loads(finished.stdout)
            return float(run["f_c"]), float(run["cpu_seconds"])
        problem = f"exit status {finished.returncode}"
    except (ValueError, LookupError, TypeError) as error:
        problem = f"unexpected output: {error!r}"
    raise RunFailed(f"{shlex.join(command)}\n{problem}\n{finished.stderr.strip()}")


def f_c(seed, options):
    assignments = dict(option.removeprefix(OPTION).split("=", 1) for option in options)
    with open_record(RECORD) as record:
        known = record.find(assignments, seed)
        if known is not None:
            return known
        command = json.loads(Path(TARGET).read_text(encoding="utf-8"))
        for key, value in assignments.items():
            command += ["--set", f"{key}={value}"]
        value, cpu_seconds = make_run([*command, "--seed", str(seed)])
        record.add(assignments, seed, value, cpu_seconds)
        return value


def main(arguments):
    try:
        print(repr(-f_c(int(arguments[3]), arguments[4:])))
    except RunFailed as error:
        Path(FAILURE).write_text(f"{error}\n", encoding="utf-8")
        sys.exit(str(error))


if __name__ == "__main__":
    main(sys.argv[1:])
