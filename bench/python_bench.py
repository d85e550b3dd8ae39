#!/usr/bin/env python3
"""What the Python package costs, beside the same in pure Python in one run: align at 200 genes; arrays to a
frame and back for a genome of 200 connections; and single calls.

    PYTHONPATH=build/release/python bench/python_bench.py

CPU time of the process, the best of several rounds. With --check it ends with status 1 where an aim is missed.
"""

import random
import struct
import sys
import time

import gene_clocks
from gene_clocks import GeneClass, GeneClock, Genes, Genome, InnovationNumber, Schema, flag, float64

try:
    import numpy
except ImportError:
    sys.exit("this benchmark needs NumPy (Debian: python3-numpy)")

SCHEMA = Schema([GeneClass("node", [float64("bias"), float64("response")]),
                 GeneClass("connection", [float64("weight"), flag("enabled")], ends="index")],
                genesis_count=22)
STAMP = 100_000


def marks(count, rng, start=23):
    """Ascending marks of many robots."""
    counter, made = start, []
    for _ in range(count):
        counter += rng.randrange(1, 30)
        made.append(InnovationNumber(counter, rng.randrange(1, 100)))
    return made


def columns(made):
    return (numpy.array([mark.counter for mark in made], dtype=numpy.uint64),
            numpy.array([mark.robot for mark in made], dtype=numpy.uint32))


def a_genome(rng):
    nodes, links = marks(72, rng), marks(200, rng)
    return Genome(7, 3, {
        "node": Genes(*columns(nodes), attributes={
            name: numpy.array([rng.gauss(0, 1) for _ in nodes]) for name in ("bias", "response")}),
        "connection": Genes(*columns(links), *(
            numpy.array([rng.randrange(72) for _ in links], dtype=numpy.uint32) for _ in range(2)),
            {"weight": numpy.array([rng.gauss(0, 1) for _ in links]),
             "enabled": numpy.array([rng.random() < 0.8 for _ in links])})})


def siblings(rng):
    """Two genomes of 200 genes that share nine tenths."""
    common = marks(180, rng)
    return [sorted({*common, *marks(20, rng)})[:200] for _ in range(2)]


def align_in_python(first, second):
    """The same list as gene_clocks.align gives, by the plainest loop."""
    genes, i, j = [], 0, 0
    while i < len(first) and j < len(second):
        if first[i] == second[j]:
            genes.append(("matching", i, j))
            i, j = i + 1, j + 1
        elif first[i] < second[j]:
            genes.append(("disjoint_first", i, None))
            i += 1
        else:
            genes.append(("disjoint_second", None, j))
            j += 1
    genes += [("excess_first", k, None) for k in range(i, len(first))]
    genes += [("excess_second", None, k) for k in range(j, len(second))]
    return genes


def encode_in_python(genome):
    """Genes packed one by one with struct: fixed widths, no checks, no checksum."""
    parts = [struct.pack("<IQ", genome.robot, genome.birth)]
    for name, format_ in (("node", "<QIdd"), ("connection", "<QIIId?")):
        genes = genome[name]
        parts.append(struct.pack("<I", len(genes)))
        rows = zip(*(column.tolist() for column in (
            genes.counters, genes.robots,
            *((genes.sources, genes.targets) if name == "connection" else ()),
            *genes.attributes.values())))
        parts += [struct.pack(format_, *row) for row in rows]
    return b"".join(parts)


def decode_in_python(data):
    robot, birth = struct.unpack_from("<IQ", data)
    at, classes = 12, {}
    for name, format_ in (("node", "<QIdd"), ("connection", "<QIIId?")):
        (count,) = struct.unpack_from("<I", data, at)
        size = struct.calcsize(format_)
        rows = [struct.unpack_from(format_, data, at + 4 + i * size) for i in range(count)]
        classes[name] = [numpy.array(column) for column in zip(*rows)]
        at += 4 + count * size
    return robot, birth, classes


def microseconds(work, rounds=25, seconds=0.02):
    count, best = 1, None
    while True:
        start = time.process_time()
        for _ in range(count):
            work()
        spent = time.process_time() - start
        if spent >= seconds:
            break
        count *= 2
    for _ in range(rounds):
        start = time.process_time()
        for _ in range(count):
            work()
        spent = (time.process_time() - start) / count
        best = spent if best is None else min(best, spent)
    return best * 1e6


def main():
    rng = random.Random(1)
    genome, (first, second) = a_genome(rng), siblings(rng)
    left, right = Genes(*columns(first)), Genes(*columns(second))
    payload = SCHEMA.encode(genome, STAMP)
    frame = gene_clocks.encode_frame(7, STAMP, 1.0, payload)
    plain = encode_in_python(genome)
    clock = GeneClock(1)
    assert SCHEMA.decode(payload, STAMP) == genome
    assert len(align_in_python(first, second)) == len(gene_clocks.align(first, second))

    def there_and_back():
        data = gene_clocks.encode_frame(7, STAMP, 1.0, SCHEMA.encode(genome, STAMP))
        read = gene_clocks.decode_frame(data)
        return SCHEMA.decode(read.payload, read.stamp)

    rows = [
        ("align, 200 genes", lambda: gene_clocks.align_columns(left, right),
         lambda: align_in_python(first, second)),
        ("align, 200 genes, lists of marks", lambda: gene_clocks.align(first, second),
         lambda: align_in_python(first, second)),
        (f"arrays to a frame and back, 200 connections and 72 nodes ({len(frame)} bytes)", there_and_back,
         lambda: decode_in_python(encode_in_python(genome))),
        ("arrays to a payload", lambda: SCHEMA.encode(genome, STAMP), lambda: encode_in_python(genome)),
        ("payload to arrays", lambda: SCHEMA.decode(payload, STAMP), lambda: decode_in_python(plain)),
        ("mint", clock.mint, None),
        ("observe", lambda: clock.observe(1), None),
    ]
    print("| | package, µs | pure Python, µs | times faster |\n| --- | --- | --- | --- |")
    measured = {}
    for title, ours, theirs in rows:
        own = microseconds(ours)
        other = microseconds(theirs) if theirs else None
        measured[title.split(",")[0]] = measured.get(title.split(",")[0], (own, other))
        ratio = f"{other:.1f} | {other / own:.1f}" if other else "|"
        print(f"| {title} | {own:.2f} | {ratio} |")
    if "--check" in sys.argv[1:]:
        own, other = measured["align"]
        there, _ = measured["arrays to a frame and back"]
        sys.exit(0 if other >= 10 * own and there <= 25 else 1)


if __name__ == "__main__":
    main()
