#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <gene_clocks/neat/crossover.hpp>
#include <gene_clocks/neat/distance.hpp>
#include <gene_clocks/neat/timestamp_source.hpp>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tests/neat/sample_genomes.hpp"

// What holds for every genome after any sequence of operators, by robots that exchange genomes.

namespace gene_clocks::neat {
namespace {

using namespace samples;

/// Some robots with a pool of genomes each. A received genome brings the sender's stamp along.
class Breeders {
public:
    Breeders(std::size_t robots, std::uint32_t seed, bool use_timestamps)
        : random_(seed, 0),
          topology_(make_initial_topology(*rc::gen::inRange<std::size_t>(1, 5),
                                          *rc::gen::inRange<std::size_t>(1, 4))),
          pools_(robots) {
        settings_.sigma = 3.0;
        settings_.crossover = *rc::gen::element(CrossoverKind::uniform, CrossoverKind::one_point);
        const std::uint64_t genesis_marks =
            genesis_mark_count(topology_->inputs, topology_->outputs);
        for (std::uint32_t robot = 1; robot <= robots; ++robot) {
            if (use_timestamps) {
                const LocalTime time{random_.uniform(-50.0, 50.0), random_.uniform(-0.1, 0.1)};
                sources_.push_back(
                    std::make_unique<TimestampSource>(RobotId{robot}, genesis_marks, time));
            } else {
                sources_.push_back(
                    std::make_unique<GeneClockSource>(RobotId{robot}, genesis_marks));
            }
            pools_[robot - 1].push_back(
                make_initial_genome({RobotId{robot}, 0}, topology_, weight_limit, random_));
        }
    }

    /// One random event at one random robot. Returns the genome that it made, if any.
    const Genome* step(double now_cycles) {
        const std::size_t robot = draw(pools_.size());
        auto& pool = pools_[robot];
        switch (random_.below(5)) {
            case 0: {
                const std::size_t sender = draw(pools_.size());
                RC_ASSERT(sources_[robot]->observe(sources_[sender]->stamp()));
                pool.push_back(pools_[sender][draw(pools_[sender].size())]);
                return nullptr;
            }
            case 1: {
                const Genome& first = pool[draw(pool.size())];
                const Genome& second = pool[draw(pool.size())];
                const auto fitness = [&] { return static_cast<float>(random_.below(3)); };
                pool.push_back(
                    crossover({}, {&first, fitness()}, {&second, fitness()}, settings_, random_));
                return &pool.back();
            }
            default: {
                Genome child = pool[draw(pool.size())];
                settings_.p_node = random_.uniform();
                settings_.p_connection = random_.uniform();
                mutate(child, settings_, *sources_[robot], now_cycles, random_);
                pool.push_back(std::move(child));
                return &pool.back();
            }
        }
    }

    const OdneatSettings& settings() const { return settings_; }
    const std::vector<std::vector<Genome>>& pools() const { return pools_; }

private:
    std::size_t draw(std::size_t size) { return random_.below(static_cast<std::uint32_t>(size)); }

