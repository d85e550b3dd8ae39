#!/usr/bin/env python3
"""Writes the test vectors of the wire format (docs/wire-format.md) to standard output.

    tests/protocol/wire/make_vectors.py > tests/protocol/wire/vectors.json

Frames are put together here field by field, by an encoder that shares nothing with the library's; the
error and offset that a decoder must report stand beside each damaged one. Floats are given by their bits.
Sealed frames stand apart, with the key that seals them.
"""

import hashlib
import json
import struct

LIMITS = {
    "frame_bytes": 400,
    "genesis_count": 5,
    "neurons": 12,
    "connections": 12,
    "energy_bits": 0x43480000,  # 200
    "weight_bits": 0x41200000,  # 10
}
KINDS = ("input", "bias", "output", "hidden")
MAX_COUNTER = 2**64 - 1


class Here:
    """Among the parts of a frame: where the fault is."""


HERE = Here()


def bits(number):
    return struct.unpack("<I", struct.pack("<f", number))[0]


def word(value):
    return struct.pack("<I", value)


def varint(value):
    out = bytearray()
    while value >= 0x80:
        out.append(0x80 | value & 0x7F)
        value >>= 7
    return bytes([*out, value])


def crc32c(data):
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82F63B78 if crc & 1 else 0)
    return crc ^ 0xFFFFFFFF


def join(parts):
    """The bytes of parts, and the offset of HERE among them."""
    data, offset = b"", None
    for part in parts:
        if part is HERE:
            offset = len(data)
        else:
            data += part
    return data, offset


# ---- Parts -----------------------------------------------------------------------------------------


def head(leap, low_bits, robot):
    return bytes([min(leap, 15) << 4 | (8 if robot is not None else 0) | low_bits]) + (
        varint(leap - 15) if leap >= 15 else b""
    )


def neuron(leap, kind, robot=None):
    return head(leap, KINDS.index(kind) << 1, robot) + (b"" if robot is None else varint(robot))


def connection(leap, source, target, weight=1.0, flags=1, robot=None):
    """`flags`: 1 enabled, 2 recurrent. `weight`: a number, or the bytes of one."""
    return (
        head(leap, 1 | flags << 1, robot)
        + (b"" if robot is None else varint(robot))
        + (source if isinstance(source, bytes) else varint(source))
        + (target if isinstance(target, bytes) else varint(target))
        + (weight if isinstance(weight, bytes) else struct.pack("<f", weight))
    )


def counts(neurons, connections, robot=7, birth=0):
    return varint(robot) + varint(birth) + varint(neurons) + varint(connections)


# Marks 1 to 5: an input, the bias, an output, and what joins them.
NEURONS = [neuron(1, "input"), neuron(1, "bias"), neuron(1, "output")]
CONNECTIONS = [connection(1, 0, 2, 0.5), connection(1, 1, 2, -0.25)]
PERCEPTRON = NEURONS + CONNECTIONS
# Robot 7 splits the first connection: marks <6, 7> to <8, 7>.
SPLIT = [neuron(1, "hidden", robot=7), connection(1, 0, 3), connection(1, 3, 2, 0.5)]


def frame(payload, sender=varint(7), stamp=varint(100), energy=word(bits(50.0)), version=b"\x01",
          length=None, checksum=None, after=b""):
    """Parts of a frame; every field can be replaced by parts of one's own."""
    as_parts = lambda field: field if isinstance(field, list) else [field]
    size = len(join(payload)[0])
    parts = [
        *as_parts(version), *as_parts(sender), *as_parts(stamp), *as_parts(energy),
        *as_parts(varint(size) if length is None else length), *payload,
    ]
    data = join(parts)[0]
    sum_parts = [word(crc32c(data))] if checksum is None else checksum
    return [*parts, *sum_parts, *as_parts(after)]


# ---- Valid frames, from values ---------------------------------------------------------------------


def gene(counter, robot, kind, source=None, target=None, weight=None, enabled=True, recurrent=False):
    value = {"counter": counter, "robot": robot, "kind": kind}
    if kind == "connection":
        value |= {"enabled": enabled, "recurrent": recurrent, "source": source, "target": target,
                  "weight_bits": weight if isinstance(weight, int) else bits(weight)}
    return value


