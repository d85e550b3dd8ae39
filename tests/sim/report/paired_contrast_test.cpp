#include "sim/report/paired_contrast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "sim/report/contrast.hpp"
#include "sim/settings/input_error.hpp"
#include "tests/sim/report/sample_input.hpp"

namespace gene_clocks::report {
namespace {

using experiment::InputError;
using enum sim::Task;
using enum sim::Source;

using Changes = std::vector<std::string>;

constexpr const char* losses[] = {"radio.loss=0", "radio.loss=0.5", "radio.loss=0.9"};

/// An arm whose every value of a seed is `higher` than that of an arm of level 140 with that seed.
ArmRuns arm_of(sim::Source source, const std::string& loss, std::uint64_t seeds,
               double higher = 0.0) {
    ArmRuns arm = short_arm(navigation, source, {loss});
    arm.runs.clear();
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Run run = sample_run(arm.settings, 140.0, seed);
        for (sim::Sample& sample : run.result.samples) sample.swarm_fitness += higher;
        if (higher != 0.0) ++run.result.trajectory_hash;
        arm.runs.push_back(std::move(run));
    }
    return arm;
}

/// Gene clocks and timestamps under every loss, the latter higher by so much.
Input sweep(const std::vector<double>& higher, std::uint64_t seeds) {
    Input input;
    input.study = "sweep";
    for (std::size_t i = 0; i < higher.size(); ++i) {
        input.arms.push_back(arm_of(gene_clock, losses[i], seeds));
        input.arms.push_back(arm_of(timestamp, losses[i], seeds, higher[i]));
    }
    return input;
}

TEST(PairedContrast, PutsTogetherWhatChangesTheSame) {
    Input input = sweep({0.0, 0.0, 0.0}, 4);
    input.arms.push_back(arm_of(global_counter, losses[1], 4));
    for (const sim::Source source : {gene_clock, timestamp})
        input.arms.push_back(short_arm(collection, source, {}));
    const auto paired = contrast(input, {}).paired;
    ASSERT_EQ(paired.size(), 3U);
    EXPECT_EQ(paired[0].changes, Changes{"source=timestamp"});
    EXPECT_EQ(paired[0].arms, 3U);
    EXPECT_EQ(paired[0].seeds, 4U);
    EXPECT_EQ(paired[0].identical, 12U);
    EXPECT_EQ(paired[1].changes, Changes{"source=global-counter"});
    EXPECT_EQ(paired[1].arms, 1U);
    EXPECT_EQ(paired[1].family, Family(navigation, "mended"));
    EXPECT_EQ(paired[2].family, Family(collection, "mended"));
    EXPECT_EQ(paired[2].arms, 1U);
    EXPECT_EQ(paired[2].seeds, 3U);
}

TEST(PairedContrast, OfASeedIsTheMeanOverTheArms) {
    const auto found = contrast(sweep({1.0, 2.0, 6.0}, 5), {}).paired.front();
    EXPECT_EQ(found.identical, 0U);
    EXPECT_NEAR(found.test.mean, 3.0, 1e-9);
    EXPECT_NEAR(found.test.interval.lower, 3.0, 1e-9);  // each seed says the same
    EXPECT_NEAR(found.test.interval.upper, 3.0, 1e-9);
    EXPECT_NEAR(found.margin, 0.05 * found.baseline_mean, 0.01 * found.margin);
}

// What scatters far more between seeds than arms differ: only pairs can tell.
TEST(PairedContrast, SeesWhatTestsOfSingleArmsCannot) {
    const ContrastPlan plan{.margin_share = 0.005};
    const Input input = sweep({0.1, 0.2, 0.0}, 10);
    const Contrasts found = contrast(input, plan);
    for (const Contrast& arm : found.arms)
        EXPECT_EQ(arm.verdict, ContrastVerdict::undecided) << arm.arm->name;
    EXPECT_EQ(found.paired.front().verdict, ContrastVerdict::small);
    const auto verdict_of_sweep = [&](const std::vector<double>& higher) {
        return contrast(sweep(higher, 10), plan).paired.front().verdict;
    };
    EXPECT_EQ(verdict_of_sweep({0.0, 0.0, 0.0}), ContrastVerdict::identical);
    EXPECT_EQ(verdict_of_sweep({30.0, 0.0, 0.0}), ContrastVerdict::different);
}

TEST(PairedContrast, TakesOnlySeedsThatAllArmsHold) {
    Input input = sweep({0.0, 0.0}, 6);
    input.arms[0].runs.erase(input.arms[0].runs.begin());  // a baseline lacks seed 1,
    input.arms[3].runs.erase(input.arms[3].runs.begin());  // as an arm does,
    input.arms[3].runs.pop_back();                         // which lacks seed 6, too
    const auto paired = contrast(input, {}).paired;
    ASSERT_EQ(paired.size(), 1U);
    EXPECT_EQ(paired[0].seeds, 4U);
    EXPECT_EQ(paired[0].identical, 8U);
    input.arms[0].runs.erase(input.arms[0].runs.begin(), input.arms[0].runs.begin() + 3);
    EXPECT_EQ(contrast(input, {}).paired.size(), 0U);  // seed 5 alone
}

TEST(PairedContrast, GoesOverConditionsThatItIsGiven) {
    Input input;
    input.study = "conditions";
    for (const char* loss : losses) input.arms.push_back(arm_of(timestamp, loss, 4));
    const ContrastPlan each{.baseline = {"radio.loss=0"}};
    const auto by_loss = contrast(input, each).paired;
    ASSERT_EQ(by_loss.size(), 2U);
    EXPECT_EQ(by_loss[0].changes, Changes{"radio.loss=0.5"});
    EXPECT_EQ(by_loss[1].changes, Changes{"radio.loss=0.9"});
    ContrastPlan all = each;
    all.over = {"radio.loss"};
    const auto together = contrast(input, all).paired;
    ASSERT_EQ(together.size(), 1U);
    EXPECT_EQ(together[0].changes, Changes{});
    EXPECT_EQ(together[0].arms, 2U);
}

TEST(PairedContrast, IsCorrectedWithinItsFamily) {
    Input input;
    input.study = "families";
    for (const sim::Source source : {gene_clock, timestamp, global_counter})
        input.arms.push_back(arm_of(source, losses[0], 8, source == timestamp ? 0.3 : 0.0));
    for (ArmRuns& arm : input.arms) {  // seeds that do not all say the same
        for (std::size_t i = 0; i < arm.runs.size(); ++i)
            for (sim::Sample& sample : arm.runs[i].result.samples)
                sample.swarm_fitness += arm.settings.source == gene_clock ? 0.0 : 0.1 * double(i);
    }
    Input alone = input;
    alone.arms.pop_back();
    const auto two = contrast(input, {}).paired;
    const auto one = contrast(alone, {}).paired;
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(one[0].difference_p_corrected, one[0].difference_p_value);
    EXPECT_EQ(two[0].difference_p_value, one[0].difference_p_value);
    EXPECT_GT(one[0].difference_p_value, 0.0);
    EXPECT_DOUBLE_EQ(two[0].difference_p_corrected, 2.0 * one[0].difference_p_value);
}

TEST(PairedContrast, WhatSharesNoSeedsIsNamed) {
    Input input = sweep({0.0, 0.0}, 3);
    for (report::Run& run : input.arms[1].runs) run.seed += 10;
    for (report::Run& run : input.arms[3].runs) run.seed += 10;
    const Contrasts found = contrast(input, {});
    EXPECT_EQ(found.arms.size(), 2U);
    EXPECT_TRUE(found.paired.empty());
    ASSERT_EQ(found.left_out.size(), 1U);
    EXPECT_NE(found.left_out[0].find("fewer than two seeds"), std::string::npos);
}

}  // namespace
}  // namespace gene_clocks::report
