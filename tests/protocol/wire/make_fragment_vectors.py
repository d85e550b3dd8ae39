#!/usr/bin/env python3
"""Writes the test vectors of fragments (docs/wire-format.md) to standard output.

    tests/protocol/wire/make_fragment_vectors.py > tests/protocol/wire/fragment_vectors.json

`splits` are messages with their fragments; `exchanges` are what one receiver is given in order, with what
becomes of each. Expectations are those of fragments.py, which shares nothing with the library; the first
exchanges are also written out by hand in check_fragment_vectors.py.
"""

import json
import random

from fragments import Assembler, split

ROBOTS = (1, 2, 3, 127, 128, 2**32 - 1)


def message_of(size, seed):
    return bytes([1]) + random.Random(seed).randbytes(size - 1)


def splits():
    for size, sender, number, limit in (
            (1, 7, 0, 20), (20, 7, 0, 20), (21, 7, 255, 20), (169, 7, 3, 20), (169, 300, 3, 20),
            (339, 7, 0, 100), (1696, 7, 9, 250), (1696, 2**32 - 1, 9, 382), (256, 7, 1, 6),
            (257, 7, 1, 6), (30, 7, 1, 5), (30, 300, 1, 6), (512, 300, 1, 8), (17, 1, 0, 16)):
        message = message_of(size, size)
        fragments = split(message, sender, number, limit)
        yield {"message": message.hex(), "sender": sender, "number": number, "fragment_bytes": limit,
               "fragments": fragments and [fragment.hex() for fragment in fragments]}


def damaged(rng, fragment):
    kind = rng.randrange(4)
    if kind == 0:
        return fragment[: rng.randrange(len(fragment))]
    if kind == 1:
        return fragment + b"\0"
    changed = bytearray(fragment)
    for _ in range(kind - 1):
        changed[rng.randrange(min(len(changed), 8))] = rng.choice((0, 1, 2, 3, 64, 127, 128, 255))
    return bytes(changed)


def random_exchange(seed):
    """Messages of some senders in small pieces: lost, repeated, out of order, damaged."""
    rng = random.Random(seed)
    link, numbers = [], {robot: rng.randrange(256) for robot in ROBOTS}
    for _ in range(rng.randrange(4, 14)):
        sender = rng.choice(ROBOTS)
        numbers[sender] = (numbers[sender] + rng.choice((1, 1, 1, 0, 2, 255, 100))) % 256
        message = message_of(rng.randrange(2, 75), rng.random())
        fragments = split(message, sender, numbers[sender], rng.randrange(14, 24)) or []
        if rng.random() < 0.5:
            rng.shuffle(fragments)
        link += fragments
    for i in range(len(link)):  # a few change places
        if rng.random() < 0.2:
            j = min(len(link) - 1, i + rng.randrange(5))
            link[i], link[j] = link[j], link[i]
    for fragment in link:
        fate = rng.random()
        if fate < 0.1:
            continue
        yield fragment
        if fate > 0.9:
            yield damaged(rng, fragment)
        elif fate > 0.8:
            yield fragment


def exchange(messages, message_bytes, received):
    assembler, steps = Assembler(messages, message_bytes), []
    for data in received:
        outcome, message = assembler.take(data)
        steps.append([data.hex(), outcome, *([message.hex()] if message else [])])
    return {"messages": messages, "message_bytes": message_bytes, "steps": steps}


def by_hand():
    """Every rule once; check_fragment_vectors.py has the outcomes."""
    piece = lambda number, last, index, data, sender=5: bytes(
        [64, sender, number, last, index]) + data
    yield exchange(2, 10, [
        b"", b"\1whole", b"\1elevenbytes", bytes([64]), bytes([64, 0, 1, 1, 0, 9]),
        piece(1, 0, 0, b"a"), piece(1, 1, 2, b"a"), piece(1, 1, 0, b""),
        piece(1, 2, 2, b"gh"), piece(1, 2, 0, b"abc"), piece(1, 2, 0, b"abc"), piece(1, 2, 1, b"def"),
        piece(1, 2, 1, b"def"), piece(1, 2, 2, b"gh"), piece(1, 2, 2, b"gH"), piece(0, 2, 2, b"gh"),
        piece(249, 1, 0, b"x"), piece(248, 1, 1, b"y"), piece(248 - 8, 1, 1, b"y"), piece(249, 1, 1, b"y")])
    yield exchange(2, 10, [
        piece(1, 1, 0, b"abcdef"), piece(1, 1, 1, b"ghijk"), piece(1, 1, 1, b"ghij"),
        piece(1, 1, 0, b"abcdef"), piece(2, 2, 2, b"abc"), piece(2, 2, 0, b"ab"),
        piece(3, 9, 0, b"ab"), piece(3, 9, 0, b"a"), piece(3, 9, 9, b"b"), piece(3, 9, 9, b"bc")])
    yield exchange(2, 10, [
        piece(1, 1, 0, b"a", 1), piece(1, 1, 0, b"b", 2), piece(1, 1, 1, b"b", 2),
        piece(1, 1, 0, b"c", 3), piece(1, 1, 1, b"a", 1), piece(1, 1, 1, b"c", 3),
        piece(1, 1, 0, b"d", 4), piece(1, 1, 1, b"c", 3), piece(1, 1, 1, b"a", 1)])


def main():
    exchanges = [*by_hand()]
    exchanges += [exchange(1 + seed % 3, 60, random_exchange(seed)) for seed in range(40)]
    lines, more = (",\n".join("  " + json.dumps(one) for one in some) for some in (splits(), exchanges))
    print(f'{{"splits": [\n{lines}\n],\n"exchanges": [\n{more}\n]}}')


if __name__ == "__main__":
    main()
