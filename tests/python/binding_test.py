"""The Python module: the same marks, the same order, the same frames as elsewhere.

The module is found by PYTHONPATH; GENE_CLOCKS_WIRE_VECTORS names the file of test vectors.
"""

import json
import os
import pathlib
import pickle
import random
import resource
import struct
import unittest

import gene_clocks
from gene_clocks import Gene, GeneClock, GeneKind, GeneMatch, InnovationNumber, Message, WireError

DOCUMENT = json.loads(pathlib.Path(os.environ["GENE_CLOCKS_WIRE_VECTORS"]).read_text())
MAXIMUM = 2**64 - 1
# Where the build says nothing, whatever the module has is tested.
AUTHENTICATES = os.environ.get("GENE_CLOCKS_AUTHENTICATION", str(hasattr(gene_clocks, "Sealer"))) in (
    "1", "True")


def float_of(bits):
    return struct.unpack("<f", struct.pack("<I", bits))[0]


def bits_of(number):
    return struct.unpack("<I", struct.pack("<f", number))[0]


def wire_limits():
    limits = dict(DOCUMENT["limits"])
    return gene_clocks.WireLimits(energy=float_of(limits.pop("energy_bits")),
                                  weight=float_of(limits.pop("weight_bits")), **limits)


def message_of(value):
    """The message that a vector describes."""
    genes = []
    for gene in value["genome"]["genes"]:
        mark = InnovationNumber(gene["counter"], gene["robot"])
        kind = getattr(GeneKind, gene["kind"])
        if kind == GeneKind.connection:
            genes.append(Gene(mark, kind, source=gene["source"], target=gene["target"],
                              weight=float_of(gene["weight_bits"]), enabled=gene["enabled"],
                              recurrent=gene["recurrent"]))
        else:
            genes.append(Gene(mark, kind))
    return Message(sender=value["sender"], stamp=value["stamp"],
                   energy=float_of(value["energy_bits"]), robot=value["genome"]["robot"],
                   birth=value["genome"]["birth"], genes=genes)


def value_of(message):
    """The other way round, so that a vector's value is compared in full."""
    genes = []
    for gene in message.genes:
        described = {"counter": gene.mark.counter, "robot": gene.mark.robot, "kind": gene.kind.name}
        if gene.kind == GeneKind.connection:
            described |= {"enabled": gene.enabled, "recurrent": gene.recurrent,
                          "source": gene.source, "target": gene.target,
                          "weight_bits": bits_of(gene.weight)}
        genes.append(described)
    return {"sender": message.sender, "stamp": message.stamp,
            "energy_bits": bits_of(message.energy),
            "genome": {"robot": message.robot, "birth": message.birth, "genes": genes}}


class InnovationNumberTest(unittest.TestCase):
    def test_counter_first_then_robot(self):
        shuffled = [InnovationNumber(c, r) for c in (1, 2, MAXIMUM) for r in (0, 7, 2**32 - 1)]
        random.Random(1).shuffle(shuffled)
        self.assertEqual([(m.counter, m.robot) for m in sorted(shuffled)],
                         sorted((m.counter, m.robot) for m in shuffled))

    def test_equal_marks_are_one_key_and_survive_pickling(self):
        mark = InnovationNumber(2**63, 5)
        self.assertEqual(len({mark, InnovationNumber(2**63, 5), InnovationNumber(2**63, 6)}), 2)
        self.assertEqual(pickle.loads(pickle.dumps(mark)), mark)
        self.assertEqual(repr(mark), "InnovationNumber(9223372036854775808, 5)")

    def test_what_has_too_many_bits_is_refused(self):
        for counter, robot in ((2**64, 1), (-1, 1), (1, 2**32), (1, -1)):
            self.assertRaises(ValueError, InnovationNumber, counter, robot)


