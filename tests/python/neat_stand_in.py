"""A stand-in for neat-python: what the adapter touches of its interface, and the order in which neat-python
calls it, as small as that can be. Tests also run with neat-python itself where it can be imported."""

import itertools
import random


class _Attribute:
    def __init__(self, name):
        self.name = name


class FloatAttribute(_Attribute):
    pass


class BoolAttribute(_Attribute):
    pass


class StringAttribute(_Attribute):
    pass


class NodeGene:
    _gene_attributes = [FloatAttribute("bias"), FloatAttribute("response"), FloatAttribute("time_constant"),
                        StringAttribute("activation"), StringAttribute("aggregation")]

    def __init__(self, key):
        assert isinstance(key, int), "a node's key is an int"
        self.key = key
        self.bias, self.response, self.time_constant = random.gauss(0, 1), 1.0, 1.0
        self.activation, self.aggregation = random.choice(["tanh", "relu", "sigmoid"]), "sum"


class ConnectionGene:
    _gene_attributes = [FloatAttribute("weight"), BoolAttribute("enabled")]

    def __init__(self, key, innovation=None):
        assert isinstance(key, tuple) and isinstance(innovation, int), "an innovation number is an int"
        self.key, self.innovation = key, innovation
        self.weight, self.enabled = random.gauss(0, 1), True


class GenomeConfig:
    node_gene_type, connection_gene_type = NodeGene, ConnectionGene
    activation_options, aggregation_options = ["tanh", "relu", "sigmoid"], ["sum"]
    bias_min_value = response_min_value = time_constant_min_value = weight_min_value = -30.0
    bias_max_value = response_max_value = time_constant_max_value = weight_max_value = 30.0

    def __init__(self, inputs=3, outputs=2, hidden=0, feed_forward=True, partial=False):
        self.input_keys = [-i - 1 for i in range(inputs)]
        self.output_keys = list(range(outputs))
        self.num_hidden, self.feed_forward, self.partial = hidden, feed_forward, partial
        self.node_indexer = None
        self.innovation_tracker = None

    def get_new_node_key(self, node_dict):
        if self.node_indexer is None:
            self.node_indexer = itertools.count(max(node_dict) + 1)
        key = next(self.node_indexer)
        assert key not in node_dict
        return key


class Config:
    def __init__(self, **options):
        self.genome_config = GenomeConfig(**options)
        self.genome_type = Genome


class Genome:
    def __init__(self, key):
        self.key, self.fitness, self.nodes, self.connections = key, None, {}, {}

    def configure_new(self, config):
        for key in config.output_keys:
            self.nodes[key] = NodeGene(key)
        for _ in range(config.num_hidden):
            key = config.get_new_node_key(self.nodes)
            self.nodes[key] = NodeGene(key)
        pairs = [(i, o) for i in config.input_keys for o in self.nodes]
        for pair in random.sample(pairs, len(pairs) // 2) if config.partial else pairs:
            number = config.innovation_tracker.get_innovation_number(*pair, "initial_connection")
            self.connections[pair] = ConnectionGene(pair, innovation=number)

    def copy(self, key):
        child = Genome(key)
        for node in self.nodes.values():
            child.nodes[node.key] = NodeGene(node.key)
            vars(child.nodes[node.key]).update(vars(node))
        for one in self.connections.values():
            child.connections[one.key] = ConnectionGene(one.key, innovation=one.innovation)
            vars(child.connections[one.key]).update(vars(one))
        return child

    def mutate(self, config):
        tracker = config.innovation_tracker
        if random.random() < 0.5:
            split = random.choice(list(self.connections.values()))
            node, into, out = tracker.get_node_split(*split.key,
                                                     lambda: config.get_new_node_key(self.nodes))
            if node in self.nodes:
                return
            self.nodes[node] = NodeGene(node)
            split.enabled = False
            for pair, number in (((split.key[0], node), into), ((node, split.key[1]), out)):
                self.connections[pair] = ConnectionGene(pair, innovation=number)
        else:
            pair = (random.choice([*config.input_keys, *self.nodes]), random.choice(list(self.nodes)))
            if pair in self.connections or (config.feed_forward and self._leads(pair[1], pair[0])):
                return
            self.connections[pair] = ConnectionGene(
                pair, innovation=tracker.get_innovation_number(*pair, "add_connection"))
        if random.random() < 0.2:
            self.connections.pop(random.choice(list(self.connections)))
            if not self.connections:
                pair = (config.input_keys[0], config.output_keys[0])
                self.connections[pair] = ConnectionGene(
                    pair, innovation=tracker.get_innovation_number(*pair, "add_connection"))

    def _leads(self, start, end):
        reached = [start]
        for node in reached:
            reached += [o for i, o in self.connections if i == node and o not in reached]
        return end in reached


class Tracker:
    """neat-python's own: a plain counter."""

    def __init__(self):
        self.counter, self.generation = itertools.count(1), {}

    def get_innovation_number(self, *key):
        return self.generation.setdefault(key, next(self.counter))

    def reset_generation(self):
        self.generation = {}


class Reproduction:
    def __init__(self):
        self.innovation_tracker = Tracker()
        self.genome_indexer = itertools.count(1)
        self.ancestors = {}


class SpeciesSet:
    speciated = 0

    def speciate(self, config, population, generation):
        self.speciated += 1


class Population:
    def __init__(self, config, size=10):
        self.config, self.generation, self.reporters = config, 0, []
        self.reproduction, self.species, self.best_genome = Reproduction(), SpeciesSet(), None
        self.size = size
        config.genome_config.innovation_tracker = self.reproduction.innovation_tracker
        self.population = {}
        for _ in range(size):
            genome = Genome(next(self.reproduction.genome_indexer))
            genome.configure_new(config.genome_config)
            self.population[genome.key] = genome

    def add_reporter(self, reporter):
        self.reporters.append(reporter)

    def run(self, fitness_function, generations):
        for _ in range(generations):
            for reporter in self.reporters:
                reporter.start_generation(self.generation)
            fitness_function(list(self.population.items()), self.config)
            best = max(self.population.values(), key=lambda genome: genome.fitness)
            self.best_genome = best
            for reporter in self.reporters:
                reporter.post_evaluate(self.config, self.population, self.species, best)
            self.config.genome_config.innovation_tracker = self.reproduction.innovation_tracker
            self.reproduction.innovation_tracker.reset_generation()
            parents = list(self.population.values())
            self.population = {best.key: best}
            while len(self.population) < self.size:
                child = random.choice(parents).copy(next(self.reproduction.genome_indexer))
                child.mutate(self.config.genome_config)
                self.population[child.key] = child
            for reporter in self.reporters:
                reporter.end_generation(self.config, self.population, self.species)
            self.generation += 1
