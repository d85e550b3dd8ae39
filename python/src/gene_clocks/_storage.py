"""What must outlive a crash, and the gate before a clock."""

from __future__ import annotations

import os
from collections.abc import Iterable
from types import TracebackType

from gene_clocks import _core
from gene_clocks._core import GeneClock
from gene_clocks._errors import StorageError
from gene_clocks._marks import Admission, InnovationNumber

_ERRORS = (
    ("", ""),
    ("missing", "nothing is stored here: a new robot, or storage that was wiped. A robot id that was never "
     "used before is create()d; any other one may not be used again without its counter"),
    ("exists", "something is stored here already: open() it"),
    ("damaged", "something was stored, and nothing of it can be trusted: go on under a new robot id"),
    ("other_robot", "it was stored by another robot"),
    ("unknown_version", "it was stored by another version of this format"),
    ("in_use", "another process has it open, or this one came of a fork"),
    ("not_open", "it was neither created nor opened"),
    ("bad_counter", "no clock has this counter"),
    ("device", "the file system reports an error"),
)


class FileStore(_core.FileStore):
    """The one number that a clock needs after a crash, in two files of a folder that exists and belongs to
    this robot alone.

    >>> store = FileStore("/var/lib/robot", robot=7)                # doctest: +SKIP
    >>> clock = GeneClock.restart(7, store.open(), 22, block=1000)  # doctest: +SKIP
    """

    def __init__(self, folder: str | os.PathLike[str], robot: int) -> None:
        self.folder = os.fspath(folder)
        super().__init__(self.folder, robot)

    def _check(self, status: tuple[int, int]) -> None:
        error, number = status
        if error:
            name, text = _ERRORS[error]
            system = f" ({os.strerror(number)})" if number else ""
            raise StorageError(name, f"{self.folder}: {text}{system}", number)

    def create(self, counter: int) -> None:
        """First use: stores a counter where nothing is stored yet. Only for a robot id that was never
        used."""
        self._check(self._create(counter))

    def open(self) -> int:
        """Every later use: the counter that was stored."""
        self._check(self._open())
        return self.stored

    def store(self, counter: int) -> None:
        """Returns when this counter, or a larger one, is on stable storage. After an error, what was
        stored before still is, and it may be tried again."""
        self._check(self._store(counter))

    def __enter__(self) -> FileStore:
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None,
                 traceback: TracebackType | None) -> None:
        self.close()


class AdmissionGate(_core.AdmissionGate):
    """Stands before a clock where messages may be forged or damaged: receptions may advance it by
    `allowance` counters, and by `per_cycle` more with each elapse(). The default refuses nothing that the
    clock's own limits admit."""

    def admit(self, clock: GeneClock, stamp: int, marks: Iterable[InnovationNumber] = ()) -> Admission:
        """Hands a message to the clock, or refuses it and says why; then nothing but the counts has
        changed."""
        if not 0 <= stamp < 1 << 64:  # no clock has it
            self._unheard_of += 1
            return Admission.beyond_maximum
        return Admission(self._admit(clock, stamp, marks))

    def counts(self) -> dict[Admission, int]:
        """How many messages had each outcome."""
        counts = dict(zip(Admission, self._counts()))
        counts[Admission.beyond_maximum] += self._unheard_of
        return counts

    _unheard_of = 0
