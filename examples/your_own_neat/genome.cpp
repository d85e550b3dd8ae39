#include "genome.hpp"

#include <algorithm>
#include <cmath>
#include <gene_clocks/align.hpp>

namespace your_own_neat {

using gene_clocks::align;
using gene_clocks::GeneMatch;
using gene_clocks::genesis_robot;

float uniform(Random& random, float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) * 0x1.0p-24f;
}

std::size_t below(Random& random, std::size_t bound) {
    return random() % bound;
}

std::size_t place_of(const Genome& genome, InnovationNumber mark) {
    const auto place = std::lower_bound(
        genome.nodes.begin(), genome.nodes.end(), mark,
        [](const Node& node, InnovationNumber wanted) { return node.mark < wanted; });
    return static_cast<std::size_t>(place - genome.nodes.begin());
}

Genome initial_genome(Random& random) {
    const auto genesis = [](std::uint64_t counter) {
        return InnovationNumber{counter, genesis_robot};
    };
    Genome genome;
    for (Kind kind : {Kind::input, Kind::input, Kind::bias, Kind::output}) {
        genome.nodes.push_back({genesis(genome.nodes.size() + 1), kind});
    }
    for (std::uint64_t from = 1; from <= 3; ++from) {
        genome.links.push_back(
            {genesis(4 + from), genesis(from), genesis(4), uniform(random, -2.0f, 2.0f), true});
    }
    return genome;
}

bool add_node(Genome& genome, GeneClock& clock, Random& random) {
    Link& split = genome.links[below(random, genome.links.size())];
    const bool is_from_bias = genome.nodes[place_of(genome, split.from)].kind == Kind::bias;
    if (!split.is_enabled || is_from_bias) return false;
    const auto marks = clock.mint(3);  // all three, or none
    if (!marks) return false;
    split.is_enabled = false;
    const Link old = split;
    // New marks are above all that this process knows, so that lists stay sorted by appending.
    genome.nodes.push_back({(*marks)[0], Kind::hidden});
    genome.links.push_back({(*marks)[1], old.from, (*marks)[0], 1.0f, true});
    genome.links.push_back({(*marks)[2], (*marks)[0], old.to, old.weight, true});
    return true;
}

namespace {

bool leads_to(const Genome& genome, InnovationNumber from, InnovationNumber to) {
    // Ends whatever the links are: a genome that came from elsewhere may have a cycle.
    std::vector<InnovationNumber> reached{from};
    for (std::size_t next = 0; next < reached.size(); ++next) {
        if (reached[next] == to) return true;
        for (const Link& link : genome.links) {
            if (link.from != reached[next]) continue;
            if (std::ranges::find(reached, link.to) == reached.end()) reached.push_back(link.to);
        }
    }
    return false;
}

}  // namespace

bool add_link(Genome& genome, GeneClock& clock, Random& random) {
    const Node& from = genome.nodes[below(random, genome.nodes.size())];
    const Node& to = genome.nodes[3 + below(random, genome.nodes.size() - 3)];  // no input, no bias
    const bool is_joined =
        std::any_of(genome.links.begin(), genome.links.end(),
                    [&](const Link& l) { return l.from == from.mark && l.to == to.mark; });
    if (is_joined || leads_to(genome, to.mark, from.mark)) return false;
    const auto mark = clock.mint();
    if (!mark) return false;
    genome.links.push_back({*mark, from.mark, to.mark, uniform(random, -2.0f, 2.0f), true});
    return true;
}

void mutate_weights(Genome& genome, Random& random) {
    for (Link& link : genome.links) {
        link.weight = std::clamp(link.weight + uniform(random, -1.5f, 1.5f), -10.0f, 10.0f);
    }
}

Genome crossover(const Genome& fitter, const Genome& other, Random& random) {
    Genome child = fitter;
    align(
        fitter.links, other.links,
        [&](GeneMatch match, std::size_t i, std::size_t j) {
            if (match == GeneMatch::matching && below(random, 2) == 0) {
                child.links[i].weight = other.links[j].weight;
            }
        },
        &Link::mark);
    return child;
}

float distance(const Genome& a, const Genome& b) {
    float matching = 0.0f, unmatched = 0.0f, difference = 0.0f;
    align(
        a.links, b.links,
        [&](GeneMatch match, std::size_t i, std::size_t j) {
            if (match == GeneMatch::matching) {
                matching += 1.0f;
                difference += std::abs(a.links[i].weight - b.links[j].weight);
            } else {
                unmatched += 1.0f;
            }
        },
        &Link::mark);
    // Never a division by zero: the genesis links match in any two genomes.
    return unmatched / static_cast<float>(std::max(a.links.size(), b.links.size())) +
           0.4f * difference / matching;
}

float activate(const Genome& genome, float first, float second) {
    std::vector<float> values(genome.nodes.size(), 0.0f);
    values[0] = first;
    values[1] = second;
    values[2] = 1.0f;
    for (std::size_t round = 3; round < genome.nodes.size(); ++round) {
        std::vector<float> sums(genome.nodes.size(), 0.0f);
        for (const Link& link : genome.links) {
            if (!link.is_enabled) continue;
            sums[place_of(genome, link.to)] += link.weight * values[place_of(genome, link.from)];
        }
        for (std::size_t i = 3; i < values.size(); ++i) {
            values[i] = 1.0f / (1.0f + std::exp(-4.9f * sums[i]));
        }
    }
    return values[3];
}

}  // namespace your_own_neat