    OdneatSettings settings_;
    RandomStream random_;
    std::shared_ptr<const Topology> topology_;
    std::vector<std::unique_ptr<InnovationSource>> sources_;
    std::vector<std::vector<Genome>> pools_;
};

Breeders random_breeders(bool use_timestamps) {
    return Breeders(*rc::gen::inRange<std::size_t>(1, 6), *rc::gen::arbitrary<std::uint32_t>(),
                    use_timestamps);
}

RC_GTEST_PROP(OperatorsProperty, EveryGenomeIsValid, ()) {
    Breeders breeders = random_breeders(*rc::gen::arbitrary<bool>());
    const int steps = *rc::gen::inRange(0, 150);
    for (int cycle = 0; cycle < steps; ++cycle) {
        const Genome* made = breeders.step(cycle);
        RC_ASSERT((made ? fault_of(*made) : "valid") == "valid");
    }
}

/// The marks of a topology's own genes, without the genesis ones, neurons and connections.
std::set<InnovationNumber> new_marks(const Topology& topology) {
    std::set<InnovationNumber> marks;
    for (const NeuronGene& neuron : topology.neurons) {
        if (neuron.mark.robot != genesis_robot) marks.insert(neuron.mark);
    }
    for (const InnovationNumber& mark : topology.connection_marks) {
        if (mark.robot != genesis_robot) marks.insert(mark);
    }
    return marks;
}

RC_GTEST_PROP(OperatorsProperty, ANewGeneIsTheLargestOfItsGenomeUnderGeneClocks, ()) {
    Breeders breeders = random_breeders(false);
    std::set<InnovationNumber> all;
    const int steps = *rc::gen::inRange(0, 150);
    for (int cycle = 0; cycle < steps; ++cycle) {
        const Genome* made = breeders.step(cycle);
        if (!made) continue;
        const auto marks = new_marks(*made->topology);
        // The new ones are those that no genome had before; all others must be smaller. So the
        // order of marks in a genome is the order of creation: a chain.
        bool seen_new = false;
        for (const InnovationNumber& mark : marks) {
            const bool is_new = !all.contains(mark);
            RC_ASSERT((is_new || !seen_new));
            seen_new = seen_new || is_new;
        }
        all.insert(marks.begin(), marks.end());
    }
}

RC_GTEST_PROP(OperatorsProperty, OneMarkIsOneGene, ()) {
    Breeders breeders = random_breeders(*rc::gen::arbitrary<bool>());
    const int steps = *rc::gen::inRange(0, 150);
    for (int cycle = 0; cycle < steps; ++cycle) breeders.step(cycle);
    // Two genomes that share a mark share the gene: created once, then inherited.
    std::map<InnovationNumber, ConnectionEnds> connections;
    std::set<InnovationNumber> neurons;
    for (const auto& pool : breeders.pools()) {
        for (const Genome& genome : pool) {
            for (const NeuronGene& neuron : genome.topology->neurons) neurons.insert(neuron.mark);
            for (std::size_t i = 0; i < genome.connections(); ++i) {
                const auto& ends = genome.topology->connection_ends[i];
                const auto [known, inserted] =
                    connections.emplace(genome.topology->connection_marks[i], ends);
                RC_ASSERT((inserted || known->second == ends));
            }
        }
    }
    for (const auto& [mark, ends] : connections) RC_ASSERT(!neurons.contains(mark));
}

RC_GTEST_PROP(OperatorsProperty, AChildHasTheMarksOfOneParentLessReversals, ()) {
    Breeders breeders = random_breeders(*rc::gen::arbitrary<bool>());
    for (int cycle = 0; cycle < 100; ++cycle) breeders.step(cycle);
    const auto& pool = *rc::gen::elementOf(breeders.pools());
    const Genome& first = *rc::gen::elementOf(pool);
    const Genome& second = *rc::gen::elementOf(pool);
    RandomStream random(*rc::gen::arbitrary<std::uint32_t>(), 1);
    const Genome child =
        crossover({}, {&first, 2.0f}, {&second, 1.0f}, breeders.settings(), random);
    const Topology& parent = *first.topology;
    RC_ASSERT(child.topology->neurons == parent.neurons);
    std::size_t next = 0;
    for (std::size_t i = 0; i < parent.connection_marks.size(); ++i) {
        const ConnectionEnds& ends = parent.connection_ends[i];
        bool is_reversal = false;
        for (std::size_t j = 0; j < i; ++j) {
            const ConnectionEnds& earlier = parent.connection_ends[j];
            is_reversal = is_reversal || (!earlier.recurrent && earlier.source == ends.target &&
                                          earlier.target == ends.source);
        }
        if (is_reversal) continue;
        RC_ASSERT(next < child.connections());
        RC_ASSERT(child.topology->connection_marks[next] == parent.connection_marks[i]);
        RC_ASSERT(child.topology->connection_ends[next] == ends);
        ++next;
    }
    RC_ASSERT(next == child.connections());
}

// OdneatSettings::crossover: of the genes that both parents have, the older come from one of them
// and the younger from the other, weight and flag alike.
RC_GTEST_PROP(OperatorsProperty, OnePointCrossoverCutsTheCommonGenesOnce, ()) {
    Breeders breeders = random_breeders(*rc::gen::arbitrary<bool>());
    for (int cycle = 0; cycle < 100; ++cycle) breeders.step(cycle);
    const auto& pool = *rc::gen::elementOf(breeders.pools());
    const Genome& first = *rc::gen::elementOf(pool);
    const Genome& second = *rc::gen::elementOf(pool);
    RandomStream random(*rc::gen::arbitrary<std::uint32_t>(), 1);
    OdneatSettings settings = breeders.settings();
    settings.crossover = CrossoverKind::one_point;
    const Genome child = crossover({}, {&first, 2.0f}, {&second, 1.0f}, settings, random);

    using Copy = std::pair<float, float>;
    const auto genes_of = [](const Genome& genome) {
        std::map<InnovationNumber, Copy> genes;
        for (std::size_t i = 0; i < genome.connections(); ++i) {
            genes[genome.topology->connection_marks[i]] = {genome.weights[i], genome.enabled[i]};
        }
        return genes;
    };
    const auto of_first = genes_of(first);
    const auto of_second = genes_of(second);
    std::vector<InnovationNumber> common;
    for (const auto& [mark, copy] : of_first) {
        if (of_second.contains(mark)) common.push_back(mark);
    }
    // Some cut, either way round, explains the whole child.
    const auto is_explained = [&](std::size_t cut, bool older_from_second) {
        for (std::size_t i = 0; i < child.connections(); ++i) {
            const InnovationNumber mark = child.topology->connection_marks[i];
            const bool is_common = of_second.contains(mark);
            const bool is_older = cut == common.size() || mark < common[cut];
            const auto& source = is_common && is_older == older_from_second ? of_second : of_first;
            if (source.at(mark) != Copy{child.weights[i], child.enabled[i]}) return false;
        }
        return true;
    };
    bool explained = false;
    for (std::size_t cut = 1; cut < std::max<std::size_t>(common.size(), 2); ++cut) {
        explained = explained || is_explained(cut, false) || is_explained(cut, true);
    }
    RC_ASSERT(explained);
}

// distance.hpp: below the last common gene, parted genomes differ only by what crossover dropped.
RC_GTEST_PROP(OperatorsProperty, BelowTheLastCommonGeneLieDroppedReversalsAloneUnderGeneClocks,
              ()) {
    Breeders breeders = random_breeders(false);
    const int steps = *rc::gen::inRange(0, 200);
    for (int cycle = 0; cycle < steps; ++cycle) breeders.step(cycle);
    OdneatSettings settings;
    settings.mismatch = Mismatch::since_common;
    settings.c_excess = settings.c_weight = 0.0;
    settings.c_disjoint = 1.0;
    const DistanceMeasure below_common(settings);
    const auto has_unmatched_reversal = [](const Topology& genome, const Topology& other) {
        for (std::size_t i = 0; i < genome.connection_ends.size(); ++i) {
            const ConnectionEnds& ends = genome.connection_ends[i];
            if (genome.joined(ends.target, ends.source) && ends.source != ends.target &&
                !std::ranges::binary_search(other.connection_marks, genome.connection_marks[i])) {
                return true;
            }
        }
        return false;
    };
    const auto& pool = *rc::gen::elementOf(breeders.pools());
    const Genome& first = *rc::gen::elementOf(*rc::gen::elementOf(breeders.pools()));
    for (const Genome& second : pool) {
        const bool differs_below = distance(first, second, below_common) > 0.0f;
        RC_ASSERT((!differs_below || has_unmatched_reversal(*first.topology, *second.topology) ||
                   has_unmatched_reversal(*second.topology, *first.topology)));
    }
}

}  // namespace
}  // namespace gene_clocks::neat
