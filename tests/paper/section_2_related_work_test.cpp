#include <gtest/gtest.h>

#include <algorithm>
#include <gene_clocks/neat/timestamp_source.hpp>

#include "tests/paper/paper_agents.hpp"

// Section 2: what NEAT and odNEAT do.

namespace gene_clocks::neat::paper {
namespace {

// "These innovation numbers are inherited by offspring networks."
TEST(Section2, OffspringInheritInnovationNumbers) {
    OdneatSettings settings = calm_settings();
    settings.p_mutate = 1.0;
    settings.p_node = 1.0;
    Agent robot = make_robot(1, settings);
    for (int generation = 0; generation < 10; ++generation) {
        const auto parents = robot.population().members();
        robot.replace(0.0);
        const auto& marks = robot.active().topology->connection_marks;
        const bool inherits = std::any_of(parents.begin(), parents.end(), [&](const auto& parent) {
            const auto& inherited = parent.genome->topology->connection_marks;
            return std::includes(marks.begin(), marks.end(), inherited.begin(), inherited.end());
        });
        EXPECT_TRUE(inherits);
    }
}

// "genes having the same innovation number in two parent genomes are not repeated when applying
// cross-over"
TEST(Section2, CrossoverDoesNotRepeatMatchingGenes) {
    const OdneatSettings settings = calm_settings();
    RandomStream random(1, 1);
    GeneClockSource clock(RobotId{1}, genesis_mark_count(inputs, outputs));
    Genome first = *genome_of(0, 1.0f);
    for (int i = 0; i < 5; ++i) add_neuron(first, settings, clock, 0.0, random);
    Genome second = first;
    for (int i = 0; i < 5; ++i) add_neuron(second, settings, clock, 0.0, random);
    const Genome child = crossover({}, {&first, 1.0f}, {&second, 2.0f}, settings, random);
    const auto& marks = child.topology->connection_marks;
    EXPECT_EQ(std::adjacent_find(marks.begin(), marks.end()), marks.end());
    EXPECT_EQ(child.connections(), second.connections());
    EXPECT_TRUE(is_valid(child, settings.weight_limit));
}

// "intra-species fitness sharing, i.e. networks in the same niche share the same fitness"
TEST(Section2, NetworksInTheSameNicheShareTheirFitness) {
    const OdneatSettings settings = calm_settings();
    Population population(settings);
    population.add(genome_of(0, 0.0f), 30.0f);
    population.add(genome_of(1, 0.0f), 90.0f);
    EXPECT_EQ(population.species_count(), 1u);
    EXPECT_EQ(population.species_share(0), population.species_share(1));
}

// "Innovation markers are assigned using local, high-resolution timestamps."
TEST(Section2, TimestampsMarkGenesByTheLocalClock) {
    TimestampSource source(RobotId{1}, genesis_mark_count(inputs, outputs), {});
    const Genome genome = *genome_of(0, 0.0f);
    const auto early = source.mark_connection(genome, {}, 10.0);
    const auto soon = source.mark_connection(genome, {}, 10.00001);
    const auto late = source.mark_connection(genome, {}, 11.0);
    EXPECT_LT(early, soon);
    EXPECT_LT(soon, late);
}

// "Since odNEAT runs on all robots that are simultaneously evolving, their respective local clocks
// have a strong probability of drifting […] innovation timestamps would not be coherent, and thus
// would not correctly keep track of the actual chronology of innovations."
TEST(Section2, DriftingTimestampsLoseTheChronologyAndGeneClocksDoNot) {
    const std::uint64_t genesis_marks = genesis_mark_count(inputs, outputs);
    const Genome genome = *genome_of(0, 0.0f);
    const auto in_creation_order = [&](InnovationSource& first, InnovationSource& second) {
        const auto earlier = first.mark_connection(genome, {}, 10'000.0);
        EXPECT_TRUE(second.observe(first.stamp()));  // the second robot receives the genome
        const auto later = second.mark_connection(genome, {}, 10'001.0);
        return *earlier < *later;
    };
    TimestampSource fast(RobotId{1}, genesis_marks, {.drift_rate = 1e-3});
    TimestampSource slow(RobotId{2}, genesis_marks, {.drift_rate = -1e-3});
    EXPECT_FALSE(in_creation_order(fast, slow));
    GeneClockSource clock_1(RobotId{1}, genesis_marks);
    GeneClockSource clock_2(RobotId{2}, genesis_marks);
    EXPECT_TRUE(in_creation_order(clock_1, clock_2));
    EXPECT_TRUE(in_creation_order(clock_2, clock_1));
}

}  // namespace
}  // namespace gene_clocks::neat::paper
