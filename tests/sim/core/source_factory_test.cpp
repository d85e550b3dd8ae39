#include "sim/core/src/source_factory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "sim/core/src/volatile_source.hpp"

namespace gene_clocks::sim {
namespace {

constexpr std::uint64_t genesis_marks = 32;

class SourceFactoryTest : public testing::Test {
protected:
    SourceFactory factory(Source source, std::uint64_t seed = 1) {
        settings_.source = source;
        settings_.world.robots = 10;
        return {settings_, genesis_marks, seed};
    }
    std::uint64_t first_counter(neat::InnovationSource& source, double now_cycles = 0.0) {
        return source
            .mark_connection(genome_, {{1, genesis_robot}, {2, genesis_robot}}, now_cycles)
            ->counter;
    }
    /// By how many cycles the clocks of the first 10 robots are off at a time.
    std::vector<double> clock_errors_cycles(Source source, double now_cycles) {
        SourceFactory made = factory(source);
        std::vector<double> errors;
        for (std::uint32_t robot = 1; robot <= 10; ++robot) {
            const auto clock = made.make(RobotId{robot});
            const auto counter = static_cast<double>(first_counter(*clock, now_cycles));
            errors.push_back(counter / 0x1p20 - 0x1p31 - now_cycles);
        }
        return errors;
    }

