#include <gtest/gtest.h>

#include <gene_clocks/neat/gene_clock_source.hpp>
#include <limits>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();

class GeneClockSourceTest : public testing::Test {
protected:
    InnovationNumber mark_connection(GeneClockSource& source) {
        return source.mark_connection(genome_, {}, 0.0).value();
    }
    Genome genome_ = perceptron(2, 1);
};

TEST_F(GeneClockSourceTest, StartsAboveTheGenesisMarks) {
    GeneClockSource source(RobotId{5}, genesis_mark_count(2, 1));
    EXPECT_EQ(source.stamp(), Stamp{6});
    EXPECT_EQ(mark_connection(source), mark(6, 5));
    for (const auto& genesis_mark : genome_.topology->connection_marks) {
        EXPECT_LT(genesis_mark, mark(6, 5));
    }
}

TEST_F(GeneClockSourceTest, MarksTheNeuronThenItsConnections) {
    GeneClockSource source(RobotId{5}, 5);
    const auto marks = source.mark_split(genome_, 0, 0.0).value();
    EXPECT_EQ(marks.neuron, mark(6, 5));
    EXPECT_EQ(marks.incoming, mark(7, 5));
    EXPECT_EQ(marks.outgoing, mark(8, 5));
    EXPECT_EQ(mark_connection(source), mark(9, 5));
    EXPECT_EQ(source.stamp(), Stamp{10});
}

TEST_F(GeneClockSourceTest, TakesTheMaximumWithAReceivedStamp) {
    GeneClockSource source(RobotId{5}, 5);
    EXPECT_TRUE(source.observe(Stamp{100}));
    EXPECT_EQ(source.stamp(), Stamp{100});
    EXPECT_TRUE(source.observe(Stamp{50}));
    EXPECT_EQ(mark_connection(source), mark(100, 5));
}

TEST_F(GeneClockSourceTest, RefusesWhatItsLimitsRefuse) {
    GeneClockSource source(RobotId{5}, 5, {.maximum = 100, .window = 10});
    EXPECT_FALSE(source.observe(Stamp{17}));
    EXPECT_EQ(source.stamp(), Stamp{6});
    EXPECT_TRUE(source.observe(Stamp{16}));
}

TEST_F(GeneClockSourceTest, DoesNotLookAtTheTime) {
    GeneClockSource source(RobotId{5}, 5);
    EXPECT_EQ(source.mark_connection(genome_, {}, 1e9), mark(6, 5));
    EXPECT_EQ(source.mark_connection(genome_, {}, -1e9), mark(7, 5));
}

TEST_F(GeneClockSourceTest, MarksASplitWholeOrNotAtAllNearExhaustion) {
    GeneClockSource source(RobotId{5}, largest - 3);
    EXPECT_FALSE(source.mark_split(genome_, 0, 0.0).has_value());
    EXPECT_EQ(mark_connection(source), mark(largest - 2, 5));
    EXPECT_EQ(mark_connection(source), mark(largest - 1, 5));
    EXPECT_EQ(source.mark_connection(genome_, {}, 0.0), std::nullopt);
    EXPECT_EQ(source.stamp(), Stamp{largest});
}

TEST_F(GeneClockSourceTest, AnExhaustedClockMeansNoStructuralMutation) {
    GeneClockSource source(RobotId{5}, largest - 1);
    OdneatSettings settings;
    settings.p_node = 0.5;
    settings.p_connection = 1.0;
    settings.p_recurrent = 1.0;
    RandomStream random(1, 1);
    const Genome before = genome_;
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(mutate(genome_, settings, source, 0.0, random), Mutation::none);
    }
    EXPECT_TRUE(same_genes(genome_, before));
}

}  // namespace
}  // namespace gene_clocks::neat
