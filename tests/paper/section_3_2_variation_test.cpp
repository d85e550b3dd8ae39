#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gene_clocks/neat/distance.hpp>

#include "tests/paper/paper_agents.hpp"

// Section 3.2: mutation, and the genotypic distance of Equation 1.

namespace gene_clocks::neat::paper {
namespace {

class Section32Variation : public testing::Test {
protected:
    Mutation mutate_once(Genome& genome) {
        const Mutation done = mutate(genome, settings_, clock_, 0.0, random_);
        EXPECT_TRUE(is_valid(genome, settings_.weight_limit));
        return done;
    }
    OdneatSettings settings_ = calm_settings();
    GeneClockSource clock_{RobotId{1}, genesis_mark_count(inputs, outputs)};
    RandomStream random_{1, 1};
};

// "adding a neuron with a probability p_node by splitting a random existing connection"
TEST_F(Section32Variation, AddsANeuronBySplittingAConnection) {
    settings_.p_node = 0.35;
    constexpr int draws = 10'000;
    int added = 0;
    for (int i = 0; i < draws; ++i) {
        Genome genome = *genome_of(0, 3.0f);
        if (mutate_once(genome) != Mutation::add_neuron) continue;
        ++added;
        const Topology& topology = *genome.topology;
        const InnovationNumber neuron = topology.neurons.back().mark;
        const std::size_t in = genome.connections() - 2;
        const std::size_t out = genome.connections() - 1;
        ASSERT_EQ(topology.connection_ends[in].target, neuron);
        ASSERT_EQ(topology.connection_ends[out].source, neuron);
        // It took the place of one connection between the same ends.
        const auto split = static_cast<std::size_t>(
            std::find(genome.enabled.begin(), genome.enabled.end(), 0.0f) - genome.enabled.begin());
        ASSERT_LT(split, topology.initial_connections);
        ASSERT_EQ(topology.connection_ends[split].source, topology.connection_ends[in].source);
        ASSERT_EQ(topology.connection_ends[split].target, topology.connection_ends[out].target);
    }
    EXPECT_NEAR(added / double{draws}, 0.35, tolerance(0.35, draws));
}

// "adding a connection with probability p_conn between two random unconnected existing neurons"
TEST_F(Section32Variation, AddsAConnectionBetweenUnconnectedNeurons) {
    settings_.p_connection = 0.35;
    settings_.p_recurrent = 1.0;
    constexpr int draws = 10'000;
    int added = 0;
    for (int i = 0; i < draws; ++i) {
        Genome genome = *genome_of(0, 3.0f);
        if (mutate_once(genome) != Mutation::add_connection) continue;
        ++added;
        const ConnectionEnds ends = genome.topology->connection_ends.back();
        ASSERT_FALSE(topology()->joined(ends.source, ends.target));
        ASSERT_TRUE(topology()->find_neuron(ends.source).has_value());
        ASSERT_TRUE(topology()->find_neuron(ends.target).has_value());
    }
    EXPECT_NEAR(added / double{draws}, 0.35, tolerance(0.35, draws));
}

// "When adding a connection, there is a probability p_recur for this connection to be recurrent."
TEST_F(Section32Variation, ANewConnectionIsRecurrentWithItsProbability) {
    settings_.p_recurrent = 0.6;
    Genome base = *genome_of(0, 1.0f);
    for (int i = 0; i < 8; ++i) {
        ASSERT_TRUE(add_neuron(base, settings_, clock_, 0.0, random_));
    }
    settings_.p_connection = 1.0;
    constexpr int draws = 5000;
    int recurrent = 0;
    for (int i = 0; i < draws; ++i) {
        Genome genome = base;
        ASSERT_EQ(mutate_once(genome), Mutation::add_connection);
        recurrent += genome.topology->connection_ends.back().recurrent ? 1 : 0;
    }
    EXPECT_NEAR(recurrent / double{draws}, 0.6, tolerance(0.6, draws));
}

// "a probability p_w of mutating all weights by adding a normal random variable with mean 0 and a
// standard deviation σ"
TEST_F(Section32Variation, MutatesAllWeightsByANormalVariable) {
    settings_.p_weight = 0.4;
    settings_.sigma = 0.442;
    constexpr int draws = 10'000;
    int mutated = 0;
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < draws; ++i) {
        Genome genome = *genome_of(0, 1.0f);
        if (mutate_once(genome) != Mutation::weights) continue;
        ++mutated;
        for (const float weight : genome.weights) {
            ASSERT_NE(weight, 1.0f);
            sum += weight - 1.0;
            squares += (weight - 1.0) * (weight - 1.0);
        }
    }
    EXPECT_NEAR(mutated / double{draws}, 0.4, tolerance(0.4, draws));
    const double changes = mutated * static_cast<double>(inputs * outputs);
    EXPECT_NEAR(sum / changes, 0.0, 5 * 0.442 / std::sqrt(changes));
    EXPECT_NEAR(std::sqrt(squares / changes), 0.442, 5 * 0.442 / std::sqrt(2 * changes));
}

// "Synaptic weights are maintained in [−10, +10]."
TEST_F(Section32Variation, WeightsStayWithinTen) {
    settings_.p_weight = 1.0;
    settings_.sigma = 8.0;
    Genome genome = *genome_of(0, 0.0f);
    float largest = 0.0f;
    for (int i = 0; i < 1000; ++i) {
        mutate_once(genome);
        for (const float weight : genome.weights) largest = std::max(largest, std::abs(weight));
    }
    EXPECT_EQ(largest, 10.0f);
}

/// Equation 1 with the paper's coefficients: c1 = 0.5, c2 = 1.5, c3 = 0.4 (Table 1).
class Equation1 : public Section32Variation {
protected:
    /// Adds a recurrent connection between outputs, of the given mark.
    static void add(Genome& genome, InnovationNumber mark, std::size_t from, std::size_t to) {
        auto grown = std::make_shared<Topology>(*genome.topology);
        const auto index = static_cast<std::ptrdiff_t>(
            grown->insert(mark, ConnectionEnds{grown->neurons[inputs + from].mark,
                                               grown->neurons[inputs + to].mark, true}));
        genome.weights.insert(genome.weights.begin() + index, 0.0f);
        genome.enabled.insert(genome.enabled.begin() + index, 1.0f);
        genome.topology = std::move(grown);
    }
    static constexpr InnovationNumber mark(std::uint64_t counter) { return {counter, RobotId{1}}; }