    Settings settings_;
    neat::Genome genome_{{}, neat::make_initial_topology(10, 2), {}, {}};
};

TEST_F(SourceFactoryTest, EverySourceMarksAboveTheGenesisMarks) {
    for (const SourceDisplay& source : sources) {
        SourceFactory made = factory(source.source);
        EXPECT_GT(first_counter(*made.make(RobotId{1})), genesis_marks);
    }
}

TEST_F(SourceFactoryTest, GeneClocksMergeUnlessTheyAreTheAblation) {
    const auto with = factory(Source::gene_clock).make(RobotId{1});
    const auto without = factory(Source::gene_clock_no_merge).make(RobotId{1});
    EXPECT_TRUE(with->observe(Stamp{100}));
    EXPECT_TRUE(without->observe(Stamp{100}));
    EXPECT_EQ(first_counter(*with), 100u);
    EXPECT_EQ(first_counter(*without), genesis_marks + 1);
}

TEST_F(SourceFactoryTest, RobotsShareOneGlobalCounter) {
    SourceFactory made = factory(Source::global_counter);
    const auto one = made.make(RobotId{1});
    const auto other = made.make(RobotId{2});
    EXPECT_EQ(first_counter(*one), first_counter(*other));
    EXPECT_EQ(other->mark_split(genome_, 0, 0.0)->neuron.counter, genesis_marks + 2);
}

TEST_F(SourceFactoryTest, CongruenceClassesKnowTheNumberOfRobots) {
    const auto source = factory(Source::congruence_class).make(RobotId{4});
    EXPECT_EQ(first_counter(*source), genesis_marks + 4);
    EXPECT_EQ(first_counter(*source), genesis_marks + 14);
}

TEST_F(SourceFactoryTest, RobotsDrawDifferentIdentifiersAndTheSameAgainFromTheSameSeed) {
    const auto draws = [&](std::uint64_t seed) {
        SourceFactory made = factory(Source::random_identifier, seed);
        std::vector<std::uint64_t> neurons;
        for (std::uint32_t robot = 1; robot <= 10; ++robot) {
            neurons.push_back(
                made.make(RobotId{robot})->mark_split(genome_, 0, 0.0)->neuron.counter);
        }
        return neurons;
    };
    EXPECT_EQ(draws(1), draws(1));
    EXPECT_NE(draws(1), draws(2));
    EXPECT_NE(draws(1)[0], draws(1)[1]);
}

TEST_F(SourceFactoryTest, TimestampsArePerfectUnlessTold) {
    for (const double error : clock_errors_cycles(Source::timestamp, 1000.0)) EXPECT_EQ(error, 0.0);
    settings_.timestamp.offset_cycles = 50.0;
    double largest = 0.0;
    for (const double error : clock_errors_cycles(Source::timestamp, 1000.0)) {
        EXPECT_LE(std::abs(error), 50.0);
        largest = std::max(largest, std::abs(error));
    }
    EXPECT_GT(largest, 25.0);
}

TEST_F(SourceFactoryTest, DriftIsTypicalUnlessTold) {
    double largest = 0.0;
    for (const double error : clock_errors_cycles(Source::timestamp_drift, 0.0)) {
        EXPECT_LE(std::abs(error), 10'000.0);
        largest = std::max(largest, std::abs(error));
    }
    EXPECT_GT(largest, 5000.0);
    // A million cycles at 100 ppm are 100 cycles; the offset is the same as before.
    const auto before = clock_errors_cycles(Source::timestamp_drift, 0.0);
    const auto after = clock_errors_cycles(Source::timestamp_drift, 1e6);
    double largest_drift = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_LE(std::abs(after[i] - before[i]), 100.1);
        largest_drift = std::max(largest_drift, std::abs(after[i] - before[i]));
    }
    EXPECT_GT(largest_drift, 50.0);

    settings_.timestamp.offset_cycles = 3.0;
    for (const double error : clock_errors_cycles(Source::timestamp_drift, 0.0)) {
        EXPECT_LE(std::abs(error), 3.0);
    }
}

TEST_F(SourceFactoryTest, SynchronisedClocksAreOffByTheErrorOnly) {
    settings_.timestamp = {.offset_cycles = 1000.0,
                           .synchronised_every_cycles = 100.0,
                           .synchronisation_error_cycles = 2.0};
    const auto errors = clock_errors_cycles(Source::timestamp_drift, 550.0);
    for (const double error : errors) EXPECT_LE(std::abs(error), 2.0);
    EXPECT_NE(errors[0], errors[1]);
}

TEST_F(SourceFactoryTest, HybridClocksReadTheSamePhysicalClocks) {
    settings_.timestamp.offset_cycles = 1000.0;
    const auto timestamp = factory(Source::timestamp).make(RobotId{1});
    const auto hybrid = factory(Source::hybrid_logical_clock).make(RobotId{1});
    EXPECT_NEAR(static_cast<double>(first_counter(*hybrid, 10.0)) / 0x1p26 - 0x1p31,
                static_cast<double>(first_counter(*timestamp, 10.0)) / 0x1p20 - 0x1p31, 0.01);
}

TEST_F(SourceFactoryTest, AfterARebootCountersStartOverAndPhysicalClocksDoNot) {
    settings_.timestamp.offset_cycles = 1000.0;
    for (const auto source : {Source::gene_clock, Source::gene_clock_no_merge,
                              Source::congruence_class, Source::timestamp}) {
        const SourceFactory made = factory(source);
        for (const std::uint32_t robot : {1u, 7u, 10u}) {
            EXPECT_EQ(first_counter(*made.make(RobotId{robot}, 1), 5.0),
                      first_counter(*made.make(RobotId{robot}, 0), 5.0));
        }
    }
    const SourceFactory made = factory(Source::random_identifier);
    const auto drawn = [&](std::uint64_t life) {
        return made.make(RobotId{1}, life)->mark_split(genome_, 0, 0.0)->neuron;
    };
    EXPECT_NE(drawn(0), drawn(1));
    EXPECT_NE(drawn(1), drawn(2));
}

TEST_F(SourceFactoryTest, AVolatileSourcePassesOverMarksThatTheGenomeHas) {
    const RobotId robot{3};
    auto topology = std::make_shared<neat::Topology>(*genome_.topology);
    topology->insert({{genesis_marks + 2, robot}, neat::NeuronKind::hidden});
    topology->insert({genesis_marks + 5, robot},
                     {{1, genesis_robot}, {genesis_marks + 2, robot}, false});
    const neat::Genome genome{{}, topology, {}, {}};
    const auto lost = [&] {
        return VolatileSource(factory(Source::gene_clock_no_merge).make(robot, 1));
    };
    VolatileSource joins = lost();
    std::vector<std::uint64_t> counters;
    for (int i = 0; i < 4; ++i) {
        counters.push_back(joins.mark_connection(genome, {}, 0.0)->counter - genesis_marks);
    }
    EXPECT_EQ(counters, (std::vector<std::uint64_t>{1, 3, 4, 6}));
    // 1, 2, 3 and 4, 5, 6 would each repeat one.
    VolatileSource splits = lost();
    EXPECT_EQ(splits.mark_split(genome, 0, 0.0)->neuron.counter, genesis_marks + 7);
}

}  // namespace
}  // namespace gene_clocks::sim
