#pragma once

#include <cstddef>
#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <gene_clocks/neat/random.hpp>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace gene_clocks::neat {

enum class NeuronKind : std::uint8_t { input, bias, output, hidden };

struct NeuronGene {
    InnovationNumber mark;
    NeuronKind kind{};
    friend bool operator==(const NeuronGene&, const NeuronGene&) = default;
};

/// The neurons that a connection joins, by their marks.
struct ConnectionEnds {
    InnovationNumber source;
    InnovationNumber target;
    bool recurrent = false;
    friend bool operator==(const ConnectionEnds&, const ConnectionEnds&) = default;
};

/// The structure of a genome: its genes without their weights. Immutable once shared, so that
/// clones and weight mutants share one topology and are recognised as equal by its address.
///
/// Invariants: both gene lists are sorted by mark, without repetition; the ends of every
/// connection are marks of `neurons`; no connection ends in an input or the bias; inputs, bias
/// and outputs come first among the neurons, in this order, and the first `initial_connections`
/// connections are the genesis ones, since no operator deletes a gene that all genomes share.
struct Topology {
    std::vector<NeuronGene> neurons;
    std::vector<InnovationNumber> connection_marks;
    std::vector<ConnectionEnds> connection_ends;  ///< parallel to connection_marks
    std::size_t inputs = 0;                       ///< the bias included
    std::size_t outputs = 0;
    std::size_t initial_connections = 0;

    /// Index of a neuron by its mark; nullopt where there is none.
    std::optional<std::size_t> find_neuron(InnovationNumber mark) const;
    bool joined(InnovationNumber source, InnovationNumber target) const;
    /// Adds a gene at its place in the order of marks and returns its index.
    /// Preconditions: the mark is new; the connection's ends are among the neurons.
    std::size_t insert(NeuronGene neuron);
    std::size_t insert(InnovationNumber mark, ConnectionEnds ends);

    std::size_t size() const { return neurons.size() + connection_marks.size(); }
    std::size_t initial_size() const { return inputs + outputs + initial_connections; }
};

/// One genesis mark for each gene that `make_initial_topology` makes.
std::uint64_t genesis_mark_count(std::size_t inputs, std::size_t outputs);

/// The perceptron that every robot starts from (paper, section 3.2): `inputs` neurons, the last
/// of which is the bias, each connected to each of `outputs` neurons. Its genes carry the genesis
/// marks 1…n, over neurons, then connections. Preconditions: inputs ≥ 1, outputs ≥ 1.
std::shared_ptr<const Topology> make_initial_topology(std::size_t inputs, std::size_t outputs);

/// Identity of a genome: the robot that made it, and a number that this robot gives to no other
/// (how many it had made before; after a crash, more).
struct GenomeId {
    RobotId robot{};
    std::uint32_t birth{};
    friend auto operator<=>(const GenomeId&, const GenomeId&) = default;
};

/// Neuron and connection genes, sorted by innovation number; weights apart from structure.
///
/// `enabled` is 1 or 0 in floating point: the distance multiplies by it instead of branching.
struct Genome {
    GenomeId id;
    std::shared_ptr<const Topology> topology;  ///< never null
    std::vector<float> weights;                ///< parallel to topology->connection_marks
    std::vector<float> enabled;                ///< parallel to weights: 1 enabled, 0 disabled

    bool is_enabled(std::size_t connection) const { return enabled[connection] != 0.0f; }
    std::size_t connections() const { return weights.size(); }
};

/// The initial genome with weights drawn from N(0, 1), clipped to ±weight_limit.
Genome make_initial_genome(GenomeId id, std::shared_ptr<const Topology> topology,
                           double weight_limit, RandomStream& random);

/// The first broken invariant of a genome in words, or nullopt.
std::optional<std::string_view> find_fault(const Genome& genome, double weight_limit);

inline bool is_valid(const Genome& genome, double weight_limit) {
    return !find_fault(genome, weight_limit);
}

}  // namespace gene_clocks::neat
