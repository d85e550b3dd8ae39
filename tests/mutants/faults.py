"""Lists of faults: what is wrong, in which file, and the text that makes it so."""

import pathlib
import re
import subprocess
from dataclasses import dataclass

MAKE_SLIP = pathlib.Path(__file__).parents[2] / "proofs" / "make_slip"


class BrokenList(Exception):
    """A list of faults that does not fit the sources, or cannot be read."""


@dataclass(frozen=True)
class Fault:
    name: str  # such as "kernel.h/mint-wraps-around"
    file: str  # from the root of the sources
    meaning: str
    before: str  # as in the list, where \n is a line break
    after: str
    equivalent: str = ""  # why no test can notice it; empty where one must

    def mutant(self, root):
        """The file's text with the fault in it. Raises BrokenList where it fits no more."""
        made = subprocess.run(
            [MAKE_SLIP, pathlib.Path(root) / self.file, self.before, self.after],
            capture_output=True, check=False,
        )
        if made.returncode != 0:
            raise BrokenList(f"{self.name}: {made.stderr.decode().strip()}")
        return made.stdout


def read(path, file=None):
    """The faults of a list.

    A line is FILE, what is wrong, the text as it is, the text with the fault, and for a mutant that
    is equivalent a fifth column with the reason; tabs part them. With `file`, all lines are about
    that one, and name a function of it instead (proofs/kernel/slips.txt).
    """
    path = pathlib.Path(path)
    faults = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        columns = line.split("\t")
        if len(columns) == 2:
            continue  # of another list: see reasons()
        if not 4 <= len(columns) <= 5:
            raise BrokenList(f"{path}:{number}: {len(columns)} columns, not 4 or 5")
        place, meaning, before, after, *equivalent = columns
        in_words = f"{place.removeprefix('gene_clocks_')} {meaning}" if file else meaning
        name = f"{pathlib.Path(file or place).name}/{re.sub('[^a-z0-9]+', '-', in_words.lower())}"
        faults.append(Fault(name.strip("-"), file or place, meaning, before, after, *equivalent))
    return faults


def reasons(path):
    """Why faults of another list are equivalent, by their names: the lines of two columns."""
    lines = (line.split("\t") for line in pathlib.Path(path).read_text().splitlines())
    return dict(columns for columns in lines if len(columns) == 2)


def check(faults, root):
    """Raises BrokenList where a name is not unique or a fault no longer fits the sources."""
    problems, names = [], set()
    for fault in faults:
        if fault.name in names:
            problems.append(f"{fault.name}: there are two of that name")
        names.add(fault.name)
        try:
            fault.mutant(root)
        except BrokenList as problem:
            problems.append(str(problem))
    if problems:
        raise BrokenList("\n".join(problems))
