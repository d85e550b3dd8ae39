"""A decoder of general genomes, written from docs/wire-format.md alone. Standard library only.

A schema is a dict as in general_vectors.json; a genome's values are integers: the bits of floats, the
number of a flag or an enumeration's value.
"""

import functools

from decoder import Bytes, Refused, crc32c

TYPES = ("flag", "enumeration", "integer", "float32", "float64")
ENDS = ("none", "index", "mark")
WIDTHS = {"float32": 4, "float64": 8}


class SchemaReader:
    """A schema, off its canonical bytes."""

    def __init__(self, data):
        self.source = Bytes(data)

    def read(self):
        if self.source.byte() != 1:
            raise Refused("form", 0)
        schema = {"genesis_count": self.source.varint(64), "attributes": self.attributes(),
                  "classes": [self.gene_class() for _ in range(self.source.byte())]}
        if self.source.at != self.source.end:
            raise Refused("trailing", self.source.at)
        return schema

    def name(self):
        return self.source.take(self.source.byte()).decode("ascii")

    def gene_class(self):
        return {"name": self.name(), "marked": bool(self.source.byte()),
                "ends": ENDS[self.source.byte()], "attributes": self.attributes()}

    def attributes(self):
        return [self.attribute() for _ in range(self.source.byte())]

    def attribute(self):
        attribute = {"name": self.name(), "type": TYPES[self.source.byte()]}
        if attribute["type"] == "enumeration":
            attribute["values"] = [self.name() for _ in range(self.source.varint(16))]
        if attribute["type"] == "integer":
            attribute["minimum"] = unfolded(self.source.varint(64))
            attribute["maximum"] = unfolded(self.source.varint(64))
        if attribute["type"] in WIDTHS:
            width = WIDTHS[attribute["type"]]
            attribute["limit_bits"] = int.from_bytes(self.source.take(width), "little")
        return attribute


def unfolded(number):
    return number // 2 if number % 2 == 0 else -(number + 1) // 2


def width_of(attribute):
    """Bits in the head."""
    if attribute["type"] == "flag":
        return 1
    return (len(attribute["values"]) - 1).bit_length() if attribute["type"] == "enumeration" else 0


def fewest_bytes(attribute):
    return {"flag": 0, "enumeration": 0, "integer": 1}.get(attribute["type"]) or WIDTHS.get(
        attribute["type"], 0)


def is_admitted(attribute, value):
    if attribute["type"] == "enumeration":
        return value < len(attribute["values"])
    if attribute["type"] == "integer":
        return attribute["minimum"] <= value <= attribute["maximum"]
    if attribute["type"] in WIDTHS:
        return value & (1 << 8 * WIDTHS[attribute["type"]] - 1) - 1 <= attribute["limit_bits"]
    return True


