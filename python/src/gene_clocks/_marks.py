"""Marks of genes, and how genes match."""

from __future__ import annotations

import enum
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, SupportsIndex, overload


class _Mark(NamedTuple):
    counter: int
    robot: int


class InnovationNumber(_Mark):
    """The mark of a gene: a counter and a robot, ordered by counter, then by robot.

    It is a tuple, so that `counter, robot = mark` and comparisons with tuples work, and an integer where
    one is needed: `int(mark)` and `pack()` keep the order.
    """

    __slots__ = ()

    def __new__(cls, counter: int, robot: int) -> InnovationNumber:
        if not 0 <= counter < 1 << 64:
            raise ValueError(f"a mark's counter is {counter}, not from 0 to 2^64 - 1")
        if not 0 <= robot < 1 << 32:
            raise ValueError(f"a mark's robot is {robot}, not from 0 to 2^32 - 1")
        return super().__new__(cls, counter, robot)

    def __int__(self) -> int:
        return self.counter << 32 | self.robot

    def pack(self, robot_bits: int = 32) -> int:
        """One integer: the counter, then the robot in its lowest bits. In the order of marks.

        OverflowError where the robot has more bits.
        """
        if self.robot >> robot_bits:
            raise OverflowError(f"robot {self.robot} has more than {robot_bits} bits")
        return self.counter << robot_bits | self.robot

    @classmethod
    def unpack(cls, number: int, robot_bits: int = 32) -> InnovationNumber:
        """The mark that pack() made this integer of."""
        return cls(number >> robot_bits, number & (1 << robot_bits) - 1)

    def __repr__(self) -> str:
        return f"InnovationNumber({self.counter}, {self.robot})"

    def __reduce__(self) -> Any:
        return InnovationNumber, (self.counter, self.robot)


class MintedMarks(Sequence[InnovationNumber]):
    """Consecutive marks of one robot. Takes no memory for them."""

    __slots__ = ("first", "_count")

    def __init__(self, first: InnovationNumber, count: int) -> None:
        self.first = InnovationNumber(*first)
        self._count = count

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: SupportsIndex) -> InnovationNumber: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[InnovationNumber]: ...
    def __getitem__(self, index: SupportsIndex | slice) -> InnovationNumber | Sequence[InnovationNumber]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(self._count))]
        number = index.__index__()
        if not -self._count <= number < self._count:
            raise IndexError(f"mark {number} of {self._count}")
        return InnovationNumber(self.first.counter + number % self._count, self.first.robot)

    def __iter__(self) -> Iterator[InnovationNumber]:
        robot = self.first.robot
        for counter in range(self.first.counter, self.first.counter + self._count):
            yield InnovationNumber(counter, robot)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, MintedMarks):
            return self._count == other._count and (self._count == 0 or self.first == other.first)
        if isinstance(other, (list, tuple)):
            return self._count == len(other) and all(a == b for a, b in zip(self, other))
        return NotImplemented

    def __hash__(self) -> int:
        return hash((self._count, self.first if self._count else None))

    def __repr__(self) -> str:
        return f"MintedMarks({self.first!r}, {self._count})"

    def __reduce__(self) -> Any:
        return MintedMarks, (self.first, self._count)


class GeneMatch(enum.IntEnum):
    """How a gene stands in the alignment of two genomes."""

    matching = 0
    disjoint_first = 1
    disjoint_second = 2
    excess_first = 3
    excess_second = 4


class Admission(enum.IntEnum):
    """What becomes of a received message. All but `admitted` are refusals, and change nothing."""

    admitted = 0
    beyond_maximum = 1
    beyond_window = 2
    beyond_allowance = 3
    gene_not_covered = 4
    identity_conflict = 5
