"""What is raised, and the words for it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gene_clocks._marks import InnovationNumber

REASONS = {
    "truncated": "a field ends beyond the bytes",
    "trailing": "bytes are left over",
    "too_long": "it is longer than the limits allow",
    "version": "it is no frame of version 1",
    "not_shortest": "a number has a shorter encoding",
    "out_of_range": "a number has more bits than its field",
    "checksum": "the bytes are not those that were sent",
    "robot": "robot 0 is reserved for the initial genes",
    "stamp": "no clock of this fleet has this stamp: it is not above the genesis marks",
    "energy": "the energy is not finite, or beyond its limit",
    "too_many_genes": "it has more genes than the limits allow",
    "gene_count": "it has not as many genes of a kind as announced",
    "not_ascending": "its mark is not above that of the gene before; sort genes by their marks, each once",
    "not_below": "its mark is not below the stamp; take the stamp after the last mark was made",
    "genesis": "robot 0 marks genes 1 to genesis_count, and no others",
    "kind": "genes come as inputs, one bias, outputs, then the rest",
    "ends": "there is no such gene to join, or it may not be joined",
    "repeated_ends": "another connection joins the same neurons",
    "weight": "its weight is not finite, or beyond its limit",
    "no_room": "the buffer is too small",
    "form": "it is of another form",
    "schema": "its genes are after another schema than this one",
    "attribute": "the schema does not admit its value: not finite, or out of bounds",
}


class WireError(ValueError):
    """A message that is refused, or that cannot be written.

    `error` is the reason's name (docs/wire-format.md) and `offset` the byte where it was found, None
    where nothing was read. Of a general genome, `gene_class`, `gene` (counted in its class), `mark` and
    `attribute` say where it is, as far as that is known.
    """

    def __init__(self, error: str, offset: int | None = None, where: str = "", *,
                 gene_class: str | None = None, gene: int | None = None,
                 mark: InnovationNumber | None = None, attribute: str | None = None) -> None:
        self.error = error
        self.offset = offset
        self.where = where
        self.gene_class, self.gene, self.mark, self.attribute = gene_class, gene, mark, attribute
        place = [where] if where else []
        if self.offset is not None:
            place.append(f"byte {self.offset}")
        at = f" ({', '.join(place)})" if place else ""
        super().__init__(f"{error}{at}: {REASONS.get(error, error)}")

    def __reduce__(self) -> Any:
        return _wire_error, (self.error, self.offset, self.where, self.gene_class, self.gene, self.mark,
                             self.attribute, str(self))


def _wire_error(error: str, offset: int | None, where: str, gene_class: str | None, gene: int | None,
                mark: InnovationNumber | None, attribute: str | None, text: str) -> WireError:
    made = WireError(error, offset, where, gene_class=gene_class, gene=gene, mark=mark,
                     attribute=attribute)
    made.args = (text,)
    return made


class SealError(ValueError):
    """A sealed frame that is not opened: `refusal` is the reason's name."""

    def __init__(self, refusal: str) -> None:
        self.refusal = refusal
        super().__init__(refusal)


class SchemaError(ValueError):
    """A schema that cannot be: `error` is the reason's name."""

    def __init__(self, error: str, text: str = "") -> None:
        self.error = error
        super().__init__(text or error)

    def __reduce__(self) -> Any:
        return SchemaError, (self.error, str(self))


class StorageError(OSError):
    """A counter that could not be stored or read back: `error` is the reason's name."""

    def __init__(self, error: str, text: str = "", number: int = 0) -> None:
        self.error = error
        if number:
            super().__init__(number, text)
        else:
            super().__init__(text or error)

    def __reduce__(self) -> Any:
        return StorageError, (self.error, str(self.args[-1]), self.errno or 0)
