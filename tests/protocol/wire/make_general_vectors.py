#!/usr/bin/env python3
"""Writes the test vectors of general genomes (docs/wire-format.md) to standard output.

    tests/protocol/wire/make_general_vectors.py > tests/protocol/wire/general_vectors.json

As make_vectors.py: put together field by field, by an encoder that shares nothing with the library's.
"""

import json
import struct

from make_vectors import HERE, crc32c, join, varint, word

TYPES = ("flag", "enumeration", "integer", "float32", "float64")
ENDS = ("none", "index", "mark")
F32_MAX, F64_MAX = 0x7F7FFFFF, 0x7FEFFFFFFFFFFFFF
I64_MIN, I64_MAX = -(2**63), 2**63 - 1
STAMP, GENES_MAX = 1000, 40


def f32(number):
    return struct.unpack("<I", struct.pack("<f", number))[0]


def f64(number):
    return struct.unpack("<Q", struct.pack("<d", number))[0]


def folded(number):
    return varint(2 * number if number >= 0 else -2 * number - 1)


# ---- Schemas -------------------------------------------------------------------------------------------


def attribute(name, kind, **more):
    return {"name": name, "type": kind, **more}


def gene_class(name, *attributes, marked=True, ends="none"):
    return {"name": name, "marked": marked, "ends": ends, "attributes": list(attributes)}


def float32(name, limit=F32_MAX):
    return attribute(name, "float32", limit_bits=limit)


def float64(name, limit=F64_MAX):
    return attribute(name, "float64", limit_bits=limit)


NEAT_PYTHON = [
    "abs", "clamped", "cube", "elu", "exp", "gauss", "hat", "identity", "inv", "lelu", "log", "relu",
    "selu", "sigmoid", "sin", "softplus", "square", "tanh"]
SCHEMAS = {
    "as in the document": {"genesis_count": 1, "attributes": [], "classes": [
        gene_class("node", float32("bias", f32(30.0))),
        gene_class("link", float32("weight", f32(30.0)), attribute("enabled", "flag"), ends="index")]},
    "neat-python": {"genesis_count": 4, "attributes": [
        float64("fitness"), attribute("has_fitness", "flag")], "classes": [
            gene_class("input"),
            gene_class("node", float64("bias"), float64("response"), float64("time_constant"),
                       attribute("activation", "enumeration", values=NEAT_PYTHON),
                       attribute("aggregation", "enumeration", values=[
                           "max", "maxabs", "mean", "median", "min", "product", "sum"])),
            gene_class("connection", float64("weight"), attribute("enabled", "flag"), ends="index")]},
    "links without marks": {"genesis_count": 0, "attributes": [], "classes": [
        gene_class("node", attribute("activation", "integer", minimum=0, maximum=255)),
        gene_class("link", float64("weight"), marked=False, ends="index")]},
    "ends by mark": {"genesis_count": 2, "attributes": [], "classes": [
        gene_class("link", float32("weight"), ends="mark"),
        gene_class("module", marked=False, ends="mark")]},
    "every type": {"genesis_count": 0, "attributes": [
        attribute(f"flag{i}", "flag") for i in range(9)], "classes": [
            gene_class("gene", *[attribute(f"kind{i}", "enumeration", values=[
                f"v{j}" for j in range(n)]) for i, n in enumerate((2, 3, 256))],
                attribute("any", "integer", minimum=I64_MIN, maximum=I64_MAX),
                attribute("small", "integer", minimum=-3, maximum=5),
                float32("single"), float64("double"), attribute("on", "flag")),
            gene_class("wide", *[attribute(f"f{i}", "flag") for i in range(32)],
                       marked=False, ends="index")]},
}


def name_bytes(name):
    return bytes([len(name)]) + name.encode("ascii")


def attribute_list(attributes):
    data = bytes([len(attributes)])
    for one in attributes:
        data += name_bytes(one["name"]) + bytes([TYPES.index(one["type"])])
        if one["type"] == "enumeration":
            data += varint(len(one["values"])) + b"".join(map(name_bytes, one["values"]))
        elif one["type"] == "integer":
            data += folded(one["minimum"]) + folded(one["maximum"])
        elif one["type"] == "float32":
            data += struct.pack("<I", one["limit_bits"])
        elif one["type"] == "float64":
            data += struct.pack("<Q", one["limit_bits"])
    return data


def schema_bytes(schema):
    data = b"\x01" + varint(schema["genesis_count"]) + attribute_list(schema["attributes"])
    data += bytes([len(schema["classes"])])
    for one in schema["classes"]:
        data += name_bytes(one["name"]) + bytes([one["marked"], ENDS.index(one["ends"])])
        data += attribute_list(one["attributes"])
    return data


