"""Messages of version 1: odNEAT's genes, as objects."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from typing import Any, NamedTuple

from gene_clocks import _core
from gene_clocks._core import WireLimits as _WireLimits
from gene_clocks._marks import InnovationNumber


class GeneKind(enum.IntEnum):
    """What a gene of a message is: a neuron of one of four kinds, or a connection."""

    input = 0
    bias = 1
    output = 2
    hidden = 3
    connection = 4


class Gene(NamedTuple):
    """A gene of a message. source and target count the message's neurons from 0; they, weight, enabled
    and recurrent are of connections only."""

    mark: InnovationNumber
    kind: GeneKind
    source: int = 0
    target: int = 0
    weight: float = 0.0
    enabled: bool = True
    recurrent: bool = False


class _Message(NamedTuple):
    sender: int
    stamp: int
    energy: float
    robot: int
    birth: int
    genes: tuple[Gene, ...]


class Message(_Message):
    """A genome on its way, with its sender's stamp: who made it (robot, birth) and its genes, in the order
    of their marks."""

    __slots__ = ()

    def __new__(cls, *, sender: int, stamp: int, energy: float, robot: int, birth: int,
                genes: Iterable[Gene]) -> Message:
        return super().__new__(cls, sender, stamp, energy, robot, birth, tuple(genes))

    def __reduce__(self) -> Any:
        return _message, tuple(self)


def _message(sender: int, stamp: int, energy: float, robot: int, birth: int,
             genes: tuple[Gene, ...]) -> Message:
    return Message(sender=sender, stamp=stamp, energy=energy, robot=robot, birth=birth, genes=genes)


class WireLimits(_WireLimits):
    """What a deployment admits. Everything beyond is refused before it costs memory."""

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, WireLimits):
            return NotImplemented
        return self._fields() == other._fields()

    def __hash__(self) -> int:
        return hash(self._fields())

    def __repr__(self) -> str:
        names = ("frame_bytes", "genesis_count", "neurons", "connections", "energy", "weight")
        return f"WireLimits({', '.join(f'{n}={v!r}' for n, v in zip(names, self._fields()))})"

    def __reduce__(self) -> Any:
        return _limits, self._fields()


def _limits(frame_bytes: int, genesis_count: int, neurons: int, connections: int, energy: float,
            weight: float) -> WireLimits:
    return WireLimits(frame_bytes=frame_bytes, genesis_count=genesis_count, neurons=neurons,
                      connections=connections, energy=energy, weight=weight)


_STANDARD = WireLimits()


def encode(message: Message, limits: WireLimits = _STANDARD) -> bytes:
    """The frame of a message; WireError, which names the gene, where decode would refuse it."""
    return _core._encode(message, limits)


def decode(data: bytes | bytearray | memoryview, limits: WireLimits = _STANDARD) -> Message:
    """The message in a frame (any buffer); WireError for any other bytes. Its stamp still has to pass the
    clock's observe()."""
    return _message(*_core._decode(data, limits))


class Frame(NamedTuple):
    """A frame around a payload of any format."""

    sender: int
    stamp: int
    energy: float
    payload: bytes


def encode_frame(sender: int, stamp: int, energy: float, payload: bytes | bytearray | memoryview,
                 limits: WireLimits = _STANDARD) -> bytes:
    """A frame with a checksum around a payload (any buffer); WireError where decode_frame would refuse
    it."""
    return _core._encode_frame(sender, stamp, energy, payload, limits)


def decode_frame(data: bytes | bytearray | memoryview, limits: WireLimits = _STANDARD) -> Frame:
    """The fields of a frame (any buffer); WireError for any other bytes. The payload is not looked at,
    and the stamp still has to pass the clock's observe()."""
    return Frame(*_core._decode_frame(data, limits))


def split_message(message: bytes | bytearray | memoryview, sender: int, number: int,
                  fragment_bytes: int) -> list[bytes]:
    """A frame, sealed or not, in fragments of at most fragment_bytes; the frame alone where it fits.

    number is one more for each message of this sender, from any number on; 0 follows 255.
    """
    return _core._split(message, sender, number % 256, fragment_bytes)


class MessageAssembler(_core.MessageAssembler):
    """Puts messages together from fragments: one at a time for each sender, `messages` at a time in all, in
    memory that is fixed from the start."""

    def take(self, data: bytes | bytearray | memoryview) -> bytes | None:
        """Takes what came off a link; the message where it is whole with it, else None. `outcome` then
        says why."""
        self.outcome, message = self._take(data)
        return message

    #: What became of the last fragment: kept, completes, repeated, late, malformed or too_long.
    outcome: str = ""
