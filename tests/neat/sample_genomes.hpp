#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/neat/mutation.hpp>
#include <gene_clocks/neat/settings.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// Small genomes with known genes, for the tests of this folder.

namespace gene_clocks::neat {

// Found by argument-dependent lookup: GoogleTest prints these in messages.
inline void PrintTo(const GenomeId& id, std::ostream* out) {
    *out << "genome " << id.birth << " of robot " << static_cast<std::uint32_t>(id.robot);
}

}  // namespace gene_clocks::neat

namespace gene_clocks::neat::samples {

constexpr double weight_limit = 10.0;

/// A mark of robot 1 unless said otherwise.
inline InnovationNumber mark(std::uint64_t counter, std::uint32_t robot = 1) {
    return {counter, RobotId{robot}};
}
inline InnovationNumber genesis(std::uint64_t counter) {
    return {counter, genesis_robot};
}

/// The perceptron, all weights 0. Its neurons carry the marks 1…inputs (the bias last), then the
/// outputs; see make_initial_topology.
inline Genome perceptron(std::size_t inputs, std::size_t outputs, GenomeId id = {RobotId{1}, 0}) {
    const auto topology = make_initial_topology(inputs, outputs);
    const std::size_t connections = topology->connection_marks.size();
    return {id, topology, std::vector<float>(connections, 0.0f),
            std::vector<float>(connections, 1.0f)};
}

inline void add_hidden(Genome& genome, InnovationNumber neuron) {
    auto topology = std::make_shared<Topology>(*genome.topology);
    topology->insert(NeuronGene{neuron, NeuronKind::hidden});
    genome.topology = std::move(topology);
}

inline void add_gene(Genome& genome, InnovationNumber at, ConnectionEnds ends, float weight = 0.0f,
                     bool enabled = true) {
    auto topology = std::make_shared<Topology>(*genome.topology);
    const auto index = static_cast<std::ptrdiff_t>(topology->insert(at, ends));
    genome.weights.insert(genome.weights.begin() + index, weight);
    genome.enabled.insert(genome.enabled.begin() + index, enabled ? 1.0f : 0.0f);
    genome.topology = std::move(topology);
}

/// A perceptron that has one free place for as many connections as wanted: `neurons` hidden
/// neurons of marks 1000, 1001, …, each joined to nothing. Good for tests of marks alone.
inline Genome with_hidden(Genome genome, std::size_t neurons) {
    for (std::uint64_t i = 0; i < neurons; ++i) add_hidden(genome, genesis(1000 + i));
    return genome;
}

/// Index of a connection gene by its mark; fails the test where there is none.
inline std::size_t index_of(const Genome& genome, InnovationNumber wanted) {
    const auto& marks = genome.topology->connection_marks;
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (marks[i] == wanted) return i;
    }
    ADD_FAILURE() << "no gene with counter " << wanted.counter;
    return 0;
}

inline bool same_structure(const Topology& a, const Topology& b) {
    return a.neurons == b.neurons && a.connection_marks == b.connection_marks &&
           a.connection_ends == b.connection_ends && a.inputs == b.inputs &&
           a.outputs == b.outputs && a.initial_connections == b.initial_connections;
}

/// Equal genes, whatever the id and whether or not the topology is shared.
inline bool same_genes(const Genome& a, const Genome& b) {
    return same_structure(*a.topology, *b.topology) && a.weights == b.weights &&
           a.enabled == b.enabled;
}

/// `genome`'s fault in words, or "valid".
inline std::string fault_of(const Genome& genome) {
    return std::string(find_fault(genome, weight_limit).value_or("valid"));
}

/// Adds `elements` structural elements and new weights, by the project's operators.
inline void grow(Genome& genome, std::size_t elements, InnovationSource& source,
                 RandomStream& random) {
    OdneatSettings settings;
    settings.sigma = 1.0;
    for (std::size_t i = 0; i < elements; ++i) {
        if (random.chance(0.5)) {
            add_neuron(genome, settings, source, 0.0, random);
        } else {
            add_connection(genome, settings, source, 0.0, random);
        }
    }
    mutate_weights(genome, settings, random);
}

}  // namespace gene_clocks::neat::samples
