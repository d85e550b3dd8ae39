"""Gene Clocks: innovation numbers for NEAT that need no coordinator.

Each process has a GeneClock under an id of its own. It mints the mark of every new gene, sends its stamp()
with every genome, and hands the stamp of every genome that it receives to observe() before it uses a gene.
That is the whole protocol: marks are unique, and a gene that was made with knowledge of another sorts
after it.

    clock = GeneClock(robot=7, genesis_count=22)
    mark = clock.mint()                                 # a new gene; None at exhaustion
    node, into, out = clock.mint(3)                     # a split connection

    data = encode_frame(7, clock.stamp(), fitness, payload)
    frame = decode_frame(data)                          # WireError for anything but a frame
    if clock.observe(frame.stamp):                      # before any of its genes is used
        ...

Genomes of any NEAT become payloads by a Schema; odNEAT's genes have encode() and decode(). FileStore keeps
what must outlive a crash, AdmissionGate bounds what strangers do to a clock, Sealer and Opener keep strangers
out (where has_authentication), split_message and MessageAssembler take frames over links that carry less.
gene_clocks.islands does all of it for a distributed NEAT.
"""

from __future__ import annotations

from gene_clocks import _core
from gene_clocks._core import GeneClock as GeneClock
from gene_clocks._errors import (SchemaError as SchemaError, SealError as SealError,
                                 StorageError as StorageError, WireError as WireError)
from gene_clocks._genomes import (Alignment as Alignment, Attribute as Attribute, GeneClass as GeneClass,
                                  Genes as Genes, Genome as Genome, Schema as Schema,
                                  align_columns as align_columns, enumeration as enumeration, flag as flag,
                                  float32 as float32, float64 as float64, integer as integer)
from gene_clocks._marks import (Admission as Admission, GeneMatch as GeneMatch,
                                InnovationNumber as InnovationNumber, MintedMarks as MintedMarks)
from gene_clocks._messages import (Frame as Frame, Gene as Gene, GeneKind as GeneKind,
                                   Message as Message, MessageAssembler as MessageAssembler,
                                   WireLimits as WireLimits, decode as decode,
                                   decode_frame as decode_frame, encode as encode,
                                   encode_frame as encode_frame, split_message as split_message)
from gene_clocks._sealing import Opener as Opener, Sealer as Sealer
from gene_clocks._storage import AdmissionGate as AdmissionGate, FileStore as FileStore

from collections.abc import Iterable as _Iterable

__version__: str = _core.__version__
#: Whether Sealer and Opener work: the package was built with libsodium.
has_authentication: bool = _core.has_authentication


def align(first: _Iterable[InnovationNumber], second: _Iterable[InnovationNumber],
          ) -> list[tuple[GeneMatch, int | None, int | None]]:
    """Aligns two ascending sequences of marks: (GeneMatch, index in first or None, index in second or
    None) for every gene, in the order of marks. ValueError where they do not ascend. align_columns() is the
    same for columns, and faster."""
    return _core._align(first, second)
