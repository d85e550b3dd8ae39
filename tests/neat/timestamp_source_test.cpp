#include <gtest/gtest.h>

#include <gene_clocks/neat/timestamp_source.hpp>
#include <limits>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

constexpr std::uint64_t ticks_per_cycle = std::uint64_t{1} << 20;
constexpr std::uint64_t epoch_cycles = std::uint64_t{1} << 31;

class TimestampSourceTest : public testing::Test {
protected:
    /// The mark that a robot of this local time gives at `now_cycles`, as its first.
    InnovationNumber first_mark(LocalTime time, double now_cycles, std::uint32_t robot = 1) {
        TimestampSource source(RobotId{robot}, 5, time);
        return read(source, now_cycles);
    }
    InnovationNumber read(TimestampSource& source, double now_cycles) {
        return source.mark_connection(genome_, {}, now_cycles).value();
    }
    Genome genome_ = perceptron(2, 1);
};

TEST_F(TimestampSourceTest, ReadsTheTimeInTicks) {
    EXPECT_EQ(first_mark({}, 0.0), mark(epoch_cycles * ticks_per_cycle));
    EXPECT_EQ(first_mark({}, 1.0), mark((epoch_cycles + 1) * ticks_per_cycle));
    EXPECT_EQ(first_mark({}, 40'000.5), mark((2 * epoch_cycles + 80'001) * (ticks_per_cycle / 2)));
}

TEST_F(TimestampSourceTest, AddsTheOffset) {
    EXPECT_EQ(first_mark({.offset_cycles = 2.5}, 10.0), first_mark({}, 12.5));
    EXPECT_EQ(first_mark({.offset_cycles = -2.5}, 10.0), first_mark({}, 7.5));
}

TEST_F(TimestampSourceTest, AppliesTheDriftToTheTimeSinceTheStart) {
    EXPECT_EQ(first_mark({.drift_rate = 0.25}, 1000.0), first_mark({}, 1250.0));
    EXPECT_EQ(first_mark({.drift_rate = -0.25}, 1000.0), first_mark({}, 750.0));
    EXPECT_EQ(first_mark({.offset_cycles = 7.0, .drift_rate = 0.5}, 0.0), first_mark({}, 7.0));
}

TEST_F(TimestampSourceTest, ResolvesOnePartPerMillionOverARun) {
    const auto exact = first_mark({}, 40'000.0);
    const auto drifted = first_mark({.drift_rate = 1e-6}, 40'000.0);
    EXPECT_EQ(drifted.counter - exact.counter, static_cast<std::uint64_t>(0.04 * 0x1p20));
}

TEST_F(TimestampSourceTest, GivesTheGenesOfOneMomentDifferentTicksInOrder) {
    TimestampSource source(RobotId{1}, 5, {});
    const auto marks = source.mark_split(genome_, 0, 3.0).value();
    const std::uint64_t tick = (epoch_cycles + 3) * ticks_per_cycle;
    EXPECT_EQ(marks.neuron, mark(tick));
    EXPECT_EQ(marks.incoming, mark(tick + 1));
    EXPECT_EQ(marks.outgoing, mark(tick + 2));
    EXPECT_EQ(read(source, 3.0), mark(tick + 3));
    EXPECT_EQ(read(source, 4.0), mark(tick + ticks_per_cycle));
}

TEST_F(TimestampSourceTest, NeverGoesBackwards) {
    TimestampSource source(RobotId{1}, 5, {.drift_rate = -3.0});  // runs backwards
    InnovationNumber last = read(source, 0.0);
    for (int cycle = 1; cycle < 100; ++cycle) {
        const InnovationNumber next = read(source, cycle);
        EXPECT_LT(last, next);
        last = next;
    }
}

TEST_F(TimestampSourceTest, TellsEqualTicksOfTwoRobotsApart) {
    EXPECT_EQ(first_mark({}, 3.0, 2).counter, first_mark({}, 3.0, 1).counter);
    EXPECT_LT(first_mark({}, 3.0, 1), first_mark({}, 3.0, 2));
}

TEST_F(TimestampSourceTest, KeepsAboveTheGenesisMarksWhateverTheOffset) {
    const std::uint64_t genesis_last = genome_.topology->connection_marks.back().counter;
    for (const double offset : {-0x1p31, -0x1p40, -1e300}) {
        TimestampSource source(RobotId{1}, 5, {.offset_cycles = offset});
        const auto first = read(source, 0.0);
        EXPECT_LT(genesis_last, first.counter) << offset;
        EXPECT_LT(first, read(source, 0.0)) << offset;
    }
}

TEST_F(TimestampSourceTest, StopsMarkingAtTheEndOfTime) {
    constexpr double end_cycles = 0x1p43 - 0x1p31;  // 2^63 ticks, less the epoch
    EXPECT_EQ(first_mark({.offset_cycles = end_cycles - 1.0}, 0.0),
              mark((std::uint64_t{1} << 63) - ticks_per_cycle));
    for (const double offset : {end_cycles, 1e300, std::numeric_limits<double>::infinity()}) {
        TimestampSource source(RobotId{1}, 5, {.offset_cycles = offset});
        EXPECT_FALSE(source.mark_connection(genome_, {}, 0.0).has_value());
        EXPECT_FALSE(source.mark_split(genome_, 0, 0.0).has_value());
    }
}

TEST_F(TimestampSourceTest, SendsNothingAndTakesNothing) {
    TimestampSource source(RobotId{1}, 5, {});
    EXPECT_EQ(source.stamp(), Stamp{0});
    EXPECT_TRUE(source.observe(Stamp{std::numeric_limits<std::uint64_t>::max()}));
    EXPECT_EQ(read(source, 0.0), mark(epoch_cycles * ticks_per_cycle));
    EXPECT_EQ(source.stamp(), Stamp{0});
}

TEST_F(TimestampSourceTest, WithoutMessagesAFastClockOutrunsASlowOne) {
    // What gene clocks rule out: a gene made later, and after a message, may sort first.
    TimestampSource fast(RobotId{1}, 5, {.offset_cycles = 100.0});
    TimestampSource slow(RobotId{2}, 5, {});
    const auto earlier = read(fast, 10.0);
    EXPECT_TRUE(slow.observe(fast.stamp()));
    EXPECT_LT(read(slow, 20.0), earlier);
}

}  // namespace
}  // namespace gene_clocks::neat