class GeneClockTest(unittest.TestCase):
    def test_what_is_made_with_knowledge_sorts_after(self):
        ours, theirs = GeneClock(1, 22), GeneClock(2, 22)
        first = ours.mint()
        self.assertEqual(first, InnovationNumber(23, 1))
        self.assertTrue(theirs.observe(ours.stamp()))
        self.assertLess(first, theirs.mint())

    def test_all_marks_or_none(self):
        clock = GeneClock(1, maximum=5)
        self.assertEqual(clock.mint(3), [InnovationNumber(c, 1) for c in (1, 2, 3)])
        self.assertIsNone(clock.mint(2))
        self.assertEqual(clock.stamp(), 4)
        self.assertEqual(clock.mint(), InnovationNumber(4, 1))
        self.assertIsNone(clock.mint())

    def test_marks_take_no_memory_and_more_than_there_are_is_none(self):
        clock = GeneClock(1)
        self.assertEqual(clock.mint(2**62)[-1], InnovationNumber(2**62, 1))
        for count in (2**64 - 1, 2**64, 2**200):
            self.assertIsNone(clock.mint(count))
        self.assertRaises(ValueError, clock.mint, -1)
        self.assertEqual(clock.stamp(), 2**62 + 1)

    def test_a_refused_stamp_changes_nothing(self):
        clock = GeneClock(1, window=10)
        self.assertFalse(clock.observe(12))
        self.assertFalse(clock.observe(8, [InnovationNumber(8, 2)]))
        self.assertEqual(clock.stamp(), 1)
        self.assertTrue(clock.observe(11))
        self.assertTrue(clock.observe(14, [InnovationNumber(13, 2)]))
        self.assertEqual(clock.stamp(), 14)

    def test_restart_makes_no_mark_again(self):
        clock = GeneClock(1, block=100)
        before = {clock.mint() for _ in range(150)}
        again = GeneClock.restart(1, clock.durable_needed(), 0, block=100)
        self.assertFalse(before & {again.mint() for _ in range(150)})

    def test_preconditions_are_errors(self):
        self.assertRaises(ValueError, GeneClock, 0)
        self.assertRaises(ValueError, GeneClock, 1, 5, maximum=5)
        self.assertRaises(ValueError, GeneClock.restart, 1, 0, 0)
        self.assertRaises(ValueError, GeneClock.restart, 1, 6, 0, maximum=5)
        self.assertRaises(ValueError, GeneClock.restart, 1, 5, 5)
        self.assertEqual(GeneClock.restart(1, 6, 5).stamp(), 6)


class AlignTest(unittest.TestCase):
    def test_agrees_with_sets(self):
        rng = random.Random(2)
        for _ in range(200):
            pool = [InnovationNumber(rng.randrange(1, 12), rng.randrange(1, 4)) for _ in range(14)]
            first = sorted(set(rng.sample(pool, rng.randrange(10))))
            second = sorted(set(rng.sample(pool, rng.randrange(10))))
            self.assertEqual(gene_clocks.align(first, second), self.naive(first, second))

    @staticmethod
    def naive(first, second):
        def stands(mark):
            i = first.index(mark) if mark in first else None
            j = second.index(mark) if mark in second else None
            if i is not None and j is not None:
                return GeneMatch.matching, i, j
            side, others = ("first", second) if j is None else ("second", first)
            excess = not others or mark > others[-1]
            return getattr(GeneMatch, f"{'excess' if excess else 'disjoint'}_{side}"), i, j

        return [stands(mark) for mark in sorted({*first, *second})]

    def test_marks_must_ascend(self):
        marks = [InnovationNumber(c, 1) for c in (1, 2)]
        for wrong in (marks[::-1], [marks[0], marks[0]]):
            self.assertRaises(ValueError, gene_clocks.align, wrong, marks)
            self.assertRaises(ValueError, gene_clocks.align, marks, wrong)


