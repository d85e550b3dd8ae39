#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gene_clocks/neat/crossover.hpp>
#include <map>
#include <set>
#include <vector>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

constexpr GenomeId child_id{RobotId{7}, 42};

/// Two parents from one perceptron: `first` has the hidden neuron 20 of its own, `second` a
/// recurrent connection 23 and one more, 24. Weights of `first` are 1, of `second` 2.
class Crossover : public testing::Test {
protected:
    Crossover() {
        first_ = perceptron(3, 2, {RobotId{1}, 1});
        second_ = perceptron(3, 2, {RobotId{2}, 1});
        add_hidden(first_, mark(20));
        add_gene(first_, mark(21), {genesis(1), mark(20), false});
        add_gene(first_, mark(22), {mark(20), genesis(4), false});
        add_gene(second_, mark(23), {genesis(4), genesis(4), true});
        first_.weights.assign(first_.connections(), 1.0f);
        second_.weights.assign(second_.connections(), 2.0f);
    }

    Genome cross(float fitness_first, float fitness_second) {
        Genome child = crossover(child_id, {&first_, fitness_first}, {&second_, fitness_second},
                                 settings_, random_);
        EXPECT_EQ(fault_of(child), "valid");
        EXPECT_EQ(child.id, child_id);
        return child;
    }

    OdneatSettings settings_;
    RandomStream random_{1, 1};
    Genome first_;
    Genome second_;
};

TEST_F(Crossover, TheChildHasTheGenesOfTheFitterParent) {
    EXPECT_TRUE(same_structure(*cross(2.0f, 1.0f).topology, *first_.topology));
    EXPECT_TRUE(same_structure(*cross(1.0f, 2.0f).topology, *second_.topology));
}

TEST_F(Crossover, OfEquallyFitParentsTheSmallerCountsAsFitter) {
    EXPECT_TRUE(same_structure(*cross(1.0f, 1.0f).topology, *second_.topology));
    std::swap(first_, second_);
    EXPECT_TRUE(same_structure(*cross(1.0f, 1.0f).topology, *first_.topology));
}

TEST_F(Crossover, OfEquallyFitParentsOfOneSizeTheSecondCountsAsFitter) {
    add_gene(second_, mark(24), {genesis(5), genesis(5), true}, 2.0f);
    ASSERT_EQ(first_.connections(), second_.connections());
    EXPECT_TRUE(same_structure(*cross(1.0f, 1.0f).topology, *second_.topology));
    std::swap(first_, second_);
    EXPECT_TRUE(same_structure(*cross(1.0f, 1.0f).topology, *second_.topology));
}

TEST_F(Crossover, TheChildSharesTheTopologyWhereNothingIsDropped) {
    EXPECT_EQ(cross(2.0f, 1.0f).topology, first_.topology);
}

TEST_F(Crossover, MatchingWeightsComeFromEitherParentHalfOfTheTime) {
    int from_second = 0;
    constexpr int children = 20'000;
    for (int i = 0; i < children; ++i) {
        const Genome child = cross(2.0f, 1.0f);
        for (std::size_t gene = 0; gene < 6; ++gene) {
            ASSERT_TRUE(child.weights[gene] == 1.0f || child.weights[gene] == 2.0f);
            from_second += child.weights[gene] == 2.0f ? 1 : 0;
        }
    }
    EXPECT_NEAR(from_second / (6.0 * children), 0.5, 5 * std::sqrt(0.25 / (6.0 * children)));
}

TEST_F(Crossover, GenesMatchByTheirMarksNotByTheirPlaces) {
    add_gene(first_, mark(30), {genesis(5), genesis(5), true}, 3.0f);
    add_gene(second_, mark(30), {genesis(5), genesis(5), true}, 4.0f, false);
    add_gene(second_, mark(40), {genesis(4), genesis(5), true}, 5.0f);
    const std::size_t place = index_of(first_, mark(30));
    ASSERT_EQ(second_.topology->connection_marks.at(place), mark(40));
    settings_.disable_probability = 1.0;
    int from_second = 0;
    for (int i = 0; i < 100; ++i) {
        const Genome child = cross(2.0f, 1.0f);
        ASSERT_TRUE(child.weights[place] == 3.0f || child.weights[place] == 4.0f);
        ASSERT_FALSE(child.is_enabled(place));
        from_second += child.weights[place] == 4.0f ? 1 : 0;
    }
    EXPECT_GT(from_second, 0);
}

