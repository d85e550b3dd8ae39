#pragma once

#include <cstddef>
#include <cstdint>
#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/neat/global_counter_source.hpp>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace gene_clocks::sim {

/// Tells genes apart where marks do not: every gene of a run has a number, the initial ones
/// 0, 1, … in the order of marks, then those that are created.
using GeneIndex = std::uint32_t;

/// Which genes a topology is made of.
struct TopologyGenes {
    std::vector<GeneIndex> neurons;      ///< parallel to the topology's
    std::vector<GeneIndex> connections;  ///< parallel to the topology's
    std::size_t bytes{};                 ///< of a payload, less the genome's id
    /// Keeps the topology's address from being used again.
    std::weak_ptr<const neat::Topology> topology;
};

/// The alignment of two genomes over connection genes.
struct Homology {
    std::uint64_t matching{}, disjoint{}, excess{};
    std::uint64_t missed{};    ///< pairs of unmatched genes of the same structure
    std::uint64_t mistaken{};  ///< matching genes of different structure
};

/// One gene that a mutation created.
struct Innovation {
    InnovationNumber mark;
    std::uint64_t structure{};
};

/// Where the genes of all genomes come from, and which of them are the same innovation.
class GeneOrigins {
public:
    explicit GeneOrigins(std::shared_ptr<const neat::Topology> initial);

    /// Precondition of all: the topologies of parents are known, by `inherit` or `innovate`.
    const TopologyGenes& of(const neat::Topology& topology) const { return known_.at(&topology); }

    /// The genes of a topology that comes of one parent, or of two; `second` may be null. A mark
    /// that both parents have stands for the gene of one that has all marks, if there is one.
    const TopologyGenes& inherit(const std::shared_ptr<const neat::Topology>& topology,
                                 const neat::Topology& first, const neat::Topology* second);

    /// The genes of a topology that has some beyond those it inherited. The new ones are then
    /// `innovations()`, in the order in which they were marked.
    const TopologyGenes& innovate(const std::shared_ptr<const neat::Topology>& topology,
                                  const neat::Topology& inherited);
    std::span<const Innovation> innovations() const { return innovations_; }

    Homology align(const neat::Topology& first, const neat::Topology& second);

    /// Whether two of its genes are the same innovation.
    bool repeats_structure(const neat::Topology& topology);

    std::size_t initial_genes() const { return initial_genes_; }

private:
    TopologyGenes& enter(std::shared_ptr<const neat::Topology> topology);
    GeneIndex add(InnovationNumber mark, std::uint64_t structure);
    void add_split(const neat::Topology& topology, const neat::Topology& inherited,
                   std::size_t neuron, TopologyGenes& genes);
    std::uint64_t structure_of_neuron(const neat::Topology& topology, const TopologyGenes& genes,
                                      InnovationNumber mark) const;
    std::uint64_t join(const neat::Topology& topology, const TopologyGenes& genes,
                       const neat::ConnectionEnds& ends);

    std::size_t initial_genes_;
    std::unordered_map<const neat::Topology*, TopologyGenes> known_;
    std::size_t sweep_size_ = 1024;  // of known_, at which those that are gone are taken out
    std::vector<std::uint64_t> structures_;  // of each gene, by its index
    neat::InnovationRecord record_;          // numbers structures
    std::vector<Innovation> innovations_;
    std::vector<std::uint64_t> scratch_first_, scratch_second_;
};

}  // namespace gene_clocks::sim
