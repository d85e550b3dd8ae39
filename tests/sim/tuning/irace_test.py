"""Whole tunings with the real irace, of short runs: irace_test.py PROGRAM SOURCE_FOLDER"""

import json
import re
import signal
import sqlite3
import subprocess
import sys
import tomllib

from tuning_test_support import SHORT, FolderTest, gene_clocks, main, tune, tune_command

import irace

NO_IRACE = 77
TUNING = ["--task", "navigation", "--source", "timestamp", "--budget", str(irace.MINIMUM_BUDGET), *SHORT]


def runs_of(folder):
    with sqlite3.connect(folder / "runs.sqlite") as database:
        return database.execute("SELECT assignments, seed, f_c FROM run ORDER BY assignments, seed").fetchall()


def study_of(folder):
    return tomllib.loads((folder / "elites.toml").read_text(encoding="utf-8"))


class TuningTest(FolderTest):
    def stop_in_the_middle(self, folder):
        """Starts a tuning on two threads, sees that it has the folder for itself, and stops it."""
        process = subprocess.Popen(tune_command(folder, *TUNING, "--threads", "2"), stderr=subprocess.PIPE,
                                   text=True)
        try:
            lines = iter(process.stderr.readline, "")
            self.assertTrue(any(re.match("[3-9][0-9] of 300 runs", line) for line in lines))
            second = tune(folder, *TUNING)
            self.assertEqual(second.returncode, 2)
            self.assertRegex(second.stderr, "a tuning is at work in it")
            process.send_signal(signal.SIGINT)
            _, words = process.communicate()
        finally:
            process.kill()
        self.assertEqual(process.returncode, 130, words)
        self.assertIn("the same command goes on from here", words)

    def test_one_that_was_stopped_ends_as_one_that_was_not(self):
        stopped, whole = self.folder / "stopped", self.folder / "whole"
        self.stop_in_the_middle(stopped)
        kept = runs_of(stopped)
        self.assertGreaterEqual(len(kept), 30)
        self.assertLess(len(kept), 300)
        self.assertFalse((stopped / "elites.toml").exists())

        resumed = tune(stopped, *TUNING, "--threads", "1")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertTrue(set(kept) < set(runs_of(stopped)))
        self.assertRegex(resumed.stderr, rf"(?m)^{len(kept)} of 300 runs")
        uninterrupted = tune(whole, *TUNING, "--threads", "2")
        self.assertEqual(uninterrupted.returncode, 0, uninterrupted.stderr)
        self.assertEqual(runs_of(stopped), runs_of(whole))
        self.assertEqual(study_of(stopped), study_of(whole))
        self.look_at_the_outcome(whole, uninterrupted.stdout)

        other = tune(whole, *TUNING, "--budget", "301")
        self.assertEqual(other.returncode, 2)
        self.assertRegex(other.stderr, "holds a tuning with another budget;")

    def look_at_the_outcome(self, folder, summary):
        runs = runs_of(folder)
        self.assertGreater(len(runs), 250)
        self.assertLessEqual(len(runs), 300)
        self.assertLessEqual({seed for _, seed, _ in runs}, set(irace.SEEDS))
        asked = {tuple(map(float, json.loads(assignments).values())) for assignments, _, _ in runs}
        self.assertGreater(len(asked), 10)
        for assignments, _, _ in runs:
            for key, text in json.loads(assignments).items():
                low, high = irace.ranges()[key]
                self.assertTrue(low <= float(text) <= high, f"{key} = {text}")

        elites = [arm for arm in study_of(folder)["arm"] if arm["name"].startswith("elite-")]
        self.assertGreater(len(elites), 0)
        for arm in elites:
            self.assertEqual((arm["task"], arm["source"]), ("navigation", "timestamp"))
            elite = {f"odneat.{key}": value for key, value in arm["settings"]["odneat"].items()}
            self.assertEqual(elite.keys(), irace.ranges().keys())
            values = [f_c for assignments, _, f_c in runs
                      if {key: float(text) for key, text in json.loads(assignments).items()} == elite]
            self.assertRegex(summary, rf"{arm['name']}: mean f_c {sum(values) / len(values):.2f} "
                                      rf"of {len(values)} runs; p_mate={elite['odneat.p_mate']}")
        gene_clocks("study", str(folder / "elites.toml"), "--dry-run")

    def test_a_run_that_fails_ends_it_with_the_runs_words(self):
        program = self.make_program('for word; do [ "${word#odneat.sigma=2}" = "$word" ] || [ "$1" != run ] || '
                                    '{ echo too much >&2; exit 1; }; done\nexec "$PROGRAM" "$@"\n')
        folder = self.folder / "results"
        failed = tune(folder, *TUNING, program=program)
        self.assertEqual(failed.returncode, 1, failed.stderr)
        self.assertRegex(failed.stderr, "tune: a run failed: .*--set odneat.sigma=2.*\n"
                                        "exit status 1\ntoo much")
        self.assertTrue(all(float(json.loads(assignments)["odneat.sigma"]) < 2
                            for assignments, _, _ in runs_of(folder)))
        self.assertFalse((folder / "elites.toml").exists())


if __name__ == "__main__":
    try:
        irace.version()
    except irace.TunerError as error:
        print(f"Skipped: {error}")
        sys.exit(NO_IRACE)
    main()
