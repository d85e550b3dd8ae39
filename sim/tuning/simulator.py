"""The program gene-clocks, as a tuning asks it."""

import json
import subprocess


class InputError(Exception):
    """What was asked for cannot be done; nothing was written."""


class Simulator:
    """`selection`: the options of `gene-clocks run` that are the same for all runs of a tuning."""

    def __init__(self, program, selection):
        self.program = str(program)
        self.selection = selection

    def ask(self, command, *options):
        """Standard output of a command; InputError with the program's own words where it refuses."""
        try:
            finished = subprocess.run([self.program, *command, *options], capture_output=True, text=True,
                                      check=False, stdin=subprocess.DEVNULL)
        except OSError as error:
            raise InputError(f"{self.program}: {error.strerror}") from error
        if finished.returncode != 0:
            raise InputError(finished.stderr.strip().removeprefix("gene-clocks: "))
        return finished.stdout

    def version(self):
        return self.ask(["--version"]).strip()

    def settings(self, *options):
        """All settings of a run, {"odneat": {"p_mate": 0.2, ...}, "task": ..., ...}."""
        return json.loads(self.ask(["settings", *self.selection, "--format", "json"], *options))

    def run_command(self):
        return [self.program, "run", "--json", *self.selection]

    def probe(self):
        """The trajectory hash of two hundred cycles: what the simulator does with these settings.

        Refuses what only the simulator can refuse, such as an arena without room for the robots.
        """
        short = ["--set", "run.cycles=200", "--set", "run.sample_period_cycles=100", "--seed", "1"]
        return json.loads(self.ask(["run", "--json", *self.selection], *short))["trajectory_hash"]


def flat(settings):
    """{"odneat": {"p_mate": 0.2}, "task": "x"} → {"odneat.p_mate": 0.2, "task": "x"}"""
    keys = {}
    for name, value in settings.items():
        if isinstance(value, dict):
            keys.update({f"{name}.{key}": inner for key, inner in value.items()})
        else:
            keys[name] = value
    return keys
