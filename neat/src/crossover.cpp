#include "gene_clocks/neat/crossover.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

#include "gene_clocks/align.hpp"

namespace gene_clocks::neat {
namespace {

bool is_first_fitter(const Parent& first, const Parent& second) {
    if (first.fitness != second.fitness) return first.fitness > second.fitness;
    return first.genome->connections() < second.genome->connections();
}

/// Whether the child already has this connection, or the feed-forward one that it reverses.
bool is_repeated(const std::vector<ConnectionEnds>& taken, const ConnectionEnds& ends) {
    return std::any_of(taken.begin(), taken.end(), [&](const ConnectionEnds& other) {
        return (other.source == ends.source && other.target == ends.target) ||
               (!other.recurrent && other.source == ends.target && other.target == ends.source);
    });
}

/// Leaves the child the neurons that its connections need, beside inputs and outputs.
void keep_needed_neurons(Topology& child) {
    std::erase_if(child.neurons, [&](const NeuronGene& neuron) {
        return neuron.kind == NeuronKind::hidden &&
               std::none_of(child.connection_ends.begin(), child.connection_ends.end(),
                            [&](const ConnectionEnds& ends) {
                                return ends.source == neuron.mark || ends.target == neuron.mark;
                            });
    });
}

}  // namespace

Genome crossover(GenomeId id, Parent first, Parent second, const OdneatSettings& settings,
                 RandomStream& random) {
    // The fitter parent's genes are the child's: only matching ones have a choice.
    const bool swap = !is_first_fitter(first, second);
    const Genome& fitter = swap ? *second.genome : *first.genome;
    const Genome& other = swap ? *first.genome : *second.genome;
    const Topology& fitter_topology = *fitter.topology;

    Genome child{id, fitter.topology, fitter.weights, fitter.enabled};
    std::vector<bool> dropped(fitter.connections(), false);
    bool any_dropped = false;
    std::vector<ConnectionEnds> taken;
    taken.reserve(fitter.connections());
    align(fitter_topology.connection_marks, other.topology->connection_marks,
          [&](GeneMatch match, std::size_t i, std::size_t j) {
              if (match == GeneMatch::disjoint_second || match == GeneMatch::excess_second) return;
              if (match == GeneMatch::matching) {
                  if (random.chance(0.5)) child.weights[i] = other.weights[j];
                  const float enabled_in = fitter.enabled[i] + other.enabled[j];
                  const bool disable =
                      enabled_in == 0.0f ||
                      (enabled_in == 1.0f && random.chance(settings.disable_probability));
                  child.enabled[i] = disable ? 0.0f : 1.0f;
              }
              const ConnectionEnds& ends = fitter_topology.connection_ends[i];
              if (is_repeated(taken, ends)) {
                  dropped[i] = any_dropped = true;
              } else {
                  taken.push_back(ends);
              }
          });

    if (any_dropped) {
        auto topology = std::make_shared<Topology>(fitter_topology);
        const auto compact = [&](auto& genes) {
            std::size_t i = 0;
            std::erase_if(genes, [&](const auto&) { return dropped[i++]; });
        };
        compact(topology->connection_marks);
        compact(topology->connection_ends);
        compact(child.weights);
        compact(child.enabled);
        keep_needed_neurons(*topology);
        child.topology = std::move(topology);
    }
    assert(is_valid(child, settings.weight_limit));
    return child;
}

}  // namespace gene_clocks::neat