class WireTest(unittest.TestCase):
    def test_vectors(self):
        limits, valid, refused = wire_limits(), 0, 0
        for vector in DOCUMENT["vectors"]:
            with self.subTest(vector["name"]):
                frame = bytes.fromhex(vector["frame"])
                if "value" in vector:
                    valid += 1
                    self.assertEqual(value_of(gene_clocks.decode(frame, limits)), vector["value"])
                    self.assertEqual(gene_clocks.encode(message_of(vector["value"]), limits), frame)
                    continue
                refused += 1
                with self.assertRaises(WireError) as raised:
                    gene_clocks.decode(frame, limits)
                self.assertEqual((raised.exception.error, raised.exception.offset),
                                 (vector["error"], vector["offset"]))
        self.assertGreaterEqual(valid, 10)
        self.assertGreaterEqual(refused, 30)

    def test_what_would_be_refused_is_not_written(self):
        genes = message_of(DOCUMENT["vectors"][0]["value"]).genes
        fields = {"sender": 7, "stamp": 100, "energy": 1.0, "robot": 7, "birth": 0, "genes": genes}
        gene_clocks.encode(Message(**fields), wire_limits())
        heavy = Gene(genes[-1].mark, GeneKind.connection, source=1, target=2, weight=float("inf"))
        for field, value, error in (("sender", 0, "robot"), ("robot", 0, "robot"),
                                    ("stamp", 5, "not_below"), ("energy", float("nan"), "energy"),
                                    ("genes", [*genes[:3], genes[4], genes[3]], "not_ascending"),
                                    ("genes", genes[:1], "kind"),
                                    ("genes", genes * 100, "too_many_genes"),
                                    ("genes", [*genes[:-1], heavy], "weight")):
            with self.assertRaises(WireError, msg=error) as raised:
                gene_clocks.encode(Message(**{**fields, field: value}), wire_limits())
            self.assertEqual(raised.exception.error, error)

    def test_a_wire_error_is_a_value_error(self):
        self.assertRaises(ValueError, gene_clocks.decode, b"")
        self.assertRaises(TypeError, gene_clocks.decode, "text")

    def refused(self, data, limits=None):
        with self.assertRaises(WireError) as raised:
            gene_clocks.decode(data, limits or wire_limits())
        return raised.exception.error, raised.exception.offset

    def test_damaged_frames_are_refused(self):
        for vector in DOCUMENT["vectors"]:
            if "value" not in vector:
                continue
            frame = bytes.fromhex(vector["frame"])
            for size in range(len(frame)):
                self.assertEqual(self.refused(frame[:size])[0], "truncated")
            for bit in range(8 * len(frame)):
                flipped = bytearray(frame)
                flipped[bit // 8] ^= 1 << bit % 8
                self.refused(bytes(flipped))

    def test_ten_megabytes_are_refused_without_memory(self):
        self.assertEqual(self.refused(bytes(10_000_000)), ("too_long", 400))
        # Counts of 65 535 neurons and connections, in a frame that has the bytes and no gene.
        header = bytes.fromhex("0107640000000084ade2040700ffff03ffff03")
        huge = header.ljust(11 + 10_000_004, b"\0") + bytes.fromhex("097c870e")
        wide = gene_clocks.WireLimits(frame_bytes=2**32 - 1, genesis_count=5, neurons=65535,
                                      connections=65535)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        self.assertEqual(self.refused(huge, wide), ("not_ascending", 19))
        grown_kib = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        # 16 bytes for each connection that the limits allow; not the genes that were announced.
        self.assertLess(grown_kib, 2048)


@unittest.skipUnless(AUTHENTICATES, "built without libsodium")
class AuthenticationTest(unittest.TestCase):
    KEY = bytes.fromhex(DOCUMENT["key"])

    def outcome(self, opener, sealed):
        try:
            return opener.open(sealed)
        except gene_clocks.SealError as error:
            return error.refusal

    def test_vectors(self):
        for vector in DOCUMENT["sealed"]:
            with self.subTest(vector["name"]):
                opener = gene_clocks.Opener(self.KEY, wire_limits())
                sealed = bytes.fromhex(vector["sealed"])
                found = self.outcome(opener, sealed)
                if "refusal" in vector:
                    self.assertEqual(found, vector["refusal"])
                    self.assertEqual(opener.counts()[found], 1)
                    self.assertEqual(opener.windows(), {})
                    continue
                self.assertEqual(found, bytes.fromhex(vector["frame"]))
                self.assertEqual(opener.windows(), {7: (vector["number"], 1)})
                if vector["number"] < MAXIMUM:
                    sealer = gene_clocks.Sealer(self.KEY, GeneClock(1, vector["number"] - 1))
                    self.assertEqual(sealer.seal(found), sealed)

    def test_each_frame_is_taken_once_also_after_a_restart(self):
        frame = bytes.fromhex(DOCUMENT["vectors"][0]["frame"])
        sealer = gene_clocks.Sealer(self.KEY, GeneClock(7, block=10))
        opener = gene_clocks.Opener(self.KEY, wire_limits(), senders_max=1)
        sealed = [sealer.seal(frame) for _ in range(70)]
        self.assertGreaterEqual(sealer.durable_needed(), 71)
        self.assertEqual(self.outcome(opener, sealed[69]), frame)
        self.assertEqual(self.outcome(opener, sealed[69]), "replayed")
        self.assertEqual(self.outcome(opener, sealed[0]), "too_old")
        again = gene_clocks.Opener(self.KEY, wire_limits(), windows=opener.windows())
        self.assertEqual(self.outcome(again, sealed[69]), "replayed")
        self.assertEqual(self.outcome(again, sealed[68]), frame)
        other = bytes.fromhex(next(vector["frame"] for vector in DOCUMENT["vectors"]
                                   if vector.get("value", {}).get("sender", 7) != 7))
        self.assertEqual(self.outcome(opener, sealer.seal(other)), "too_many_senders")

    def test_numbers_end_and_keys_have_32_bytes(self):
        sealer = gene_clocks.Sealer(self.KEY, GeneClock(7, maximum=2))
        self.assertIsNotNone(sealer.seal(b""))
        self.assertIsNone(sealer.seal(b""))
        self.assertRaises(ValueError, gene_clocks.Sealer, self.KEY[1:], GeneClock(7))
        self.assertRaises(ValueError, gene_clocks.Opener, self.KEY + b"1")


if __name__ == "__main__":
    unittest.main()
