"""Genomes of any NEAT: schemas, and genes as columns."""

from __future__ import annotations

import dataclasses
import struct
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal

from gene_clocks import _core
from gene_clocks._errors import SchemaError
from gene_clocks._marks import InnovationNumber

#: Any buffer of numbers (NumPy's arrays, array.array, memoryview), or any sequence of them.
Column = Any

_TYPES = ("flag", "enumeration", "integer", "float32", "float64")
_ENDS = ("none", "index", "mark")
_FLOAT32_MAX = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0]
_GENES_MAX = 2048


@dataclasses.dataclass(frozen=True)
class Attribute:
    """What a gene, or a genome, has beside its mark and ends; made by the functions below."""

    name: str
    type: Literal["flag", "enumeration", "integer", "float32", "float64"]
    values: tuple[str, ...] = ()
    minimum: int = 0
    maximum: int = 0
    limit: float = 0.0

    def _fields(self) -> tuple[Any, ...]:
        return (self.name, _TYPES.index(self.type), self.values, self.minimum, self.maximum, self.limit)


def flag(name: str) -> Attribute:
    """True or False; takes one bit."""
    return Attribute(name, "flag")


def enumeration(name: str, values: Sequence[str]) -> Attribute:
    """One of 2 to 256 named values, as its index; takes the bits that it needs."""
    return Attribute(name, "enumeration", tuple(values))


def integer(name: str, minimum: int = -(2**63), maximum: int = 2**63 - 1) -> Attribute:
    """An integer of 64 bits within bounds; the nearer to 0, the shorter."""
    return Attribute(name, "integer", (), minimum, maximum)


def float32(name: str, limit: float = _FLOAT32_MAX) -> Attribute:
    """A finite number of 32 bits, of at most this magnitude."""
    return Attribute(name, "float32", limit=limit)


def float64(name: str, limit: float = sys.float_info.max) -> Attribute:
    """A finite number of 64 bits, of at most this magnitude."""
    return Attribute(name, "float64", limit=limit)


@dataclasses.dataclass(frozen=True)
class GeneClass:
    """One kind of genes. They are told apart, and sorted, by their marks or, where they have none, by
    their ends. Ends by index count the genes of all classes before; ends by mark name genes that need not
    be in the genome."""

    name: str
    attributes: Sequence[Attribute] = ()
    ends: Literal["none", "index", "mark"] = "none"
    marked: bool = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "attributes", tuple(self.attributes))


class Genes:
    """The genes of one class, as columns in the order of their marks.

    `counters` and `robots` are their marks (None where the class has none), `sources` and `targets` their
    ends (None where it has none): indices or, by mark, pairs of columns (counters, robots). `attributes`
    has a column for each attribute of the class.
    """

    __slots__ = ("counters", "robots", "sources", "targets", "attributes")

    def __init__(self, counters: Column = None, robots: Column = None, sources: Column = None,
                 targets: Column = None, attributes: Mapping[str, Column] | None = None) -> None:
        self.counters = counters
        self.robots = robots
        self.sources = sources
        self.targets = targets
        self.attributes: dict[str, Column] = {} if attributes is None else dict(attributes)

    def __len__(self) -> int:
        if self.counters is not None:
            return len(self.counters)
        ends = self.sources[0] if isinstance(self.sources, tuple) else self.sources
        return 0 if ends is None else len(ends)

    def __getitem__(self, attribute: str) -> Column:
        """The column of an attribute."""
        return self.attributes[attribute]

    def marks(self) -> list[InnovationNumber]:
        """The marks as objects, for those who need some."""
        counters, robots, *_ = self._plain()
        return [InnovationNumber(counter, robot) for counter, robot in zip(counters, robots)]

    def _plain(self) -> tuple[Any, ...]:
        def plain(column: Column) -> Any:
            if isinstance(column, tuple) and len(column) == 2 and hasattr(column[0], "__len__"):
                return plain(column[0]), plain(column[1])
            return column.tolist() if hasattr(column, "tolist") else (
                None if column is None else list(column))

        return (plain(self.counters), plain(self.robots), plain(self.sources), plain(self.targets),
                {name: plain(column) for name, column in self.attributes.items()})

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Genes):
            return NotImplemented
        return bool(self._plain() == other._plain())

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<Genes: {len(self)}, {', '.join(self.attributes) or 'no attributes'}>"

    def __reduce__(self) -> Any:
        return Genes, self._plain()


