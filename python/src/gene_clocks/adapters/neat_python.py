"""neat-python on several machines (neat-python 2.x).

    population = neat.Population(config)
    island = NeatIsland(population, robot=7, folder="island-7")
    population.add_reporter(island.migration(send, receive, every=5))
    population.run(eval_genomes, 300)

NeatIsland takes the place of neat-python's innovation tracker and of its counter of node keys, so that both
are the same gene on every island and never the same for two genes; it keeps its rule that equal mutations of
one generation are one. neat-python itself is not imported here.

Node keys stay neat-python's: inputs -1, -2, …, outputs 0, 1, …; those of hidden nodes, and the innovation
numbers of connections, are marks as integers, `InnovationNumber.unpack(key)`.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from typing import Any

from gene_clocks._genomes import (Attribute, GeneClass, Genes, Genome, Schema, enumeration, flag, float64,
                                  integer)
from gene_clocks._marks import InnovationNumber
from gene_clocks.islands import Island, Outcome, Received, living

_NO_OTHER = "no-other"  # beside a single option: enumerations have two values


class GenomeRefused(ValueError):
    """A genome that is well-formed, but none of this configuration: why stands in the text."""


def schema_of(genome_config: Any) -> Schema:
    """The schema of a configuration (config.genome_config): all attributes of its node and connection
    genes. The same on every island, or it is noticed."""
    inputs, outputs = len(genome_config.input_keys), len(genome_config.output_keys)

    def attributes(gene_type: Any) -> list[Attribute]:
        return [_attribute(one, genome_config) for one in gene_type._gene_attributes]

    return Schema(
        [GeneClass("input"),
         GeneClass("node", attributes(genome_config.node_gene_type)),
         GeneClass("connection", attributes(genome_config.connection_gene_type), ends="index")],
        genesis_count=inputs + outputs + inputs * outputs,
        attributes=[float64("fitness"), flag("has_fitness")])


def _attribute(described: Any, genome_config: Any) -> Attribute:
    name, kind = described.name, type(described).__name__
    if kind.startswith("Bool"):
        return flag(name)
    if kind.startswith("String"):
        options = list(getattr(genome_config, f"{name}_options"))
        return enumeration(name, options if len(options) > 1 else [*options, _NO_OTHER])
    low, high = (getattr(genome_config, f"{name}_{end}_value") for end in ("min", "max"))
    if kind.startswith("Int"):
        return integer(name, int(low), int(high))
    # A split gives its first connection a weight of 1, whatever the bounds.
    return float64(name, max(abs(float(low)), abs(float(high)), 1.0))


class InnovationTracker:
    """Takes the place of neat-python's class of this name, and of its counter of node keys.

    It can be pickled, as in a checkpoint, but its clock does not go back: what is restored goes on with the
    island of the same robot that is open in the process.
    """

    def __init__(self, island: Island, inputs: int, outputs: int) -> None:
        self.island = island
        self.inputs, self.outputs = inputs, outputs
        self.generation_innovations: dict[tuple[int, int, str], Any] = {}

    @property
    def global_counter(self) -> int:
        """The last counter that any island is known to have used."""
        return self.island.clock.stamp() - 1

    def get_current_innovation_number(self) -> int:
        return self.global_counter

    def get_innovation_number(self, input_node: int, output_node: int,
                              mutation_type: str = "add_connection") -> int:
        """The mark of a connection; for the same mutation in one generation, the same."""
        key = (input_node, output_node, mutation_type)
        if key not in self.generation_innovations:
            genesis = self._genesis(input_node, output_node) if (
                mutation_type == "initial_connection") else None
            self.generation_innovations[key] = genesis or self.island.new_id()
        number: int = self.generation_innovations[key]
        return number

    def get_node_split(self, in_node: int, out_node: int, allocate_node_key: Callable[[], int],
                       ) -> tuple[int, int, int]:
        """Node key and both marks of a split. The counter of keys behind allocate_node_key is this
        process's own, and is not asked."""
        key = (in_node, out_node, "split_node")
        if key not in self.generation_innovations:
            node, into, out = self.island.mint_many(3)
            self.generation_innovations[key] = (int(node), int(into), int(out))
        split: tuple[int, int, int] = self.generation_innovations[key]
        return split

    def reset_generation(self) -> None:
        self.generation_innovations = {}

    def new_node_key(self, node_dict: dict[int, Any] | None = None) -> int:
        """In the place of config.genome_config.get_new_node_key."""
        return self.island.new_id()

    def _genesis(self, input_node: int, output_node: int) -> int | None:
        """The mark that a connection from an input to an output has on every island, however it was
        chosen: partial and fs_neat connections too are the same gene everywhere."""
        source, target = -input_node - 1, output_node
        if not (0 <= source < self.inputs and 0 <= target < self.outputs):
            return None
        counter = self.inputs + self.outputs + source * self.outputs + target + 1
        return int(InnovationNumber(counter, 0))

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "island": None, "robot": self.island.robot}

    def __setstate__(self, state: dict[str, Any]) -> None:
        robot = state.pop("robot")
        vars(self).update(state)
        if robot not in living:
            raise RuntimeError(f"this checkpoint was made by island {robot}: open it first (Island or "
                               "NeatIsland, with its folder), so that no mark is made twice")
        self.island = living[robot]
        # Numbers of the generation that was restored are in its genomes; equal mutations from here on are
        # new ones, since others may have been made after the checkpoint.
        self.generation_innovations = {}


