"""Completion, manual pages and schemas, as shells, man(1) and editors take them:

    shell_integration_test.py GENE_CLOCKS SOURCE_FOLDER

What is not on this machine (zsh, fish, groff, jsonschema) is skipped, and named.
"""

import functools
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

try:
    import jsonschema
except ImportError:
    jsonschema = None

PROGRAM = SOURCE = None


@functools.cache
def output_of(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True).stdout


def status_of(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, check=False).returncode


def commands():
    """The names that --help lists."""
    listed = output_of("--help").partition("Subcommands:")[2].partition("\n\n")[0]
    return re.findall(r"^  ([a-z-]+)", listed, re.MULTILINE)


def options(command):
    return set(re.findall(r"(?<![\w-])--[a-z-]+", output_of(command, "--help").partition("Options:")[2]
                          .partition("\n\n")[0]))


class BashTest(unittest.TestCase):
    def replies(self, *words):
        script = "\n".join([
            f"source <('{PROGRAM}' completion bash)",
            "COMP_WORDS=(gene-clocks " + " ".join(f"'{word}'" for word in words) + ")",
            f"COMP_CWORD={len(words)}", "compopt() { :; }", "_gene_clocks",
            'printf "%s\\n" "${COMPREPLY[@]}"'])
        run = subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True, check=True)
        self.assertEqual(run.stderr, "")
        return run.stdout.split()

    def test_commands(self):
        self.assertGreater(len(commands()), 10)
        self.assertGreater(len(options("run")), 8)
        self.assertLessEqual(set(commands()), set(self.replies("")))
        self.assertEqual(self.replies("repl"), ["replay"])

    def test_options_of_each_command(self):
        for command in commands():
            self.assertEqual(set(self.replies(command, "--")), options(command), command)

    def test_words_that_an_option_takes(self):
        tasks = self.replies("run", "--task", "")
        self.assertIn("navigation", tasks)
        self.assertIn("collection", tasks)
        self.assertEqual(self.replies("run", "--source", "hybrid"), ["hybrid-logical-clock"])
        self.assertEqual(self.replies("run", "--set", "odneat.p_mate"), ["odneat.p_mate="])
        self.assertEqual(self.replies("settings", "--format", "t"), ["text", "toml"])
        self.assertEqual(self.replies("study", "equal"), ["equal-weights"])
        self.assertEqual(self.replies("run", "--json", "--seed", ""), [])

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "mine.sqlite").touch()
            self.assertEqual(self.replies("export", f"{folder}/m"), [f"{folder}/mine.sqlite"])
            self.assertEqual(self.replies("run", "--settings", f"{folder}/m"), [f"{folder}/mine.sqlite"])


class OtherShellsTest(unittest.TestCase):
    def completions(self, line):
        script = f"'{PROGRAM}' completion fish | source; complete -C '{line}'"
        run = subprocess.run(["fish", "--no-config", "-c", script], capture_output=True, text=True, check=True)
        self.assertEqual(run.stderr, "")
        return [row.partition("\t")[0] for row in run.stdout.splitlines()]

    @unittest.skipUnless(shutil.which("fish"), "there is no fish")
    def test_fish(self):
        self.assertLessEqual(set(commands()), set(self.completions("gene-clocks ")))
        self.assertEqual(self.completions("gene-clocks run --source hybrid"), ["hybrid-logical-clock"])
        self.assertIn("--trace", self.completions("gene-clocks run --tr"))
        self.assertIn("equal-weights", self.completions("gene-clocks study equal"))

    @unittest.skipUnless(shutil.which("zsh"), "there is no zsh")
    def test_zsh(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "_gene-clocks").write_text(output_of("completion", "zsh"))
            check = subprocess.run(["zsh", "-n", f"{folder}/_gene-clocks"], capture_output=True, text=True)
            self.assertEqual((check.returncode, check.stderr), (0, ""))
            # compinit takes it up for the command.
            script = (f"fpath=('{folder}' $fpath); autoload -U compinit; compinit -u -d '{folder}/dump';"
                      "print $_comps[gene-clocks]")
            run = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True)
            self.assertEqual(run.stdout.strip(), "_gene-clocks")
        text = output_of("completion", "zsh")
        for command in commands():
            self.assertIn(f"        {command})", text)
            for option in options(command):
                self.assertIn(option, text)

    def test_another_shell_is_refused(self):
        self.assertEqual(status_of("completion", "tcsh"), 2)
        self.assertEqual(status_of("completion"), 2)


