#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "tests/sim/core/naive_swarm.hpp"
#include "tests/sim/core/watched_run.hpp"

// Who hears whom, when, in which order, and what they are told: each against the swarm's own
// places.

namespace gene_clocks::sim {
namespace {

using watched::Event;

class Messages : public testing::Test {
protected:
    Messages() {
        settings_.world.robots = 16;
        settings_.run.cycles = 300;
        settings_.radio.range_px = 20.0;  // less than what the rays see
    }
    std::set<int> in_reach(const watched::Run& run, std::int64_t cycle, std::size_t robot) const {
        std::set<int> found;
        const auto t = static_cast<std::size_t>(cycle);
        for (const naive::Met& met : naive::look(settings_, arena_, run, t, robot).rays) {
            if (met.robot >= 0) found.insert(met.robot);
        }
        return found;
    }

    Settings settings_;
    Arena arena_ = naive::arena();
};

TEST_F(Messages, GoToThoseWhomTheSendersRaysMeetWithinTheRangeOfTheRadio) {
    const watched::Run run(settings_, arena_);
    std::map<std::uint64_t, std::multiset<int>> heard_by;
    for (const Event& event : run.events) {
        if (event.kind == Event::Kind::admitted) {
            heard_by[event.message].insert(static_cast<int>(event.robot));
        }
    }
    int agree = 0, disagree = 0;
    for (const Event& event : run.events) {
        if (event.kind != Event::Kind::sent) continue;
        const std::multiset<int>& heard = heard_by[event.message];
        const std::set<int> expected = in_reach(run, event.cycle, event.robot);
        const bool is_equal =
            std::equal(heard.begin(), heard.end(), expected.begin(), expected.end());
        ++(is_equal ? agree : disagree);
    }
    EXPECT_GT(agree, 500);
    EXPECT_LE(disagree, agree / 100);  // rays that graze a corner may be told either way
}

TEST_F(Messages, ASwarmOfLonersSendsWheneverItSeesSomebody) {
    settings_.radio.loss = 1.0;  // one genome in each population: its species has all the fitness
    const watched::Run run(settings_, arena_);
    std::set<std::pair<std::int64_t, std::size_t>> sent;
    for (const Event& event : run.events) {
        EXPECT_EQ(event.kind, Event::Kind::sent);
        EXPECT_TRUE(sent.emplace(event.cycle, event.robot).second) << "twice in a cycle";
    }
    int agree = 0, disagree = 0;
    for (std::int64_t cycle = 0; cycle < settings_.run.cycles; ++cycle) {
        for (std::size_t i = 0; i < run.moments[0].robots.size(); ++i) {
            const bool sees = !in_reach(run, cycle, i).empty();
            ++(sees == sent.contains({cycle, i}) ? agree : disagree);
        }
    }
    EXPECT_GT(sent.size(), 500u);
    EXPECT_LE(disagree, agree / 300);
}

/// What a species has of all species' fitness: the mean of its members' over its size.
double share_of(const watched::Robot& robot) {
    std::map<std::size_t, std::pair<double, double>> species;  // sum and size
    for (const auto& member : robot.members) {
        species[member.species].first += static_cast<double>(member.fitness);
        species[member.species].second += 1.0;
    }
    double all = 0.0;
    for (const auto& [index, found] : species) all += found.first / (found.second * found.second);
    const auto& [sum, size] = species.at(robot.member(robot.genome->id)->species);
    return all > 0.0 ? sum / (size * size) / all : 0.0;
}

TEST_F(Messages, AreSentAsOftenAsTheShareOfTheirSpeciesSays) {
    settings_.run.cycles = 1500;
    settings_.radio.loss = 0.9;  // shares change little within a cycle
    const watched::Run run(settings_, arena_);
    double expected = 0.0, variance = 0.0;
    for (std::int64_t cycle = 0; cycle < settings_.run.cycles; ++cycle) {
        for (std::size_t i = 0; i < run.moments[0].robots.size(); ++i) {
            if (in_reach(run, cycle, i).empty()) continue;
            const double share = share_of(run.moments[static_cast<std::size_t>(cycle)].robots[i]);
            expected += share;
            variance += share * (1.0 - share);
        }
    }
    EXPECT_GT(variance, 100.0) << "hardly anything was left to chance";
    EXPECT_NEAR(static_cast<double>(run.messages), expected,
                5 * std::sqrt(variance) + 0.01 * expected);
}

TEST_F(Messages, ArriveInTheCycleInWhichTheyAreSentUnlessTheyAreDelayed) {
    for (const std::int64_t delay : {0, 1, 5}) {
        settings_.radio.delay_cycles = delay;
        const watched::Run run(settings_, arena_);
        std::map<std::uint64_t, std::int64_t> sent;
        std::size_t admitted = 0;
        for (const Event& event : run.events) {
            if (event.kind == Event::Kind::sent) {
                sent[event.message] = event.cycle;
            } else {
                ++admitted;
                ASSERT_TRUE(sent.contains(event.message)) << "heard before it was sent";
                EXPECT_EQ(event.cycle, sent.at(event.message) + delay);
            }
        }
        EXPECT_GT(admitted, 500u);
    }
}

TEST_F(Messages, DelayedOnesArriveAsTheyWereSentAndBeforeAnybodySendsAnew) {
    settings_.radio.delay_cycles = 3;
    const watched::Run run(settings_, arena_);
    std::size_t several = 0;
    for (std::size_t i = 1; i < run.events.size(); ++i) {
        const Event& before = run.events[i - 1];
        const Event& now = run.events[i];
        if (before.cycle != now.cycle) continue;
        if (before.kind == Event::Kind::sent) {
            EXPECT_EQ(now.kind, Event::Kind::sent) << "heard after somebody has sent";
        } else if (now.kind == Event::Kind::admitted) {
            EXPECT_LE(before.message, now.message);
            several += before.message != now.message;
        }
    }
    EXPECT_GT(several, 50u);
}

TEST_F(Messages, AreSentInAnOrderDrawnAnewEachCycle) {
    settings_.radio.loss = 1.0;
    settings_.run.cycles = 2000;
    const watched::Run run(settings_, arena_);
    // Neighbours in the order: the second robot is before or after the first equally often; and who
    // is first once is not so again and again.
    double pairs = 0.0, ascending = 0.0, firsts = 0.0, same_first = 0.0;
    std::size_t last_first = 0;
    for (std::size_t i = 1; i < run.events.size(); ++i) {
        if (run.events[i - 1].cycle == run.events[i].cycle) {
            pairs += 1.0;
            ascending += run.events[i - 1].robot < run.events[i].robot;
        } else {
            firsts += 1.0;
            same_first += run.events[i].robot == last_first;
            last_first = run.events[i].robot;
        }
    }
    EXPECT_GT(pairs, 3000.0);
    EXPECT_NEAR(ascending / pairs, 0.5, 5 * std::sqrt(0.25 / pairs));
    EXPECT_LT(same_first / firsts, 0.4);
}

TEST_F(Messages, AreSentInAnyOrderEquallyOften) {
    // Three large robots that stand near each other: all see one another, and all send.
    arena_ = {"small", 60.0, 60.0, 5.0, 5.0, 5.0, 5.0, {}};
    settings_.world.robots = 3;
    settings_.world.robot_radius_px = 8.0;
    settings_.world.translation_px = 0.0;
    settings_.radio.range_px = 30.0;
    settings_.radio.loss = 1.0;
    settings_.run.cycles = 3000;
    const watched::Run run(settings_, arena_);
    ASSERT_GT(run.events.size(), 6000u);
    std::map<std::int64_t, std::vector<std::size_t>> orders;
    for (const Event& event : run.events) orders[event.cycle].push_back(event.robot);
    std::map<std::vector<std::size_t>, double> counts;
    double complete = 0.0, pairs = 0.0, same = 0.0;
    const std::vector<std::size_t>* before = nullptr;
    for (const auto& [cycle, order] : orders) {
        if (order.size() != 3) continue;
        complete += 1.0;
        counts[order] += 1.0;
        if (before != nullptr) pairs += 1.0, same += *before == order;
        before = &order;
    }
    ASSERT_GT(complete, 500.0);
    ASSERT_EQ(counts.size(), 6u);
    const auto tolerance = [](double p, double of) { return 5 * std::sqrt(p * (1 - p) / of); };
    for (const auto& [order, count] : counts) {
        EXPECT_NEAR(count / complete, 1.0 / 6.0, tolerance(1.0 / 6.0, complete));
    }
    EXPECT_NEAR(same / pairs, 1.0 / 6.0, tolerance(1.0 / 6.0, pairs));
}

TEST_F(Messages, CarryTheEnergyOfTheirSender) {
    settings_.run.cycles = 1500;
    const watched::Run run(settings_, arena_);
    int accepted = 0;
    for (std::size_t t = 0; t + 1 < run.moments.size(); ++t) {
        const auto& robots = run.moments[t].robots;
        for (std::size_t i = 0; i < robots.size(); ++i) {
            const watched::Robot& next = run.moments[t + 1].robots[i];
            for (const auto& member : next.members) {
                const auto maker = static_cast<std::size_t>(member.id.robot) - 1;
                if (maker == i || robots[i].holds(member.id)) continue;
                ++accepted;
                ASSERT_EQ(robots[maker].genome->id, member.id) << "not what its maker sends";
                EXPECT_EQ(member.fitness, robots[maker].energy);
                EXPECT_EQ(member.reports, 1);
            }
        }
    }
    EXPECT_GT(accepted, 100);
}

TEST_F(Messages, AboutAHeldGenomeAreAveragedInOrReplaceWhatWasKnown) {
    settings_.odneat.population = 30;  // nobody leaves
    for (const auto rule : {neat::HeldEnergy::running_mean, neat::HeldEnergy::overwrite}) {
        settings_.odneat.held_energy = rule;
        const watched::Run run(settings_, arena_);
        int reports = 0;
        for (std::size_t t = 0; t + 1 < run.moments.size(); ++t) {
            const auto& robots = run.moments[t].robots;
            for (std::size_t i = 0; i < robots.size(); ++i) {
                for (const auto& member : run.moments[t + 1].robots[i].members) {
                    const auto* const held = robots[i].member(member.id);
                    if (held == nullptr || held->reports == member.reports) continue;
                    ++reports;
                    const auto maker = static_cast<std::size_t>(member.id.robot) - 1;
                    const float energy = robots[maker].energy;
                    const auto many = static_cast<float>(member.reports);
                    ASSERT_EQ(member.reports, held->reports + 1);
                    EXPECT_FLOAT_EQ(member.fitness,
                                    rule == neat::HeldEnergy::overwrite
                                        ? energy
                                        : held->fitness + (energy - held->fitness) / many);
                }
            }
        }
        EXPECT_GT(reports, 300);
    }
}

}  // namespace
}  // namespace gene_clocks::sim