class NeatIsland:
    """A population of neat-python's as an island. Arguments beyond `folder` are those of Island."""

    def __init__(self, population: Any, robot: int, folder: str | os.PathLike[str] | None = None,
                 **options: Any) -> None:
        self.population = population
        config = population.config.genome_config
        self._island = Island(robot, schema_of(config), folder, **options)
        self.tracker = InnovationTracker(self._island, len(config.input_keys), len(config.output_keys))
        self._install(config)

    @property
    def island(self) -> Island:
        return self._island

    def _install(self, config: Any) -> None:
        self.population.reproduction.innovation_tracker = self.tracker
        config.innovation_tracker = self.tracker
        config.get_new_node_key = self.tracker.new_node_key
        # The first generation was made with numbers of neat-python's own.
        keys: dict[int, int] = {}
        for genome in self.population.population.values():
            self._rename(genome, keys)

    def _rename(self, genome: Any, keys: dict[int, int]) -> None:
        """Gives initial genes their marks, in place."""
        outputs = self.tracker.outputs

        def renamed(key: int) -> int:
            if key < outputs or key >= 1 << 32:  # inputs, outputs; or a mark already
                return key
            if key not in keys:
                keys[key] = self.tracker.new_node_key()
            return keys[key]

        for nodes in (genome.nodes,):
            for node in list(nodes.values()):
                del nodes[node.key]
                node.key = renamed(node.key)
                nodes[node.key] = node
        for connection in list(genome.connections.values()):
            del genome.connections[connection.key]
            source, target = connection.key
            connection.key = (renamed(source), renamed(target))
            if connection.innovation < 1 << 32:
                connection.innovation = self.tracker.get_innovation_number(
                    *connection.key, "initial_connection")
            genome.connections[connection.key] = connection

    # ---- Genomes ----------------------------------------------------------------------------------------

    def _mark_of(self, key: int) -> InnovationNumber:
        tracker = self.tracker
        if key < 0:
            return InnovationNumber(-key, 0)
        if key < tracker.outputs:
            return InnovationNumber(tracker.inputs + key + 1, 0)
        return InnovationNumber.unpack(key)

    def _key_of(self, counter: int, robot: int) -> int:
        tracker = self.tracker
        if robot != 0:
            return int(InnovationNumber(counter, robot))
        return -counter if counter <= tracker.inputs else counter - tracker.inputs - 1

    def to_columns(self, genome: Any) -> Genome:
        """A genome of neat-python's as columns, with all attributes; as its maker's where one is noted
        (genome.gene_clocks_identity), else to become this island's own."""
        schema = self._island.schema
        inputs = self.tracker.inputs
        nodes = sorted(genome.nodes.values(), key=lambda node: self._mark_of(node.key))
        connections = sorted(genome.connections.values(), key=lambda one: int(one.innovation))
        place = {-i - 1: i for i in range(inputs)}
        place |= {node.key: inputs + i for i, node in enumerate(nodes)}
        for one in connections:
            for end in one.key:
                if end not in place:
                    raise GenomeRefused(f"connection {one.key} of genome {genome.key} joins node {end}, "
                                        "which the genome has not")

        def values(genes: list[Any], gene_class: GeneClass) -> dict[str, list[Any]]:
            return {a.name: [getattr(gene, a.name) for gene in genes] for a in gene_class.attributes}

        node_marks = [self._mark_of(node.key) for node in nodes]
        marks = [InnovationNumber.unpack(one.innovation) for one in connections]
        robot, birth = getattr(genome, "gene_clocks_identity", (0, 0))
        has_fitness = genome.fitness is not None
        return Genome(robot, birth, {
            "input": Genes(range(1, inputs + 1), [0] * inputs),
            "node": Genes([m.counter for m in node_marks], [m.robot for m in node_marks],
                          attributes=values(nodes, schema.classes[1])),
            "connection": Genes([m.counter for m in marks], [m.robot for m in marks],
                                [place[one.key[0]] for one in connections],
                                [place[one.key[1]] for one in connections],
                                values(connections, schema.classes[2]))},
            {"fitness": float(genome.fitness) if has_fitness else 0.0, "has_fitness": has_fitness})

    def from_columns(self, columns: Genome, key: int) -> Any:
        """A genome of neat-python's, under a key of this process. GenomeRefused where it is none of this
        configuration; nothing that came off a wire is believed."""
        config = self.population.config.genome_config
        tracker, schema = self.tracker, self._island.schema
        genome = self.population.config.genome_type(key)
        inputs, nodes, connections = (columns[name] for name in ("input", "node", "connection"))
        keys = [self._key_of(*mark) for part in (inputs, nodes) for mark in part.marks()]
        if keys[:len(inputs)] != [-i - 1 for i in range(tracker.inputs)]:
            raise GenomeRefused("its inputs are not those of this configuration")
        hidden_or_output = keys[len(inputs):]
        if hidden_or_output[:tracker.outputs] != list(range(tracker.outputs)) or any(
                key < 1 << 32 for key in hidden_or_output[tracker.outputs:]):
            raise GenomeRefused("its outputs are not those of this configuration")
        for index, gene in enumerate(_genes(nodes, schema.classes[1], [
                config.node_gene_type(key) for key in hidden_or_output])):
            genome.nodes[hidden_or_output[index]] = gene
        ends = list(zip(connections.sources.tolist(), connections.targets.tolist()))
        for index, (source, target) in enumerate(ends):
            if target < len(inputs):
                raise GenomeRefused(f"connection gene {index} leads into an input")
        pairs = [(keys[source], keys[target]) for source, target in ends]
        if len(set(pairs)) != len(pairs):
            raise GenomeRefused("two connection genes join the same nodes")
        if config.feed_forward and _has_cycle(pairs):
            raise GenomeRefused("its connections form a cycle, and this configuration is feed-forward")
        made = [config.connection_gene_type(pair, innovation=int(mark))
                for pair, mark in zip(pairs, connections.marks())]
        for gene in _genes(connections, schema.classes[2], made):
            genome.connections[gene.key] = gene
        genome.gene_clocks_identity = (columns.robot, columns.birth)
        return genome

    # ---- Messages ---------------------------------------------------------------------------------------

    def pack(self, genome: Any) -> bytes:
        """The frame of a genome, to be sent."""
        columns = self.to_columns(genome)
        # The frame's energy is a float of 32 bits; the whole fitness is among the attributes.
        energy = 0.0 if genome.fitness is None else max(-3e38, min(3e38, float(genome.fitness)))
        frame = self._island.pack(columns, energy)
        genome.gene_clocks_identity = (columns.robot, columns.birth)
        return frame

    def receive(self, data: bytes | bytearray | memoryview) -> tuple[Any, Received]:
        """The genome in bytes that arrived, ready for the population, or None; and what became of them."""
        received = self._island.receive(data)
        if received.genome is None:
            return None, received
        try:
            genome = self.from_columns(received.genome, next(self.population.reproduction.genome_indexer))
        except GenomeRefused as refused:
            return None, received._replace(outcome=Outcome.malformed, genome=None, reason=str(refused))
        self.population.reproduction.ancestors[genome.key] = ()
        return genome, received

    def add(self, immigrants: Iterable[Any]) -> int:
        """Immigrants join the population and its species; they are evaluated with the next generation. Those
        that are in it already, since their island sent them before, do not. How many joined."""
        population, count = self.population, 0
        present = {getattr(genome, "gene_clocks_identity", None)
                   for genome in population.population.values()}
        for genome in immigrants:
            if genome.gene_clocks_identity in present:
                continue
            present.add(genome.gene_clocks_identity)
            population.population[genome.key] = genome
            count += 1
        if count:
            population.species.speciate(population.config, population.population, population.generation)
        return count

    def migration(self, send: Callable[[bytes], object],
                  receive: Callable[[], Iterable[bytes]], every: int = 1) -> Migration:
        """A reporter that, every so many generations, sends the best genome and takes in what has arrived.
        send(bytes) passes a frame on; receive() gives those that have arrived, without waiting."""
        return Migration(self, send, receive, every)


