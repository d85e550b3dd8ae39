"""A decoder of the wire format, version 1, written from docs/wire-format.md alone. Standard library only."""

import hashlib
import hmac

KINDS = ("input", "bias", "output", "hidden")
INPUT, BIAS, OUTPUT, HIDDEN = range(4)
# Which kinds of neurons the one before a neuron may have; None: it is the first gene.
ALLOWED_AFTER = {
    INPUT: (None, INPUT),
    BIAS: (None, INPUT),
    OUTPUT: (BIAS, OUTPUT),
    HIDDEN: (OUTPUT, HIDDEN),
}


class Refused(Exception):
    """Bytes that are not a frame: why, and at which offset."""

    def __init__(self, error, offset=None):
        super().__init__(error, offset)
        self.error, self.offset = error, offset


class Bytes:
    """What is read from the front, up to `end`. Offsets are the frame's."""

    def __init__(self, data):
        self.data, self.at, self.end = data, 0, len(data)

    def take(self, count):
        if self.end - self.at < count:
            raise Refused("truncated", self.at)
        self.at += count
        return self.data[self.at - count : self.at]

    def byte(self):
        return self.take(1)[0]

    def word(self):
        return int.from_bytes(self.take(4), "little")

    def varint(self, bits):
        start, value, shift = self.at, 0, 0
        while self.at < self.end:
            byte = self.byte()
            left = bits - shift
            if left < 8 and byte >> left:
                raise Refused("out_of_range", start)
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                if byte == 0 and shift > 7:
                    raise Refused("not_shortest", start)
                return value
        raise Refused("truncated", start)


def is_within(float_bits, limit_bits):
    """IEEE 754 orders magnitudes as it orders their bits."""
    magnitude = float_bits & 0x7FFFFFFF
    return magnitude < 0x7F800000 and magnitude <= limit_bits


def crc32c(data):
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82F63B78 if crc & 1 else 0)
    return crc ^ 0xFFFFFFFF


def decode(data, limits):
    """The value of a frame, with the genome that is its payload; raises Refused."""
    frame, payload = decode_frame(data, limits)
    return frame | {"genome": Genome(payload, frame["stamp"], limits).read()}


def decode_frame(data, limits):
    """The fields of a frame, and its payload as Bytes."""
    if len(data) > limits["frame_bytes"]:
        raise Refused("too_long", limits["frame_bytes"])
    source = Bytes(data)

    if source.byte() != 1:
        raise Refused("version", 0)
    at = source.at
    if (sender := source.varint(32)) == 0:
        raise Refused("robot", at)
    at = source.at
    if (stamp := source.varint(64)) <= limits["genesis_count"]:
        raise Refused("stamp", at)
    at = source.at
    if not is_within(energy := source.word(), limits["energy_bits"]):
        raise Refused("energy", at)
    at = source.at
    payload_bytes = source.varint(32)
    frame_end = source.at + payload_bytes + 4
    if frame_end > len(data):
        raise Refused("truncated", at)
    if frame_end < len(data):
        raise Refused("trailing", frame_end)
    source.end = frame_end - 4
    if crc32c(data[: source.end]) != int.from_bytes(data[source.end :], "little"):
        raise Refused("checksum", source.end)
    return {"sender": sender, "stamp": stamp, "energy_bits": energy}, source


class Genome:
    def __init__(self, source, stamp, limits):
        self.source, self.stamp, self.limits = source, stamp, limits
        self.kinds = []  # of the neurons so far
        self.joined = set()  # ends of the connections so far

    def read(self):
        source, limits = self.source, self.limits
        at = source.at
        if (robot := source.varint(32)) == 0:
            raise Refused("robot", at)
        birth = source.varint(32)
        at = source.at
        if (neurons := source.varint(16)) > limits["neurons"]:
            raise Refused("too_many_genes", at)
        at = source.at
        if (connections := source.varint(16)) > limits["connections"]:
            raise Refused("too_many_genes", at)
        if neurons + 7 * connections > source.end - source.at:
            raise Refused("truncated", source.end)
        self.neurons, self.connections = neurons, connections
        genes, last = [], (0, 0)
        for _ in range(neurons + connections):
            start = source.at
            gene = self.read_gene(start, last)
            if error := self.fault(gene, last):
                raise Refused(error, start)
            genes.append(gene)
            last = gene["counter"], gene["robot"]
        if OUTPUT not in self.kinds:
            raise Refused("kind", source.at)
        if source.at != source.end:
            raise Refused("trailing", source.at)
        return {"robot": robot, "birth": birth, "genes": genes}

    def read_gene(self, start, last):
        source = self.source
        head = source.byte()
        counter, robot = last[0] + (head >> 4), last[1]
        if head >> 4 == 15:
            counter += source.varint(64)
        if counter >= self.stamp:
            raise Refused("not_below", start)
        if head & 8:
            at = source.at
            if (robot := source.varint(32)) == last[1]:
                raise Refused("not_shortest", at)
        gene = {"counter": counter, "robot": robot}
        if head & 1 == 0:
            return gene | {"kind": KINDS[head >> 1 & 3]}
        return gene | {"kind": "connection", "enabled": head & 2 != 0, "recurrent": head & 4 != 0,
                       "source": source.varint(16), "target": source.varint(16),
                       "weight_bits": source.word()}

    def fault(self, gene, last):
        """The first rule that the gene breaks; else notes what the next genes need."""
        counter, robot = gene["counter"], gene["robot"]
        if (counter, robot) <= last:
            return "not_ascending"
        if counter == 0 or (robot == 0) != (counter <= self.limits["genesis_count"]):
            return "genesis"
        if gene["kind"] == "connection":
            return self.connection_fault(gene)
        if len(self.kinds) == self.neurons:
            return "gene_count"
        kind = KINDS.index(gene["kind"])
        if (self.kinds[-1] if self.kinds else None) not in ALLOWED_AFTER[kind]:
            return "kind"
        if kind != HIDDEN and (robot != 0 or self.joined):
            return "kind"
        self.kinds.append(kind)
        return None

    def connection_fault(self, gene):
        source, target = gene["source"], gene["target"]
        if len(self.joined) == self.connections:
            return "gene_count"
        if OUTPUT not in self.kinds:
            return "kind"
        if max(source, target) >= len(self.kinds) or self.kinds[target] in (INPUT, BIAS):
            return "ends"
        if not is_within(gene["weight_bits"], self.limits["weight_bits"]):
            return "weight"
        if (source, target) in self.joined:
            return "repeated_ends"
        self.joined.add((source, target))
        return None


def unseal(data, key, limits):
    """The number of a sealed frame, and the frame's bytes; raises Refused, without an offset."""
    if not 16 <= len(data) <= limits["frame_bytes"] + 27:
        raise Refused("forged")
    tagged, tag = data[:-16], data[-16:]
    if not hmac.compare_digest(hashlib.blake2b(tagged, digest_size=16, key=key).digest(), tag):
        raise Refused("forged")
    source = Bytes(tagged)
    try:
        version, number = source.byte(), source.varint(64)
        frame = tagged[source.at :]
        decode_frame(frame, limits)
    except Refused:
        raise Refused("malformed") from None
    if version != 129 or number == 0:
        raise Refused("malformed")
    return number, frame
