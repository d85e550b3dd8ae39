"""Islands, and the adapter for neat-python: with a stand-in, and with neat-python itself where it can be
imported (PYTHONPATH). The package is found by PYTHONPATH too."""

import copy
import os
import pathlib
import pickle
import random
import signal
import socket
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import neat_stand_in  # noqa: E402

import gene_clocks  # noqa: E402
from gene_clocks import GeneClass, Genes, Genome, InnovationNumber, Schema, WireError, float64  # noqa: E402
from gene_clocks.adapters.neat_python import GenomeRefused, NeatIsland  # noqa: E402
from gene_clocks.islands import Exhausted, Island, Outcome  # noqa: E402

SCHEMA = Schema([GeneClass("node"), GeneClass("link", [float64("weight")], ends="index")], genesis_count=2)


def genome(island):
    """Two initial nodes and a link of this island's."""
    mark = island.mint()
    return Genome(0, 0, {"node": Genes([1, 2], [0, 0]),
                         "link": Genes([mark.counter], [mark.robot], [0], [1], {"weight": [0.5]})})


class IslandTest(unittest.TestCase):
    def test_a_genome_travels_and_clocks_follow(self):
        one, two = Island(1, SCHEMA), Island(2, SCHEMA)
        for _ in range(5):
            one.mint()
        sent = genome(one)
        frame = one.pack(sent, 1.5)
        received = two.receive(frame)
        self.assertEqual((received.outcome, received.sender, received.energy), (Outcome.genome, 1, 1.5))
        self.assertEqual(received.genome, sent)
        self.assertEqual((sent.robot, sent.birth > 0), (1, True))
        self.assertGreater(two.mint(), InnovationNumber(8, 1))
        self.assertEqual(one.receive(frame).outcome, Outcome.own)
        self.assertEqual(two.receive(frame).outcome, Outcome.genome)  # a repeated one does no harm
        self.assertEqual(two.counts[Outcome.genome], 2)

    def test_whatever_arrives_is_named_and_changes_nothing(self):
        one, two = Island(1, SCHEMA), Island(2, SCHEMA, window=100)
        frame = one.pack(genome(one))
        stamp = two.clock.stamp()
        for data in (b"", b"x", frame[:-1], frame + b"\0", bytes(1000)):
            self.assertEqual(two.receive(data).outcome, Outcome.damaged)
        for bit in range(8 * len(frame)):
            flipped = bytearray(frame)
            flipped[bit // 8] ^= 1 << bit % 8
            self.assertEqual(two.receive(flipped).outcome, Outcome.damaged)
        other = Island(3, Schema(SCHEMA.classes, genesis_count=2, attributes=[float64("fitness")]))
        foreign = other.pack(Genome(0, 0, genome(other).classes, {"fitness": 1.0}))
        self.assertEqual(two.receive(foreign).outcome, Outcome.another_schema)
        nothing = gene_clocks.encode_frame(1, 10, 0.0, b"\0" * 9, two.limits)
        self.assertEqual(two.receive(nothing).outcome, Outcome.another_schema)
        whole = genome(one)
        whole.robot = 1
        cut = gene_clocks.encode_frame(1, 50, 0.0, SCHEMA.encode(whole, 50)[:-1], two.limits)
        self.assertEqual(two.receive(cut).outcome, Outcome.malformed)
        far = Island(4, SCHEMA)
        far.clock.observe(1000)
        self.assertEqual(two.receive(far.pack(genome(far))).outcome, Outcome.too_far)
        forged = genome(one)
        forged["link"].robots = [2]
        self.assertEqual(two.receive(one.pack(forged)).outcome, Outcome.conflict)
        self.assertEqual(two.clock.stamp(), stamp)
        self.assertEqual(two.counts[Outcome.genome], 0)

    def test_no_mark_and_no_birth_is_made_twice_in_two_lives(self):
        with tempfile.TemporaryDirectory() as folder:
            seen, births = set(), set()
            for _ in range(4):
                with Island(7, SCHEMA, pathlib.Path(folder) / "island", block=10) as island:
                    for _ in range(23):
                        sent = genome(island)
                        island.pack(sent)
                        mark = sent["link"].marks()[0]
                        self.assertNotIn(mark, seen)
                        self.assertNotIn(sent.birth, births)
                        seen.add(mark)
                        births.add(sent.birth)

    def test_nothing_leaves_before_its_counter_is_stored(self):
        with tempfile.TemporaryDirectory() as folder, Island(7, SCHEMA, folder, block=5) as island:
            for _ in range(20):
                sent = genome(island)
                island.pack(sent)
                self.assertGreater(island._store.stored, sent.birth)
            island.close()
            self.assertRaises(RuntimeError, island.pack, genome(island))

    def test_two_processes_cannot_have_one_folder(self):
        with tempfile.TemporaryDirectory() as folder, Island(7, SCHEMA, folder):
            with self.assertRaises(gene_clocks.StorageError) as raised:
                Island(7, SCHEMA, folder)
            self.assertEqual(raised.exception.error, "in_use")

    def test_errors_say_what_is_wrong(self):
        self.assertRaises(ValueError, Island, 0, SCHEMA)
        self.assertRaises(ValueError, Island, 1, SCHEMA, limits=gene_clocks.WireLimits())
        island = Island(1, SCHEMA)
        broken = genome(island)
        broken["link"].attributes["weight"] = [float("nan")]
        with self.assertRaises(WireError) as raised:
            island.pack(broken)
        self.assertEqual((raised.exception.gene_class, raised.exception.gene,
                          raised.exception.attribute), ("link", 0, "weight"))
        island.clock.observe(2**64 - 1)
        self.assertRaises(Exhausted, island.mint)
        self.assertRaises(Exhausted, island.mint_many, 3)

    @unittest.skipUnless(gene_clocks.has_authentication, "built without libsodium")
    def test_a_key_keeps_strangers_out(self):
        key = bytes(range(32))
        with tempfile.TemporaryDirectory() as folder:
            two, stranger = Island(2, SCHEMA, key=key), Island(3, SCHEMA, key=bytes(32))
            numbers = set()
            for _ in range(2):
                with Island(1, SCHEMA, folder, key=key) as one:
                    for _ in range(3):
                        frame = one.pack(genome(one))
                        numbers.add(frame[1:5])
                        self.assertEqual(two.receive(frame).outcome, Outcome.genome)
                        self.assertEqual(two.receive(frame).outcome, Outcome.replayed)
            self.assertEqual(two.receive(stranger.pack(genome(stranger))).outcome, Outcome.forged)
            plain = Island(4, SCHEMA)
            self.assertEqual(two.receive(plain.pack(genome(plain))).outcome, Outcome.forged)


def evaluate(genomes, config):
    for _, one in genomes:
        one.fitness = float(len(one.connections)) + random.random()


def archipelago(count, every=1, loss=0.0, **options):
    """Islands whose frames are copied into each other's mail boxes."""
    boxes, islands = [[] for _ in range(count)], []
    for i in range(count):
        population = neat_stand_in.Population(neat_stand_in.Config(**options))
        island = NeatIsland(population, robot=i + 1)

        def send(frame, i=i):
            for j, box in enumerate(boxes):
                if j != i and random.random() >= loss:
                    box.append(frame)

        def receive(i=i):
            frames, boxes[i][:] = list(boxes[i]), []
            return frames

        population.add_reporter(island.migration(send, receive, every))
        islands.append(island)
    return islands


class NeatPythonTest(unittest.TestCase):
    def setUp(self):
        random.seed(7)

    def test_a_mark_means_one_gene_on_all_islands(self):
        for options in ({}, {"partial": True}, {"hidden": 2}, {"feed_forward": False}):
            islands = archipelago(3, loss=0.25, **options)
            meanings, nodes = {}, {}
            for generation in range(30):
                for island in islands:
                    island.population.run(evaluate, 1)
                    for one in island.population.population.values():
                        for connection in one.connections.values():
                            meanings.setdefault(connection.innovation, set()).add(connection.key)
                        for key in one.nodes:
                            nodes.setdefault(key, 0)
            self.assertEqual([m for m in meanings.values() if len(m) > 1], [])
            self.assertGreater(len(meanings), 100)
            hidden = [InnovationNumber.unpack(key) for key in nodes if key >= 2]
            self.assertEqual({mark.robot for mark in hidden}, {1, 2, 3})
            for island in islands:
                reporter = island.population.reporters[0]
                self.assertGreater(reporter.taken, 3)
                self.assertGreater(island.population.species.speciated, 3)

    def test_a_genome_comes_back_with_all_attributes(self):
        one, two = archipelago(2)
        for _ in range(10):
            one.population.run(evaluate, 1)
        for sent in one.population.population.values():
            sent.fitness = 1.25
            received, outcome = two.receive(one.pack(sent))
            self.assertEqual(outcome.outcome, Outcome.genome)
            for mine, theirs in ((sent.nodes, received.nodes), (sent.connections, received.connections)):
                self.assertEqual({k: vars(g) for k, g in mine.items()},
                                 {k: vars(g) for k, g in theirs.items()})
            self.assertEqual(two.to_columns(received).attributes["has_fitness"], False)
            self.assertEqual(outcome.genome.attributes, {"fitness": 1.25, "has_fitness": True})

    def test_equal_mutations_of_one_generation_are_one_and_no_others(self):
        (island,) = archipelago(1)
        tracker = island.tracker
        asked = []
        first = tracker.get_node_split(-1, 0, lambda: asked.append(1))
        self.assertEqual(tracker.get_node_split(-1, 0, lambda: asked.append(1)), first)
        self.assertEqual(asked, [])
        number = tracker.get_innovation_number(-1, 1)
        self.assertEqual(tracker.get_innovation_number(-1, 1), number)
        self.assertNotEqual(tracker.get_innovation_number(-2, 1), number)
        tracker.reset_generation()
        self.assertNotEqual(tracker.get_node_split(-1, 0, lambda: 0), first)
        self.assertNotEqual(tracker.get_innovation_number(-1, 1), number)
        self.assertGreater(tracker.get_innovation_number(-1, 1), first[2])
        self.assertEqual(tracker.get_current_innovation_number(), tracker.global_counter)

    def test_initial_genes_are_the_same_on_all_islands(self):
        for options in ({}, {"partial": True}):
            numbers = {}
            for island in archipelago(3, **options):
                for one in island.population.population.values():
                    for connection in one.connections.values():
                        numbers.setdefault(connection.key, set()).add(connection.innovation)
            self.assertEqual({len(found) for found in numbers.values()}, {1})
            self.assertEqual(len(set().union(*numbers.values())), 6)

    def test_a_best_genome_that_is_sent_again_does_not_join_twice(self):
        one, two = archipelago(2)
        evaluate(one.population.population.items(), None)
        frame = one.pack(one.population.population[1])
        before = len(two.population.population)
        for _ in range(3):
            two.add([two.receive(frame)[0]])
        self.assertEqual(len(two.population.population), before + 1)

    def test_a_checkpoint_does_not_go_back(self):
        with tempfile.TemporaryDirectory() as folder:
            population = neat_stand_in.Population(neat_stand_in.Config())
            island = NeatIsland(population, 5, folder)
            number = island.tracker.get_innovation_number(-1, 1)
            saved = pickle.dumps(population.config.genome_config.innovation_tracker)
            later = island.tracker.get_innovation_number(-2, 1)
            restored = pickle.loads(saved)
            self.assertGreater(restored.get_innovation_number(-3, 1), later)
            self.assertNotEqual(restored.get_innovation_number(-1, 1), number)
            self.assertIs(copy.deepcopy(island.tracker).island, island.island)
            island.island.close()
            del island, restored
            population.reproduction = population.config = None
            import gc
            gc.collect()
            with self.assertRaises(RuntimeError) as raised:
                pickle.loads(saved)
            self.assertIn("open it first", str(raised.exception))

    def refused(self, change, **options):
        """What the adapter says of a genome that a liar changed."""
        one, two = archipelago(2, **options)
        for _ in range(6):
            one.population.run(evaluate, 1)
        sent = max(one.population.population.values(), key=lambda g: len(g.nodes))
        columns = one.to_columns(sent)
        change(columns)
        received, outcome = two.receive(one.island.pack(columns))
        self.assertIsNone(received)
        self.assertEqual(outcome.outcome, Outcome.malformed)
        return outcome.reason

    def test_genomes_that_are_none_of_this_configuration_are_refused(self):
        def without_input(columns):
            columns["input"].counters = [1, 2]
            columns["input"].robots = [0, 0]
            for side in ("sources", "targets"):
                setattr(columns["connection"], side,
                        [max(0, end - 1) for end in getattr(columns["connection"], side)])

        def without_output(columns):
            nodes = columns["node"]
            nodes.counters, nodes.robots = nodes.counters[1:], nodes.robots[1:]
            nodes.attributes = {name: values[1:] for name, values in nodes.attributes.items()}
            for side in ("sources", "targets"):
                setattr(columns["connection"], side,
                        [0 if end < 3 else 3 for end in getattr(columns["connection"], side)])

        def into_input(columns):
            columns["connection"].targets[0] = 0

        def twice(columns):
            for side in (columns["connection"].sources, columns["connection"].targets):
                side[1] = side[0]

        def cycle(columns):
            columns["connection"].sources[0] = columns["connection"].targets[0] = 3

        def activation(columns):
            columns["node"].attributes["aggregation"] = [1] * len(columns["node"])

        for change, text in ((without_input, "inputs"), (without_output, "outputs"),
                             (into_input, "into an input"), (twice, "join the same"), (cycle, "a cycle"),
                             (activation, "its aggregation")):
            self.assertIn(text, self.refused(change))

    def test_a_genome_that_joins_a_missing_node_says_so(self):
        (island,) = archipelago(1)
        one = island.population.population[1]
        del one.nodes[0]
        with self.assertRaises(GenomeRefused) as raised:
            island.pack(one)
        self.assertIn("joins node 0", str(raised.exception))


def run_process(robot, ports, folder, generations):
    """A process of the test below: an island over UDP, which writes down every mark that it made and that
    leaves it."""
    random.seed(robot * 1000 + os.getpid())
    link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    link.bind(("127.0.0.1", ports[robot - 1]))
    link.setblocking(False)
    population = neat_stand_in.Population(neat_stand_in.Config(), size=8)
    island = NeatIsland(population, robot, pathlib.Path(folder) / str(robot), block=50)
    log = open(pathlib.Path(folder) / f"marks.{robot}.{os.getpid()}", "w")
    first_of_this_life, noted = island.island.clock.stamp(), set()
    pack = island.pack

    def pack_and_note(genome):
        frame = pack(genome)  # from here on it may leave
        for connection in genome.connections.values():
            mark = InnovationNumber.unpack(connection.innovation)
            if mark.robot == robot and mark.counter >= first_of_this_life and mark not in noted:
                noted.add(mark)
                log.write(f"{connection.innovation} {connection.key[0]} {connection.key[1]}\n")
        log.flush()
        return frame

    island.pack = pack_and_note

    def send(frame):
        for port in ports:
            if random.random() > 0.25:
                try:
                    link.sendto(frame, ("127.0.0.1", port))
                except OSError:
                    pass

    def receive():
        frames = []
        while True:
            try:
                frames.append(link.recv(65535))
            except OSError:
                return frames

    population.add_reporter(island.migration(send, receive))
    population.run(evaluate, generations)
    os._exit(0)


@unittest.skipUnless(hasattr(os, "fork"), "needs fork")
class ProcessesTest(unittest.TestCase):
    def test_four_processes_with_loss_and_kills_never_make_a_mark_twice(self):
        sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(4)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        ports = [one.getsockname()[1] for one in sockets]
        for one in sockets:
            one.close()
        with tempfile.TemporaryDirectory() as folder:
            def start(robot):
                child = os.fork()
                if child == 0:
                    try:
                        run_process(robot, ports, folder, 100_000)
                    except BaseException:
                        import traceback
                        traceback.print_exc()
                        os._exit(3)
                return child

            def lines():
                return sum(path.read_text().count("\n") for path in pathlib.Path(folder).glob("marks.*"))

            children = {robot: start(robot) for robot in range(1, 5)}
            for robot in (1, 2, 3, 4, 1, 2):
                goal = lines() + 60
                while lines() < goal:
                    time.sleep(0.02)
                    self.assertEqual(os.waitpid(children[robot], os.WNOHANG), (0, 0), "it died by itself")
                os.kill(children[robot], signal.SIGKILL)
                os.waitpid(children[robot], 0)
                children[robot] = start(robot)
            for child in children.values():
                os.kill(child, signal.SIGKILL)
                os.waitpid(child, 0)
            meanings, made = {}, 0
            for path in pathlib.Path(folder).glob("marks.*"):
                for line in path.read_text().splitlines(keepends=True):
                    if not line.endswith("\n"):
                        continue  # killed within the line
                    mark, *pair = map(int, line.split())
                    self.assertTrue(mark not in meanings, f"{InnovationNumber.unpack(mark)} twice")
                    meanings[mark] = pair
                    made += 1
        self.assertGreater(made, 300)
        self.assertEqual({InnovationNumber.unpack(mark).robot for mark in meanings}, {1, 2, 3, 4})


try:
    import neat
except ImportError:
    neat = None


@unittest.skipUnless(neat, "neat-python cannot be imported")
class RealNeatPythonTest(unittest.TestCase):
    CONFIG = """
[NEAT]
fitness_criterion = max
fitness_threshold = 3.9
no_fitness_termination = True
pop_size = 60
reset_on_extinction = True
[DefaultGenome]
num_inputs = 2
num_hidden = 0
num_outputs = 1
initial_connection = full_direct
feed_forward = True
compatibility_disjoint_coefficient = 1.0
compatibility_weight_coefficient = 0.5
conn_add_prob = 0.5
conn_delete_prob = 0.2
node_add_prob = 0.3
node_delete_prob = 0.1
activation_default = sigmoid
activation_options = sigmoid tanh
activation_mutate_rate = 0.1
aggregation_default = sum
aggregation_options = sum
aggregation_mutate_rate = 0.0
bias_init_mean = 0.0
bias_init_stdev = 1.0
bias_replace_rate = 0.1
bias_mutate_rate = 0.7
bias_mutate_power = 0.5
bias_max_value = 30.0
bias_min_value = -30.0
response_init_mean = 1.0
response_init_stdev = 0.0
response_replace_rate = 0.0
response_mutate_rate = 0.0
response_mutate_power = 0.0
response_max_value = 30.0
response_min_value = -30.0
time_constant_init_mean = 1.0
time_constant_init_stdev = 0.0
time_constant_replace_rate = 0.0
time_constant_mutate_rate = 0.0
time_constant_mutate_power = 0.0
time_constant_max_value = 10.0
time_constant_min_value = 0.1
weight_max_value = 30
weight_min_value = -30
weight_init_mean = 0.0
weight_init_stdev = 1.0
weight_mutate_rate = 0.8
weight_replace_rate = 0.1
weight_mutate_power = 0.5
enabled_default = True
enabled_mutate_rate = 0.01
[DefaultSpeciesSet]
compatibility_threshold = 3.0
[DefaultStagnation]
species_fitness_func = max
max_stagnation = 20
species_elitism = 2
[DefaultReproduction]
elitism = 2
survival_threshold = 0.2
"""

    @staticmethod
    def evaluate(genomes, config):
        for _, one in genomes:
            net = neat.nn.FeedForwardNetwork.create(one, config)
            one.fitness = 4.0 - sum((net.activate((a, b))[0] - (a != b)) ** 2
                                    for a in (0, 1) for b in (0, 1))

    def test_two_islands_share_genes_and_no_mark_has_two_meanings(self):
        with tempfile.NamedTemporaryFile("w", suffix=".ini") as file:
            file.write(self.CONFIG)
            file.flush()
            boxes, islands = [[], []], []
            for i in range(2):
                config = neat.Config(neat.DefaultGenome, neat.DefaultReproduction, neat.DefaultSpeciesSet,
                                     neat.DefaultStagnation, file.name)
                island = NeatIsland(neat.Population(config), i + 1)

                def receive(i=i):
                    frames, boxes[i][:] = list(boxes[i]), []
                    return frames

                island.population.add_reporter(island.migration(boxes[1 - i].append, receive, 3))
                islands.append(island)
        meanings = {}
        for _ in range(10):
            for island in islands:
                island.population.run(self.evaluate, 3)
                for one in island.population.population.values():
                    for connection in one.connections.values():
                        meanings.setdefault(connection.innovation, set()).add(connection.key)
        self.assertEqual([m for m in meanings.values() if len(m) > 1], [])
        self.assertGreater(islands[0].population.reporters.reporters[0].taken, 0)
        saved = pickle.dumps(islands[0].population.config)
        self.assertIs(pickle.loads(saved).genome_config.innovation_tracker.island, islands[0].island)
        best = islands[0].population.best_genome
        received, _ = islands[1].receive(islands[0].pack(best))
        self.assertEqual({k: vars(g) for k, g in best.connections.items()},
                         {k: vars(g) for k, g in received.connections.items()})


if __name__ == "__main__":
    unittest.main()