# ---- Parts of a payload --------------------------------------------------------------------------------


def bits_and_rest(attributes, values):
    bits, at, rest = 0, 0, b""
    for one, value in zip(attributes, values, strict=True):
        if one["type"] in ("flag", "enumeration"):
            bits |= value << at
            at += 1 if one["type"] == "flag" else (len(one["values"]) - 1).bit_length()
        elif one["type"] == "integer":
            rest += folded(value)
        else:
            rest += struct.pack("<I" if one["type"] == "float32" else "<Q", value)
    return bits, at, rest


def own(attributes, values):
    """A genome's own attributes."""
    bits, width, rest = bits_and_rest(attributes, values)
    return bits.to_bytes(-(-width // 8), "little") + rest


def end(value):
    return varint(value) if isinstance(value, int) else varint(value[0]) + varint(value[1])


def gene_bytes(one_class, gene, last):
    bits, width, rest = bits_and_rest(one_class["attributes"], gene["values"])
    ends = b"".join(end(gene[side]) for side in ("source", "target") if side in gene)
    if not one_class["marked"]:
        return bits.to_bytes(-(-width // 8), "little") + ends + rest
    size = -(-(1 + width + 3) // 8)
    far = 2 ** (8 * size - 1 - width) - 1
    leap, robot = gene["mark"][0] - last[0], gene["mark"][1]
    head = (min(leap, far) << width | bits) << 1 | (robot != last[1])
    return (head.to_bytes(size, "little") + (varint(leap - far) if leap >= far else b"")
            + (varint(robot) if robot != last[1] else b"") + ends + rest)


def header(schema, *counts, robot=varint(7), birth=varint(0), marker=b"\0", fingerprint=None):
    return [marker, word(crc32c(schema_bytes(schema))) if fingerprint is None else fingerprint, robot,
            birth, *[varint(count) if isinstance(count, int) else count for count in counts]]


def encode(schema, genome):
    parts = header(schema, *map(len, genome["classes"]), robot=varint(genome["robot"]),
                   birth=varint(genome["birth"]))
    parts.append(own(schema["attributes"], genome["values"]))
    for one_class, genes in zip(schema["classes"], genome["classes"], strict=True):
        last = (0, 0)
        for gene in genes:
            parts.append(gene_bytes(one_class, gene, last))
            last = gene.get("mark")
    return join(parts)[0]


# ---- Valid payloads ------------------------------------------------------------------------------------


def marked(counter, robot, *values, ends=None):
    gene = {"mark": [counter, robot]}
    if ends:
        gene |= {"source": ends[0], "target": ends[1]}
    return gene | {"values": list(values)}


def joined(source, target, *values):
    return {"source": source, "target": target, "values": list(values)}


def valid_genomes():
    def genome(*classes, values=(), robot=7, birth=0):
        return {"robot": robot, "birth": birth, "values": list(values), "classes": list(classes)}

    one, half = f32(1.0), f32(0.5)
    yield "the document's example", "as in the document", genome(
        [marked(1, 0, 0), marked(4, 7, half)], [marked(5, 7, f32(-1.0), 1, ends=(0, 1))])
    yield "no genes", "as in the document", genome([], [])
    yield "nodes alone", "as in the document", genome([marked(2, 1, one)], [])
    yield "the largest identity", "as in the document", genome(
        [], [], robot=2**32 - 1, birth=2**64 - 1)
    yield "limits, both signs, both zeros", "as in the document", genome(
        [marked(i + 2, 9, bits) for i, bits in enumerate(
            (f32(30.0), f32(-30.0), 0, 0x80000000, 1))], [])
    for leap in (126, 127, 128, 254, 255, 995):
        yield f"a leap of {leap} in seven bits", "as in the document", genome(
            [marked(1, 0, 0), marked(1 + leap, 3, 0)], [])
    for leap in (62, 63, 64, 190, 191):
        yield f"a leap of {leap} in six bits", "as in the document", genome(
            [marked(1, 0, 0)], [marked(2, 3, 0, 0, ends=(0, 0)), marked(2 + leap, 3, 0, 0, ends=(0, 0))])
    yield "the same counter twice, of two robots", "as in the document", genome(
        [marked(5, 3, 0), marked(5, 4, 0), marked(5, 2**32 - 1, 0)], [])
    yield "a link and a node with one mark", "as in the document", genome(
        [marked(5, 3, 0)], [marked(5, 3, one, 1, ends=(0, 0))])
    yield "two links with the same ends", "as in the document", genome(
        [marked(5, 3, 0)], [marked(6, 3, one, 1, ends=(0, 0)), marked(7, 3, one, 0, ends=(0, 0))])

    weights = [f64(number) for number in (0.1, -30.0, 1e308)]
    yield "neat-python, a split connection", "neat-python", genome(
        [marked(1, 0), marked(2, 0)],
        [marked(3, 0, f64(0.25), f64(1.0), f64(1.0), 17, 6),
         marked(40, 5, f64(-1.5), f64(1.0), f64(0.5), 0, 0)],
        [marked(4, 0, weights[0], 0, ends=(0, 2)), marked(41, 5, weights[1], 1, ends=(0, 3)),
         marked(42, 5, weights[2], 1, ends=(3, 2))], values=(f64(3.75), 1))
    yield "links in the order of their ends", "links without marks", genome(
        [marked(1, 2, 0), marked(3, 2, 255), marked(4, 1, 7)],
        [joined(0, 0, weights[0]), joined(0, 2, weights[1]), joined(1, 0, weights[2]), joined(2, 2, 0)])
    yield "ends of genes that are elsewhere", "ends by mark", genome(
        [marked(7, 3, one, ends=([1, 0], [2, 0])), marked(8, 3, one, ends=([999, 4], [7, 3]))],
        [joined([1, 0], [5, 1]), joined([1, 0], [5, 2]), joined([3, 9], [1, 0])])
    yield "every type", "every type", genome(
        [marked(1, 1, 1, 2, 255, I64_MIN, -3, F32_MAX, F64_MAX, 1),
         marked(2, 1, 0, 0, 0, I64_MAX, 5, F32_MAX | 1 << 31, F64_MAX | 1 << 63, 0),
         marked(3, 1, 1, 1, 128, 0, 0, 0, 0, 1), marked(4, 1, 0, 2, 7, -1, -1, 1, 1, 0)],
        [joined(0, 0, *[1] * 32), joined(0, 3, *[0] * 32), joined(3, 0, *[1, 0] * 16)],
        values=[1, 0, 1, 1, 0, 0, 0, 1, 1])


# ---- Refused payloads ----------------------------------------------------------------------------------


def refused(name, error, schema, parts, **more):
    payload, offset = join(parts)
    return {"name": name, "schema": schema, "payload": payload.hex(), "error": error, "offset": offset,
            **more}


def refused_headers():
    schema, name = SCHEMAS["as in the document"], "as in the document"

    def fault(title, error, parts, **more):
        return refused(title, error, name, parts, **more)

    start = lambda **fields: header(schema, 0, 0, **fields)
    yield fault("nothing", "truncated", [HERE])
    yield fault("another marker", "form", [HERE, *start(marker=b"\x01")])
    yield fault("a genome of version 1", "form", [HERE, bytes.fromhex("0700030210121413")])
    for other in SCHEMAS:
        if other != name:
            yield fault(f"genes after the schema {other!r}", "schema",
                        [b"\0", HERE, *header(SCHEMAS[other], 0, 0)[1:]])
    yield fault("robot 0", "robot", [*start()[:2], HERE, b"\0", b"\0\0\0"])
    yield fault("a robot of 33 bits", "out_of_range",
                [*start()[:2], HERE, varint(2**32), b"\0\0\0"])
    yield fault("a birth with a superfluous byte", "not_shortest",
                [*start()[:3], HERE, b"\x81\0", b"\0\0"])
    yield fault("a birth of 65 bits", "out_of_range",
                [*start()[:3], HERE, b"\xff" * 9 + b"\x02", b"\0\0"])
    yield fault("more genes than the limit", "too_many_genes",
                [*start()[:4], HERE, varint(GENES_MAX + 1), b"\0"])
    yield fault("more genes than the limit in two classes", "too_many_genes",
                [*start()[:4], varint(GENES_MAX), HERE, b"\x01"])
    yield fault("a count of 32 bits", "too_many_genes", [*start()[:4], b"\0", HERE, varint(2**32 - 1)])
    yield fault("a count of 33 bits", "out_of_range", [*start()[:4], b"\0", HERE, varint(2**32)])
    yield fault("two nodes announced in the bytes of one", "truncated",
                [*header(schema, 2, 0), b"\x04\x00\x00\x00\x00\x04\x00\x00\x00", HERE])
    yield fault("a link announced in too few bytes", "truncated",
                [*header(schema, 0, 1), b"\x04\0\0\0\0\0", HERE])
    yield fault("a byte after an empty genome", "trailing", [*start(), HERE, b"\0"])


def refused_genes():
    schema, name = SCHEMAS["as in the document"], "as in the document"
    node, link = (lambda gene, last=(0, 0): gene_bytes(schema["classes"][0], gene, last)), (
        lambda gene, last=(0, 0): gene_bytes(schema["classes"][1], gene, last))

    def fault(title, error, *parts, counts=(1, 0), **more):
        return refused(title, error, name, [*header(schema, *counts), *parts], **more)

    initial = node(marked(1, 0, 0))
    yield fault("a mark that is no mark", "not_ascending", HERE, b"\x00\0\0\0\0")
    yield fault("a counter of 0", "genesis", HERE, b"\x01\x05\0\0\0\0")
    yield fault("a mark twice", "not_ascending", initial, HERE, b"\x00\0\0\0\0", counts=(2, 0))
    yield fault("the same counter, a smaller robot", "not_ascending", node(marked(5, 4, 0)), HERE,
                b"\x01\x03\0\0\0\0", counts=(2, 0))
    yield fault("a mark of robot 0 above the genesis marks", "genesis", HERE, node(marked(2, 0, 0)))
    yield fault("a genesis mark of a robot", "genesis", HERE, node(marked(1, 3, 0)))
    yield fault("a robot that is given twice", "not_shortest", node(marked(5, 4, 0)), b"\x03", HERE,
                b"\x04\0\0\0\0", counts=(2, 0))
    yield fault("the reserved robot, given", "not_shortest", b"\x03", HERE, b"\0\0\0\0\0")
    yield fault("a counter that is the stamp", "not_below", HERE, node(marked(STAMP, 3, 0)))
    yield fault("a leap within the head, to the stamp", "not_below", HERE, node(marked(5, 3, 0)), stamp=5)
    yield fault("a leap of nearly 2^64", "not_below", initial, HERE,
                b"\xff" + b"\xff" * 9 + b"\x01" + b"\x03\0\0\0\0", counts=(2, 0))
    yield fault("a leap of 65 bits", "out_of_range", initial, b"\xff", HERE,
                b"\xff" * 9 + b"\x02" + b"\x03\0\0\0\0", counts=(2, 0))
    yield fault("more with a superfluous byte", "not_shortest", b"\xff", HERE, b"\x81\x00\x03\0\0\0\0")
    yield fault("a bias beyond the limit", "attribute", HERE, node(marked(1, 0, f32(30.0) + 1)))
    yield fault("a bias that is infinite", "attribute", HERE, node(marked(1, 0, 0x7F800000)))
    yield fault("a bias that is no number", "attribute", HERE, node(marked(1, 0, 0xFFC00000)))
    yield fault("a second byte more that takes from the bias", "truncated", b"\xff\x81\x01\x03", HERE,
                b"\0")
    to_itself = marked(6, 3, 0, 0, ends=(0, 0))
    yield fault("a source that is not there", "ends", initial, HERE,
                link(to_itself | {"source": 1}), counts=(1, 1))
    yield fault("a target that is not there", "ends", initial, HERE,
                link(to_itself | {"target": 1}), counts=(1, 1))
    yield fault("a link to a link", "ends", initial, link(to_itself), HERE,
                link(marked(7, 3, 0, 0, ends=(0, 1)), (6, 3)), counts=(1, 2))
    yield fault("a source with a superfluous byte", "not_shortest", initial, b"\x19\x03", HERE,
                b"\x80\0\0\0\0\0\0", counts=(1, 1))
    yield fault("a target of 33 bits", "out_of_range", initial, b"\x19\x03\0", HERE,
                varint(2**32) + b"\0\0\0\0", counts=(1, 1))
    yield fault("a weight beyond the limit", "attribute", initial, HERE,
                link(marked(6, 3, f32(-30.0) + 1, 0, ends=(0, 0))), counts=(1, 1))
    yield fault("links whose marks begin anew, but not above", "not_ascending", initial, HERE,
                b"\x00\0\0\0\0\0\0", counts=(1, 1))
    yield fault("a byte after the last gene", "trailing", initial, HERE, b"\0")


def refused_elsewhere():
    def fault(title, error, name, counts, *parts, values=(), **more):
        schema = SCHEMAS[name]
        return refused(title, error, name, [*header(schema, *counts), *parts], **more)

    neat = SCHEMAS["neat-python"]
    yield fault("a fitness that is no number", "attribute", "neat-python", (0, 0, 0), HERE,
                own(neat["attributes"], (0x7FF8000000000000, 1)))
    yield fault("a bit beside the genome's flag", "out_of_range", "neat-python", (0, 0, 0), HERE,
                b"\x02" + bytes(8))
    rest = own(neat["attributes"], (0, 0))
    node = marked(3, 0, 0, 0, 0, 17, 6)
    for title, values in (("activation", (0, 0, 0, 18, 6)), ("aggregation", (0, 0, 0, 17, 7)),
                          ("time constant", (0, 0, F64_MAX + 1, 17, 6))):
        yield fault(f"no such {title}", "attribute", "neat-python", (0, 1, 0), rest, HERE,
                    gene_bytes(neat["classes"][1], node | {"values": list(values)}, (0, 0)))
    links = SCHEMAS["links without marks"]
    nodes = b"".join(gene_bytes(links["classes"][0], marked(5, robot, 0), last)
                     for robot, last in ((1, (0, 0)), (2, (5, 1))))
    link = lambda source, target: gene_bytes(links["classes"][1], joined(source, target, 0), None)
    for title, first, second in (("the same ends", (0, 1), (0, 1)), ("a smaller target", (0, 1), (0, 0)),
                                 ("a smaller source", (1, 0), (0, 1))):
        yield fault(f"links without marks: {title}", "not_ascending", "links without marks", (2, 2),
                    nodes, link(*first), HERE, link(*second))
    node = lambda value: gene_bytes(links["classes"][0], marked(5, 1, value), (0, 0))
    yield fault("an integer above its maximum", "attribute", "links without marks", (1, 0), HERE,
                node(256))
    yield fault("an integer below its minimum", "attribute", "links without marks", (1, 0), HERE,
                node(-1))
    yield fault("an integer with a superfluous byte", "not_shortest", "links without marks", (1, 0),
                b"\x0b\x01", HERE, b"\x80\0")
    yield fault("an integer of 65 bits", "out_of_range", "links without marks", (1, 0),
                b"\x0b\x01", HERE, b"\xff" * 9 + b"\x02")
    by_mark = SCHEMAS["ends by mark"]
    link = lambda source, target: gene_bytes(
        by_mark["classes"][0], marked(7, 3, 0, ends=(source, target)), (0, 0))
    for title, mark in (("a counter of 0", [0, 1]), ("no mark", [0, 0]), ("the stamp", [STAMP, 1]),
                        ("a genesis mark of a robot", [2, 1]), ("robot 0 above genesis", [3, 0])):
        yield fault(f"a source with {title}", "ends", "ends by mark", (1, 0), HERE, link(mark, [1, 0]))
        yield fault(f"a target with {title}", "ends", "ends by mark", (1, 0), HERE, link([1, 0], mark))
    yield fault("a link by marks, announced in too few bytes", "truncated", "ends by mark", (1, 0),
                link([1, 0], [1, 0])[:-2], HERE)
    module = lambda source, target: end(source) + end(target)
    for title, first, second in (
            ("the same marks", ([1, 0], [5, 2]), ([1, 0], [5, 2])),
            ("a smaller target robot", ([1, 0], [5, 2]), ([1, 0], [5, 1])),
            ("a smaller target counter", ([1, 0], [5, 2]), ([1, 0], [4, 3])),
            ("a smaller source robot", ([5, 2], [1, 0]), ([5, 1], [2, 0]))):
        yield fault(f"modules without marks: {title}", "not_ascending", "ends by mark", (0, 2),
                    module(*first), HERE, module(*second))
    every = SCHEMAS["every type"]
    yield fault("a bit beside nine flags", "out_of_range", "every type", (0, 0), HERE, b"\0\x02")
    gene = lambda *values: gene_bytes(every["classes"][0], marked(1, 1, *values), (0, 0))
    yield fault("an enumeration's value that its bits hold", "attribute", "every type", (1, 0), b"\0\0",
                HERE, gene(0, 3, 0, 0, 0, 0, 0, 0))


def main():
    vectors = []
    for name, schema, genome in valid_genomes():
        vectors.append({"name": name, "schema": schema,
                        "payload": encode(SCHEMAS[schema], genome).hex(), "value": genome})
    vectors += [*refused_headers(), *refused_genes(), *refused_elsewhere()]
    names = [vector["name"] for vector in vectors]
    assert len(names) == len(set(names)), "names are unique"
    schemas = [{"name": name, "bytes": schema_bytes(schema).hex(),
                "fingerprint": crc32c(schema_bytes(schema)), "value": schema}
               for name, schema in SCHEMAS.items()]
    schema_lines, lines = (",\n".join("  " + json.dumps(one) for one in some)
                           for some in (schemas, vectors))
    print(f'{{"stamp": {STAMP}, "genes_max": {GENES_MAX},\n"schemas": [\n{schema_lines}\n],\n'
          f'"vectors": [\n{lines}\n]}}')


if __name__ == "__main__":
    main()