def encode_genome(genome):
    kinds = [gene["kind"] for gene in genome["genes"]]
    payload = counts(len(kinds) - kinds.count("connection"), kinds.count("connection"),
                     genome["robot"], genome["birth"])
    last_counter, last_robot = 0, 0
    for gene in genome["genes"]:
        leap = gene["counter"] - last_counter
        robot = gene["robot"] if gene["robot"] != last_robot else None
        if gene["kind"] == "connection":
            flags = (1 if gene["enabled"] else 0) | (2 if gene["recurrent"] else 0)
            payload += connection(leap, gene["source"], gene["target"], word(gene["weight_bits"]),
                                  flags, robot)
        else:
            payload += neuron(leap, gene["kind"], robot)
        last_counter, last_robot = gene["counter"], gene["robot"]
    return payload


INITIAL = [gene(1, 0, "input"), gene(2, 0, "bias"), gene(3, 0, "output"),
           gene(4, 0, "connection", 0, 2, 0.5), gene(5, 0, "connection", 1, 2, -0.25)]


def valid(name, genes, sender=7, stamp=100, energy=50.0, robot=7, birth=0):
    genome = {"robot": robot, "birth": birth, "genes": genes}
    energy_bits = energy if isinstance(energy, int) else bits(energy)
    parts = frame([encode_genome(genome)], varint(sender), varint(stamp), word(energy_bits))
    value = {"sender": sender, "stamp": stamp, "energy_bits": energy_bits, "genome": genome}
    return {"name": name, "frame": join(parts)[0].hex(), "value": value}


def valid_vectors():
    hidden = gene(6, 7, "hidden")
    yield valid("the initial genome", INITIAL)
    yield valid("an input that is not there: the bias alone",
                [gene(1, 0, "bias"), gene(2, 0, "output"), gene(3, 0, "connection", 0, 1, 1.0)])
    yield valid("no connection", INITIAL[:3])
    yield valid("two outputs", [gene(1, 0, "bias"), gene(2, 0, "output"), gene(3, 0, "output")])
    yield valid("a connection split by robot 7",
                [*INITIAL, hidden, gene(7, 7, "connection", 0, 3, 1.0),
                 gene(8, 7, "connection", 3, 2, 0.5)], stamp=9)
    yield valid("disabled and recurrent connections",
                [*INITIAL[:4], gene(5, 0, "connection", 1, 2, -0.25, enabled=False), hidden,
                 gene(7, 7, "connection", 3, 3, 1.0, recurrent=True),
                 gene(8, 7, "connection", 2, 3, 1.0, enabled=False, recurrent=True)])
    yield valid("the same counter of two robots",
                [*INITIAL, gene(6, 7, "hidden"), gene(6, 8, "hidden"), gene(6, 4294967295, "hidden")])
    yield valid("a smaller robot with a larger counter",
                [*INITIAL, gene(6, 300, "hidden"), gene(7, 7, "hidden"), gene(8, 300, "hidden")])
    yield valid("leaps of 14, 15, 16 and 142, 143", [
        *INITIAL, gene(19, 7, "hidden"), gene(34, 7, "hidden"), gene(50, 7, "hidden"),
        gene(192, 7, "hidden"), gene(335, 7, "hidden")], stamp=336)
    yield valid("the largest counter below the largest stamp",
                [*INITIAL, gene(MAX_COUNTER - 1, 7, "hidden")], stamp=MAX_COUNTER)
    yield valid("the largest counter, after its neighbour", [
        *INITIAL, gene(MAX_COUNTER - 2, 7, "hidden"), gene(MAX_COUNTER - 1, 7, "hidden")],
        stamp=MAX_COUNTER)
    yield valid("the smallest stamp", INITIAL, stamp=6)
    yield valid("the largest sender, maker and birth", INITIAL, sender=2**32 - 1, robot=2**32 - 1,
                birth=2**32 - 1)
    yield valid("the largest energy", INITIAL, energy=200.0)
    yield valid("a negative energy", INITIAL, energy=-200.0)
    yield valid("a negative zero, the smallest number and the largest weights",
                [*INITIAL[:3], gene(4, 0, "connection", 0, 2, 0x80000000),
                 gene(5, 0, "connection", 1, 2, 1), gene(6, 7, "hidden"),
                 gene(7, 7, "connection", 0, 3, 10.0), gene(8, 7, "connection", 3, 2, -10.0)],
                energy=0x80000000)
    yield valid("as many genes as the limits allow",
                [*INITIAL, *(gene(6 + i, 7, "hidden") for i in range(9)),
                 *(gene(20 + i, 7, "connection", 0, 3 + i, 1.0) for i in range(9)),
                 gene(40, 7, "connection", 2, 2, 1.0, recurrent=True)])


