#include <gtest/gtest.h>

#include <cmath>
#include <gene_clocks/sim/run_observer.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <map>
#include <set>
#include <stdexcept>

#include "tests/sim/core/naive_geometry.hpp"

namespace gene_clocks::sim {
namespace {

class SimulationTest : public testing::Test {
protected:
    SimulationTest() {
        settings_.world.robots = 12;
        settings_.world.items = 3;
        settings_.run.cycles = 3000;
    }
    RunResult run(std::uint64_t seed = 1) { return simulate(settings_, arena_, seed).value(); }

    Settings settings_;
    Arena arena_ = naive::arena();
};

/// Notes which robot sent or took messages first, and when which genes were marked.
class FirstContacts final : public RunObserver {
public:
    void gene_marked(RobotId robot, InnovationNumber mark, double now_cycles) override {
        repeated += marks.insert(mark).second ? 0 : 1;
        const auto index = static_cast<std::size_t>(robot);
        if (!marked_at.contains(index)) marked_at[index] = now_cycles;
    }
    void message_sent(RobotId robot, Stamp, InnovationNumber) override { heard_or_sent(robot); }
    void message_admitted(RobotId robot, std::uint64_t, Stamp) override { heard_or_sent(robot); }

    std::set<InnovationNumber> marks;
    int repeated = 0;  // marks of two genes
    std::map<std::size_t, double> marked_at;
    std::set<std::size_t> active;

private:
    void heard_or_sent(RobotId robot) { active.insert(static_cast<std::size_t>(robot)); }
};

class Counter final : public RunObserver {
public:
    void gene_marked(RobotId, InnovationNumber mark, double) override { marks.insert(mark); }
    void message_sent(RobotId, Stamp, InnovationNumber) override { ++sent; }
    void message_admitted(RobotId, std::uint64_t message, Stamp) override {
        EXPECT_LT(message, sent);
        ++admitted;
    }
    std::set<InnovationNumber> marks;
    std::uint64_t sent = 0, admitted = 0;
};

TEST_F(SimulationTest, IsAFunctionOfSettingsAndSeed) {
    for (const Task task : {Task::navigation, Task::collection}) {
        settings_.task = task;
        EXPECT_EQ(run(1).trajectory_hash, run(1).trajectory_hash);
        EXPECT_NE(run(1).trajectory_hash, run(2).trajectory_hash);
    }
}

TEST_F(SimulationTest, SamplesEveryPeriodAndCountsSteps) {
    const RunResult result = run();
    ASSERT_EQ(result.samples.size(), 30u);
    for (std::size_t i = 0; i < result.samples.size(); ++i) {
        EXPECT_EQ(result.samples[i].cycle, 100 * static_cast<std::int64_t>(i));
    }
    EXPECT_EQ(result.samples[0].swarm_fitness, 100.0);
    EXPECT_EQ(result.samples[0].species, 1.0);
    EXPECT_EQ(result.samples[0].added_elements, 0.0);
    EXPECT_EQ(result.robot_steps, 12u * 3000u);
    EXPECT_GT(result.counters.births, 20u);
    EXPECT_GT(result.counters.messages_received, 100u);
    EXPECT_GE(result.counters.births, result.counters.matings);
}

TEST_F(SimulationTest, AnObserverSeesEverythingAndChangesNothing) {
    Counter counter;
    const RunResult observed = simulate_observed(settings_, arena_, 1, counter).value();
    const RunResult alone = run();
    EXPECT_EQ(observed.trajectory_hash, alone.trajectory_hash);
    EXPECT_EQ(counter.sent, alone.counters.messages_sent);
    EXPECT_EQ(counter.admitted, alone.counters.messages_received);
    EXPECT_EQ(counter.marks.size(), alone.counters.genes_created);
}

TEST_F(SimulationTest, CreationTimesAreRecordedWhereAskedFor) {
    EXPECT_TRUE(run().creations.empty());
    settings_.run.record_creation_times = true;
    const RunResult recorded = run();
    ASSERT_EQ(recorded.creations.size(), recorded.counters.genes_created);
    EXPECT_GT(recorded.creations.size(), 10u);
    for (std::size_t i = 1; i < recorded.creations.size(); ++i) {
        EXPECT_LE(recorded.creations[i - 1].cycle, recorded.creations[i].cycle);
    }
    settings_.run.record_creation_times = false;
    EXPECT_EQ(run().trajectory_hash, recorded.trajectory_hash);
}

TEST_F(SimulationTest, StopsWhenTold) {
    RunControl control;
    control.stop = true;
    EXPECT_EQ(simulate(settings_, arena_, 1, &control), std::nullopt);
    EXPECT_LT(control.cycles_done, settings_.run.cycles);
}

TEST_F(SimulationTest, TellsHowFarItIs) {
    RunControl control;
    ASSERT_TRUE(simulate(settings_, arena_, 1, &control));
    EXPECT_EQ(control.cycles_done, settings_.run.cycles);
}

TEST_F(SimulationTest, ADeafSwarmReceivesNothing) {
    settings_.radio.loss = 1.0;
    const RunResult result = run();
    EXPECT_GT(result.counters.messages_sent, 100u);
    EXPECT_EQ(result.counters.messages_received, 0u);
    EXPECT_EQ(result.counters.genomes_accepted, 0u);
}

TEST_F(SimulationTest, RefusesSettingsThatContradictEachOther) {
    const auto refused = [&](auto change) {
        Settings settings = settings_;
        change(settings);
        EXPECT_THROW(simulate(settings, arena_, 1), std::invalid_argument);
    };
    refused([](Settings& s) { s.world.robots = 0; });
    refused([](Settings& s) { s.run.cycles = 0; });
    refused([](Settings& s) { s.run.sample_period_cycles = 0; });
    refused([](Settings& s) { s.odneat.population = 0; });
    refused([](Settings& s) { s.radio.range_px = s.world.sensor_range_px + 1; });
    refused([](Settings& s) { s.join.late_share = 1.0; });
    refused([](Settings& s) { s.world.arena_scale = 0.01, s.world.robot_radius_px = 1.0; });
}

TEST_F(SimulationTest, EverySourceWorksInEveryTask) {
    settings_.run.cycles = 1000;
    for (const Task task : {Task::navigation, Task::collection}) {
        for (const SourceDisplay& source : sources) {
            settings_.task = task;
            settings_.source = source.source;
            EXPECT_EQ(run().robot_steps, 12'000u);
        }
    }
}

TEST_F(SimulationTest, RobotsRebootWithTheirProbability) {
    const auto without = run();
    EXPECT_EQ(without.counters.reboots, 0u);
    settings_.reboot.clock = RebootClock::lost;  // of no consequence without reboots
    EXPECT_EQ(run().trajectory_hash, without.trajectory_hash);
    settings_.reboot.probability = 0.01;
    const auto rebooted = run();
    const double expected = 0.01 * 12 * 3000;
    EXPECT_NEAR(static_cast<double>(rebooted.counters.reboots), expected, 5 * std::sqrt(expected));
    EXPECT_LT(rebooted.samples.back().added_elements, without.samples.back().added_elements);
    settings_.reboot.probability = 1.0;
    EXPECT_EQ(run().counters.reboots, 12u * 3000u);
    EXPECT_EQ(run().counters.births, 0u);
}

TEST_F(SimulationTest, OnlyALostClockMarksTwoGenesAlike) {
    settings_.odneat.p_mutate = 0.9;
    settings_.reboot.probability = 0.002;
    for (const auto source :
         {Source::gene_clock, Source::gene_clock_no_merge, Source::congruence_class}) {
        settings_.source = source;
        for (const auto clock : {RebootClock::kept, RebootClock::lost}) {
            settings_.reboot.clock = clock;
            FirstContacts contacts;
            const auto result = simulate_observed(settings_, arena_, 1, contacts).value();
            EXPECT_GT(result.counters.reboots, 10u);
            EXPECT_EQ(contacts.repeated > 0, clock == RebootClock::lost)
                << static_cast<int>(source);
        }
    }
}

TEST_F(SimulationTest, EverySourceOutlivesRebootsInADebugBuildsAssertions) {
    settings_.run.cycles = 2000;
    settings_.odneat.p_mutate = settings_.odneat.p_mate = 0.9;
    settings_.reboot = {.probability = 0.005, .clock = RebootClock::lost};
    for (const SourceDisplay& source : sources) {
        settings_.source = source.source;
        EXPECT_GT(run().counters.genes_created, 10u);
    }
}

TEST_F(SimulationTest, LateRobotsDoNothingUntilTheyAreSwitchedOn) {
    settings_.join = {.late_share = 0.5, .cycles = 1'000'000'000};  // 6 of 12: never, in this run
    FirstContacts contacts;
    const auto result = simulate_observed(settings_, arena_, 1, contacts).value();
    EXPECT_EQ(contacts.active.size(), 6u);
    for (const auto& [robot, cycle] : contacts.marked_at) {
        EXPECT_TRUE(contacts.active.contains(robot));
    }
    // Their fitness would stay 100; those that are on start there too, and then differ from it.
    EXPECT_EQ(result.samples.front().swarm_fitness, 100.0);
    settings_.join.cycles = 1;  // all on from cycle 1: no draw of anybody's differs after that
    FirstContacts all;
    EXPECT_TRUE(simulate_observed(settings_, arena_, 1, all));
    EXPECT_EQ(all.active.size(), 12u);
}

TEST_F(SimulationTest, LateRobotsJoinInTheirCyclesAndCountInTheMeansFromThen) {
    settings_.join = {.late_share = 0.75, .cycles = 2000};
    settings_.odneat.p_mutate = settings_.odneat.p_node = 1.0;
    settings_.world.robots = 40;
    settings_.world.robot_radius_px = 1.0;
    FirstContacts contacts;
    const auto result = simulate_observed(settings_, arena_, 1, contacts).value();
    // Marks come from robots that are on: at first from a quarter, in the end from nearly all.
    int early = 0;
    for (const auto& [robot, cycle] : contacts.marked_at) early += cycle < 300.0 ? 1 : 0;
    EXPECT_LE(early, 10 + 10);
    EXPECT_GT(contacts.active.size(), 35u);
    EXPECT_EQ(result.samples.size(), 30u);
    EXPECT_EQ(result.trajectory_hash, run().trajectory_hash);
}

TEST_F(SimulationTest, TheMeansAreThoseOfTheRobotsThatAreOn) {
    // Nobody gains: who is on has no energy left before long, who is off keeps its 100.
    settings_.task = Task::collection;
    settings_.world.items = 0;
    settings_.energy.decay = 10.0;
    settings_.odneat.maturation_cycles = 1'000'000;
    settings_.join = {.late_share = 0.5, .cycles = 1'000'000'000};
    const auto result = run();
    EXPECT_LT(result.samples.back().swarm_fitness, 3.0);
}

TEST_F(SimulationTest, LateRobotsStandStill) {
    // Who moves straight on soon hits a wall in every cycle; the one robot that is on may.
    settings_.world.rotation_deg = 0.0;
    settings_.join = {.late_share = 11.0 / 12.0, .cycles = 1'000'000'000};
    for (const auto actuation : {Actuation::translation_rotation, Actuation::wheels}) {
        settings_.world.actuation = actuation;
        EXPECT_LE(run().counters.collisions, 3000u);
    }
}

TEST_F(SimulationTest, LateRobotsTakeNoItems) {
    // All can reach all items, and nobody moves: the one robot that is on gets every item.
    settings_.task = Task::collection;
    settings_.world.translation_px = 0.0;
    settings_.world.item_reach_px = 200.0;
    settings_.join = {.late_share = 11.0 / 12.0, .cycles = 1'000'000'000};
    settings_.run.cycles = 500;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        EXPECT_GT(run(seed).samples.back().swarm_fitness, 150.0);
    }
}

TEST_F(SimulationTest, AScaledArenaIsAnArenaOfThatSize) {
    for (const double factor : {0.8, 3.16}) {
        Arena large = arena_;
        for (double* length : {&large.width_px, &large.height_px, &large.frame_left_px,
                               &large.frame_right_px, &large.frame_top_px, &large.frame_bottom_px})
            *length *= factor;
        for (ThickSegment& wall : large.walls) {
            wall = {wall.x1_px * factor, wall.y1_px * factor, wall.x2_px * factor,
                    wall.y2_px * factor, wall.thickness_px * factor};
        }
        settings_.world.arena_scale = 1.0;
        const auto expected = simulate(settings_, large, 1).value().trajectory_hash;
        EXPECT_NE(expected, run().trajectory_hash);
        settings_.world.arena_scale = factor;
        EXPECT_EQ(run().trajectory_hash, expected);
    }
}

// docs/markings.md: both sort genes by how many their robot had made, and then by robot.
TEST_F(SimulationTest, CongruenceClassesAreGeneClocksWithoutTheMerge) {
    // Many genes, and a great difference between excess and disjoint, which only the order decides.
    settings_.odneat.p_mutate = 0.9;
    settings_.odneat.c_excess = 0.0;
    settings_.odneat.c_disjoint = 5.0;
    int differing = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        settings_.source = Source::gene_clock_no_merge;
        const auto unmerged = run(seed).trajectory_hash;
        settings_.source = Source::congruence_class;
        EXPECT_EQ(run(seed).trajectory_hash, unmerged);
        settings_.source = Source::gene_clock;
        differing += run(seed).trajectory_hash != unmerged;
    }
    EXPECT_GT(differing, 0);
}

// docs/markings.md: an order that extends cause and effect sorts every genome by creation; where
// excess weighs as much as disjoint, that is all that a marking can do.
TEST_F(SimulationTest, MarkingsThatExtendCauseAndEffectGiveOneTrajectory) {
    settings_.odneat.c_disjoint = settings_.odneat.c_excess;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        settings_.source = Source::gene_clock;
        const auto expected = run(seed).trajectory_hash;
        settings_.source = Source::timestamp;
        EXPECT_EQ(run(seed).trajectory_hash, expected);
        settings_.source = Source::hybrid_logical_clock;
        EXPECT_EQ(run(seed).trajectory_hash, expected);
    }
}

// docs/markings.md: so do the other two mismatches, whatever excess and disjoint weigh, and the
// crossover that cuts the genes in the order of their marks.
TEST_F(SimulationTest, ChronologicalOperatorsCannotTellMarkingsThatExtendCauseAndEffectApart) {
    settings_.odneat.p_mate = 0.9;
    settings_.odneat.p_mutate = 0.9;
    settings_.odneat.c_excess = 0.5;
    settings_.odneat.c_disjoint = 5.0;
    settings_.odneat.crossover = neat::CrossoverKind::one_point;
    settings_.odneat.second_parent = neat::SecondParent::population;
    const auto trajectory = [&](Source source, std::uint64_t seed) {
        settings_.source = source;
        const RunResult result = run(seed);
        EXPECT_GT(result.counters.matings, 10u);
        return result.trajectory_hash;
    };
    int differing = 0;
    for (const auto mismatch : {neat::Mismatch::age, neat::Mismatch::since_common}) {
        settings_.odneat.mismatch = mismatch;
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const auto expected = trajectory(Source::gene_clock, seed);
            EXPECT_EQ(trajectory(Source::timestamp, seed), expected);
            EXPECT_EQ(trajectory(Source::hybrid_logical_clock, seed), expected);
            differing += trajectory(Source::gene_clock_no_merge, seed) != expected;
        }
    }
    EXPECT_GT(differing, 0) << "nothing here depends on the order of marks";
    settings_.odneat.mismatch = neat::Mismatch::excess_disjoint;
    differing = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        differing += trajectory(Source::timestamp, seed) != trajectory(Source::gene_clock, seed);
    }
    EXPECT_GT(differing, 0) << "Equation 1 could not tell them apart either";
}

}  // namespace
}  // namespace gene_clocks::sim