class ManualTest(unittest.TestCase):
    @unittest.skipUnless(shutil.which("groff"), "there is no groff")
    def test_pages_are_roff_and_say_all(self):
        for command in [None, *commands()]:
            page = output_of("manual", *([command] if command else []))
            shown = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-P-c"], input=page,
                                   capture_output=True, text=True, check=True)
            self.assertEqual(shown.stderr, "", command)
            text = re.sub(r".\x08", "", shown.stdout).replace("\u2212", "-").replace("\u2010", "-")
            for word in commands() if command is None else options(command):
                self.assertIn(word, text)

    def test_a_page_that_is_not_there(self):
        self.assertEqual(status_of("manual", "rnu"), 2)


@unittest.skipUnless(jsonschema, "there is no jsonschema (Debian: python3-jsonschema)")
class SchemaTest(unittest.TestCase):
    def validator(self, kind):
        schema = json.loads(output_of("schema", kind))
        jsonschema.Draft202012Validator.check_schema(schema)
        return jsonschema.Draft202012Validator(schema)

    def builtin(self, folder):
        files = sorted((SOURCE / folder).glob("*.toml"))
        self.assertGreater(len(files), 1)
        return files

    def test_every_file_that_ships_fits(self):
        for kind, folder in (("study", "sim/studies"), ("arena", "sim/arenas")):
            for file in self.builtin(folder):
                errors = [f"{file.name}: {list(error.path)}: {error.message}" for error in
                          self.validator(kind).iter_errors(tomllib.loads(file.read_text("utf-8")))]
                self.assertEqual(errors, [])

    def test_settings_of_a_run_fit(self):
        for task in ("navigation", "collection"):
            text = output_of("settings", "--task", task, "--format", "toml")
            self.validator("settings").validate(tomllib.loads(text))

    def test_what_the_program_refuses_does_not_fit(self):
        arm = '[[arm]]\ntask = "navigation"\nsource = "gene-clock"\n'
        head = 'name = "x"\ntitle = "X"\n'
        self.assertTrue(self.validator("study").is_valid(tomllib.loads(head + arm)))
        contrast = '[contrast]\nbaseline = ["radio.loss=0"]\npaired.over = ["radio.loss"]\n'
        self.assertTrue(self.validator("study").is_valid(tomllib.loads(head + contrast + arm)))
        for text in (head, arm, head + "seed = 3\n" + arm, head + "seeds = 0\n" + arm,
                     head + arm + "settings.odneat.p_mate = 2\n", head + arm + "settings.world.robot = 3\n",
                     head + arm + 'settings.odneat.crossover = "none"\n',
                     head + arm.replace("navigation", "flight"), head + arm + "grid.radio.loss = 0.5\n",
                     'name = "a b"\ntitle = "X"\n' + arm, head + "[quick]\nseed = 1\n" + arm,
                     head + "[contrast]\nbaselines = [\"radio.loss=0\"]\n" + arm,
                     head + arm + 'settings.run.cycles = "many"\n'):
            self.assertFalse(self.validator("study").is_valid(tomllib.loads(text)), text)
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "study.toml"
                file.write_text(text)
                self.assertEqual(status_of("study", str(file), "--dry-run"), 2, text)

    def test_another_kind_is_refused(self):
        self.assertEqual(status_of("schema", "swarm"), 2)


if __name__ == "__main__":
    PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