# ---- Damaged frames --------------------------------------------------------------------------------


def refused(name, error, parts):
    data, offset = join(parts)
    assert offset is not None, name
    return {"name": name, "frame": data.hex(), "error": error, "offset": offset}


def refused_frames():
    whole = [counts(3, 2), *PERCEPTRON]
    size = len(join(whole)[0])
    yield refused("nothing", "truncated", [HERE])
    yield refused("version 0", "version", frame(whole, version=[HERE, b"\x00"]))
    yield refused("version 2", "version", frame(whole, version=[HERE, b"\x02"]))
    yield refused("sender 0", "robot", frame(whole, sender=[HERE, b"\x00"]))
    yield refused("a sender with a superfluous byte", "not_shortest",
                  frame(whole, sender=[HERE, b"\x87\x00"]))
    yield refused("a sender of 33 bits", "out_of_range",
                  frame(whole, sender=[HERE, b"\xff\xff\xff\xff\x1f"]))
    yield refused("a sender of six bytes", "out_of_range",
                  frame(whole, sender=[HERE, b"\x80\x80\x80\x80\x80\x01"]))
    yield refused("a frame that ends within its sender", "truncated", [b"\x01", HERE, b"\x87"])
    yield refused("stamp 0", "stamp", frame(whole, stamp=[HERE, b"\x00"]))
    yield refused("a stamp among the genesis marks", "stamp", frame(whole, stamp=[HERE, b"\x05"]))
    yield refused("a stamp of 65 bits", "out_of_range",
                  frame(whole, stamp=[HERE, b"\xff" * 9 + b"\x02"]))
    yield refused("a stamp with a superfluous byte", "not_shortest",
                  frame(whole, stamp=[HERE, b"\xe4\x80\x00"]))
    for name, value in (("NaN", 0x7FC00000), ("a signalling NaN", 0xFF800001),
                        ("infinity", 0x7F800000), ("minus infinity", 0xFF800000),
                        ("the next number after the limit", 0x43480001)):
        yield refused(f"energy: {name}", "energy", frame(whole, energy=[HERE, word(value)]))
    data = join(frame(whole, length=varint(size - 1)))[0]
    yield refused("a payload length that is one too small", "trailing",
                  [data[:-1], HERE, data[-1:]])
    yield refused("a payload length that is one too large", "truncated",
                  frame(whole, length=[HERE, varint(size + 1)]))
    yield refused("a payload length of 4 GiB", "truncated",
                  frame(whole, length=[HERE, varint(2**32 - 1)]))
    yield refused("a payload length of 33 bits", "out_of_range",
                  frame(whole, length=[HERE, b"\xff\xff\xff\xff\x1f"]))
    yield refused("a payload length with a superfluous byte", "not_shortest",
                  frame(whole, length=[HERE, bytes([0x80 | size, 0])]))
    yield refused("no room for the checksum", "truncated",
                  [b"\x01\x07\x64", word(bits(50.0)), HERE, b"\x00", b"\x00" * 3])
    yield refused("a byte after the checksum", "trailing", frame(whole, after=[HERE, b"\x00"]))
    data = join(frame(whole))[0]
    yield refused("a checksum with its bytes the other way round", "checksum",
                  frame(whole, checksum=[HERE, data[:-5:-1]]))
    yield refused("a checksum of zero", "checksum", frame(whole, checksum=[HERE, word(0)]))
    limit = LIMITS["frame_bytes"]
    yield refused("a frame of one byte too many", "too_long", [b"\x01" * limit, HERE, b"\x01"])


