#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <gene_clocks/sim/simulation.hpp>
#include <vector>

#include "sim/core/src/task.hpp"
#include "sim/experiment/study/study.hpp"
#include "sim/settings/arena_file.hpp"
#include "sim/settings/profile.hpp"

// Section 4, Experiments. Where the published runs differed from the text, the profile "text" has
// the text; docs/deviations.md lists the differences.

namespace gene_clocks::sim {
namespace {

Settings text_settings(Task task, std::optional<std::string> parameters = {}) {
    return experiment::select(
        {.task = task, .profile = "text", .parameters = std::move(parameters)});
}

/// A short run in which no genome changes.
RunResult short_run(Settings settings, std::int64_t cycles) {
    settings.run.cycles = cycles;
    settings.odneat.p_mutate = 0.0;
    return simulate(settings, experiment::find_arena(settings.world.arena), 1).value();
}

/// ΔE/Δt of a robot whose wheels turn at these velocities, from −½ (full speed back) to ½.
double energy_of(double v_l, double v_r, double d) {
    const std::array<float, 1> output_0{static_cast<float>(v_l + 0.5)};
    const std::array<float, 1> output_1{static_cast<float>(v_r + 0.5)};
    std::array<float, 1> translation{};
    std::array<float, 1> rotation{};
    const Commands commands{1, output_0.data(), output_1.data(), translation.data(),
                            rotation.data()};
    interpret_outputs(Actuation::wheels, commands);
    const std::array<float, 1> nearest_obstacle{static_cast<float>(1.0 - d)};
    std::array<float, 1> energy_change{};
    navigation_energy(NavigationEnergy::equation_2, commands, nearest_obstacle.data(),
                      energy_change.data());
    return energy_change[0];
}

// Equation 2: "ΔE/Δt = f_n(|v_l + v_r| · (1 − √|v_l − v_r|) · (1 − d))", "The f_n function is a
// linear mapping from the interval [0, 1] to [−1, 1]."
TEST(Section41, NavigationEnergyIsEquation2) {
    for (double v_l = -0.5; v_l <= 0.5; v_l += 0.125) {
        for (double v_r = -0.5; v_r <= 0.5; v_r += 0.125) {
            for (double d = 0.0; d <= 1.0; d += 0.25) {
                const double x =
                    std::abs(v_l + v_r) * (1.0 - std::sqrt(std::abs(v_l - v_r))) * (1.0 - d);
                EXPECT_NEAR(energy_of(v_l, v_r, d), 2.0 * x - 1.0, 1e-5)
                    << v_l << ' ' << v_r << ' ' << d;
            }
        }
    }
}

// "if a robot moves fast, straight and far from obstacles it will gain energy, and it will lose
// energy otherwise"
TEST(Section41, FastStraightAndFarFromObstaclesGainsEnergy) {
    EXPECT_NEAR(energy_of(0.5, 0.5, 0.0), 1.0, 1e-6);
    EXPECT_LT(energy_of(0.1, 0.1, 0.0), 0.0);   // slow
    EXPECT_LT(energy_of(0.5, 0.0, 0.0), 0.0);   // not straight
    EXPECT_LT(energy_of(0.5, -0.5, 0.0), 0.0);  // on the spot
    EXPECT_LT(energy_of(0.5, 0.5, 0.9), 0.0);   // near an obstacle
}

// Equation 3: "ΔE/Δt = −0.1 + 10 · c(t)", "At each time step, the robot loses 0.1 energy units, and
// when it picks up an item, it gains 10 units."
TEST(Section41, CollectionEnergyIsEquation3) {
    Settings settings = text_settings(Task::collection);
    EXPECT_EQ(settings.energy.decay, 0.1);
    EXPECT_EQ(settings.energy.item_gain, 10.0);
    // Items of no effect: the energy falls from 100 to 90 in 100 cycles, sampled every ten.
    settings.energy.item_gain = 0.0;
    EXPECT_NEAR(short_run(settings, 101).samples.back().swarm_fitness, 95.0, 1e-3);
    // Each item is worth its gain: without decay, F_s rises in proportion.
    settings.energy.decay = 0.0;
    settings.energy.item_gain = 1e-3;
    const double small = short_run(settings, 101).samples.back().swarm_fitness - 100.0;
    settings.energy.item_gain = 2e-3;
    const double twice = short_run(settings, 101).samples.back().swarm_fitness - 100.0;
    EXPECT_GT(small, 0.0);
    EXPECT_NEAR(twice / small, 2.0, 0.2);
}

// "initialized with a bias neuron and as many inputs as there are sensors (9 in the case of
// navigation and 17 in the case of item collection). The two outputs […]"
TEST(Section41, ControllersStartWithAsManyInputsAsSensorsAndABias) {
    const auto size = [](Task task) {
        return short_run(text_settings(task), 100).samples.front().controller_size;
    };
    EXPECT_EQ(size(Task::navigation), (9 + 1) + 2 + (9 + 1) * 2);
    EXPECT_EQ(size(Task::collection), (17 + 1) + 2 + (17 + 1) * 2);
}

// "The energy level of the new genome is reset to the default value of 100 units, its maximal value
// being 200 units."
TEST(Section41, EnergyStartsAt100AndEndsAt200) {
    for (const Task task : {Task::navigation, Task::collection}) {
        EXPECT_EQ(text_settings(task).odneat.energy_initial, 100.0);
        EXPECT_EQ(text_settings(task).odneat.energy_maximum, 200.0);
    }
}

// "In the experiments, 75 items are randomly placed in the environment." "100 robots were deployed"
// "for 40000 cycles in the navigation task and 60000 cycles in the collection task"
TEST(Section41, TheExperimentsHaveThePapersScale) {
    for (const char* profile : {"gecco15", "text"}) {
        const auto navigation = experiment::select({.task = Task::navigation, .profile = profile});
        const auto collection = experiment::select({.task = Task::collection, .profile = profile});
        EXPECT_EQ(navigation.world.robots, 100);
        EXPECT_EQ(collection.world.robots, 100);
        EXPECT_EQ(collection.world.items, 75);
        EXPECT_EQ(navigation.run.cycles, 40'000);
        EXPECT_EQ(collection.run.cycles, 60'000);
    }
}

// "We performed 64 independent runs for both innovation marking methods in both tasks."
TEST(Section41, TheStudyHas64RunsOfBothMethodsInBothTasks) {
    for (const char* name : {"gecco15", "gecco15-as-printed"}) {
        const auto study =
            experiment::read_study(experiment::find_document(experiment::Builtin::study, name));
        EXPECT_EQ(study.seeds, 64);
        std::vector<std::pair<Task, Source>> arms;
        for (const auto& arm : study.arms)
            arms.emplace_back(arm.settings.task, arm.settings.source);
        const std::vector<std::pair<Task, Source>> expected{{Task::navigation, Source::gene_clock},
                                                            {Task::navigation, Source::timestamp},
                                                            {Task::collection, Source::gene_clock},
                                                            {Task::collection, Source::timestamp}};
        EXPECT_EQ(arms, expected);
    }
}

// "Every 100 cycles, we measure"
TEST(Section41, SamplesAreTakenEvery100Cycles) {
    const auto samples = short_run(text_settings(Task::navigation), 1000).samples;
    ASSERT_EQ(samples.size(), 10u);
    for (std::size_t i = 1; i < samples.size(); ++i) {
        EXPECT_EQ(samples[i].cycle - samples[i - 1].cycle, 100);
    }
}

// Figure 2: "the average accumulated swarm fitness, f_c, the fixed budget swarm fitness, f_b, the
// time to reach target g_f, and the accumulated fitness above target, f_a"
TEST(Section41, TheFourMeasuresOfFigure2) {
    std::vector<Sample> samples;
    for (int i = 0; i < 20; ++i) {  // of 2000 cycles
        samples.push_back({.cycle = 100 * i, .swarm_fitness = i < 15 ? 10.0 * i : 150.0 - i});
    }
    const Measures measures = measure(samples, {.accumulated_share = 0.10,
                                                .budget_share = 0.90,
                                                .target_share = 0.50,
                                                .best_fitness = 260.0});
    EXPECT_DOUBLE_EQ(measures.f_c, (132.0 + 131.0) / 2.0);  // the last tenth: from cycle 1800 on
    EXPECT_DOUBLE_EQ(measures.f_b, 132.0);                  // at cycle 1800
    EXPECT_DOUBLE_EQ(measures.t_f, 1300.0);                 // the first of at least 130
    EXPECT_DOUBLE_EQ(measures.f_a, 10.0 + (5.0 + 4.0 + 3.0 + 2.0 + 1.0));
}

// Table 1: "Summary of the tuned and fixed parameters of odNEAT in our experiments"
TEST(Section41, TheParametersAreThoseOfTable1) {
    const auto navigation = text_settings(Task::navigation, "A").odneat;
    EXPECT_EQ(navigation.p_mate, 0.842);
    EXPECT_EQ(navigation.p_mutate, 0.154);
    EXPECT_EQ(navigation.p_weight, 0.575);
    EXPECT_EQ(navigation.p_node, 0.057);
    EXPECT_EQ(navigation.p_connection, 0.184);
    EXPECT_EQ(navigation.p_recurrent, 0.376);
    EXPECT_EQ(navigation.sigma, 0.442);
    EXPECT_EQ(navigation.maturation_cycles, 19);
    EXPECT_EQ(navigation.population, 5);
    const auto collection = text_settings(Task::collection, "B").odneat;
    EXPECT_EQ(collection.p_mate, 0.212);
    EXPECT_EQ(collection.p_mutate, 0.244);
    EXPECT_EQ(collection.p_weight, 0.559);
    EXPECT_EQ(collection.p_node, 0.422);
    EXPECT_EQ(collection.p_connection, 0.275);
    EXPECT_EQ(collection.p_recurrent, 0.526);
    EXPECT_EQ(collection.sigma, 0.114);
    EXPECT_EQ(collection.maturation_cycles, 27);
    EXPECT_EQ(collection.population, 7);
    for (const auto& settings : {navigation, collection}) {
        EXPECT_EQ(settings.c_excess, 0.5);
        EXPECT_EQ(settings.c_disjoint, 1.5);
        EXPECT_EQ(settings.c_weight, 0.4);
    }
}

}  // namespace
}  // namespace gene_clocks::sim
