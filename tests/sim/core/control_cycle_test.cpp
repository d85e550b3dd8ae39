#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "tests/sim/core/naive_swarm.hpp"
#include "tests/sim/core/watched_run.hpp"

// What becomes of a robot in one cycle: readings and energy go into the controller, its outputs
// move the robot and change the energy, the energy decides on fitness and life. Every figure is
// computed a second time, from notes of the cycle before.

namespace gene_clocks::sim {
namespace {

/// Rays that graze a corner may be told either way.
struct Tally {
    int agree = 0, disagree = 0;
    void add(bool is_equal) { ++(is_equal ? agree : disagree); }
    void expect_agreement(int at_least, const char* what) const {
        EXPECT_GT(agree, at_least) << what;
        EXPECT_LE(disagree, (agree + disagree) / 200) << what << ", of " << agree + disagree;
    }
};

class ControlCycle : public testing::TestWithParam<std::pair<Task, Actuation>> {
protected:
    ControlCycle() {
        settings_.task = GetParam().first;
        settings_.world.actuation = GetParam().second;
        if (settings_.world.actuation == Actuation::wheels) {
            settings_.energy.navigation = NavigationEnergy::equation_2;
        }
        settings_.world.robots = 24;
        settings_.world.items = 5;
        settings_.run.cycles = 400;
        settings_.run.sample_period_cycles = 50;
        // Controllers without state, whose outputs depend on every input; short lives.
        settings_.odneat.p_mutate = 0.0;
        settings_.odneat.weight_limit = 0.5;
        settings_.odneat.maturation_cycles = 30;  // longer than the energy lasts
        settings_.odneat.energy_initial = 20.0;
        settings_.odneat.energy_maximum = 40.0;
        settings_.odneat.fitness_period_cycles = 7;
        settings_.energy.item_gain = 12.0;
        settings_.energy.decay = 0.75;
    }

    float clamped(float energy) const {
        return std::clamp(energy, 0.0f, static_cast<float>(settings_.odneat.energy_maximum));
    }

    /// By robot, the item that it picks up in cycle `t`: robots in their order, each the first item
    /// within reach, if it saw one there when it last looked.
    std::vector<std::optional<std::size_t>> picked_up(const watched::Run& run,
                                                      std::size_t t) const {
        auto items = run.moments[t].items;
        const auto seen = naive::items_seen(run, t);
        std::vector<std::optional<std::size_t>> picked;
        for (const watched::Robot& robot : run.moments[t].robots) {
            const auto reaches = [&](const auto& item) {
                return std::hypot(item.x_px - robot.x_px, item.y_px - robot.y_px) <
                       settings_.world.item_reach_px;
            };
            auto& taken = picked.emplace_back();
            if (std::none_of(seen.begin(), seen.end(), [&](const naive::Point& point) {
                    return reaches(watched::Item{point.x, point.y, true});
                })) {
                continue;
            }
            for (std::size_t item = 0; item < items.size() && !taken; ++item) {
                if (items[item].is_present && reaches(items[item])) taken = item;
            }
            if (taken) items[*taken].is_present = false;
        }
        return picked;
    }

    /// The energy that a robot acts with: an item's gain comes first.
    std::vector<float> energies(const watched::Run& run, std::size_t t) const {
        const auto picked = picked_up(run, t);
        std::vector<float> energies;
        for (std::size_t i = 0; i < picked.size(); ++i) {
            const float gain = picked[i] ? static_cast<float>(settings_.energy.item_gain) : 0.0f;
            energies.push_back(clamped(run.moments[t].robots[i].energy + gain));
        }
        return energies;
    }

