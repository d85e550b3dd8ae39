#include <gtest/gtest.h>

#include <algorithm>
#include <gene_clocks/gene_clock.hpp>
#include <type_traits>
#include <vector>

#include "tests/paper/paper_agents.hpp"

// Section 3, odNEAT with logical markers, and 3.1, Decentralized Marking of Innovations.

namespace gene_clocks::neat::paper {
namespace {

// "every processor has a unique identifier and a monotonically increasing local counter"
TEST(Section3, TheCounterIncreasesMonotonically) {
    GeneClock clock(RobotId{1});
    Stamp last = clock.stamp();
    for (const std::uint64_t received : {1u, 50u, 3u, 50u, 7u, 200u}) {
        ASSERT_TRUE(clock.observe(Stamp{received}));
        EXPECT_GE(clock.stamp(), last);
        last = clock.stamp();
        ASSERT_TRUE(clock.mint().has_value());
        EXPECT_GT(clock.stamp(), last);
        last = clock.stamp();
    }
}

// "the event is marked with the current local counter and the counter is incremented by one"
TEST(Section3, AnEventTakesTheCurrentCounterWhichIsThenIncrementedByOne) {
    GeneClock clock(RobotId{1});
    for (int event = 0; event < 10; ++event) {
        const std::uint64_t current = clock.stamp().value;
        EXPECT_EQ(clock.mint()->counter, current);
        EXPECT_EQ(clock.stamp().value, current + 1);
    }
}

// "Whenever a processor receives a message, it updates its local counter with the maximum value
// between the received counter and its own."
TEST(Section3, ReceptionTakesTheMaximumOfTheTwoCounters) {
    GeneClock clock(RobotId{1});
    ASSERT_TRUE(clock.observe(Stamp{100}));
    EXPECT_EQ(clock.stamp(), Stamp{100});
    ASSERT_TRUE(clock.observe(Stamp{99}));
    EXPECT_EQ(clock.stamp(), Stamp{100});
    ASSERT_TRUE(clock.observe(Stamp{100}));
    EXPECT_EQ(clock.stamp(), Stamp{100});
}

// "However, two events may have identical counters if they originated in two different processors
// and no communication took place between the two processors during the period in between events."
TEST(Section3, ConcurrentEventsMayHaveIdenticalCounters) {
    GeneClock first(RobotId{1});
    GeneClock second(RobotId{2});
    EXPECT_EQ(first.mint()->counter, second.mint()->counter);
}

// "authors order the concurrent events by convention w.r.t. the processor identifier to define a
// total order between events in the system"
TEST(Section3, IdentifiersOrderConcurrentEvents) {
    const InnovationNumber of_robot_1{5, RobotId{1}};
    const InnovationNumber of_robot_2{5, RobotId{2}};
    EXPECT_LT(of_robot_1, of_robot_2);
    EXPECT_LT(of_robot_2, (InnovationNumber{6, RobotId{1}}));  // the counter comes first
}

// "We consider innovation numbers as pairs ⟨r, c_r⟩."
TEST(Section31, AnInnovationNumberIsThePairOfRobotAndCounter) {
    GeneClock clock(RobotId{7});
    ASSERT_TRUE(clock.observe(Stamp{41}));
    const auto [counter, robot] = *clock.mint();
    EXPECT_EQ(robot, RobotId{7});
    EXPECT_EQ(counter, 41u);
}

// "Each robot increments its counter c_r by one each time a mutation adds a new gene"
TEST(Section31, EachNewGeneIncrementsTheCounterByOne) {
    const OdneatSettings settings = calm_settings();
    RandomStream random(1, 1);
    GeneClockSource clock(RobotId{1}, genesis_mark_count(inputs, outputs));
    Genome genome = *genome_of(0, 1.0f);
    const std::uint64_t start = clock.stamp().value;
    ASSERT_TRUE(add_neuron(genome, settings, clock, 0.0, random));  // a neuron, two connections
    EXPECT_EQ(clock.stamp().value, start + 3);
    ASSERT_TRUE(add_connection(genome, settings, clock, 0.0, random));
    EXPECT_EQ(clock.stamp().value, start + 4);
    EXPECT_EQ(genome.topology->size() - genome.topology->initial_size(), 4u);
    mutate_weights(genome, settings, random);
    EXPECT_EQ(clock.stamp().value, start + 4);
}

// "When a robot broadcasts its active genome, all its topological innovations are marked with such
// innovation numbers."
TEST(Section31, ABroadcastGenomeIsMarkedThroughout) {
    OdneatSettings settings = calm_settings();
    settings.p_mutate = 1.0;
    settings.p_node = 1.0;
    Agent robot = make_robot(7, settings);
    for (int birth = 0; birth < 5; ++birth) robot.replace(0.0);
    const Topology& sent = *robot.message().genome->topology;
    EXPECT_GT(sent.size(), sent.initial_size());
    std::vector<InnovationNumber> marks = sent.connection_marks;
    for (const NeuronGene& neuron : sent.neurons) marks.push_back(neuron.mark);
    EXPECT_EQ(marks.size(), sent.size());
    std::sort(marks.begin(), marks.end());
    EXPECT_EQ(std::adjacent_find(marks.begin(), marks.end()), marks.end());
    for (const InnovationNumber& mark : marks) {
        EXPECT_TRUE(mark.robot == RobotId{7} || mark.robot == genesis_robot);
        EXPECT_LT(mark.counter, robot.message().stamp.value);
    }
}

// "genes in the genome can be ordered, based on their gene counters, since they keep a
// chronological sequence of the innovations on each individual robot"
TEST(Section31, TheCountersOfARobotAreTheChronologyOfItsGenes) {
    const OdneatSettings settings = calm_settings();
    RandomStream random(1, 1);
    GeneClockSource clock(RobotId{1}, genesis_mark_count(inputs, outputs));
    Genome genome = *genome_of(0, 1.0f);
    for (int i = 0; i < 20; ++i) {
        const auto before = genome.topology->connection_marks;
        ASSERT_TRUE(add_neuron(genome, settings, clock, 0.0, random));
        const auto& marks = genome.topology->connection_marks;
        // The new genes follow all older ones.
        EXPECT_TRUE(std::equal(before.begin(), before.end(), marks.begin()));
    }
}

// "in addition to sending its active genome, a robot broadcasts its current c_r, and upon
// reception, robots update their respective c_r's with the maximum of the received value and their
// own"
TEST(Section31, RobotsBroadcastTheirCounterAndTakeTheMaximum) {
    OdneatSettings settings = calm_settings();
    settings.p_mutate = 1.0;
    settings.p_node = 1.0;
    Agent ahead = make_robot(1, settings);
    Agent behind = make_robot(2, settings);
    for (int birth = 0; birth < 5; ++birth) ahead.replace(0.0);
    ASSERT_GT(ahead.message().stamp, behind.message().stamp);
    const Stamp stamp = ahead.message().stamp;
    behind.receive(RobotId{1}, ahead.message());
    EXPECT_EQ(behind.message().stamp, stamp);
    ahead.receive(RobotId{2}, behind.message());
    EXPECT_EQ(ahead.message().stamp, stamp);
    // A gene that the receiver makes now sorts after all that the sender had made.
    behind.replace(0.0);
    EXPECT_GE(behind.active().topology->connection_marks.back().counter, stamp.value);
}

// "innovation numbers will be ordered by convention with respect to the robot's identifier so all
// robots sort genes in the exact same manner"
TEST(Section31, AllRobotsSortGenesInTheExactSameManner) {
    std::vector<InnovationNumber> genes;
    for (std::uint32_t robot = 1; robot <= 4; ++robot) {
        GeneClock clock(RobotId{robot});
        for (int gene = 0; gene < 4; ++gene) genes.push_back(*clock.mint());
    }
    auto sorted = genes;
    std::sort(sorted.begin(), sorted.end());
    RandomStream random(1, 1);
    for (int robot = 0; robot < 50; ++robot) {
        // Each robot came to know them in an order of its own.
        for (std::uint32_t i = static_cast<std::uint32_t>(genes.size()); i > 1; --i) {
            std::swap(genes[i - 1], genes[random.below(i)]);
        }
        auto sorted_here = genes;
        std::sort(sorted_here.begin(), sorted_here.end());
        EXPECT_EQ(sorted_here, sorted);
    }
}

// Section 4.2: "only requires the addition of one integer to broadcasted genomes (the current
// robot's c_r)"
TEST(Section42, AMessageHasOneIntegerMore) {
    static_assert(std::is_same_v<decltype(Message::stamp), Stamp>);
    static_assert(sizeof(Stamp) == sizeof(std::uint64_t));
    static_assert(std::is_same_v<decltype(Stamp::value), std::uint64_t>);
}

}  // namespace
}  // namespace gene_clocks::neat::paper
