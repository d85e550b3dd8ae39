#include "sim/report/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sim/settings/input_error.hpp"
#include "sim/statistics/quantiles.hpp"
#include "tests/sim/report/sample_input.hpp"

namespace gene_clocks::report {
namespace {

using experiment::InputError;

TEST(Comparison, ArmsThatDifferInTheSourceAloneBelongTogether) {
    Input input = sample_input();
    std::ranges::reverse(input.arms);
    const auto comparisons = compare(input);
    ASSERT_EQ(comparisons.size(), 3U);
    for (const Comparison& comparison : comparisons) {
        ASSERT_EQ(comparison.arms.size(), 2U);
        EXPECT_EQ(comparison.arms[0].arm->settings.source, sim::Source::gene_clock);
        EXPECT_EQ(comparison.arms[1].arm->settings.source, sim::Source::timestamp);
    }
}

TEST(Comparison, OneMoreDifferenceKeepsArmsApart) {
    Input input = sample_input();
    input.arms.resize(2);
    input.arms[1].settings.radio.loss = 0.5;
    EXPECT_EQ(compare(input).size(), 2U);
    input.arms[1].settings.radio.loss = 0.0;
    EXPECT_EQ(compare(input).size(), 1U);
    input.arms[1].profile = "mended";
    EXPECT_EQ(compare(input).size(), 2U);
}

TEST(Comparison, TheParametersGiveTheRole) {
    const auto role = [](sim::Task task, const char* parameters) {
        Input input;
        input.arms.push_back(sample_arm({.task = task, .parameters = parameters, .runs = 1}));
        return compare(input).front();
    };
    EXPECT_EQ(role(sim::Task::navigation, "B").role, Role::as_run);
    EXPECT_EQ(role(sim::Task::navigation, "A").role, Role::as_printed);
    EXPECT_EQ(role(sim::Task::navigation, "C").role, Role::other);
    EXPECT_EQ(role(sim::Task::collection, "C").role, Role::as_run);
    EXPECT_EQ(role(sim::Task::collection, "B").role, Role::as_printed);
    EXPECT_EQ(role(sim::Task::collection, "B").parameters, "B");

    Input changed;
    changed.arms.push_back(sample_arm({.runs = 1}));
    changed.arms[0].settings.odneat.sigma += 0.001;
    EXPECT_EQ(compare(changed).front().role, Role::other);
    EXPECT_EQ(compare(changed).front().parameters, "");
}

TEST(Comparison, TheTargetComesFromTheBestOfBothMethods) {
    Input input;
    input.arms.push_back(sample_arm({.level = 120.0}));
    input.arms.push_back(sample_arm({.source = sim::Source::timestamp, .level = 190.0}));
    double best = 0.0;
    for (const report::Run& run : input.arms[1].runs)
        for (const sim::Sample& sample : run.result.samples)
            best = std::max(best, sample.swarm_fitness);
    const Comparison comparison = compare(input).front();
    EXPECT_EQ(comparison.best.value, best);
    // No run at 120 ever gets near nine tenths of 190.
    const auto last = static_cast<double>(input.arms[0].runs[0].result.samples.back().cycle);
    const ArmNumbers& low = *comparison.arm(sim::Source::gene_clock);
    EXPECT_EQ(low.values.at("t_f"), std::vector<double>(6, last));
    EXPECT_EQ(low.values.at("f_a"), std::vector<double>(6, 0.0));
    const ArmNumbers& high = *comparison.arm(sim::Source::timestamp);
    EXPECT_LT(statistics::median(high.values.at("t_f")), last);
    EXPECT_GT(statistics::median(high.values.at("f_a")), 0.0);
}

TEST(Comparison, RunsAreInTheOrderOfTheirSeeds) {
    Input input;
    input.arms.push_back(sample_arm({}));
    std::swap(input.arms[0].runs[0], input.arms[0].runs[4]);
    const ArmNumbers numbers = compare(input).front().arms.front();
    EXPECT_TRUE(std::ranges::is_sorted(numbers.runs, {}, &report::Run::seed));
    EXPECT_EQ(numbers.values.at("final_swarm_fitness")[4],
              numbers.runs[4]->result.samples.back().swarm_fitness);
}

TEST(Comparison, HalvesOfSharedSeedsShareNone) {
    Input input;
    input.arms.push_back(sample_arm({.first_seed = 1, .runs = 5}));  // 1 … 5
    input.arms.push_back(
        sample_arm({.source = sim::Source::timestamp, .first_seed = 3, .runs = 5}));  // 3 … 7
    const Comparison comparison = compare(input).front();
    const auto halves =
        independent_halves(comparison.arms[0], comparison.arms[1], "final_swarm_fitness");
    ASSERT_TRUE(halves);
    const auto ends = [&](std::size_t arm, std::initializer_list<std::size_t> runs) {
        std::vector<double> values;
        for (const std::size_t run : runs)
            values.push_back(input.arms[arm].runs[run].result.samples.back().swarm_fitness);
        return values;
    };
    EXPECT_EQ(halves->first, ends(0, {0, 1, 2, 4}));  // seeds 1, 2, 3 and 5
    EXPECT_EQ(halves->second, ends(1, {1, 3, 4}));    // seeds 4, 6 and 7
}

TEST(Comparison, NoHalvesWithoutSharedSeedsOrWithOneRunEach) {
    Input input;
    input.arms.push_back(sample_arm({.first_seed = 1, .runs = 3}));
    input.arms.push_back(
        sample_arm({.source = sim::Source::timestamp, .first_seed = 4, .runs = 3}));
    const Comparison apart = compare(input).front();
    EXPECT_FALSE(independent_halves(apart.arms[0], apart.arms[1], "f_c"));
    for (ArmRuns& arm : input.arms) {
        arm.runs.resize(1);
        arm.runs[0].seed = 1;
    }
    const Comparison single = compare(input).front();
    EXPECT_FALSE(independent_halves(single.arms[0], single.arms[1], "f_c"));
}

TEST(Comparison, TrajectoriesAreComparedSeedBySeed) {
    Input input;
    input.arms.push_back(sample_arm({.runs = 4}));  // 1 … 4
    input.arms.push_back(sample_arm({.source = sim::Source::timestamp, .first_seed = 2}));  // 2 … 7
    sim::RunResult& parted = input.arms[1].runs[1].result;
    parted.trajectory_hash += 1;
    parted.samples[7].species += 0.5;
    const Comparison comparison = compare(input).front();
    const SharedTrajectories shared = share_trajectories(comparison.arms[0], comparison.arms[1]);
    EXPECT_EQ(shared.pairs, 3U);
    EXPECT_EQ(shared.identical, 2U);
    EXPECT_EQ(shared.first_difference_cycles, std::vector<double>{700.0});
}

TEST(Comparison, RunsThatDoNotFitTogetherAreRefused) {
    const auto expect_refused = [](auto&& spoil, const std::string& why) {
        Input input = sample_input();
        spoil(input.arms[0].runs[2].result.samples, input.arms[0].runs[2]);
        try {
            compare(input);
            ADD_FAILURE() << "accepted: " << why;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("navigation-B-gene-clock"), std::string::npos)
                << error.what();
        }
    };
    using Samples = std::vector<sim::Sample>;
    expect_refused([](Samples& samples, report::Run&) { samples.clear(); }, "no samples");
    expect_refused([](Samples& samples, report::Run&) { samples.pop_back(); }, "other cycles");
    expect_refused([](Samples& samples, report::Run&) { std::swap(samples[1], samples[2]); },
                   "order");
    expect_refused(
        [](Samples& samples, report::Run&) {
            samples[3].species = std::numeric_limits<double>::quiet_NaN();
        },
        "not a number");
    expect_refused([](Samples&, report::Run& run) { run.seed = 2; },
                   "seed 2: the seed occurs twice");
}

TEST(Comparison, WithoutRunsThereIsNoReport) {
    Input input = sample_input();
    for (ArmRuns& arm : input.arms) arm.runs.clear();
    EXPECT_THROW(compare(input), InputError);
    input.arms.clear();
    EXPECT_THROW(compare(input), InputError);
}

}  // namespace
}  // namespace gene_clocks::report