def refused_genomes():
    def genome(name, error, payload):
        return refused(name, error, frame(payload))

    yield genome("no payload", "truncated", [HERE])
    yield genome("maker 0", "robot", [HERE, counts(3, 2, robot=0), *PERCEPTRON])
    yield genome("a birth of 33 bits", "out_of_range",
                 [b"\x07", HERE, b"\xff\xff\xff\xff\x1f", b"\x03\x02", *PERCEPTRON])
    yield genome("more neurons than the limit", "too_many_genes",
                 [b"\x07\x00", HERE, b"\x0d", b"\x02", *PERCEPTRON, b"\x00" * 99])
    yield genome("more connections than the limit", "too_many_genes",
                 [b"\x07\x00\x03", HERE, b"\x0d", *PERCEPTRON, b"\x00" * 99])
    yield genome("a count of 17 bits", "out_of_range",
                 [b"\x07\x00", HERE, b"\xff\xff\x07", b"\x02", *PERCEPTRON])
    yield genome("counts that the payload cannot hold", "truncated",
                 [counts(3, 3), *PERCEPTRON, HERE])
    yield genome("fewer genes than there are bytes for", "trailing",
                 [counts(3, 1), *NEURONS, CONNECTIONS[0], HERE, CONNECTIONS[1]])
    yield genome("a neuron where a connection was announced", "gene_count",
                 [counts(3, 2), *PERCEPTRON[:4], HERE, neuron(2, "hidden", robot=7), b"\x00" * 5])
    yield genome("a connection where a neuron was announced", "gene_count",
                 [counts(4, 2), *PERCEPTRON, HERE, connection(1, 0, 2, robot=7)])
    yield genome("an initial neuron where a connection was announced", "gene_count",
                 [counts(3, 2), *PERCEPTRON[:4], HERE, neuron(1, "output"), b"\x00" * 6])
    # Marks
    yield genome("a repeated mark", "not_ascending",
                 [counts(4, 2), *PERCEPTRON, HERE, connection(0, 0, 2), SPLIT[0]])
    yield genome("a robot that descends at the same counter", "not_ascending",
                 [counts(5, 2), *PERCEPTRON, neuron(1, "hidden", robot=8), HERE,
                  neuron(0, "hidden", robot=7)])
    yield genome("a first gene without a counter", "not_ascending",
                 [counts(3, 2), HERE, neuron(0, "input"), *PERCEPTRON[1:]])
    yield genome("a first gene with counter 0 of a robot", "genesis",
                 [counts(4, 2), HERE, neuron(0, "hidden", robot=7), *PERCEPTRON])
    yield genome("a counter that equals the stamp", "not_below",
                 [counts(4, 2), *PERCEPTRON, HERE, neuron(95, "hidden", robot=7)])
    yield refused("a counter that equals the stamp, and no robot behind it", "not_below",
                  frame([counts(4, 2), *PERCEPTRON, HERE, b"\x1c"], stamp=varint(6)))
    yield genome("a counter beyond 64 bits", "not_below",
                 [counts(4, 2), *PERCEPTRON, HERE, neuron(MAX_COUNTER - 4, "hidden", robot=7)])
    yield genome("the largest leap", "not_below",
                 [counts(4, 2), *PERCEPTRON, HERE, head(15 + MAX_COUNTER, 6, 7), b"\x07"])
    yield genome("a leap with a superfluous byte", "not_shortest",
                 [counts(4, 2), *PERCEPTRON, b"\xfe", HERE, b"\x80\x00", b"\x07"])
    yield genome("a robot that is given again", "not_shortest",
                 [counts(4, 4), *PERCEPTRON, SPLIT[0], bytes([1 << 4 | 8 | 3]), HERE, b"\x07",
                  b"\x00\x03", word(0), SPLIT[2]])
    yield genome("robot 0 given again at the first gene", "not_shortest",
                 [counts(3, 2), bytes([1 << 4 | 8]), HERE, b"\x00", *PERCEPTRON[1:]])
    yield genome("a robot of 33 bits", "out_of_range",
                 [counts(4, 2), *PERCEPTRON, bytes([1 << 4 | 8 | 6]), HERE, b"\xff\xff\xff\xff\x1f"])
    yield genome("an initial gene beyond the genesis marks", "genesis",
                 [counts(4, 2), *PERCEPTRON, HERE, neuron(1, "hidden")])
    yield genome("a robot's gene among the genesis marks", "genesis",
                 [counts(4, 1), *PERCEPTRON[:4], HERE, neuron(1, "hidden", robot=7)])
    # Kinds
    yield genome("no genes", "kind", [counts(0, 0), HERE])
    yield genome("no output", "kind", [counts(2, 0), *NEURONS[:2], HERE])
    yield genome("no bias", "kind",
                 [counts(2, 0), neuron(1, "input"), HERE, neuron(1, "output")])
    yield genome("two biases", "kind",
                 [counts(3, 0), neuron(1, "bias"), HERE, neuron(1, "bias"), neuron(1, "output")])
    yield genome("an input after the bias", "kind",
                 [counts(3, 0), neuron(1, "bias"), HERE, neuron(1, "input"), neuron(1, "output")])
    yield genome("an output after a hidden neuron", "kind",
                 [counts(4, 0), neuron(1, "bias"), neuron(1, "output"), neuron(1, "hidden"), HERE,
                  neuron(1, "output")])
    yield genome("an output after a connection", "kind",
                 [counts(4, 1), *PERCEPTRON[:4], HERE, neuron(1, "output")])
    yield genome("a hidden neuron before all others", "kind",
                 [counts(3, 0), HERE, neuron(1, "hidden"), neuron(1, "bias"), neuron(1, "output")])
    yield genome("an output of a robot", "kind",
                 [counts(4, 0), *NEURONS, HERE, neuron(3, "output", robot=7)])
    yield genome("a connection before the output", "kind",
                 [counts(3, 1), *NEURONS[:2], HERE, connection(1, 0, 1), NEURONS[2]])
    # Connections
    yield genome("a source that is not there", "ends",
                 [counts(3, 2), *PERCEPTRON[:4], HERE, connection(1, 3, 2)])
    yield genome("a target that is not there", "ends",
                 [counts(3, 2), *PERCEPTRON[:4], HERE, connection(1, 1, 3)])
    yield genome("a connection before its neuron", "ends",
                 [counts(4, 3), *PERCEPTRON, HERE, connection(1, 0, 3, robot=7), neuron(1, "hidden")])
    yield genome("a connection into the input", "ends",
                 [counts(3, 2), *PERCEPTRON[:4], HERE, connection(1, 2, 0)])
    yield genome("a connection into the bias", "ends",
                 [counts(3, 2), *PERCEPTRON[:4], HERE, connection(1, 2, 1)])
    yield genome("the same ends twice", "repeated_ends",
                 [counts(3, 2), *PERCEPTRON[:4], HERE, connection(1, 0, 2)])
    yield genome("a source of 17 bits", "out_of_range",
                 [counts(3, 2), *PERCEPTRON[:4], b"\x13", HERE, b"\x80\x80\x04", b"\x02", word(0)])
    yield genome("a target with a superfluous byte", "not_shortest",
                 [counts(3, 2), *PERCEPTRON[:4], b"\x13\x01", HERE, b"\x82\x00", word(0)])
    yield genome("the same ends twice, and no number for a weight", "weight",
                 [counts(3, 2), *PERCEPTRON[:4], HERE, connection(1, 0, 2, word(0x7FC00000))])
    for name, value in (("NaN", 0x7FC00000), ("infinity", 0x7F800000),
                        ("minus infinity", 0xFF800000),
                        ("the next number after the limit", 0x41200001),
                        ("the next number before the negative limit", 0xC1200001)):
        yield genome(f"weight: {name}", "weight",
                     [counts(3, 2), *PERCEPTRON[:4], HERE, connection(1, 1, 2, word(value))])
    yield genome("genes that cannot fit: the last weight is cut short", "truncated",
                 [counts(3, 2), *PERCEPTRON[:4], CONNECTIONS[1][:-1], HERE])
    yield genome("a payload that ends within a weight", "truncated",
                 [counts(3, 2), *PERCEPTRON[:4], b"\xf3\x01\x01\x02", HERE, b"\x00\x00\x00"])
    yield refused("a payload that ends within a target", "truncated",
                  frame([counts(3, 2), *PERCEPTRON[:4], b"\xfb\x80\x80\x01\x07\x00", HERE, b"\x82"],
                        stamp=varint(2**40)))
    yield genome("a byte after the last gene", "trailing", [counts(3, 2), *PERCEPTRON, HERE, b"\x00"])
    yield genome("a gene after the last gene", "trailing",
                 [counts(3, 2), *PERCEPTRON, HERE, neuron(1, "hidden", robot=7)])


