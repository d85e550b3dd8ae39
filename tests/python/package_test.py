"""The package as its users take it: objects that behave, columns, errors that name the gene, storage, forks;
and general genomes and fragments beside the implementations that were written from the document alone.

The package is found by PYTHONPATH, the test vectors by GENE_CLOCKS_WIRE_VECTORS.
"""

import array
import copy
import gc
import json
import os
import pathlib
import pickle
import random
import struct
import sys
import tempfile
import threading
import unittest

import gene_clocks as gc_
from gene_clocks import (Admission, Gene, GeneClass, GeneClock, GeneKind, Genes, Genome, InnovationNumber,
                         Message, Schema, WireError, enumeration, flag, float32, float64, integer)

WIRE = pathlib.Path(os.environ["GENE_CLOCKS_WIRE_VECTORS"]).parent
sys.path.insert(0, str(WIRE))
import fragments as document_fragments  # noqa: E402
import general_decoder  # noqa: E402

try:
    import numpy
except ImportError:
    numpy = None

GENERAL = json.loads((WIRE / "general_vectors.json").read_text())
PROTOCOLS = range(pickle.HIGHEST_PROTOCOL + 1)


def schema_of(described):
    def attribute(one):
        kind, name = one["type"], one["name"]
        if kind == "float32":
            return float32(name, struct.unpack("<f", struct.pack("<I", one["limit_bits"]))[0])
        if kind == "float64":
            return float64(name, struct.unpack("<d", struct.pack("<Q", one["limit_bits"]))[0])
        if kind == "integer":
            return integer(name, one["minimum"], one["maximum"])
        return flag(name) if kind == "flag" else enumeration(name, one["values"])

    return Schema([GeneClass(one["name"], [attribute(a) for a in one["attributes"]], one["ends"],
                             one["marked"]) for one in described["classes"]],
                  described["genesis_count"], [attribute(a) for a in described["attributes"]])


SCHEMAS = {one["name"]: schema_of(one["value"]) for one in GENERAL["schemas"]}
DESCRIBED = {one["name"]: one for one in GENERAL["schemas"]}


def listed(column):
    return column.tolist() if hasattr(column, "tolist") else list(column)


def bits_of(kind, value):
    if kind == "float32":
        return struct.unpack("<I", struct.pack("<f", value))[0]
    if kind == "float64":
        return struct.unpack("<Q", struct.pack("<d", value))[0]
    return int(value)


def value_of(genome, name):
    """A genome as the vectors describe it."""
    described = DESCRIBED[name]["value"]
    value = {"robot": genome.robot, "birth": genome.birth, "classes": [], "values": [
        bits_of(one["type"], genome.attributes[one["name"]]) for one in described["attributes"]]}
    for one in described["classes"]:
        genes, rows = genome[one["name"]], []
        columns = {a["name"]: listed(genes[a["name"]]) for a in one["attributes"]}
        ends = {}
        for side, column in (("source", genes.sources), ("target", genes.targets)):
            if one["ends"] == "mark":
                ends[side] = [list(pair) for pair in zip(*map(listed, column))]
            elif one["ends"] == "index":
                ends[side] = listed(column)
        for i in range(len(genes)):
            row = {}
            if one["marked"]:
                row["mark"] = [listed(genes.counters)[i], listed(genes.robots)[i]]
            row |= {side: ends[side][i] for side in ends}
            row["values"] = [bits_of(a["type"], columns[a["name"]][i]) for a in one["attributes"]]
            rows.append(row)
        value["classes"].append(rows)
    return value


