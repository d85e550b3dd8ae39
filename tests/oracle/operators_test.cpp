// Crossover, distance and whole swarms of shipped sources, clocks and gates give what the proved
// ones give.
#include "tests/oracle/operators.hpp"

#include <gtest/gtest.h>

#include "tests/oracle/swarm_comparison.hpp"

namespace gene_clocks::test {
namespace {

class Operators : public testing::Test {
protected:
    static void SetUpTestSuite() { gene_clocks_oracle_start(); }
};

TEST_F(Operators, CrossoverAndDistanceAreTheProvedOnes) {
    OperatorComparison comparison(1);
    neat::RandomStream random(2, 0);
    for (int fleet = 0; fleet < 150; ++fleet) {
        const std::size_t inputs = 1 + random.below(4);
        comparison.grow(inputs, 1 + random.below(3), static_cast<int>(random.below(120)));
        ASSERT_NO_THROW(comparison.compare_all());
    }
    const auto& reached = comparison.reached();
    EXPECT_GT(reached.matching, 1000u);
    EXPECT_GT(reached.disjoint, 1000u);
    EXPECT_GT(reached.excess, 1000u);
    EXPECT_GT(reached.reversals, 100u);
}

TEST_F(Operators, SwarmsOfDurableSourcesAreTheProvedOnes) {
    SwarmComparison<StreamDraws> comparison{StreamDraws(3)};
    for (int swarm = 0; swarm < 400; ++swarm) {
        ASSERT_NO_THROW(comparison.run(100));
    }
    const auto& reached = comparison.reached();
    EXPECT_GT(reached.grown, 1000u);
    EXPECT_GT(reached.mated, 500u);
    EXPECT_GT(reached.sent, 1000u);
    EXPECT_GT(reached.held_back, 50u) << "storage that fails";
    EXPECT_GT(reached.admitted, 500u);
    EXPECT_GT(reached.refused, 100u);
    EXPECT_GT(reached.exhausted, 50u);
    EXPECT_GT(reached.stored_beyond, 500u) << "genomes that are numbered by the same counter";
    EXPECT_GT(reached.lost, 100u) << "genomes in a crash";
}

}  // namespace
}  // namespace gene_clocks::test
