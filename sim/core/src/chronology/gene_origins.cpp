#include "sim/core/src/chronology/gene_origins.hpp"

#include <algorithm>
#include <cassert>
#include <gene_clocks/align.hpp>
#include <gene_clocks/neat/message_codec.hpp>
#include <gene_clocks/wire.hpp>
#include <limits>
#include <numeric>
#include <utility>

namespace gene_clocks::sim {
namespace {

constexpr GeneIndex not_yet = std::numeric_limits<GeneIndex>::max();

/// A structure's number as an innovation record takes it.
InnovationNumber number(std::uint64_t structure) {
    return {structure, neat::no_robot};
}

/// Looks the genes of one topology up in another by their marks; `not_yet` where it has none.
void look_up(const neat::Topology& topology, const neat::Topology& in, const TopologyGenes& origins,
             TopologyGenes& genes) {
    // Both are sorted.
    std::size_t at = 0;
    for (std::size_t i = 0; i < topology.neurons.size(); ++i) {
        const InnovationNumber mark = topology.neurons[i].mark;
        while (at < in.neurons.size() && in.neurons[at].mark < mark) ++at;
        const bool is_there = at < in.neurons.size() && in.neurons[at].mark == mark;
        if (is_there && genes.neurons[i] == not_yet) genes.neurons[i] = origins.neurons[at];
    }
    at = 0;
    const auto& marks = in.connection_marks;
    for (std::size_t i = 0; i < topology.connection_marks.size(); ++i) {
        const InnovationNumber mark = topology.connection_marks[i];
        while (at < marks.size() && marks[at] < mark) ++at;
        const bool is_there = at < marks.size() && marks[at] == mark;
        if (is_there && genes.connections[i] == not_yet)
            genes.connections[i] = origins.connections[at];
    }
}

bool has_all_marks(const neat::Topology& topology, const neat::Topology& of) {
    return std::ranges::includes(topology.neurons, of.neurons, {}, &neat::NeuronGene::mark,
                                 &neat::NeuronGene::mark) &&
           std::ranges::includes(topology.connection_marks, of.connection_marks);
}

/// How many elements two lists have in common, each counted once for each of its pairs.
std::uint64_t count_common(std::vector<std::uint64_t>& first, std::vector<std::uint64_t>& second) {
    if (first.empty() || second.empty()) return 0;
    std::ranges::sort(first);
    std::ranges::sort(second);
    std::uint64_t common = 0;
    for (auto a = first.begin(), b = second.begin(); a != first.end() && b != second.end();) {
        if (*a == *b)
            ++common, ++a, ++b;
        else if (*a < *b)
            ++a;
        else
            ++b;
    }
    return common;
}

}  // namespace

GeneOrigins::GeneOrigins(std::shared_ptr<const neat::Topology> initial)
    : initial_genes_(initial->size()), record_(initial->size()) {
    TopologyGenes& genes = enter(std::move(initial));
    std::iota(genes.neurons.begin(), genes.neurons.end(), GeneIndex{0});
    std::iota(genes.connections.begin(), genes.connections.end(),
              static_cast<GeneIndex>(genes.neurons.size()));
    structures_.resize(initial_genes_);
    std::iota(structures_.begin(), structures_.end(), std::uint64_t{1});
}

TopologyGenes& GeneOrigins::enter(std::shared_ptr<const neat::Topology> topology) {
    if (known_.size() >= sweep_size_) {
        std::erase_if(known_, [](const auto& entry) { return entry.second.topology.expired(); });
        sweep_size_ = std::max<std::size_t>(1024, 2 * known_.size());
    }
    TopologyGenes& genes = known_[topology.get()];
    genes.topology = topology;
    genes.neurons.assign(topology->neurons.size(), not_yet);
    genes.connections.assign(topology->connection_marks.size(), not_yet);
    const std::vector<float> any(topology->connection_marks.size());
    const neat::Genome genome{{}, std::move(topology), any, any};
    genes.bytes = neat::payload_bytes(genome) - 2 * varint_bytes(0);
    return genes;
}

const TopologyGenes& GeneOrigins::inherit(const std::shared_ptr<const neat::Topology>& inherited,
                                          const neat::Topology& first,
                                          const neat::Topology* second) {
    const auto found = known_.find(inherited.get());
    if (found != known_.end()) return found->second;
    TopologyGenes& genes = enter(inherited);
    const neat::Topology& topology = *inherited;
    const bool second_first =
        second != nullptr && !has_all_marks(first, topology) && has_all_marks(*second, topology);
    if (!second_first) look_up(topology, first, of(first), genes);
    if (second != nullptr) look_up(topology, *second, of(*second), genes);
    if (second_first) look_up(topology, first, of(first), genes);
    assert(std::ranges::find(genes.neurons, not_yet) == genes.neurons.end());
    assert(std::ranges::find(genes.connections, not_yet) == genes.connections.end());
    return genes;
}

GeneIndex GeneOrigins::add(InnovationNumber mark, std::uint64_t structure) {
    innovations_.push_back({mark, structure});
    structures_.push_back(structure);
    return static_cast<GeneIndex>(structures_.size() - 1);
}

std::uint64_t GeneOrigins::structure_of_neuron(const neat::Topology& topology,
                                               const TopologyGenes& genes,
                                               InnovationNumber mark) const {
    return structures_[genes.neurons[*topology.find_neuron(mark)]];
}

std::uint64_t GeneOrigins::join(const neat::Topology& topology, const TopologyGenes& genes,
                                const neat::ConnectionEnds& ends) {
    return record_
        .join(number(structure_of_neuron(topology, genes, ends.source)),
              number(structure_of_neuron(topology, genes, ends.target)))
        .counter;
}

void GeneOrigins::add_split(const neat::Topology& topology, const neat::Topology& inherited,
                            std::size_t neuron, TopologyGenes& genes) {
    const TopologyGenes& before = of(inherited);
    const InnovationNumber mark = topology.neurons[neuron].mark;
    const auto& ends = topology.connection_ends;
    const auto incoming = static_cast<std::size_t>(
        std::ranges::find(ends, mark, &neat::ConnectionEnds::target) - ends.begin());
    const auto outgoing = static_cast<std::size_t>(
        std::ranges::find(ends, mark, &neat::ConnectionEnds::source) - ends.begin());
    assert(incoming < ends.size() && outgoing < ends.size());

    // A genome joins two neurons only once in each direction, so the ends tell which was split.
    const auto split =
        std::ranges::find_if(inherited.connection_ends, [&](const neat::ConnectionEnds& old) {
            return old.source == ends[incoming].source && old.target == ends[outgoing].target;
        });
    assert(split != inherited.connection_ends.end());
    const auto split_gene =
        before.connections[static_cast<std::size_t>(split - inherited.connection_ends.begin())];
    const auto is_there = [&](std::uint64_t structure) {
        return std::ranges::any_of(before.neurons,
                                   [&](GeneIndex gene) { return structures_[gene] == structure; });
    };
    std::uint64_t repetition = 0;
    std::uint64_t structure = 0;
    do {
        structure = record_.split(number(structures_[split_gene]), repetition++).neuron.counter;
    } while (is_there(structure));

    genes.neurons[neuron] = add(mark, structure);
    for (const std::size_t connection : {incoming, outgoing}) {
        genes.connections[connection] =
            add(topology.connection_marks[connection], join(topology, genes, ends[connection]));
    }
}

const TopologyGenes& GeneOrigins::innovate(const std::shared_ptr<const neat::Topology>& offspring,
                                           const neat::Topology& inherited) {
    innovations_.clear();
    const neat::Topology& topology = *offspring;
    TopologyGenes& genes = enter(offspring);
    look_up(topology, inherited, of(inherited), genes);
    const auto neuron = std::ranges::find(genes.neurons, not_yet);
    if (neuron != genes.neurons.end()) {
        add_split(topology, inherited, static_cast<std::size_t>(neuron - genes.neurons.begin()),
                  genes);
    }
    for (std::size_t i = 0; i < genes.connections.size(); ++i) {
        if (genes.connections[i] != not_yet) continue;
        genes.connections[i] =
            add(topology.connection_marks[i], join(topology, genes, topology.connection_ends[i]));
    }
    assert(std::ranges::find(genes.neurons, not_yet) == genes.neurons.end());
    return genes;
}

Homology GeneOrigins::align(const neat::Topology& first, const neat::Topology& second) {
    Homology homology;
    if (&first == &second) {
        homology.matching = first.connection_marks.size();
        return homology;
    }
    const auto& genes_a = of(first).connections;
    const auto& genes_b = of(second).connections;
    scratch_first_.clear();
    scratch_second_.clear();
    gene_clocks::align(first.connection_marks, second.connection_marks,
                       [&](GeneMatch match, std::size_t i, std::size_t j) {
                           switch (match) {
                               case GeneMatch::matching:
                                   ++homology.matching;
                                   if (structures_[genes_a[i]] != structures_[genes_b[j]])
                                       ++homology.mistaken;
                                   return;
                               case GeneMatch::disjoint_first:
                               case GeneMatch::disjoint_second:
                                   ++homology.disjoint;
                                   break;
                               case GeneMatch::excess_first:
                               case GeneMatch::excess_second:
                                   ++homology.excess;
                                   break;
                           }
                           const bool is_first = match == GeneMatch::disjoint_first ||
                                                 match == GeneMatch::excess_first;
                           if (is_first)
                               scratch_first_.push_back(structures_[genes_a[i]]);
                           else
                               scratch_second_.push_back(structures_[genes_b[j]]);
                       });
    homology.missed = count_common(scratch_first_, scratch_second_);
    return homology;
}

bool GeneOrigins::repeats_structure(const neat::Topology& topology) {
    // A genome joins two neurons only once, so that no connection is there twice if no neuron is.
    scratch_first_.clear();
    for (const GeneIndex gene : of(topology).neurons) scratch_first_.push_back(structures_[gene]);
    std::ranges::sort(scratch_first_);
    return std::ranges::adjacent_find(scratch_first_) != scratch_first_.end();
}

}  // namespace gene_clocks::sim
