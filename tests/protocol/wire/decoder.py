"""A decoder of the wire format, version 1, from docs/wire-format.md alone. Standard library only."""

import dataclasses
import struct

KINDS = ("input", "bias", "output", "hidden")


class Refused(Exception):
    """Bytes that are not a frame: why, and at which offset."""

    def __init__(self, error, offset):
        super().__init__(f"{error} at {offset}")
        self.error, self.offset = error, offset


@dataclasses.dataclass
class Limits:
    frame_bytes: int
    genesis_count: int
    neurons: int
    connections: int
    energy_bits: int
    weight_bits: int


class Bytes:
    """Part of a frame, read from the front. Offsets are the frame's."""

    def __init__(self, data, start, end):
        self.data, self.at, self.end = data, start, end

    def byte(self):
        if self.at == self.end:
            raise Refused("truncated", self.at)
        self.at += 1
        return self.data[self.at - 1]

    def varint(self, width):
        start, value, shift = self.at, 0, 0
        while True:
            if self.at == self.end:
                raise Refused("truncated", start)
            byte = self.byte()
            value |= (byte & 0x7F) << shift
            shift += 7
            if value >= 1 << width or (byte & 0x80 and shift >= width):
                raise Refused("out_of_range", start)
            if not byte & 0x80:
                break
        if byte == 0 and shift > 7:
            raise Refused("not_shortest", start)
        return value

    def word(self):
        if self.end - self.at < 4:
            raise Refused("truncated", self.at)
        self.at += 4
        return int.from_bytes(self.data[self.at - 4 : self.at], "little")


def float_is_within(bits, limit_bits):
    value, limit = (struct.unpack("<f", struct.pack("<I", b))[0] for b in (bits, limit_bits))
    return abs(value) < float("inf") and abs(value) <= limit  # comparisons with NaN are false


def crc32c(data):
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82F63B78 if crc & 1 else 0)
    return crc ^ 0xFFFFFFFF


def decode(data, limits):
    """The value of a frame, with the genome that is its payload; raises Refused."""
    if len(data) > limits.frame_bytes:
        raise Refused("too_long", limits.frame_bytes)
    source = Bytes(data, 0, len(data))

    def field(read, is_right, error):
        start = source.at
        value = read()
        if not is_right(value):
            raise Refused(error, start)
        return value

    field(source.byte, lambda value: value == 1, "version")
    sender = field(lambda: source.varint(32), lambda value: value != 0, "robot")
    stamp = field(lambda: source.varint(64), lambda value: value > limits.genesis_count, "stamp")
    energy = field(source.word, lambda value: float_is_within(value, limits.energy_bits), "energy")
    length_at = source.at
    length = source.varint(32)
    left = len(data) - source.at
    if left < length + 4:
        raise Refused("truncated", length_at)
    if left > length + 4:
        raise Refused("trailing", source.at + length + 4)
    payload_end = source.at + length
    if Bytes(data, payload_end, len(data)).word() != crc32c(data[:payload_end]):
        raise Refused("checksum", payload_end)
    genome = Genome(Bytes(data, source.at, payload_end), stamp, limits).read()
    return {"sender": sender, "stamp": stamp, "energy_bits": energy, "genome": genome}


class Genome:
    def __init__(self, source, stamp, limits):
        self.source, self.stamp, self.limits = source, stamp, limits
        self.genes = []
        self.kinds = []  # of the neurons so far
        self.joined = set()  # ends of the connections so far

    def read(self):
        source, limits = self.source, self.limits
        start = source.at
        robot = source.varint(32)
        if robot == 0:
            raise Refused("robot", start)
        birth = source.varint(32)
        self.counts = {}
        for kind, limit in (("neuron", limits.neurons), ("connection", limits.connections)):
            start = source.at
            self.counts[kind] = source.varint(16)
            if self.counts[kind] > limit:
                raise Refused("too_many_genes", start)
        if self.counts["neuron"] + 7 * self.counts["connection"] > source.end - source.at:
            raise Refused("truncated", source.end)
        for _ in range(sum(self.counts.values())):
            self.read_gene()
        if "output" not in self.kinds:
            raise Refused("kind", source.at)
        if source.at != source.end:
            raise Refused("trailing", source.at)
        return {"robot": robot, "birth": birth, "genes": self.genes}

    def read_gene(self):
        source, start = self.source, self.source.at
        last = (self.genes[-1]["counter"], self.genes[-1]["robot"]) if self.genes else (0, 0)
        head = source.byte()
        leap = head >> 4
        if leap == 15:
            leap += source.varint(64)
        counter, robot = last[0] + leap, last[1]
        if counter >= self.stamp:
            raise Refused("not_below", start)
        if head & 8:
            robot_at = source.at
            robot = source.varint(32)
            if robot == last[1]:
                raise Refused("not_shortest", robot_at)
        gene = {"counter": counter, "robot": robot}
        if head & 1:
            gene |= {"kind": "connection", "enabled": bool(head & 2), "recurrent": bool(head & 4)}
            gene["source"] = source.varint(16)
            gene["target"] = source.varint(16)
            gene["weight_bits"] = source.word()
        else:
            gene["kind"] = KINDS[head >> 1 & 3]
        error = self.fault(gene, last)
        if error:
            raise Refused(error, start)
        self.genes.append(gene)

    def fault(self, gene, last):
        """The first rule that the gene breaks; else notes what the next genes need."""
        mark = (gene["counter"], gene["robot"])
        if not last < mark:
            return "not_ascending"
        is_genesis_mark = 1 <= gene["counter"] <= self.limits.genesis_count
        if gene["counter"] == 0 or (gene["robot"] == 0) != is_genesis_mark:
            return "genesis"
        if gene["kind"] == "connection":
            return self.connection_fault(gene)
        return self.neuron_fault(gene)

    def neuron_fault(self, gene):
        kind = gene["kind"]
        if len(self.kinds) == self.counts["neuron"]:
            return "gene_count"
        before = self.kinds[-1] if self.kinds else None
        allowed_after = {
            "input": (None, "input"),
            "bias": (None, "input"),
            "output": ("bias", "output"),
            "hidden": ("output", "hidden"),
        }
        if before not in allowed_after[kind]:
            return "kind"
        if kind != "hidden" and (gene["robot"] != 0 or self.joined):
            return "kind"
        self.kinds.append(kind)
        return None

    def connection_fault(self, gene):
        if len(self.joined) == self.counts["connection"]:
            return "gene_count"
        if "output" not in self.kinds:
            return "kind"
        source, target = gene["source"], gene["target"]
        if max(source, target) >= len(self.kinds) or self.kinds[target] in ("input", "bias"):
            return "ends"
        if not float_is_within(gene["weight_bits"], self.limits.weight_bits):
            return "weight"
        if (source, target) in self.joined:
            return "repeated_ends"
        self.joined.add((source, target))
        return None