TEST_F(Crossover, UnmatchedGenesComeFromTheFitterAsTheyAre) {
    first_.enabled[index_of(first_, mark(21))] = 0.0f;
    for (int i = 0; i < 100; ++i) {
        const Genome child = cross(2.0f, 1.0f);
        EXPECT_EQ(child.weights[index_of(child, mark(21))], 1.0f);
        EXPECT_EQ(child.weights[index_of(child, mark(22))], 1.0f);
        EXPECT_FALSE(child.is_enabled(index_of(child, mark(21))));
        EXPECT_TRUE(child.is_enabled(index_of(child, mark(22))));
    }
}

TEST_F(Crossover, AMatchingGeneDisabledInOneParentIsMostlyDisabled) {
    first_.enabled[0] = 0.0f;
    second_.enabled[1] = 0.0f;
    int disabled_0 = 0;
    int disabled_1 = 0;
    constexpr int children = 40'000;
    for (int i = 0; i < children; ++i) {
        const Genome child = cross(2.0f, 1.0f);
        disabled_0 += child.is_enabled(0) ? 0 : 1;
        disabled_1 += child.is_enabled(1) ? 0 : 1;
    }
    const double tolerance = 5 * std::sqrt(0.875 * 0.125 / children);
    EXPECT_NEAR(disabled_0 / double{children}, 0.875, tolerance);
    EXPECT_NEAR(disabled_1 / double{children}, 0.875, tolerance);
}

TEST_F(Crossover, AMatchingGeneIsDisabledWhereItIsInBothParentsAndEnabledWhereItIsInBoth) {
    first_.enabled[0] = second_.enabled[0] = 0.0f;
    for (int i = 0; i < 1000; ++i) {
        const Genome child = cross(2.0f, 1.0f);
        ASSERT_FALSE(child.is_enabled(0));
        ASSERT_TRUE(child.is_enabled(1));
    }
}

TEST_F(Crossover, TheProbabilityOfDisablingIsASetting) {
    first_.enabled[0] = 0.0f;
    settings_.disable_probability = 0.0;
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(cross(2.0f, 1.0f).is_enabled(0));
    settings_.disable_probability = 1.0;
    for (int i = 0; i < 100; ++i) ASSERT_FALSE(cross(2.0f, 1.0f).is_enabled(0));
}

TEST_F(Crossover, AtOnePointCutsEverywhereEquallyOftenAndEitherWayRound) {
    settings_.crossover = CrossoverKind::one_point;
    std::map<std::vector<float>, int> counts;
    constexpr int children = 20'000;
    for (int i = 0; i < children; ++i) {
        const Genome child = cross(2.0f, 1.0f);
        ++counts[{child.weights.begin(), child.weights.begin() + 6}];
        EXPECT_EQ(child.weights[6], 1.0f);  // unmatched
        EXPECT_EQ(child.weights[7], 1.0f);
    }
    // Five places between six matching genes, two ways round each.
    ASSERT_EQ(counts.size(), 10u);
    for (std::size_t cut = 1; cut <= 5; ++cut) {
        for (const float older : {1.0f, 2.0f}) {
            std::vector<float> weights(6, 3.0f - older);
            std::fill_n(weights.begin(), cut, older);
            EXPECT_NEAR(counts[weights] / double{children}, 0.1,
                        5 * std::sqrt(0.1 * 0.9 / children));
        }
    }
}

TEST_F(Crossover, AtOnePointAGeneBringsItsFlagAlong) {
    settings_.crossover = CrossoverKind::one_point;
    settings_.disable_probability = 0.5;
    first_.enabled = {0.0f, 1.0f, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f, 1.0f};
    second_.enabled = {1.0f, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f, 1.0f};
    for (int i = 0; i < 100; ++i) {
        const Genome child = cross(2.0f, 1.0f);
        for (std::size_t gene = 0; gene < 8; ++gene) {
            const Genome& parent = child.weights[gene] == 1.0f ? first_ : second_;
            ASSERT_EQ(child.enabled[gene], parent.enabled[gene]) << gene;
        }
    }
}