# ---- Sealed frames ---------------------------------------------------------------------------------

KEY = bytes(range(32))


def tag(data, key=KEY):
    return hashlib.blake2b(data, digest_size=16, key=key).digest()


def seal(inner, number=varint(1), version=b"\x81"):
    data = version + number + inner
    return data + tag(data)


def sealed_vectors():
    inner = join(frame([counts(3, 2), *PERCEPTRON]))[0]

    def opened(name, number, inner):
        return {"name": name, "sealed": seal(inner, varint(number)).hex(), "number": number,
                "frame": inner.hex()}

    def refused(name, refusal, sealed):
        return {"name": name, "sealed": sealed.hex(), "refusal": refusal}

    yield opened("the first number", 1, inner)
    yield opened("a number of two bytes", 300, inner)
    yield opened("the largest number", MAX_COUNTER, inner)
    yield opened("a payload that is no genome", 301, join(frame([b"\xff"]))[0])
    data = seal(inner)[:-16]
    yield refused("no bytes", "forged", b"")
    yield refused("less than a tag", "forged", tag(b"")[:15])
    yield refused("a bare frame", "forged", inner)
    yield refused("another key", "forged", data + tag(data, KEY[::-1]))
    yield refused("no key", "forged", data + tag(data, b""))
    yield refused("the first half of a longer tag", "forged",
                  data + hashlib.blake2b(data, key=KEY).digest()[:16])
    yield refused("a tag of the frame alone", "forged", data + tag(inner))
    yield refused("another number under the tag", "forged",
                  seal(inner, varint(2))[:-16] + tag(data))
    longest = b"\x81" + varint(MAX_COUNTER) + bytes(LIMITS["frame_bytes"] + 1)
    yield refused("one byte more than any sealed frame has", "forged", longest + tag(longest))
    yield refused("a frame longer than the limit", "malformed", seal(bytes(LIMITS["frame_bytes"] + 1)))
    yield refused("nothing but a tag", "malformed", tag(b""))
    yield refused("another version", "malformed", seal(inner, version=b"\x82"))
    yield refused("number 0", "malformed", seal(inner, varint(0)))
    yield refused("a number with a superfluous byte", "malformed", seal(inner, b"\x81\x00"))
    yield refused("a number of 65 bits", "malformed", seal(inner, b"\xff" * 9 + b"\x02"))
    yield refused("no number", "malformed", seal(b"", b""))
    yield refused("no frame", "malformed", seal(b""))
    yield refused("a frame with a wrong checksum", "malformed", seal(inner[:-1] + b"\x00"))
    yield refused("a sealed frame, sealed again", "malformed", seal(seal(inner)))


def main():
    vectors = [*valid_vectors(), *refused_frames(), *refused_genomes()]
    names = [vector["name"] for vector in vectors]
    assert len(names) == len(set(names)), "names are unique"
    lines, sealed_lines = (",\n".join("  " + json.dumps(vector) for vector in some)
                           for some in (vectors, sealed_vectors()))
    print(f'{{"limits": {json.dumps(LIMITS)},\n"vectors": [\n{lines}\n],\n'
          f'"key": "{KEY.hex()}",\n"sealed": [\n{sealed_lines}\n]}}')


if __name__ == "__main__":
    main()