class Migration:
    """A reporter for neat-python: see NeatIsland.migration. `sent` and `taken` count genomes."""

    def __init__(self, island: NeatIsland, send: Callable[[bytes], object],
                 receive: Callable[[], Iterable[bytes]], every: int) -> None:
        self._island, self._send, self._receive, self._every = island, send, receive, every
        self._best: Any = None
        self._generation = 0
        self.sent = 0
        self.taken = 0

    def start_generation(self, generation: int) -> None:
        self._generation = generation

    def post_evaluate(self, config: Any, population: Any, species: Any, best_genome: Any) -> None:
        if self._generation % self._every == 0:
            self._send(self._island.pack(best_genome))
            self.sent += 1

    def end_generation(self, config: Any, population: Any, species_set: Any) -> None:
        arrived = [self._island.receive(data)[0] for data in self._receive()]
        self.taken += self._island.add(genome for genome in arrived if genome is not None)

    def post_reproduction(self, config: Any, population: Any, species: Any) -> None: ...

    def complete_extinction(self) -> None: ...

    def found_solution(self, config: Any, generation: int, best: Any) -> None: ...

    def species_stagnant(self, sid: int, species: Any) -> None: ...

    def info(self, msg: str) -> None: ...


def _genes(genes: Genes, gene_class: GeneClass, made: list[Any]) -> list[Any]:
    """The genes with the attributes that the columns have for them."""
    for attribute in gene_class.attributes:
        values: Any = genes[attribute.name].tolist()
        if attribute.type == "enumeration":
            names = attribute.values
            if _NO_OTHER in names and 1 in values:
                raise GenomeRefused(f"its {attribute.name} is none of this configuration")
            values = [names[value] for value in values]
        for gene, value in zip(made, values):
            setattr(gene, attribute.name, value)
    return made


def _has_cycle(pairs: list[tuple[int, int]]) -> bool:
    """Kahn's algorithm: what is left when nothing can be taken away is a cycle."""
    into: dict[int, int] = {}
    out: dict[int, list[int]] = {}
    for source, target in pairs:
        into[target] = into.get(target, 0) + 1
        out.setdefault(source, []).append(target)
    free = [node for node in out if node not in into]
    taken = 0
    while free:
        for target in out.get(free.pop(), ()):
            taken += 1
            into[target] -= 1
            if into[target] == 0:
                free.append(target)
    return taken < len(pairs)
