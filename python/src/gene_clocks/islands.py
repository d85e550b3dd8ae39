"""Islands: what a distributed NEAT needs beside its transport.

An Island owns a process's identity, clock and storage. It gives marks (and integers made of them) to new
genes, turns genomes into frames and back, and says what became of each frame that arrives:

    island = Island(robot=7, schema=schema, folder="/var/lib/neat/7")
    mark = island.mint()                          # a new gene
    send(island.pack(genome, energy=fitness))     # nothing leaves before its counter is stored
    received = island.receive(data)               # any bytes, from anyone
    if received.genome is not None:
        use(received.genome)

How bytes get from one island to another is the user's: datagrams, a broker, files. They may be lost,
repeated, late or out of order.
"""

from __future__ import annotations

import enum
import os
import pathlib
import weakref
from collections.abc import Sequence
from typing import NamedTuple

from gene_clocks._core import GeneClock
from gene_clocks._errors import SealError, StorageError, WireError
from gene_clocks._genomes import Genes, Genome, Schema
from gene_clocks._marks import Admission, InnovationNumber, MintedMarks
from gene_clocks._messages import WireLimits, decode_frame, encode_frame
from gene_clocks._sealing import Opener, Sealer
from gene_clocks._storage import AdmissionGate, FileStore

_MAXIMUM = 2**64 - 1


class Exhausted(RuntimeError):
    """No counter is left, or not so many: this island can make no more genes."""


class Outcome(enum.Enum):
    """What became of a frame. All but `genome` are refusals: drop the frame, nothing has changed."""

    #: A genome to use. Its stamp was merged.
    genome = "a genome"
    #: From this island itself: broadcasts come back.
    own = "sent by this island itself"
    #: Cut short, altered, or no frame at all.
    damaged = "no frame, or a damaged one"
    #: Sealed with another key, or not sealed.
    forged = "not sealed with the key"
    #: Sealed with the key, but taken before, or too old to tell.
    replayed = "taken before"
    #: The genes are after another schema: the sender has another configuration.
    another_schema = "genes after another schema"
    #: Whole, but no genome that the schema and the protocol admit.
    malformed = "no genome that the schema admits"
    #: The stamp leaps further than the limits or the gate allow.
    too_far = "its stamp leaps too far"
    #: A gene with this island's id that it never made: another island has the same id, or this one's
    #: storage was set back. Not to be overlooked: give one of them a new id.
    conflict = "another island has this island's id"


class Received(NamedTuple):
    """A frame that arrived, and what became of it; sender and energy where they are known."""

    outcome: Outcome
    genome: Genome | None = None
    sender: int = 0
    energy: float = 0.0
    reason: str = ""


#: The islands that are open in this process, by robot: what was pickled finds its own again.
living: weakref.WeakValueDictionary[int, Island] = weakref.WeakValueDictionary()


