#pragma once

#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/sim/swarm_view.hpp>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

namespace gene_clocks::replay {

enum class GeneKind : std::uint8_t { neuron, connection, recurrent_connection };

/// A gene, by its place in GeneHistory::genes().
using GeneNumber = std::uint32_t;

/// What became of one mark.
struct Gene {
    InnovationNumber mark;
    GeneKind kind = GeneKind::neuron;
    double created_cycle = 0.0;  ///< genesis genes: 0
    neat::GenomeId genome;       ///< the one that it was created in; its robot is the creator
    /// Unless 1, robots that did not know of each other gave the mark, or one that had lost its
    /// counter; then all else here is of the first time.
    std::uint32_t times_marked = 1;
    /// Whether the genome became active. It did not where its robot rebooted before; then what
    /// follows is not known, and nobody ever carried the gene.
    bool was_active = false;
    /// A connection: the neurons from and to which it leads. A hidden neuron: the connection that
    /// it splits. A genesis neuron: nothing.
    std::vector<GeneNumber> builds_upon;
    std::size_t gene_set = 0;  ///< of the genome that it was created in, itself included
};

/// A robot's active genome from a cycle on.
struct Activation {
    std::int64_t cycle{};   ///< the first that begins with it
    std::uint32_t robot{};  ///< index from 0
    std::size_t gene_set{};
};

/// Which genes were created in a run, and which robots' active genomes had them when.
class GeneHistory {
public:
    /// To be told of each mark, and of the swarm between all cycles.
    void gene_marked(RobotId robot, InnovationNumber mark, double now_cycles);
    void between_cycles(const sim::SwarmView& swarm);

    /// The genesis genes, in the order of their marks, then all others in the order of creation.
    const std::vector<Gene>& genes() const { return genes_; }
    std::size_t genesis_genes() const { return genesis_genes_; }

    /// Sets of genes beyond the genesis ones, each sorted; no two alike. The first is empty.
    const std::vector<std::vector<GeneNumber>>& gene_sets() const { return gene_sets_; }

    /// In the order of cycles; the first are those of the initial genomes, at cycle 0.
    const std::vector<Activation>& activations() const { return activations_; }

    /// The gene set of each robot's active genome.
    const std::vector<std::size_t>& active() const { return active_; }

private:
    void begin(const neat::Topology& initial);
    std::size_t find_gene_set(const std::shared_ptr<const neat::Topology>& topology);
    void complete(GeneNumber index, const neat::Genome& genome, std::size_t gene_set);

    std::vector<Gene> genes_;
    std::size_t genesis_genes_ = 0;
    std::unordered_map<RobotId, std::unordered_map<std::uint64_t, GeneNumber>> index_;  // by mark
    std::vector<std::vector<GeneNumber>> gene_sets_;
    std::map<std::vector<GeneNumber>, std::size_t> gene_set_index_;
    // By address; the pointers keep the topologies, so that no address comes twice.
    std::unordered_map<std::shared_ptr<const neat::Topology>, std::size_t> known_topologies_;
    std::vector<Activation> activations_;
    std::vector<std::size_t> active_;      // one for each robot
    std::vector<neat::GenomeId> genomes_;  // the same
    std::vector<GeneNumber> fresh_;        // created since the last look at the swarm
};

}  // namespace gene_clocks::replay
