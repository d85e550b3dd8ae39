"""Lists of faults: what is wrong, in which file, the text that makes it so, and who is to notice."""

import pathlib
import re
import subprocess
from dataclasses import dataclass

MAKE_SLIP = pathlib.Path(__file__).parents[2] / "proofs" / "make_slip"

GOLDENS = "goldens"


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
    meant: str = ""  # "PROGRAM TEST" that is to notice it; empty: that of the file (plan.py)

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

    A line is FILE, what is wrong, the text as it is, the text with the fault; for a mutant that is
    equivalent a fifth column with the reason, else empty; and maybe a sixth with the test that is
    meant to notice it: "sim/core/messages CarryTheEnergyOfTheirSender", which is a program below
    tests/ and a test in it, or "goldens" where nothing but a changed trajectory can tell. Tabs part
    them. With `file`, all lines are about that one, and name a function of it instead
    (proofs/kernel/slips.txt).
    """
    path = pathlib.Path(path)
    faults = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        columns = line.split("\t")
        if len(columns) == 2:
            continue  # of another list: see reasons()
        if not 4 <= len(columns) <= 6:
            raise BrokenList(f"{path}:{number}: {len(columns)} columns, not 4 to 6")
        place, meaning, before, after, *others = columns
        in_words = f"{place.removeprefix('gene_clocks_')} {meaning}" if file else meaning
        name = f"{pathlib.Path(file or place).name}/{re.sub('[^a-z0-9]+', '-', in_words.lower())}"
        faults.append(Fault(name.strip("-"), file or place, meaning, before, after, *others))
    return faults


def reasons(path):
    """Why faults of another list are equivalent, by their names: the lines of two columns."""
    lines = (line.split("\t") for line in pathlib.Path(path).read_text().splitlines())
    return dict(columns for columns in lines if len(columns) == 2)


def check_meant(fault, root):
    """Raises BrokenList where there is no such test."""
    if fault.meant in ("", GOLDENS):
        return
    program, _, test = fault.meant.partition(" ")
    source = pathlib.Path(root) / "tests" / f"{program}_test.cpp"
    if not source.exists():
        raise BrokenList(f"{fault.name}: {fault.meant}: there is no {source.relative_to(root)}")
    if not re.search(rf"^(TEST|TEST_F|TEST_P|RC_GTEST\w+)\(\s*\w+,\s*{re.escape(test)}[,)]",
                     source.read_text(), re.MULTILINE):
        raise BrokenList(f"{fault.name}: {source.relative_to(root)} has no test {test}")


def check(faults, root):
    """Raises BrokenList where a name is not unique or a fault no longer fits the sources."""
    problems, names = [], set()
    for fault in faults:
        if fault.name in names:
            problems.append(f"{fault.name}: there are two of that name")
        names.add(fault.name)
        try:
            fault.mutant(root)
            check_meant(fault, root)
        except BrokenList as problem:
            problems.append(str(problem))
    if problems:
        raise BrokenList("\n".join(problems))