TEST_F(Crossover, AtOnePointGenesMatchByTheirMarks) {
    settings_.crossover = CrossoverKind::one_point;
    add_gene(first_, mark(30), {genesis(5), genesis(5), true}, 3.0f);
    add_gene(second_, mark(30), {genesis(5), genesis(5), true}, 4.0f, false);
    add_gene(second_, mark(40), {genesis(4), genesis(5), true}, 5.0f);
    const std::size_t place = index_of(first_, mark(30));
    std::set<float> seen;
    for (int i = 0; i < 100; ++i) {
        const Genome child = cross(2.0f, 1.0f);
        seen.insert(child.weights[place]);
        // The youngest common gene and the oldest never come from one parent.
        ASSERT_EQ(child.weights[place] == 3.0f, child.weights[0] == 2.0f);
        ASSERT_EQ(child.is_enabled(place), child.weights[place] == 3.0f);
    }
    EXPECT_EQ(seen, (std::set<float>{3.0f, 4.0f}));
}

TEST_F(Crossover, AtOnePointWorksWithOneCommonGene) {
    settings_.crossover = CrossoverKind::one_point;
    first_ = perceptron(1, 1);
    second_ = perceptron(1, 1);
    first_.weights = {1.0f};
    second_.weights = {2.0f};
    std::set<float> seen;
    for (int i = 0; i < 100; ++i) seen.insert(cross(2.0f, 1.0f).weights[0]);
    EXPECT_EQ(seen, (std::set<float>{1.0f, 2.0f}));
}

TEST_F(Crossover, DropsAConnectionThatReversesAnEarlierFeedForwardOne) {
    add_gene(first_, mark(30), {genesis(4), mark(20), true}, 1.0f);  // reverses 22
    add_gene(first_, mark(31), {genesis(5), mark(20), true}, 1.0f);  // reverses nothing
    const Genome child = cross(2.0f, 1.0f);
    Genome expected = first_;
    std::vector<InnovationNumber> marks = first_.topology->connection_marks;
    std::erase(marks, mark(30));
    EXPECT_EQ(child.topology->connection_marks, marks);
    EXPECT_EQ(child.topology->neurons, first_.topology->neurons);
    EXPECT_FALSE(child.topology->joined(genesis(4), mark(20)));
    EXPECT_TRUE(child.topology->joined(genesis(5), mark(20)));
    EXPECT_TRUE(child.topology->joined(mark(20), genesis(4)));
    EXPECT_EQ(child.weights[index_of(child, mark(31))], 1.0f);
    EXPECT_EQ(child.connections() + 1, first_.connections());
}

TEST_F(Crossover, DropsAFeedForwardConnectionThatReversesADisabledOne) {
    add_hidden(first_, mark(30));
    add_gene(first_, mark(31), {mark(20), mark(30), false}, 1.0f, false);
    add_gene(first_, mark(32), {mark(30), mark(20), false}, 1.0f);
    const Genome child = cross(2.0f, 1.0f);
    EXPECT_TRUE(child.topology->joined(mark(20), mark(30)));
    EXPECT_FALSE(child.topology->joined(mark(30), mark(20)));
}

TEST_F(Crossover, KeepsAFeedForwardConnectionThatReversesAnEarlierRecurrentOne) {
    add_hidden(first_, mark(30));
    add_gene(first_, mark(31), {genesis(4), mark(30), true}, 1.0f);
    add_gene(first_, mark(32), {mark(30), genesis(4), false}, 1.0f);
    EXPECT_TRUE(same_structure(*cross(2.0f, 1.0f).topology, *first_.topology));
}

TEST_F(Crossover, KeepsSelfLoops) {
    EXPECT_TRUE(same_structure(*cross(1.0f, 2.0f).topology, *second_.topology));
    EXPECT_TRUE(second_.topology->joined(genesis(4), genesis(4)));
}

TEST_F(Crossover, LeavesTheParentsAsTheyWere) {
    add_gene(first_, mark(30), {genesis(4), mark(20), true}, 1.0f);
    const Genome first = first_;
    const Genome second = second_;
    const Topology topology = *first_.topology;
    cross(2.0f, 1.0f);
    EXPECT_TRUE(same_genes(first, first_));
    EXPECT_TRUE(same_genes(second, second_));
    EXPECT_TRUE(same_structure(*first_.topology, topology));
}

}  // namespace
}  // namespace gene_clocks::neat
