#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "tests/sim/core/naive_geometry.hpp"
#include "tests/sim/core/watched_run.hpp"

// What a run says of itself: its samples and counters, each against a second count by somebody who
// stood beside it.

namespace gene_clocks::sim {
namespace {

using watched::Event;

class RunResults : public testing::Test {
protected:
    RunResults() {
        settings_.world.robots = 12;
        settings_.world.items = 3;
        settings_.run.cycles = 1500;
        settings_.run.sample_period_cycles = 70;
        settings_.odneat.p_mutate = 0.8;
    }
    /// Robots and cycles in which the active genome becomes another.
    static std::uint64_t changes_of_genome(const watched::Run& run) {
        std::uint64_t changes = 0;
        for (std::size_t t = 1; t < run.moments.size(); ++t) {
            for (std::size_t i = 0; i < run.moments[t].robots.size(); ++i) {
                changes += run.moments[t].robots[i].genome != run.moments[t - 1].robots[i].genome;
            }
        }
        return changes;
    }
    static std::uint64_t count(const watched::Run& run, Event::Kind kind) {
        std::uint64_t count = 0;
        for (const Event& event : run.events) count += event.kind == kind;
        return count;
    }

    Settings settings_;
    Arena arena_ = naive::arena();
};

TEST_F(RunResults, SamplesAreMeansOverTheRobotsAtTheirCycle) {
    for (const Task task : {Task::navigation, Task::collection}) {
        settings_.task = task;
        settings_.energy.decay = 1.0;
        const watched::Run run(settings_, arena_);
        const double initial_size = task == Task::navigation ? 10 + 2 + 20 : 18 + 2 + 36;
        ASSERT_EQ(run.result.samples.size(), (1500u + 69u) / 70u);
        std::set<double> species_seen;
        for (std::size_t s = 0; s < run.result.samples.size(); ++s) {
            const Sample& sample = run.result.samples[s];
            ASSERT_EQ(sample.cycle, 70 * static_cast<std::int64_t>(s));
            const watched::Moment& moment = run.moments[static_cast<std::size_t>(sample.cycle)];
            ASSERT_EQ(moment.cycle, sample.cycle);
            double fitness = 0.0, species = 0.0, size = 0.0;
            for (const watched::Robot& robot : moment.robots) {
                fitness += robot.fitness;
                std::set<std::size_t> of_members;
                for (const auto& member : robot.members) of_members.insert(member.species);
                species += static_cast<double>(of_members.size());
                size += static_cast<double>(robot.genome->topology->neurons.size() +
                                            robot.genome->topology->connection_marks.size());
            }
            const auto robots = static_cast<double>(moment.robots.size());
            EXPECT_NEAR(sample.swarm_fitness, fitness / robots, 1e-9);
            EXPECT_NEAR(sample.species, species / robots, 1e-9);
            EXPECT_NEAR(sample.controller_size, size / robots, 1e-9);
            EXPECT_NEAR(sample.added_elements, size / robots - initial_size, 1e-9);
            species_seen.insert(sample.species);
        }
        EXPECT_GT(species_seen.size(), 3u);
        EXPECT_GT(run.result.samples.back().added_elements, 1.0);
    }
}

TEST_F(RunResults, SamplesLeaveOutRobotsThatAreNotThereYet) {
    settings_.join = {.late_share = 0.5, .cycles = 900};
    const watched::Run run(settings_, arena_);
    // Who is off keeps its place and its energy.
    std::vector<std::size_t> on_from(run.moments[0].robots.size(), run.moments.size());
    for (std::size_t i = 0; i < on_from.size(); ++i) {
        for (std::size_t t = 1; t < run.moments.size() && on_from[i] == run.moments.size(); ++t) {
            const auto& now = run.moments[t].robots[i];
            const auto& before = run.moments[t - 1].robots[i];
            const bool is_still =
                now.x_px == before.x_px && now.y_px == before.y_px && now.energy == before.energy;
            if (!is_still) on_from[i] = t - 1;
        }
    }
    std::set<std::size_t> numbers;
    for (const Sample& sample : run.result.samples) {
        const auto t = static_cast<std::size_t>(sample.cycle);
        double fitness = 0.0, robots = 0.0;
        for (std::size_t i = 0; i < on_from.size(); ++i) {
            if (on_from[i] > t) continue;
            fitness += run.moments[t].robots[i].fitness;
            robots += 1.0;
        }
        EXPECT_NEAR(sample.swarm_fitness, fitness / robots, 1e-9) << t;
        numbers.insert(static_cast<std::size_t>(robots));
    }
    EXPECT_EQ(*numbers.begin(), 6u);
    EXPECT_EQ(*numbers.rbegin(), 12u);
    EXPECT_GT(numbers.size(), 3u);
}

TEST_F(RunResults, BirthsAreTheGenomesThatWereReplaced) {
    const watched::Run run(settings_, arena_);
    EXPECT_GT(run.result.counters.births, 20u);
    EXPECT_EQ(run.result.counters.births, changes_of_genome(run));
    EXPECT_EQ(run.result.counters.reboots, 0u);
}

TEST_F(RunResults, RebootsAreTheGenomesThatWereLost) {
    settings_.reboot.probability = 0.01;
    settings_.odneat.maturation_cycles = 1'000'000;  // nobody is replaced
    const watched::Run run(settings_, arena_);
    EXPECT_GT(run.result.counters.reboots, 100u);
    // What a robot loses before the first note is taken, nobody sees.
    std::uint64_t before_the_first = 0;
    for (const watched::Robot& robot : run.moments[0].robots) {
        before_the_first += robot.genome->id.birth;
    }
    EXPECT_EQ(run.result.counters.reboots, changes_of_genome(run) + before_the_first);
    EXPECT_EQ(run.result.counters.births, 0u);
    for (std::size_t t = 1; t < run.moments.size(); ++t) {
        for (std::size_t i = 0; i < run.moments[t].robots.size(); ++i) {
            const watched::Robot& robot = run.moments[t].robots[i];
            if (robot.genome == run.moments[t - 1].robots[i].genome) continue;
            EXPECT_EQ(robot.members.size(), 1u);
            EXPECT_EQ(robot.tabu, 0u);
            EXPECT_EQ(robot.energy, 100.0f);
        }
    }
}

TEST_F(RunResults, WhoIsNotThereYetDoesNotReboot) {
    settings_.join = {.late_share = 0.5, .cycles = 1'000'000'000};  // never, in this run
    settings_.reboot.probability = 1.0;
    settings_.run.cycles = 100;
    EXPECT_EQ(watched::Run(settings_, arena_).result.counters.reboots, 6u * 100u);
}

TEST_F(RunResults, GenomesStayValidWhereClocksForgetWhatTheyMarked) {
    // Own genes come back by way of others after a reboot, and the clock would mark them again.
    settings_.source = Source::gene_clock_no_merge;
    settings_.odneat.p_mutate = 0.9;
    settings_.reboot = {.probability = 0.003, .clock = RebootClock::lost};
    settings_.run.cycles = 4000;
    const watched::Run run(settings_, arena_);
    EXPECT_GT(run.result.counters.reboots, 50u);
    EXPECT_GT(run.result.counters.genes_created, 100u);
    for (const watched::Moment& moment : run.moments) {
        for (const watched::Robot& robot : moment.robots) {
            ASSERT_EQ(neat::find_fault(*robot.genome, settings_.odneat.weight_limit), std::nullopt)
                << moment.cycle;
        }
    }
}

TEST_F(RunResults, IdentifiersAreDrawnAnewInEveryLife) {
    settings_.source = Source::random_identifier;
    settings_.odneat.p_mutate = settings_.odneat.p_node = 1.0;
    settings_.reboot = {.probability = 0.005, .clock = RebootClock::lost};
    const watched::Run run(settings_, arena_);
    std::set<InnovationNumber> neurons;
    int drawn = 0;
    for (const watched::Marking& marking : run.markings) {
        const auto t = static_cast<std::size_t>(marking.cycle) + 1;
        const auto& genome = *run.moments[t].robots[marking.robot].genome;
        if (!genome.topology->find_neuron(marking.mark)) continue;
        ++drawn;
        neurons.insert(marking.mark);
    }
    EXPECT_GT(run.result.counters.reboots, 50u);
    EXPECT_GT(drawn, 30);
    // By chance a few are drawn twice; a robot that began each life with the same draws would
    // repeat nearly all.
    EXPECT_GT(neurons.size(), static_cast<std::size_t>(drawn) * 85 / 100);
}

TEST_F(RunResults, GenesCreatedAreTheMarksThatWereNeverSeenBefore) {
    const watched::Run run(settings_, arena_);
    std::set<InnovationNumber> marks;
    for (const watched::Moment& moment : run.moments) {
        for (const watched::Robot& robot : moment.robots) {
            const neat::Topology& topology = *robot.genome->topology;
            for (const auto& neuron : topology.neurons) marks.insert(neuron.mark);
            marks.insert(topology.connection_marks.begin(), topology.connection_marks.end());
        }
    }
    EXPECT_GT(run.result.counters.genes_created, 20u);
    EXPECT_EQ(run.result.counters.genes_created, marks.size() - genesis_count(settings_));
    EXPECT_EQ(run.result.counters.genes_created, run.markings.size());
    // A gene is marked in the cycle in which its genome's predecessor dies, and by its robot.
    for (const watched::Marking& marking : run.markings) {
        const auto t = static_cast<std::size_t>(marking.cycle);
        const watched::Robot& before = run.moments[t].robots[marking.robot];
        const watched::Robot& after = run.moments[t + 1].robots[marking.robot];
        EXPECT_NE(before.genome, after.genome);
        const auto& topology = *after.genome->topology;
        EXPECT_TRUE(topology.find_neuron(marking.mark) ||
                    std::binary_search(topology.connection_marks.begin(),
                                       topology.connection_marks.end(), marking.mark));
    }
}

TEST_F(RunResults, MutationsAreTheOffspringUnlikeAnyGenomeBefore) {
    settings_.odneat.p_mate = 0.0;
    settings_.odneat.p_mutate = 0.5;
    settings_.odneat.p_weight = 0.7;  // structure and weights both change at times, or neither does
    const watched::Run run(settings_, arena_);
    using Genes = std::tuple<std::vector<InnovationNumber>, std::vector<float>, std::vector<float>>;
    std::set<Genes> known;
    std::uint64_t mutants = 0;
    for (const watched::Moment& moment : run.moments) {
        for (const watched::Robot& robot : moment.robots) {
            const neat::Genome& genome = *robot.genome;
            const bool is_new =
                known.insert({genome.topology->connection_marks, genome.weights, genome.enabled})
                    .second;
            mutants += is_new && moment.cycle > 0;
        }
    }
    EXPECT_EQ(run.result.counters.mutations, mutants);
    EXPECT_GT(mutants, 20u);
    EXPECT_LT(mutants + 10, run.result.counters.births);
    EXPECT_EQ(run.result.counters.matings, 0u);
}

TEST_F(RunResults, MatingsAreTheBirthsWithSomebodyElseAtHand) {
    settings_.odneat.p_mate = 1.0;
    settings_.odneat.second_parent = neat::SecondParent::population;
    settings_.radio.loss = 0.97;  // who dies young dies alone
    const watched::Run run(settings_, arena_);
    std::uint64_t matings = 0;
    for (std::size_t t = 1; t < run.moments.size(); ++t) {
        for (std::size_t i = 0; i < run.moments[t].robots.size(); ++i) {
            const watched::Robot& robot = run.moments[t].robots[i];
            if (robot.genome == run.moments[t - 1].robots[i].genome) continue;
            // The offspring is a third one then; room for them there is.
            matings += robot.members.size() >= 3;
        }
    }
    EXPECT_EQ(run.result.counters.matings, matings);
    EXPECT_GT(matings, 10u);
    EXPECT_LT(matings, run.result.counters.births);
}

TEST_F(RunResults, AcceptedGenomesAreThoseThatPopulationsHoldFromOthers) {
    settings_.odneat.population = 1000;  // so that nobody ever leaves
    const watched::Run run(settings_, arena_);
    std::uint64_t from_others = 0;
    for (std::size_t i = 0; i < run.moments.back().robots.size(); ++i) {
        for (const auto& member : run.moments.back().robots[i].members) {
            from_others += static_cast<std::size_t>(member.id.robot) != i + 1;
        }
    }
    EXPECT_GT(from_others, 50u);
    EXPECT_EQ(run.result.counters.genomes_accepted, from_others);
}

TEST_F(RunResults, MessagesAreThoseThatWereSeen) {
    const watched::Run run(settings_, arena_);
    EXPECT_GT(run.result.counters.messages_sent, 500u);
    EXPECT_EQ(run.result.counters.messages_sent, count(run, Event::Kind::sent));
    EXPECT_EQ(run.result.counters.messages_received, count(run, Event::Kind::admitted));
    EXPECT_NE(run.result.counters.messages_received, run.result.counters.messages_sent);
}

TEST_F(RunResults, CollisionsAreTheMovesThatEndWhereTheyBegan) {
    const watched::Run run(settings_, arena_);
    std::uint64_t stays = 0;
    for (std::size_t t = 1; t < run.moments.size(); ++t) {
        for (std::size_t i = 0; i < run.moments[t].robots.size(); ++i) {
            const watched::Robot& now = run.moments[t].robots[i];
            const watched::Robot& before = run.moments[t - 1].robots[i];
            stays += now.x_px == before.x_px && now.y_px == before.y_px;
        }
    }
    EXPECT_GT(stays, 100u);
    // A step may also be too small for a place to change.
    EXPECT_LE(run.result.counters.collisions, stays);
    EXPECT_GE(run.result.counters.collisions, stays - stays / 500);
}

TEST_F(RunResults, StampsAreThoseThatRobotsWouldSendAtTheEnd) {
    const watched::Run run(settings_, arena_);
    std::uint64_t smallest = ~std::uint64_t{0}, largest = 0;
    double sum = 0.0;
    for (const watched::Robot& robot : run.moments.back().robots) {
        smallest = std::min(smallest, robot.stamp.value);
        largest = std::max(largest, robot.stamp.value);
        sum += static_cast<double>(robot.stamp.value);
    }
    EXPECT_GT(largest, smallest);
    EXPECT_EQ(run.result.chronology.stamp_smallest, smallest);
    EXPECT_EQ(run.result.chronology.stamp_largest, largest);
    EXPECT_NEAR(run.result.chronology.stamp_mean, sum / 12.0, 1e-6);
}

TEST_F(RunResults, CreationsAreTheMarkingsWithTheirRobotsAndCycles) {
    settings_.run.record_creation_times = true;
    const watched::Run run(settings_, arena_);
    ASSERT_EQ(run.result.creations.size(), run.markings.size());
    for (std::size_t i = 0; i < run.markings.size(); ++i) {
        EXPECT_EQ(run.result.creations[i].mark, run.markings[i].mark);
        EXPECT_EQ(static_cast<std::size_t>(run.result.creations[i].robot) - 1,
                  run.markings[i].robot);
        EXPECT_EQ(run.result.creations[i].cycle, static_cast<double>(run.markings[i].cycle));
    }
}

}  // namespace
}  // namespace gene_clocks::sim