class Genome:
    """A genome as columns: who made it (robot, birth), its own attributes, and its genes by class."""

    __slots__ = ("robot", "birth", "attributes", "classes")

    def __init__(self, robot: int, birth: int, classes: Mapping[str, Genes],
                 attributes: Mapping[str, Any] | None = None) -> None:
        self.robot = robot
        self.birth = birth
        self.classes: dict[str, Genes] = dict(classes)
        self.attributes: dict[str, Any] = {} if attributes is None else dict(attributes)

    def __getitem__(self, gene_class: str) -> Genes:
        return self.classes[gene_class]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Genome):
            return NotImplemented
        return (self.robot, self.birth, self.attributes, self.classes) == (
            other.robot, other.birth, other.attributes, other.classes)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        genes = ", ".join(f"{len(genes)} {name}" for name, genes in self.classes.items())
        return f"<Genome {self.birth} of robot {self.robot}: {genes}>"

    def __reduce__(self) -> Any:
        return Genome, (self.robot, self.birth, self.classes, self.attributes)


class Schema:
    """What the genes of a fleet have in them, which all its members agree on once (docs/wire-format.md,
    general genomes). Members with another schema are noticed by its `fingerprint`."""

    __slots__ = ("classes", "genesis_count", "attributes", "_form")

    def __init__(self, classes: Sequence[GeneClass], genesis_count: int = 0,
                 attributes: Sequence[Attribute] = ()) -> None:
        self.classes = tuple(classes)
        self.genesis_count = genesis_count
        self.attributes = tuple(attributes)
        made = _core._Form.make(
            genesis_count,
            [(one.name, one.marked, _ENDS.index(one.ends), [a._fields() for a in one.attributes])
             for one in self.classes], [one._fields() for one in self.attributes])
        if isinstance(made, tuple):
            raise self._error(*made)
        self._form = made

    def _error(self, error: str, class_index: int, attribute: int) -> SchemaError:
        reasons = {
            "classes": f"{len(self.classes)} classes of genes, not 1 to 8",
            "attributes": "more than 32 attributes",
            "name": "a name is 1 to 63 characters of printable ASCII without spaces",
            "repeated": "the name stands there already",
            "identity": "genes have a mark or ends, to be told apart",
            "ends": "ends by index need a class before",
            "values": "an enumeration has 2 to 256 values",
            "bounds": "a minimum is not above its maximum, a limit is finite and above 0",
            "bits": "flags and enumerations have more than 56 bits together",
        }
        place = "schema"
        if error != "classes":
            is_class = class_index < len(self.classes)
            attributes = self.classes[class_index].attributes if is_class else self.attributes
            place = f"class {self.classes[class_index].name!r}" if is_class else "genome"
            if attribute < len(attributes):
                place += f", attribute {attributes[attribute].name!r}"
        return SchemaError(error, f"{place}: {reasons.get(error, error)}")

    @property
    def fingerprint(self) -> int:
        """The CRC-32C of the schema's bytes, which goes with every genome."""
        return self._form.fingerprint()

    def __bytes__(self) -> bytes:
        """The one encoding of this schema."""
        return self._form.bytes()

    def encode(self, genome: Genome, stamp: int, genes_max: int = _GENES_MAX) -> bytes:
        """The payload of a frame with this stamp; WireError, which names the gene, where decode() would
        refuse it."""
        return self._form.encode(genome.robot, genome.birth, genome.attributes, genome.classes, stamp,
                                 genes_max)

    def decode(self, payload: bytes | bytearray | memoryview, stamp: int,
               genes_max: int = _GENES_MAX) -> Genome:
        """The genome in a frame's payload (any buffer); WireError for any other bytes. `stamp` is the
        frame's. Columns are NumPy's arrays, or memory views where there is no NumPy."""
        robot, birth, attributes, classes = self._form.decode(payload, stamp, genes_max)
        return Genome(robot, birth, classes, attributes)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Schema):
            return NotImplemented
        return bytes(self) == bytes(other)

    def __hash__(self) -> int:
        return self.fingerprint

    def __repr__(self) -> str:
        return f"<Schema {self.fingerprint:08x}: {', '.join(one.name for one in self.classes)}>"

    def __reduce__(self) -> Any:
        return Schema, (self.classes, self.genesis_count, self.attributes)


class Alignment:
    """Genes of two genomes in the order of their marks, as columns: how each stands (`matches`, values of
    GeneMatch), and its index in either genome (`first`, `second`), -1 where it is not in it."""

    __slots__ = ("_rows",)

    def __init__(self, rows: Any) -> None:
        self._rows = rows

    @property
    def matches(self) -> Column:
        return self._rows[0]

    @property
    def first(self) -> Column:
        return self._rows[1]

    @property
    def second(self) -> Column:
        return self._rows[2]

    def __iter__(self) -> Iterator[Column]:
        """matches, first, second."""
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows[0])

    def __repr__(self) -> str:
        return f"<Alignment of {len(self)} genes>"


def align_columns(first: Genes, second: Genes) -> Alignment:
    """Aligns two genomes' genes by their marks; ValueError where these do not ascend."""
    return Alignment(_core._align_columns(first.counters, first.robots, second.counters, second.robots))
