"""What the tests of the tuning share."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, SOURCE_FOLDER = (Path(word) for word in sys.argv[1:3])
TUNING_FOLDER = SOURCE_FOLDER / "sim/tuning"
sys.path.insert(0, str(TUNING_FOLDER))

# Long enough for births, so that parameters tell; short enough for hundreds of runs.
SHORT = ["--set", "run.cycles=600", "--set", "world.robots=20", "--set", "measures.accumulated_share=0.5"]


def gene_clocks(*words):
    """Standard output; it must succeed."""
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True).stdout


def tune_command(folder, *words, program=PROGRAM):
    return [sys.executable, "-B", str(TUNING_FOLDER / "tune.py"), "--program", str(program), "--folder",
            str(folder), *words]


def tune(folder, *words, program=PROGRAM):
    return subprocess.run(tune_command(folder, *words, program=program), capture_output=True, text=True,
                          check=False)


class FolderTest(unittest.TestCase):
    """Each test has a folder of its own; its name has a space, as a user's may."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="gene clocks tuning "))
        self.addCleanup(shutil.rmtree, self.folder)

    def make_program(self, text):
        """An executable file; it may use $PROGRAM for gene-clocks."""
        path = self.folder / "program"
        path.write_text(f"#!/bin/sh\nPROGRAM='{PROGRAM}'\n{text}", encoding="utf-8")
        path.chmod(0o755)
        return path


def main():
    del sys.argv[1:3]
    unittest.main(module="__main__")
