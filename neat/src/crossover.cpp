#include <algorithm>
#include <cassert>
#include <gene_clocks/align.hpp>
#include <gene_clocks/neat/crossover.hpp>
#include <utility>
#include <vector>

namespace gene_clocks::neat {
namespace {

bool is_first_fitter(const Parent& first, const Parent& second) {
    if (first.fitness != second.fitness) return first.fitness > second.fitness;
    return first.genome->connections() < second.genome->connections();
}

/// Whether each connection reverses an earlier feed-forward one, that is, joins the same neurons
/// the other way round.
std::vector<bool> find_reversals(const Topology& topology) {
    std::vector<bool> is_reversal(topology.connection_ends.size(), false);
    // Nothing ends in an input, so that connections out of inputs, which are the most, stay aside.
    const InnovationNumber last_input = topology.neurons[topology.inputs - 1].mark;
    std::vector<ConnectionEnds> forward;
    for (std::size_t i = 0; i < topology.connection_ends.size(); ++i) {
        const ConnectionEnds& ends = topology.connection_ends[i];
        if (!(last_input < ends.source)) continue;
        is_reversal[i] =
            std::any_of(forward.begin(), forward.end(), [&](const ConnectionEnds& other) {
                return other.source == ends.target && other.target == ends.source;
            });
        if (!ends.recurrent) forward.push_back(ends);
    }
    return is_reversal;
}

/// Takes connections out of a genome. Its neurons stay: each reversal that goes leaves the
/// connection that it reversed, which needs the same two.
void drop(const std::vector<bool>& is_dropped, Genome& genome) {
    auto topology = std::make_shared<Topology>(*genome.topology);
    const auto compact = [&](auto& genes) {
        std::size_t i = 0;
        std::erase_if(genes, [&](const auto&) { return is_dropped[i++]; });
    };
    compact(topology->connection_marks);
    compact(topology->connection_ends);
    compact(genome.weights);
    compact(genome.enabled);
    genome.topology = std::move(topology);
}

/// CrossoverKind::uniform.
void inherit_uniformly(const Genome& fitter, const Genome& other, const OdneatSettings& settings,
                       RandomStream& random, Genome& child) {
    align(fitter.topology->connection_marks, other.topology->connection_marks,
          [&](GeneMatch match, std::size_t i, std::size_t j) {
              if (match != GeneMatch::matching) return;
              if (random.chance(0.5)) child.weights[i] = other.weights[j];
              const float enabled_in = fitter.enabled[i] + other.enabled[j];
              const bool disable =
                  enabled_in == 0.0f ||
                  (enabled_in == 1.0f && random.chance(settings.disable_probability));
              child.enabled[i] = disable ? 0.0f : 1.0f;
          });
}

/// CrossoverKind::one_point.
void inherit_at_one_point(const Genome& fitter, const Genome& other, RandomStream& random,
                          Genome& child) {
    std::vector<std::pair<std::size_t, std::size_t>> matches;  // oldest first
    align(fitter.topology->connection_marks, other.topology->connection_marks,
          [&](GeneMatch match, std::size_t i, std::size_t j) {
              if (match == GeneMatch::matching) matches.emplace_back(i, j);
          });
    assert(!matches.empty());  // the initial ones
    const auto places = static_cast<std::uint32_t>(std::max<std::size_t>(matches.size() - 1, 1));
    const std::size_t cut = 1 + random.below(places);
    const bool older_from_other = random.chance(0.5);
    for (std::size_t place = 0; place < matches.size(); ++place) {
        if ((place < cut) != older_from_other) continue;
        const auto [i, j] = matches[place];
        child.weights[i] = other.weights[j];
        child.enabled[i] = other.enabled[j];
    }
}

}  // namespace

Genome crossover(GenomeId id, Parent first, Parent second, const OdneatSettings& settings,
                 RandomStream& random) {
    // The fitter parent's genes are the child's: only matching ones have a choice.
    const bool swap = !is_first_fitter(first, second);
    const Genome& fitter = swap ? *second.genome : *first.genome;
    const Genome& other = swap ? *first.genome : *second.genome;

    Genome child{id, fitter.topology, fitter.weights, fitter.enabled};
    if (settings.crossover == CrossoverKind::one_point) {
        inherit_at_one_point(fitter, other, random, child);
    } else {
        inherit_uniformly(fitter, other, settings, random, child);
    }
    const auto is_reversal = find_reversals(*fitter.topology);
    if (std::find(is_reversal.begin(), is_reversal.end(), true) != is_reversal.end()) {
        drop(is_reversal, child);
    }
    assert(is_valid(child, settings.weight_limit));
    return child;
}

}  // namespace gene_clocks::neat