class Island:
    """A process of a distributed NEAT: identity, clock, storage, frames.

    robot: this island's id, 1 to 2^32 - 1, which no other has.
    schema: what genes have in them, the same on all islands.
    folder: keeps the counter across crashes; made where it is missing. Without one, an id may never be used
        again once the process has ended.
    block: counters that one flush of the storage reserves.
    key: 32 bytes, the same on all islands: frames are sealed, and others' are refused. Numbers of frames are
        kept in the folder too.
    gate: bounds what received stamps may do to the clock.
    """

    def __init__(self, robot: int, schema: Schema, folder: str | os.PathLike[str] | None = None, *,
                 block: int = 1000, window: int = _MAXIMUM, limits: WireLimits | None = None,
                 genes_max: int = 2048, key: bytes | None = None,
                 gate: AdmissionGate | None = None) -> None:
        self.schema = schema
        self.genes_max = genes_max
        self.limits = limits or WireLimits(genesis_count=schema.genesis_count)
        if self.limits.genesis_count != schema.genesis_count:
            raise ValueError(f"the limits have {self.limits.genesis_count} genesis marks, the schema "
                             f"{schema.genesis_count}")
        self.gate = gate or AdmissionGate()
        self._block = block
        self._stores: list[FileStore] = []
        path = None if folder is None else pathlib.Path(folder)
        self._store, counter = self._open(path, robot, schema.genesis_count + 1)
        self.clock = GeneClock.restart(robot, counter, schema.genesis_count, block=block if path else 0,
                                       window=window)
        self._sealer: Sealer | None = None
        self._numbers: FileStore | None = None
        if key is not None:
            self._numbers, number = self._open(path and path / "frames", robot, 1)
            self._sealer = Sealer(key, GeneClock.restart(robot, number, 0, block=block if path else 0))
            self._opener = Opener(key, self.limits)
        #: How many frames had each outcome.
        self.counts: dict[Outcome, int] = dict.fromkeys(Outcome, 0)
        living[robot] = self

    def _open(self, folder: pathlib.Path | None, robot: int, first: int) -> tuple[FileStore | None, int]:
        if folder is None:
            return None, first
        folder.mkdir(parents=True, exist_ok=True)
        store = FileStore(folder, robot)
        self._stores.append(store)
        try:
            return store, store.open()
        except StorageError as error:
            if error.error != "missing":
                raise
        store.create(first)
        return store, first

    @property
    def robot(self) -> int:
        """This island's id."""
        return self.clock.robot

    def close(self) -> None:
        """Gives the folder free. The island can then mint, but send no more."""
        for store in self._stores:
            store.close()

    def __enter__(self) -> Island:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    # ---- Marks ------------------------------------------------------------------------------------------

    def mint(self) -> InnovationNumber:
        """The mark of a new gene. Exhausted where none is left."""
        mark = self.clock.mint()
        if mark is None:
            raise Exhausted(f"island {self.robot} has no counter left")
        return mark

    def mint_many(self, count: int) -> MintedMarks:
        """So many marks, all or none: a split connection takes three."""
        marks = self.clock.mint(count)
        if marks is None:
            raise Exhausted(f"island {self.robot} has less than {count} counters left")
        return marks

    def new_id(self) -> int:
        """A mark as an integer, for a NEAT whose genes or nodes have those: unique on all islands, and in
        the order of marks."""
        return int(self.mint())

    # ---- Frames -----------------------------------------------------------------------------------------

    def pack(self, genome: Genome, energy: float = 0.0) -> bytes:
        """The frame of a genome, to be sent to whom it may concern. WireError names the gene that cannot
        go. A genome that has no maker yet (robot 0) becomes this island's own, with a new birth."""
        if genome.robot == 0:
            genome.robot, genome.birth = self.robot, self.mint().counter
        stamp = self.clock.stamp()
        payload = self.schema.encode(genome, stamp, self.genes_max)
        frame = encode_frame(self.robot, stamp, energy, payload, self.limits)
        if self._store is not None:
            self._store.store(self.clock.durable_needed())
        if self._sealer is None:
            return frame
        sealed = self._sealer.seal(frame)
        if sealed is None:
            raise Exhausted(f"island {self.robot} has no number of frames left")
        if self._numbers is not None:
            self._numbers.store(self._sealer.durable_needed())
        return sealed

    def receive(self, data: bytes | bytearray | memoryview) -> Received:
        """What to do with bytes that arrived. Never raises for what is in them."""
        received = self._examine(data)
        self.counts[received.outcome] += 1
        return received

    def _examine(self, data: bytes | bytearray | memoryview) -> Received:
        try:
            if self._sealer is not None:
                data = self._opener.open(data)
            frame = decode_frame(data, self.limits)
        except SealError as error:
            was_seen = error.refusal in ("replayed", "too_old")
            return Received(Outcome.replayed if was_seen else Outcome.forged, reason=error.refusal)
        except WireError as error:
            return Received(Outcome.damaged, reason=str(error))
        if frame.sender == self.robot:
            return Received(Outcome.own, sender=frame.sender, energy=frame.energy)
        try:
            genome = self.schema.decode(frame.payload, frame.stamp, self.genes_max)
        except WireError as error:
            outcome = Outcome.another_schema if error.error == "schema" else Outcome.malformed
            return Received(outcome, None, frame.sender, frame.energy, str(error))
        admission = self.gate.admit(self.clock, frame.stamp, self._own_marks(genome))
        if admission == Admission.admitted:
            return Received(Outcome.genome, genome, frame.sender, frame.energy)
        outcome = Outcome.conflict if admission == Admission.identity_conflict else Outcome.too_far
        return Received(outcome, None, frame.sender, frame.energy, admission.name)

    def _own_marks(self, genome: Genome) -> list[InnovationNumber]:
        """The genome's marks of this island: all that the gate needs, since the decoder saw to it that all
        are below the stamp."""
        own: list[InnovationNumber] = []
        for gene_class in self.schema.classes:
            genes = genome[gene_class.name]
            if gene_class.marked:
                own += _marks_of(genes, self.robot)
        return own


def _marks_of(genes: Genes, robot: int) -> list[InnovationNumber]:
    robots: Sequence[int] = genes.robots.tolist()
    if robot not in robots:
        return []
    counters: Sequence[int] = genes.counters.tolist()
    return [InnovationNumber(c, r) for c, r in zip(counters, robots) if r == robot]