class Genome:
    def __init__(self, payload, stamp, schema, fingerprint, genes_max):
        self.source, self.stamp, self.schema = Bytes(payload), stamp, schema
        self.fingerprint, self.genes_max = fingerprint, genes_max

    def read(self):
        source, schema = self.source, self.schema
        if source.byte() != 0:
            raise Refused("form", 0)
        if source.word() != self.fingerprint:
            raise Refused("schema", 1)
        at = source.at
        if (robot := source.varint(32)) == 0:
            raise Refused("robot", at)
        birth, counts = source.varint(64), []
        for _ in schema["classes"]:
            at = source.at
            counts.append(source.varint(32))
            if sum(counts) > self.genes_max:
                raise Refused("too_many_genes", at)
        least = self.fewest(schema["attributes"], self.head_bytes(schema["attributes"], False))
        for count, gene_class in zip(counts, schema["classes"], strict=True):
            head = self.head_bytes(gene_class["attributes"], gene_class["marked"])
            ends = {"none": 0, "index": 2, "mark": 4}[gene_class["ends"]]
            least += count * (ends + self.fewest(gene_class["attributes"], head))
        if least > source.end - source.at:
            raise Refused("truncated", source.end)
        start = source.at
        values = self.values(schema["attributes"], self.head(schema["attributes"], False)[0])
        self.require_admitted(schema["attributes"], values, start)
        classes, before = [], 0
        for count, gene_class in zip(counts, schema["classes"], strict=True):
            classes.append(self.genes(gene_class, count, before))
            before += count
        if source.at != source.end:
            raise Refused("trailing", source.at)
        return {"robot": robot, "birth": birth, "values": values, "classes": classes}

    @staticmethod
    def head_bytes(attributes, marked):
        bits = sum(map(width_of, attributes))
        return -(-(bits + 4 if marked else bits) // 8)

    @staticmethod
    def fewest(attributes, head):
        return head + sum(map(fewest_bytes, attributes))

    def head(self, attributes, marked):
        """The bits of flags and enumerations, whether there is a robot, the leap, and its maximum."""
        start, size = self.source.at, self.head_bytes(attributes, marked)
        bits, width = int.from_bytes(self.source.take(size), "little"), sum(map(width_of, attributes))
        if not marked:
            if bits >> width:
                raise Refused("out_of_range", start)
            return bits, False, 0, 0
        robot, bits = bits & 1, bits >> 1
        return bits & (1 << width) - 1, bool(robot), bits >> width, (1 << 8 * size - 1 - width) - 1

    def values(self, attributes, bits):
        values = []
        for attribute in attributes:
            if width := width_of(attribute):
                values.append(bits & (1 << width) - 1)
                bits >>= width
            elif attribute["type"] == "integer":
                values.append(unfolded(self.source.varint(64)))
            else:
                values.append(int.from_bytes(self.source.take(WIDTHS[attribute["type"]]), "little"))
        return values

    @staticmethod
    def require_admitted(attributes, values, start):
        if not all(map(is_admitted, attributes, values)):
            raise Refused("attribute", start)

    def genes(self, gene_class, count, before):
        genes, last = [], None
        for _ in range(count):
            start = self.source.at
            gene = self.gene(gene_class, start, last)
            if error := self.fault(gene_class, gene, last, before):
                raise Refused(error, start)
            self.require_admitted(gene_class["attributes"], gene["values"], start)
            genes.append(gene)
            last = gene
        return genes

    def gene(self, gene_class, start, last):
        source, gene = self.source, {}
        bits, has_robot, leap, far = self.head(gene_class["attributes"], gene_class["marked"])
        if gene_class["marked"]:
            counter, robot = last["mark"] if last else (0, 0)
            counter += leap + (source.varint(64) if leap == far else 0)
            if counter >= self.stamp:
                raise Refused("not_below", start)
            if has_robot:
                at, before = source.at, robot
                if (robot := source.varint(32)) == before:
                    raise Refused("not_shortest", at)
            gene["mark"] = [counter, robot]
        for end in ("source", "target") if gene_class["ends"] != "none" else ():
            gene[end] = source.varint(32) if gene_class["ends"] == "index" else [
                source.varint(64), source.varint(32)]
        return gene | {"values": self.values(gene_class["attributes"], bits)}

    def is_genesis_right(self, mark):
        return mark[0] > 0 and (mark[1] == 0) == (mark[0] <= self.schema["genesis_count"])

    def fault(self, gene_class, gene, last, before):
        if gene_class["marked"]:
            if gene["mark"] <= (last["mark"] if last else [0, 0]):
                return "not_ascending"
            if not self.is_genesis_right(gene["mark"]):
                return "genesis"
        for end in ("source", "target"):
            if gene_class["ends"] == "index" and gene[end] >= before:
                return "ends"
            if gene_class["ends"] == "mark" and not (
                    gene[end][0] < self.stamp and self.is_genesis_right(gene[end])):
                return "ends"
        if not gene_class["marked"] and last and (
                [gene["source"], gene["target"]] <= [last["source"], last["target"]]):
            return "not_ascending"
        return None


@functools.cache
def schema_of(schema_bytes):
    return SchemaReader(schema_bytes).read(), crc32c(schema_bytes)


def decode(payload, stamp, schema_bytes, genes_max):
    """The genome in a payload; raises Refused."""
    return Genome(payload, stamp, *schema_of(schema_bytes), genes_max).read()
