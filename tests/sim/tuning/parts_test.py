"""The parts of ./run tune, without irace: parts_test.py PROGRAM SOURCE_FOLDER"""

import json
import subprocess
import sys
import tomllib

from tuning_test_support import (PROGRAM, SHORT, SOURCE_FOLDER, TUNING_FOLDER, FolderTest, gene_clocks, main,
                                 tune)

import elites_study
import irace
from run_record import open_record


class RangesTest(FolderTest):
    def test_the_nine_parameters_of_table_1_are_tuned(self):
        sets = tomllib.loads((SOURCE_FOLDER / "sim/settings/profiles/parameters.toml").read_text(encoding="utf-8"))
        for name, values in sets.items():
            del values["description"]
            self.assertEqual({f"odneat.{key}" for key in values}, irace.ranges().keys(), name)
            for key, value in values.items():
                low, high = irace.ranges()[f"odneat.{key}"]
                self.assertTrue(low <= value <= high, f"{name}: {key} = {value}")

    def test_the_settings_table_allows_the_ranges(self):
        for key, ends in irace.ranges().items():
            kind = "whole" if isinstance(ends[0], int) else "real"
            self.assertIn(f"\n    {kind}, ", gene_clocks("settings", key))
            self.assertLess(*ends)
            for end in ends:
                gene_clocks("settings", "--task", "navigation", "--format", "json", "--set", f"{key}={end}")

    def test_no_study_can_have_the_seeds_of_a_tuning(self):
        text = elites_study.study_text("navigation", "gene-clock", "mended", {}, [], [])
        file = self.folder / "study.toml"
        file.write_text(f"first_seed = {irace.SEEDS.start - 1_000_000}\n{text}", encoding="utf-8")
        refused = subprocess.run([PROGRAM, "study", file, "--dry-run"], capture_output=True, text=True,
                                 check=False)
        self.assertEqual(refused.returncode, 2)
        self.assertRegex(refused.stderr, "first_seed: \d+ is outside")
        for seed in (irace.SEEDS[0], irace.SEEDS[-1]):
            run = json.loads(gene_clocks("run", "--task", "navigation", *SHORT, "--json", "--seed", str(seed)))
            self.assertEqual(run["seed"], seed)
        self.assertEqual(len(irace.SEEDS), 100)


class TargetRunnerTest(FolderTest):
    VALUES = {"odneat.p_mate": "0.123456789012345", "odneat.sigma": "2.000000000000001",
              "odneat.population": "11"}

    def run_target(self, command, values, seed=irace.SEEDS[0]):
        """As irace starts it: number of the configuration, of the instance, a seed, the instance."""
        (self.folder / "target.json").write_text(json.dumps(command), encoding="utf-8")
        return subprocess.run(
            [sys.executable, "-B", TUNING_FOLDER / "target_runner.py", "7", "3", "1234567", str(seed),
             *(f"--set={key}={value}" for key, value in values.items())],
            cwd=self.folder, capture_output=True, text=True, check=False)

    def test_every_digit_reaches_the_simulator(self):
        program = self.make_program('for word; do echo "$word" >>words; done; exec "$PROGRAM" "$@"\n')
        command = [str(program), "run", "--json", "--task", "navigation", *SHORT]
        result = self.run_target(command, self.VALUES)
        self.assertEqual(result.returncode, 0, result.stderr)
        words = (self.folder / "words").read_text(encoding="utf-8").splitlines()
        for key, value in self.VALUES.items():
            self.assertEqual(words[words.index(f"{key}={value}") - 1], "--set")
        self.assertEqual(words[-2:], ["--seed", str(irace.SEEDS[0])])

        settings = self.folder / "settings.toml"
        settings.write_text("".join(f"{key} = {value}\n" for key, value in self.VALUES.items()),
                            encoding="utf-8")
        run = json.loads(gene_clocks("run", "--json", "--task", "navigation", *SHORT, "--settings",
                                     str(settings), "--seed", str(irace.SEEDS[0])))
        self.assertEqual(float(result.stdout), -run["f_c"])

    def test_a_finished_run_is_not_made_again(self):
        program = self.make_program('echo again >>calls; exec "$PROGRAM" "$@"\n')
        command = [str(program), "run", "--json", "--task", "navigation", *SHORT]
        other = {**self.VALUES, "odneat.sigma": "0.5"}
        costs = [self.run_target(command, values, seed).stdout
                 for values, seed in ((self.VALUES, 1), (self.VALUES, 2), (other, 1)) * 2]
        self.assertEqual(costs[:3], costs[3:])
        self.assertEqual(len(set(costs)), 3)
        self.assertEqual((self.folder / "calls").read_text(encoding="utf-8"), "again\n" * 3)
        with open_record(self.folder / "runs.sqlite") as record:
            self.assertEqual(record.count(), 3)
            self.assertEqual(sorted(-value for value in record.values_of(
                {key: float(text) for key, text in self.VALUES.items()})),
                sorted(map(float, costs[:2])))

    def test_a_run_that_fails_is_told_and_not_recorded(self):
        for text, words in (("echo the arena is full >&2; exit 2\n", "exit status 2\nthe arena is full"),
                            ("echo '{}'\n", "unexpected output"), ("", "unexpected output"),
                            ("kill -9 $$\n", "exit status -9")):
            program = self.make_program(text)
            result = self.run_target([str(program), "run"], self.VALUES)
            self.assertEqual(result.returncode, 1)
            for told in (result.stderr, (self.folder / "failure.txt").read_text(encoding="utf-8")):
                self.assertIn("--set odneat.p_mate=0.123456789012345", told)
                self.assertIn(words, told)
                self.assertNotIn("Traceback", told)
            with open_record(self.folder / "runs.sqlite") as record:
                self.assertEqual(record.count(), 0)


