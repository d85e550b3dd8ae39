#include "sim/experiment/study/run_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/sim/experiment/example_study.hpp"
#include "tests/sim/experiment/expect_input_error.hpp"

namespace gene_clocks::experiment {
namespace {

using test::example_study;
using test::input_error;

std::set<RunKey> keys(const std::vector<PlannedRun>& planned_runs) {
    std::set<RunKey> all;
    for (const PlannedRun& planned : planned_runs) all.emplace(planned.settings_hash, planned.seed);
    return all;
}

TEST(RunPlan, HasEveryArmWithEverySeed) {
    const Study study = example_study();
    const auto planned_runs = plan_runs(study);
    ASSERT_EQ(planned_runs.size(), 10U);
    std::set<RunKey> expected;
    for (const Arm& arm : study.arms) {
        for (std::uint64_t seed = 3; seed < 8; ++seed) expected.emplace(arm.settings_hash, seed);
    }
    EXPECT_EQ(keys(planned_runs), expected);
    EXPECT_EQ(planned_runs.front().settings, &study.arms[0].settings);
    EXPECT_EQ(planned_runs.front().name, "arm one, seed 3");
}

TEST(RunPlan, ArmsWithTheSameSettingsShareTheirRuns) {
    Study study = example_study();
    study.arms.push_back(study.arms[0]);
    study.arms.back().name = "three";
    EXPECT_EQ(plan_runs(study).size(), 10U);
    std::size_t in_shards = 0;
    for (const std::int64_t i : {1, 2, 3}) in_shards += plan_runs(study, {i, 3}).size();
    EXPECT_EQ(in_shards, 10U);
}

/// A study of so many arms that differ in their hashes alone.
Study study_of(std::size_t arms, std::int64_t seeds) {
    Study study = example_study();
    study.seeds = seeds;
    study.arms.resize(arms, study.arms[0]);
    for (std::size_t i = 0; i < arms; ++i) study.arms[i].settings_hash = std::to_string(i);
    return study;
}

RC_GTEST_PROP(Shards, AreDisjointAndCoverAllAndAreBalancedOverArms, ()) {
    const auto arms = *rc::gen::inRange<std::size_t>(1, 20);
    const auto seeds = *rc::gen::inRange<std::int64_t>(1, 40);
    const auto count = *rc::gen::inRange<std::int64_t>(1, 60);
    const Study study = study_of(arms, seeds);
    const auto all = keys(plan_runs(study));
    std::set<RunKey> seen;
    std::vector<std::size_t> sizes;
    std::map<std::string, std::vector<std::int64_t>> of_arm;
    for (std::int64_t index = 1; index <= count; ++index) {
        const auto planned_runs = plan_runs(study, {index, count});
        RC_ASSERT(keys(plan_runs(study, {index, count})) == keys(planned_runs));
        sizes.push_back(planned_runs.size());
        for (auto& [hash, counts] : of_arm) counts.push_back(0);
        for (const PlannedRun& planned : planned_runs) {
            RC_ASSERT(seen.emplace(planned.settings_hash, planned.seed).second);
            auto& counts = of_arm[planned.settings_hash];
            counts.resize(static_cast<std::size_t>(index));
            ++counts.back();
        }
    }
    RC_ASSERT(seen == all);
    const auto spread = [](const auto& values) {
        const auto [least, most] = std::ranges::minmax(values);
        return most - least;
    };
    RC_ASSERT(spread(sizes) <= 1U);
    for (const auto& [hash, counts] : of_arm) RC_ASSERT(spread(counts) <= 1);
}

TEST(Shards, AreReadFromText) {
    EXPECT_EQ(parse_shard("1/1"), (Shard{1, 1}));
    EXPECT_EQ(parse_shard("2/4"), (Shard{2, 4}));
    EXPECT_EQ(parse_shard("1000000/1000000"), (Shard{1'000'000, 1'000'000}));
    for (const char* text : {"",
                             "/",
                             "1",
                             "1/",
                             "/4",
                             "0/4",
                             "5/4",
                             "-1/4",
                             "1/0",
                             "1/-4",
                             "a/b",
                             "1/4/2",
                             "1 /4",
                             " 1/4",
                             "1/4 ",
                             "+1/4",
                             "1.0/4",
                             "1/1000001",
                             "99999999999999999999/4",
                             "0x1/4"}) {
        EXPECT_THAT(input_error([&] { parse_shard(text); }),
                    testing::StartsWith("--shard: \"" + std::string(text) + "\" is no part"));
    }
}

}  // namespace
}  // namespace gene_clocks::experiment