class GeneralGenomeTest(unittest.TestCase):
    def outcome(self, payload, name, stamp):
        try:
            genome = SCHEMAS[name].decode(payload, stamp, GENERAL["genes_max"])
        except WireError as error:
            return {"error": error.error, "offset": error.offset}
        self.assertEqual(SCHEMAS[name].encode(genome, stamp, GENERAL["genes_max"]), bytes(payload))
        return {"value": value_of(genome, name)}

    def test_vectors(self):
        for name, schema in SCHEMAS.items():
            self.assertEqual(bytes(schema).hex(), DESCRIBED[name]["bytes"])
            self.assertEqual(schema.fingerprint, DESCRIBED[name]["fingerprint"])
        for vector in GENERAL["vectors"]:
            with self.subTest(vector["name"]):
                found = self.outcome(bytes.fromhex(vector["payload"]), vector["schema"],
                                     vector.get("stamp", GENERAL["stamp"]))
                self.assertEqual(found, {key: vector[key] for key in ("value", "error", "offset")
                                         if key in vector})

    def test_agrees_with_the_documents_decoder_on_all_damage(self):
        read = 0
        for vector in GENERAL["vectors"]:
            if "value" not in vector:
                continue
            payload, name = bytes.fromhex(vector["payload"]), vector["schema"]
            damaged = [payload[:size] for size in range(len(payload))]
            for bit in range(8 * len(payload)):
                flipped = bytearray(payload)
                flipped[bit // 8] ^= 1 << bit % 8
                damaged.append(flipped)
            for data in damaged:
                try:
                    expected = {"value": general_decoder.decode(
                        bytes(data), GENERAL["stamp"], bytes.fromhex(DESCRIBED[name]["bytes"]),
                        GENERAL["genes_max"])}
                    read += 1
                except general_decoder.Refused as refused:
                    expected = {"error": refused.error, "offset": refused.offset}
                self.assertEqual(self.outcome(data, name, GENERAL["stamp"]), expected)
        self.assertGreater(read, 1000)


SCHEMA = Schema([
    GeneClass("node", [float64("bias", 30.0), enumeration("activation", ["tanh", "relu", "sigmoid"])]),
    GeneClass("link", [float32("weight", 30.0), flag("enabled"), integer("age", -5, 1000)], ends="index"),
], genesis_count=2, attributes=[float64("fitness"), flag("known")])


def genome(**changes):
    nodes = Genes([1, 2, 7], [0, 0, 3], attributes={"bias": [0.5, -0.25, 1e-3],
                                                    "activation": [0, 2, 1]})
    links = Genes([8, 9], [3, 3], [0, 2], [2, 1],
                  {"weight": [0.5, -1.0], "enabled": [True, False], "age": [-5, 1000]})
    for path, column in changes.items():
        gene_class, name = path.split("_", 1)
        genes = {"node": nodes, "link": links}[gene_class]
        if name in genes.attributes:
            genes.attributes[name] = column
        else:
            setattr(genes, name, column)
    return Genome(5, 11, {"node": nodes, "link": links}, {"fitness": 2.5, "known": True})


class ColumnsTest(unittest.TestCase):
    PAYLOAD = SCHEMA.encode(genome(), 10)

    def test_a_genome_comes_back(self):
        again = SCHEMA.decode(self.PAYLOAD, 10)
        self.assertEqual(again, genome())
        self.assertEqual(again["link"].marks(), [InnovationNumber(8, 3), InnovationNumber(9, 3)])
        self.assertEqual(SCHEMA.encode(again, 10), self.PAYLOAD)
        self.assertEqual(repr(again), "<Genome 11 of robot 5: 3 node, 2 link>")

    def test_columns_are_any_buffer_and_any_sequence(self):
        for make in (list, tuple, lambda c: array.array("q", c), lambda c: memoryview(array.array("Q", c)),
                     lambda c: array.array("H", c), lambda c: bytes(c), lambda c: bytearray(c),
                     lambda c: memoryview(array.array("i", [x for y in c for x in (y, 99)]))[::2]):
            changed = genome(node_counters=make([1, 2, 7]), node_robots=make([0, 0, 3]),
                             link_sources=make([0, 2]), node_activation=make([0, 2, 1]))
            self.assertEqual(SCHEMA.encode(changed, 10), self.PAYLOAD)
        for code in "fd":
            changed = genome(link_weight=array.array(code, [0.5, -1.0]))
            self.assertEqual(SCHEMA.encode(changed, 10), self.PAYLOAD)
        self.assertEqual(SCHEMA.encode(genome(node_activation=["tanh", "sigmoid", "relu"]), 10),
                         self.PAYLOAD)
        self.assertEqual(SCHEMA.decode(memoryview(b"x" + self.PAYLOAD)[1:], 10), genome())

    @unittest.skipUnless(numpy, "needs NumPy")
    def test_columns_are_numpys_arrays(self):
        again = SCHEMA.decode(self.PAYLOAD, 10)
        types = {"counters": "uint64", "robots": "uint32", "sources": "uint32", "targets": "uint32"}
        for name, expected in types.items():
            self.assertEqual(getattr(again["link"], name).dtype, expected)
        for name, expected in {"weight": "float32", "enabled": "bool", "age": "int64"}.items():
            self.assertEqual(again["link"][name].dtype, expected)
        self.assertEqual(again["node"]["activation"].dtype, "uint8")
        swapped = numpy.array([8, 9], dtype=">u8")
        strided = numpy.arange(100, dtype=numpy.int16)[8:30:1][:2]
        for column in (swapped, strided, numpy.array([8.0, 9.0]).astype(numpy.uint32)):
            self.assertEqual(SCHEMA.encode(genome(link_counters=column), 10), self.PAYLOAD)

    def refused(self, kind, stamp=10, **changes):
        with self.assertRaises(kind) as raised:
            SCHEMA.encode(genome(**changes), stamp)
        return raised.exception

    def test_what_cannot_be_written_says_which_gene_and_why(self):
        nan, inf = float("nan"), float("inf")
        for changes, error, where in (
                ({"link_weight": [0.5, nan]}, "attribute", "link gene 1, <9, 3>, weight"),
                ({"link_weight": [inf, 0]}, "attribute", "link gene 0, <8, 3>, weight"),
                ({"link_weight": [1e300, 0]}, "attribute", "link gene 0, <8, 3>, weight"),
                ({"link_age": [0, 1001]}, "attribute", "link gene 1, <9, 3>, age"),
                ({"link_enabled": [0, 2]}, "attribute", "link gene 1, <9, 3>, enabled"),
                ({"node_activation": [0, 3, 0]}, "attribute", "node gene 1, <2, 0>, activation"),
                ({"link_sources": [0, 3]}, "ends", "link gene 1, <9, 3>, source"),
                ({"link_targets": [3, 0]}, "ends", "link gene 0, <8, 3>, target"),
                ({"link_counters": [8, 8]}, "not_ascending", "link gene 1, <8, 3>"),
                ({"node_robots": [0, 1, 3]}, "genesis", "node gene 1, <2, 1>"),
                ({"link_counters": [8, 10]}, "not_below", "link gene 1, <10, 3>")):
            raised = self.refused(WireError, **changes)
            self.assertEqual((raised.error, raised.where, raised.offset), (error, where, None))
            self.assertIn(where, str(raised))
            self.assertEqual((raised.gene_class, raised.gene), (where.split()[0],
                                                                int(where.split()[2].strip(","))))
            self.assertEqual(f"<{raised.mark.counter}, {raised.mark.robot}>", where[where.index("<"):
                             where.index(">") + 1])
        for changes, kind, text in (
                ({"link_weight": [0.5]}, ValueError, "link weight has 1 values for 2 genes"),
                ({"link_weight": [0.5, "x"]}, TypeError, "link weight of gene 1: 'x' is no number"),
                ({"link_age": [1, 1.5]}, TypeError, "link age of gene 1: 1.5 is no integer"),
                ({"link_age": [1, 2**63]}, ValueError, "link age of gene 1: it has more than 64 bits"),
                ({"link_age": [1, 2**64]}, ValueError, "does not fit into 64 bits"),
                ({"link_counters": [8, -9]}, ValueError, "link counters of gene 1: -9 may not be"),
                ({"link_robots": [3, 2**32]}, ValueError, "link robots of gene 1: 4294967296 has more"),
                ({"link_robots": array.array("q", [3, -1])}, ValueError, "link robots of gene 1: -1"),
                ({"link_counters": array.array("d", [8, 9])}, TypeError, "link counters of gene 0: 8.0"),
                ({"link_counters": 8}, TypeError, "link counters is no column"),
                ({"node_activation": ["tanh", "Relu", "relu"]}, ValueError, "of gene 1: 'Relu'"),
                ({"link_sources": None}, TypeError, "link sources is no column")):
            self.assertIn(text, str(self.refused(kind, **changes)))

    def test_attributes_and_classes_that_do_not_fit_are_named(self):
        for change, text in (
                (lambda g: g["link"].attributes.pop("age"), "link age is missing"),
                (lambda g: g["link"].attributes.update(color=[1, 2]), "link color is no attribute"),
                (lambda g: g.attributes.pop("fitness"), "genome fitness is missing"),
                (lambda g: g.classes.pop("link"), "1 classes of genes, the schema 2"),
                (lambda g: g.classes.update(arc=g.classes.pop("link")), "no genes of class link"),
                (lambda g: setattr(g, "robot", 0), "robot 0 is reserved"),
                (lambda g: setattr(g, "birth", -1), "birth is -1"),
                (lambda g: g.attributes.update(fitness=float("nan")), "genome, fitness")):
            changed = genome()
            change(changed)
            with self.assertRaises(ValueError) as raised:
                SCHEMA.encode(changed, 10)
            self.assertIn(text, str(raised.exception))

    def test_code_that_runs_while_a_column_is_read_does_no_harm(self):
        class Cunning:
            def __index__(self):
                counters.clear()
                try:
                    SCHEMA.decode(ColumnsTest.PAYLOAD, 10)
                except RuntimeError as error:
                    seen.append(str(error))
                return 8

        counters, seen = [Cunning(), 9], []
        self.assertEqual(SCHEMA.encode(genome(link_counters=counters), 10), self.PAYLOAD)
        self.assertEqual(seen, ["this schema is at work already, in another call"])

    def test_another_schema_is_noticed(self):
        other = Schema(SCHEMA.classes, genesis_count=3, attributes=SCHEMA.attributes)
        self.assertNotEqual(other, SCHEMA)
        with self.assertRaises(WireError) as raised:
            other.decode(self.PAYLOAD, 10)
        self.assertEqual(raised.exception.error, "schema")

    def test_schemas_that_cannot_be_say_where(self):
        for classes, text in (
                ([], "0 classes"), ([GeneClass("a b")], "class 'a b': a name is"),
                ([GeneClass("link", ends="index")], "class 'link': ends by index"),
                ([GeneClass("n", [flag("x"), flag("x")])], "class 'n', attribute 'x': the name stands"),
                ([GeneClass("n", [float32("w", 0.0)])], "class 'n', attribute 'w': a minimum"),
                ([GeneClass("n", [enumeration("e", ["one"])])], "2 to 256 values")):
            with self.assertRaises(gc_.SchemaError) as raised:
                Schema(classes)
            self.assertIn(text, str(raised.exception))

    def test_columns_are_aligned_as_marks_are(self):
        rng = random.Random(5)
        for _ in range(100):
            sides = []
            for _ in range(2):
                marks = sorted({InnovationNumber(rng.randrange(1, 30), rng.randrange(3))
                                for _ in range(rng.randrange(20))})
                sides.append(Genes([m.counter for m in marks], [m.robot for m in marks]))
            found = gc_.align_columns(*sides)
            rows = [(match, None if i < 0 else i, None if j < 0 else j)
                    for match, i, j in zip(*map(listed, found))]
            self.assertEqual(rows, gc_.align(sides[0].marks(), sides[1].marks()))
        with self.assertRaises(ValueError) as raised:
            gc_.align_columns(Genes([1, 1], [2, 2]), Genes([], []))
        self.assertIn("first genome gene 0, <1, 2>", str(raised.exception))


class FrameTest(unittest.TestCase):
    def test_any_payload_travels_from_any_buffer(self):
        limits = gc_.WireLimits(genesis_count=5)
        for payload in (b"", b"abc", bytearray(b"abc"), memoryview(b"xabcx")[1:4], array.array("H", [1, 2])):
            data = gc_.encode_frame(7, 100, -1.5, payload, limits)
            for buffer in (data, bytearray(data), memoryview(data), array.array("B", data)):
                frame = gc_.decode_frame(buffer, limits)
                self.assertEqual(frame, (7, 100, -1.5, bytes(payload)))
                self.assertEqual(frame.sender, 7)

    def test_what_would_be_refused_is_not_written(self):
        limits = gc_.WireLimits(frame_bytes=30, genesis_count=5, energy=10.0)
        for fields, error in (((0, 100, 0.0, b""), "robot"), ((7, 5, 0.0, b""), "stamp"),
                              ((7, 100, 10.5, b""), "energy"), ((7, 100, float("nan"), b""), "energy"),
                              ((7, 100, 0.0, bytes(100)), "too_long")):
            with self.assertRaises(WireError) as raised:
                gc_.encode_frame(*fields, limits)
            self.assertEqual(raised.exception.error, error)
        self.assertRaises(ValueError, gc_.encode_frame, 2**32, 1, 0.0, b"")
        self.assertRaises(ValueError, gc_.encode_frame, 1, 2**64, 0.0, b"")
        self.assertRaises(TypeError, gc_.encode_frame, 1, 1, 0.0, "text")
        self.assertRaises(TypeError, gc_.decode_frame, "text")
        self.assertRaises(WireError, gc_.decode_frame, b"")

    def test_genes_of_version_1_are_named_where_they_are_wrong(self):
        genes = [Gene(InnovationNumber(1, 0), GeneKind.bias), Gene(InnovationNumber(2, 0), GeneKind.output),
                 Gene(InnovationNumber(3, 9), GeneKind.connection, 0, 1, float("inf"))]
        message = Message(sender=1, stamp=4, energy=0.0, robot=1, birth=0, genes=genes)
        with self.assertRaises(WireError) as raised:
            gc_.encode(message, gc_.WireLimits(genesis_count=2))
        self.assertIn("gene 2, <3, 9>", str(raised.exception))
        with self.assertRaises(ValueError) as raised:
            gc_.encode(message._replace(genes=[*genes[:2], genes[2]._replace(source=-1)]))
        self.assertIn("gene 2", str(raised.exception))
        with self.assertRaises(TypeError):
            gc_.encode(message._replace(genes=[3]))


class FragmentTest(unittest.TestCase):
    def test_agrees_with_the_documents(self):
        rng = random.Random(3)
        outcomes = set()
        for _ in range(60):
            room, size = rng.randrange(1, 4), rng.randrange(20, 80)
            ours, theirs = gc_.MessageAssembler(room, size), document_fragments.Assembler(room, size)
            link = []
            for _ in range(8):
                message = b"\1" + rng.randbytes(rng.randrange(1, 75))
                sender, number, limit = rng.randrange(1, 5), rng.randrange(256), rng.randrange(8, 30)
                pieces = gc_.split_message(message, sender, number, limit)
                self.assertEqual(pieces, document_fragments.split(message, sender, number, limit))
                link += pieces
            for i in range(len(link)):
                j = min(len(link) - 1, i + rng.randrange(4))
                link[i], link[j] = link[j], link[i]
            for data in link:
                for _ in range(rng.randrange(3)):
                    message = ours.take(data)
                    self.assertEqual((ours.outcome, message), theirs.take(data))
                    outcomes.add(ours.outcome)
        self.assertLessEqual({"kept", "completes", "repeated", "late", "too_long"}, outcomes)

    def test_memory_that_there_is_not_is_an_error(self):
        self.assertRaises((MemoryError, ValueError), gc_.MessageAssembler, 2**40, 2**40)
        self.assertRaises(ValueError, gc_.MessageAssembler, 0)
        with self.assertRaises(WireError) as raised:
            gc_.split_message(bytes(5000), 1, 0, 20)
        self.assertEqual(raised.exception.error, "too_long")


class ObjectTest(unittest.TestCase):
    def test_everything_is_pickled_printed_and_compared(self):
        mark = InnovationNumber(2**63, 5)
        message = Message(sender=1, stamp=4, energy=0.5, robot=1, birth=0,
                          genes=[Gene(mark, GeneKind.hidden)])
        error = WireError("ends", 3, "link gene 1", gene_class="link", gene=1, mark=mark)
        for value in (mark, message, message.genes[0], gc_.WireLimits(neurons=3), SCHEMA, genome(),
                      genome()["link"], SCHEMA.decode(ColumnsTest.PAYLOAD, 10), GeneClock(1).mint(3),
                      gc_.Frame(1, 2, 3.0, b""), SCHEMA.classes[0], gc_.GeneMatch.matching):
            for protocol in PROTOCOLS:
                self.assertEqual(pickle.loads(pickle.dumps(value, protocol)), value)
            self.assertEqual(copy.deepcopy(value), value)
            self.assertIn("", repr(value))
        for error in (error, gc_.SealError("forged"), gc_.SchemaError("name", "n"),
                      gc_.StorageError("missing", "folder: missing"),
                      gc_.StorageError("device", "folder: error", 5)):
            for protocol in PROTOCOLS:
                again = pickle.loads(pickle.dumps(error, protocol))
                self.assertEqual((type(again), str(again), vars(again)),
                                 (type(error), str(error), vars(error)))

    def test_marks_are_tuples_and_integers(self):
        mark = InnovationNumber(9, 5)
        counter, robot = mark
        self.assertEqual((counter, robot), (9, 5))
        self.assertEqual(mark, (9, 5))
        self.assertEqual(int(mark), 9 << 32 | 5)
        self.assertEqual(mark.pack(11), 9 << 11 | 5)
        self.assertEqual(InnovationNumber.unpack(mark.pack(11), 11), mark)
        self.assertRaises(OverflowError, mark.pack, 2)
        marks = [InnovationNumber(c, r) for c in (1, 2, 2**64 - 1) for r in (0, 7, 2**32 - 1)]
        self.assertEqual(sorted(marks, key=int), sorted(marks))

    def test_minted_marks_are_a_sequence(self):
        marks = GeneClock(4).mint(3)
        self.assertEqual(len(marks), 3)
        node, into, out = marks
        self.assertEqual((node, out), (marks[0], marks[-1]))
        self.assertEqual(marks[1:], [into, out])
        self.assertIn(out, marks)
        self.assertRaises(IndexError, lambda: marks[3])
        self.assertEqual(marks, [node, into, out])

    def test_objects_without_init_raise(self):
        for kind, use in ((GeneClock, lambda o: o.mint()), (gc_.FileStore, lambda o: o.stored),
                          (gc_.AdmissionGate, lambda o: o.allowance), (gc_.WireLimits, repr),
                          (gc_.MessageAssembler, lambda o: o.take(b"x")),
                          (gc_._core._Form, lambda o: o.bytes())):
            with self.assertRaises(TypeError, msg=kind) as raised:
                use(kind.__new__(kind))
            self.assertIn("never initialised", str(raised.exception))
        with self.assertRaises(TypeError):
            gc_.decode_frame(b"", gc_.WireLimits.__new__(gc_.WireLimits))
        gc.collect()

    def test_clocks_are_not_copied(self):
        clock = GeneClock(1)
        for attempt in (copy.copy, copy.deepcopy, *(
                lambda c, p=protocol: pickle.dumps(c, p) for protocol in PROTOCOLS)):
            with self.assertRaises(TypeError) as raised:
                attempt(clock)
            self.assertIn("restart()", str(raised.exception))
        clock.mint(4)
        again = GeneClock.from_state(1, *clock.state())
        self.assertEqual(again.mint(), InnovationNumber(5, 1))
        self.assertRaises(ValueError, GeneClock.from_state, 1, 5, 4)

    def test_stamps_that_no_clock_has_are_refused_and_not_raised(self):
        clock = GeneClock(1)
        for stamp in (2**64, -1, 2**200):
            self.assertFalse(clock.observe(stamp))
        self.assertEqual(clock.stamp(), 1)
        self.assertRaises(TypeError, clock.observe, "5")

    @unittest.skipUnless(hasattr(os, "fork"), "needs fork")
    def test_what_crossed_a_fork_mints_no_more(self):
        clock = GeneClock(1)
        numbers = GeneClock(2)
        sealer = gc_.Sealer(bytes(32), numbers) if gc_.has_authentication else None
        with tempfile.TemporaryDirectory() as folder, gc_.FileStore(folder, 1) as store:
            store.create(5)
            reader, writer = os.pipe()
            child = os.fork()
            if child == 0:
                errors = []
                for use in (clock.mint, clock.stamp, lambda: clock.observe(9), lambda: store.store(9),
                            *([lambda: sealer.seal(b"")] if sealer else [])):
                    try:
                        use()
                        errors.append("worked")
                    except (RuntimeError, OSError) as error:
                        errors.append(str(error))
                os.write(writer, json.dumps(errors).encode())
                os._exit(0)
            os.waitpid(child, 0)
            os.close(writer)
            with os.fdopen(reader) as pipe:
                errors = json.loads(pipe.read())
            for error in errors:
                self.assertRegex(error, "crossed a fork|came of a fork")
            self.assertEqual(clock.mint(), InnovationNumber(1, 1))
            store.store(9)

    @unittest.skipUnless(gc_.has_authentication, "built without libsodium")
    def test_a_clock_that_was_handed_over_says_so(self):
        numbers = GeneClock(7)
        gc_.Sealer(bytearray(32), numbers)
        with self.assertRaises(RuntimeError) as raised:
            numbers.mint()
        self.assertIn("handed over", str(raised.exception))

    def test_help_is_there(self):
        for name in dir(gc_):
            if not name.startswith("_") and callable(getattr(gc_, name)):
                self.assertTrue(getattr(gc_, name).__doc__, name)


class StorageTest(unittest.TestCase):
    def test_a_counter_outlives_its_process(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(gc_.StorageError) as raised:
                gc_.FileStore(folder, 7).open()
            self.assertEqual(raised.exception.error, "missing")
            self.assertIn(folder, str(raised.exception))
            with gc_.FileStore(pathlib.Path(folder), 7) as store:
                store.create(1)
                clock = GeneClock.restart(7, store.stored, 0, block=100)
                first = clock.mint()
                store.store(clock.durable_needed())
                with self.assertRaises(gc_.StorageError) as raised:
                    gc_.FileStore(folder, 7).open()
                self.assertEqual(raised.exception.error, "in_use")
            with gc_.FileStore(folder, 7) as store:
                clock = GeneClock.restart(7, store.open(), 0)
                self.assertGreater(clock.mint(), first)
                with self.assertRaises(gc_.StorageError) as raised:
                    store.create(1)
                self.assertEqual(raised.exception.error, "exists")
            self.assertRaises(RuntimeError, store.store, 1000)
            with self.assertRaises(gc_.StorageError) as raised:
                gc_.FileStore(folder, 8).open()
            self.assertEqual(raised.exception.error, "other_robot")
        with self.assertRaises(gc_.StorageError) as raised:
            gc_.FileStore("/nowhere/at/all", 7).open()
        self.assertEqual((raised.exception.error, raised.exception.errno), ("device", 2))

    def test_the_gate_bounds_what_strangers_do(self):
        clock, gate = GeneClock(1), gc_.AdmissionGate(allowance=10, per_cycle=2)
        self.assertEqual(gate.admit(clock, 11), Admission.admitted)
        self.assertEqual(gate.admit(clock, 12), Admission.beyond_allowance)
        gate.elapse()
        self.assertEqual(gate.allowance, 2)
        self.assertEqual(gate.admit(clock, 12, [InnovationNumber(11, 3)]), Admission.admitted)
        self.assertEqual(gate.admit(clock, 12, [InnovationNumber(12, 3)]), Admission.gene_not_covered)
        self.assertEqual(gate.admit(clock, 14, [InnovationNumber(13, 1)]), Admission.identity_conflict)
        self.assertEqual(gate.conflicting_mark, InnovationNumber(13, 1))
        self.assertEqual(gate.admit(clock, 2**64), Admission.beyond_maximum)
        self.assertEqual(gate.counts()[Admission.admitted], 2)
        self.assertEqual(sum(gate.counts().values()), 6)


class ThreadTest(unittest.TestCase):
    def test_a_schema_serves_threads_one_at_a_time(self):
        wrong = []

        def work():
            for _ in range(200):
                if SCHEMA.encode(SCHEMA.decode(ColumnsTest.PAYLOAD, 10), 10) != ColumnsTest.PAYLOAD:
                    wrong.append(1)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    unittest.main()