class StudyTest(FolderTest):
    def test_the_program_reads_the_elites_as_they_are(self):
        elites = [{"odneat.p_mate": 0.842, "odneat.population": 9}, {"odneat.p_mate": 1.0, "odneat.population": 50}]
        text = elites_study.study_text("collection", "timestamp", "gecco15", {"world.robots": 20}, elites,
                                       ["first line", "", "last line"])
        self.assertTrue(text.startswith("# first line\n#\n# last line\n\n"))
        file = self.folder / "elites.toml"
        file.write_text(text, encoding="utf-8")
        plan = gene_clocks("study", str(file), "--dry-run")
        self.assertIn("5 arms x 64 seeds", plan)
        expected = {
            "elite-1": ["--set", "odneat.p_mate=0.842", "--set", "odneat.population=9"],
            "elite-2": ["--set", "odneat.p_mate=1", "--set", "odneat.population=50"],
            "paper-A": ["--parameters", "A"],
            "paper-B": ["--parameters", "B"],
            "paper-C": ["--parameters", "C"],
        }
        for name, words in expected.items():
            run = json.loads(gene_clocks("run", "--json", "--task", "collection", "--source", "timestamp",
                                         "--profile", "gecco15", "--set", "world.robots=20", *words,
                                         "--set", "run.cycles=60000"))
            self.assertRegex(plan, rf"(?m)^  {name} .*{run['settings_hash']}")


class ArgumentsTest(FolderTest):
    def assert_refused(self, words, message):
        folder = self.folder / "results"
        # Short, for the day that one is not refused.
        result = tune(folder, "--budget", "300", *SHORT, *words)
        self.assertEqual(result.returncode, 2, f"{words}: {result.stderr}")
        self.assertRegex(result.stderr, message)
        self.assertNotIn("Traceback", result.stderr)
        self.assertFalse(folder.exists(), words)

    def test_wrong_ones_are_refused_before_anything_is_written(self):
        task = ["--task", "navigation"]
        self.assert_refused([], "--task")
        self.assert_refused(["--task", "navigaton"], 'did you mean navigation')
        self.assert_refused([*task, "--source", "gene-clocks"], "did you mean gene-clock")
        self.assert_refused([*task, "--profile", "mend"], "did you mean mended")
        self.assert_refused([*task, "--budget", "299"], "299 is not between 300")
        self.assert_refused([*task, "--budget", "many"], "many")
        self.assert_refused([*task, "--seed", "0"], "--seed.*0 is not between")
        self.assert_refused([*task, "--threads", "0"], "--threads.*0 is not between")
        self.assert_refused([*task, "--set", "run.cycle=3"], "did you mean run.cycles")
        self.assert_refused([*task, "--set", "odneat.sigma=1"], "odneat.sigma is tuned")
        self.assert_refused([*task, "--bugdet", "300"], "--bugdet")
        self.assert_refused([*task, "--program", "/nowhere/gene-clocks"], "/nowhere/gene-clocks")


if __name__ == "__main__":
    main()