    DistanceMeasure measure_{settings_};
    Genome first_ = *genome_of(0, 0.0f);
    Genome second_ = *genome_of(1, 0.0f);
};

// "W̄ is the average of the weight difference between matching genes"
TEST_F(Equation1, WIsTheAverageWeightDifferenceOfMatchingGenes) {
    first_.weights = {1.0f, -1.0f, 2.0f, 0.0f, 0.0f, 0.0f};
    // The six differences are 1, 1, 2, 0, 0, 0.
    EXPECT_FLOAT_EQ(distance(first_, second_, measure_), 0.4f * 4.0f / 6.0f);
}

// "D is the number of disjoint genes, that is non-matching genes in the middle of the genome"
TEST_F(Equation1, DCountsNonMatchingGenesInTheMiddle) {
    add(first_, mark(20), 0, 0);
    add(second_, mark(21), 0, 1);
    add(first_, mark(22), 1, 1);
    add(second_, mark(22), 1, 1);
    EXPECT_FLOAT_EQ(distance(first_, second_, measure_), 1.5f * 2.0f / 8.0f);
}

// "E is the number of excess genes, non-matching genes in the end of the largest genome. N is the
// number of genes of the largest of both genomes"
TEST_F(Equation1, ECountsNonMatchingGenesInTheEnd) {
    add(first_, mark(20), 0, 0);
    add(second_, mark(20), 0, 0);
    add(second_, mark(21), 0, 1);
    add(second_, mark(22), 1, 1);
    EXPECT_FLOAT_EQ(distance(first_, second_, measure_), 0.5f * 2.0f / 9.0f);
}

// "The way to distinguish between matching, disjoint and excess genes consists in aligning two
// genomes using the innovation numbers"
TEST_F(Equation1, AlignmentGoesByInnovationNumbersNotByStructure) {
    // The same connection, invented twice: the marks differ, so that it does not match.
    add(first_, InnovationNumber{20, RobotId{1}}, 0, 0);
    add(second_, InnovationNumber{20, RobotId{2}}, 0, 0);
    EXPECT_FLOAT_EQ(distance(first_, second_, measure_), 1.5f / 7.0f + 0.5f / 7.0f);
}

TEST_F(Equation1, IsTheSumOfItsThreeTerms) {
    first_.weights = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
    add(first_, mark(20), 0, 0);
    add(second_, mark(21), 0, 1);
    add(second_, mark(22), 1, 1);
    const float expected = 0.5f * 2.0f / 8.0f + 1.5f * 1.0f / 8.0f + 0.4f * 1.0f;
    EXPECT_FLOAT_EQ(distance(first_, second_, measure_), expected);
    EXPECT_FLOAT_EQ(distance(second_, first_, measure_), expected);
}

}  // namespace
}  // namespace gene_clocks::neat::paper