    Settings settings_;
    Arena arena_ = naive::arena();
};

TEST_P(ControlCycle, EveryInputHasItsPlaceAndScale) {
    const watched::Run run(settings_, arena_);
    Tally headings, moves;
    std::vector<double> steps(run.moments[0].robots.size(), 0.0);
    const double turn = settings_.world.rotation_deg * std::acos(-1.0) / 180.0;
    for (std::size_t t = 0; t + 1 < run.moments.size(); ++t) {
        const auto energy = energies(run, t);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const watched::Robot& now = run.moments[t].robots[i];
            const watched::Robot& next = run.moments[t + 1].robots[i];
            const auto sight = naive::look(settings_, arena_, run, t, i);
            const auto inputs = naive::inputs_of(settings_, sight, energy[i]);
            const auto asked = naive::asked_by(
                settings_,
                naive::outputs_of(*now.genome, settings_.odneat.activation_slope, inputs));
            const double angle = std::atan2(now.heading_y, now.heading_x) + asked.rotation * turn;
            headings.add(std::hypot(next.heading_x - std::cos(angle),
                                    next.heading_y - std::sin(angle)) < 2e-3);
            // One that collides stays where it was, and stands.
            const double limit = settings_.world.acceleration_px;
            steps[i] = std::clamp(asked.translation * settings_.world.translation_px,
                                  steps[i] - limit, steps[i] + limit);
            if (next.x_px == now.x_px && next.y_px == now.y_px) {
                steps[i] = 0.0;
                continue;
            }
            moves.add(std::hypot(next.x_px - now.x_px - steps[i] * next.heading_x,
                                 next.y_px - now.y_px - steps[i] * next.heading_y) < 5e-3);
        }
    }
    headings.expect_agreement(3000, "headings");
    moves.expect_agreement(1000, "moves");
}

TEST_P(ControlCycle, EnergyChangesByWhatTheTaskGives) {
    const watched::Run run(settings_, arena_);
    Tally changes;
    int gains = 0, losses = 0;
    for (std::size_t t = 0; t + 1 < run.moments.size(); ++t) {
        const auto energy = energies(run, t);
        for (std::size_t i = 0; i < energy.size(); ++i) {
            const watched::Robot& now = run.moments[t].robots[i];
            const watched::Robot& next = run.moments[t + 1].robots[i];
            if (now.genome != next.genome) continue;  // see the lives below
            if (settings_.task == Task::collection) {
                const auto decay = static_cast<float>(settings_.energy.decay);
                ASSERT_EQ(next.energy, clamped(energy[i] - decay)) << t << ' ' << i;
            } else {
                const auto sight = naive::look(settings_, arena_, run, t, i);
                const auto inputs = naive::inputs_of(settings_, sight, energy[i]);
                const auto asked = naive::asked_by(
                    settings_,
                    naive::outputs_of(*now.genome, settings_.odneat.activation_slope, inputs));
                const double change =
                    naive::navigation_energy_of(settings_, asked, sight.nearest_obstacle);
                const double expected = clamped(energy[i] + static_cast<float>(change));
                changes.add(std::abs(next.energy - expected) < 0.02);
            }
            gains += next.energy > now.energy;
            losses += next.energy < now.energy;
        }
    }
    if (settings_.task == Task::navigation) changes.expect_agreement(2500, "changes of energy");
    // Equation 2 gains nothing from slow robots, and these are slow.
    if (settings_.energy.navigation == NavigationEnergy::reference) {
        EXPECT_GT(gains, 5);
    }
    EXPECT_GT(losses, 500);
}

TEST_P(ControlCycle, LifeEndsWithoutEnergyAndPastMaturationAndBeginsWithTheInitialOne) {
    const watched::Run run(settings_, arena_);
    const auto initial = static_cast<float>(settings_.odneat.energy_initial);
    std::vector<std::int64_t> ages(run.moments[0].robots.size(), 0);
    std::uint64_t births = 0;
    for (std::size_t t = 0; t + 1 < run.moments.size(); ++t) {
        for (std::size_t i = 0; i < ages.size(); ++i) {
            const watched::Robot& now = run.moments[t].robots[i];
            const watched::Robot& next = run.moments[t + 1].robots[i];
            ++ages[i];
            if (now.genome == next.genome) {
                EXPECT_FALSE(next.energy == 0.0f && ages[i] > settings_.odneat.maturation_cycles);
                continue;
            }
            ++births;
            EXPECT_GT(ages[i], settings_.odneat.maturation_cycles);
            EXPECT_LT(now.energy, 4.0f);  // what one cycle can cost, at most
            EXPECT_EQ(next.energy, initial);
            EXPECT_EQ(next.genome->id.birth, now.genome->id.birth + 1);
            ages[i] = 0;
        }
    }
    EXPECT_GT(births, 20u);
    EXPECT_EQ(run.result.counters.births, births);
}

TEST_P(ControlCycle, FitnessIsTheMeanOfTheEnergyInEachPeriodOfALife) {
    const watched::Run run(settings_, arena_);
    struct Life {
        std::int64_t age = 0;
        std::vector<double> samples;
    };
    std::vector<Life> lives;
    for (const watched::Robot& robot : run.moments[0].robots) lives.push_back({0, {robot.energy}});
    for (std::size_t t = 1; t < run.moments.size(); ++t) {
        for (std::size_t i = 0; i < lives.size(); ++i) {
            const watched::Robot& robot = run.moments[t].robots[i];
            if (robot.genome != run.moments[t - 1].robots[i].genome) {
                lives[i] = {0, {robot.energy}};
            } else if (++lives[i].age % settings_.odneat.fitness_period_cycles == 0) {
                lives[i].samples.push_back(robot.energy);
            }
            double sum = 0.0;
            for (const double energy : lives[i].samples) sum += energy;
            const double mean = sum / static_cast<double>(lives[i].samples.size());
            ASSERT_EQ(robot.fitness, static_cast<float>(mean)) << t << ' ' << i;
            EXPECT_EQ(robot.member(robot.genome->id)->fitness, robot.fitness);
        }
    }
}

class ItemsInACycle : public ControlCycle {};

TEST_P(ItemsInACycle, GoToTheFirstWhoReachesThemAndReappearInTime) {
    settings_.world.item_absence_cycles = 3;
    settings_.world.item_reach_px = 20.0;  // often several at once, and some that just appeared
    const watched::Run run(settings_, arena_);
    int taken = 0, reappeared = 0;
    for (std::size_t t = 0; t + 1 < run.moments.size(); ++t) {
        std::vector<bool> goes(run.moments[t].items.size(), false);
        for (const auto& item : picked_up(run, t)) {
            if (item) goes[*item] = true;
        }
        for (std::size_t item = 0; item < goes.size(); ++item) {
            const watched::Item& now = run.moments[t].items[item];
            const watched::Item& next = run.moments[t + 1].items[item];
            if (now.is_present) {
                ASSERT_EQ(next.is_present, !goes[item]) << t;
            }
            if (!goes[item] || t + 4 >= run.moments.size()) continue;
            ++taken;
            // Gone in the cycle t, it is away for three and stands elsewhere before the next.
            EXPECT_FALSE(run.moments[t + 2].items[item].is_present);
            const watched::Item& later = run.moments[t + 3].items[item];
            EXPECT_TRUE(later.is_present);
            reappeared += std::hypot(later.x_px - now.x_px, later.y_px - now.y_px) > 1.0;
        }
    }
    EXPECT_GT(taken, 10);
    EXPECT_EQ(reappeared, taken);
}

INSTANTIATE_TEST_SUITE_P(
    Tasks, ControlCycle,
    testing::Values(std::pair(Task::navigation, Actuation::translation_rotation),
                    std::pair(Task::navigation, Actuation::wheels),
                    std::pair(Task::collection, Actuation::translation_rotation)));

INSTANTIATE_TEST_SUITE_P(Collection, ItemsInACycle,
                         testing::Values(std::pair(Task::collection,
                                                   Actuation::translation_rotation)));

}  // namespace
}  // namespace gene_clocks::sim
