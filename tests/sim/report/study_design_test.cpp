#include "sim/report/study_design.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/sim/report/sample_input.hpp"

namespace gene_clocks::report {
namespace {

using Pairs = std::map<std::string, std::string>;
using enum sim::Source;
using enum sim::Task;

/// The arms of pairings, by name.
Pairs names_of(const std::vector<Pairing>& pairings) {
    Pairs names;
    for (const auto& [arm, baseline] : pairings)
        names[arm->numbers->arm->name] = baseline->numbers->arm->name;
    return names;
}

std::vector<std::string> keys_of(const Factor& factor) {
    std::vector<std::string> keys;
    for (const experiment::Setting* setting : factor.settings) keys.push_back(setting->key);
    return keys;
}

Input input_of(std::vector<ArmRuns> arms) {
    Input input;
    input.study = "sample";
    input.arms = std::move(arms);
    return input;
}

TEST(StudyDesign, SourcesAloneAreNoFactor) {
    const Input input = sample_study("markings");
    const auto comparisons = compare(input);
    const auto groups = groups_of(comparisons);
    ASSERT_EQ(groups.size(), 2U);
    EXPECT_EQ(groups[0].task, navigation);
    EXPECT_EQ(groups[1].task, collection);
    EXPECT_EQ(groups[0].arms.size(), 9U);
    EXPECT_TRUE(groups[0].factors.empty());
    EXPECT_EQ(groups[0].baseline, gene_clock);
    const Pairs pairs = names_of(pair_treatments(groups[0]));
    EXPECT_EQ(pairs.size(), 8U);
    for (const auto& [arm, baseline] : pairs) EXPECT_EQ(baseline, "navigation-gene-clock") << arm;
    EXPECT_TRUE(pair_conditions(groups[0]).empty());
}

TEST(StudyDesign, ASweepIsComparedUnderEachConditionAndWithItsBase) {
    const Input input = sample_study("loss");
    const auto comparisons = compare(input);
    const Group group = groups_of(comparisons).front();
    ASSERT_EQ(group.factors.size(), 1U);
    EXPECT_EQ(keys_of(group.factors[0]), std::vector<std::string>{"radio.loss"});
    EXPECT_EQ(group.factors[0].levels.size(), 3U);
    EXPECT_EQ(group.factors[0].base, 0U);
    EXPECT_FALSE(group.is_treatment(group.factors[0]));
    const Pairs treatments = names_of(pair_treatments(group));
    EXPECT_EQ(treatments.size(), 6U);
    EXPECT_EQ(treatments.at("navigation-timestamp-radio.loss=0.5"),
              "navigation-gene-clock-radio.loss=0.5");
    const Pairs conditions = names_of(pair_conditions(group));
    EXPECT_EQ(conditions.size(), 6U);
    EXPECT_EQ(conditions.at("navigation-timestamp-radio.loss=0.99"),
              "navigation-timestamp-radio.loss=0");
}

TEST(StudyDesign, WhatHasNoCounterpartIsComparedWithTheOneAtTheBase) {
    const Input input = sample_study("drift");
    const auto comparisons = compare(input);
    const Group group = groups_of(comparisons).front();
    EXPECT_EQ(group.factors.size(), 2U);
    const Pairs treatments = names_of(pair_treatments(group));
    EXPECT_EQ(treatments.size(), 4U);
    for (const auto& [arm, baseline] : treatments)
        EXPECT_EQ(baseline, "navigation-gene-clock") << arm;
    EXPECT_EQ(pair_conditions(group).size(), 3U);
}

TEST(StudyDesign, ChoicesOfASingleSourceAreComparedUnderTheOtherSettings) {
    const Input input = sample_study("operators");
    const auto comparisons = compare(input);
    const Group group = groups_of(comparisons).front();
    EXPECT_FALSE(group.baseline);
    ASSERT_EQ(group.factors.size(), 3U);
    for (const Factor& factor : group.factors)
        EXPECT_EQ(group.is_treatment(factor), !factor.is_numeric());
    const auto treatments = pair_treatments(group);
    EXPECT_EQ(treatments.size(), 6U);
    for (const auto& [arm, baseline] : treatments) {
        const sim::Settings& held = baseline->numbers->arm->settings;
        EXPECT_EQ(held.odneat.crossover, neat::CrossoverKind::uniform);
        EXPECT_EQ(held.odneat.mismatch, neat::Mismatch::excess_disjoint);
        EXPECT_EQ(held.odneat.p_mate, arm->numbers->arm->settings.odneat.p_mate);
    }
}

TEST(StudyDesign, ChoicesAreConditionsWhereSourcesAreCompared) {
    std::vector<ArmRuns> arms;
    for (const char* mismatch : {"odneat.mismatch=excess-disjoint", "odneat.mismatch=age"})
        for (const sim::Source source : {gene_clock, timestamp})
            arms.push_back(short_arm(navigation, source, {mismatch}));
    const Input input = input_of(std::move(arms));
    const auto comparisons = compare(input);
    const Group group = groups_of(comparisons).front();
    ASSERT_EQ(group.factors.size(), 1U);
    EXPECT_FALSE(group.is_treatment(group.factors[0]));
    EXPECT_EQ(names_of(pair_treatments(group)),
              (Pairs{{"navigation-timestamp-odneat.mismatch=excess-disjoint",
                      "navigation-gene-clock-odneat.mismatch=excess-disjoint"},
                     {"navigation-timestamp-odneat.mismatch=age",
                      "navigation-gene-clock-odneat.mismatch=age"}}));
}

// Sizes with their scale: one factor, named by the number that comes first; a repeated scale does
// not part them.
TEST(StudyDesign, SettingsThatGoAlongAreOneFactor) {
    std::vector<ArmRuns> arms;
    for (const auto& [robots, scale] :
         {std::pair{"10", "0.5"}, std::pair{"100", "1.0"}, std::pair{"120", "1.0"}})
        arms.push_back(short_arm(
            navigation, gene_clock,
            {std::string("world.robots=") + robots, std::string("world.arena_scale=") + scale}));
    const Input input = input_of(std::move(arms));
    const auto comparisons = compare(input);
    const Group group = groups_of(comparisons).front();
    ASSERT_EQ(group.factors.size(), 1U);
    EXPECT_EQ(keys_of(group.factors[0]),
              (std::vector<std::string>{"world.robots", "world.arena_scale"}));
    EXPECT_EQ(group.factors[0].base, 1U);  // 100 robots, as the profile has it
}

// Whichever of them comes first in the table of settings.
TEST(StudyDesign, ACountNamesWhatGoesAlongWithIt) {
    const Input input = input_of(
        {short_arm(navigation, gene_clock, {"world.arena_scale=0.5", "world.robots=25"}),
         short_arm(navigation, gene_clock, {"world.arena_scale=1.0", "world.robots=100"})});
    const auto comparisons = compare(input);
    const Group group = groups_of(comparisons).front();
    ASSERT_EQ(group.factors.size(), 1U);
    EXPECT_EQ(keys_of(group.factors[0]),
              (std::vector<std::string>{"world.robots", "world.arena_scale"}));
}

TEST(StudyDesign, LevelsOfNumbersAscendAndTheFirstArmIsTheBaseWhereNoneIsUsual) {
    std::vector<ArmRuns> arms;
    for (const char* loss : {"radio.loss=0.9", "radio.loss=0.1", "radio.loss=0.5"})
        arms.push_back(short_arm(navigation, timestamp, {loss}));
    const Input input = input_of(std::move(arms));
    const auto comparisons = compare(input);
    const Group group = groups_of(comparisons).front();
    const Factor& factor = group.factors.at(0);
    EXPECT_EQ(std::get<double>(factor.levels[0][0]), 0.1);
    EXPECT_EQ(std::get<double>(factor.levels[2][0]), 0.9);
    EXPECT_EQ(factor.base, 2U);
    EXPECT_EQ(group.arms[0].levels, std::vector<std::size_t>{2});
}

TEST(StudyDesign, NamedParameterSetsPartAGroup) {
    const Input input = sample_input();
    const auto comparisons = compare(input);
    const auto groups = groups_of(comparisons);
    ASSERT_EQ(groups.size(), 3U);
    EXPECT_EQ(groups[0].parameters, "B");
    EXPECT_EQ(groups[1].parameters, "C");
    EXPECT_EQ(groups[2].parameters, "A");
    for (const Group& group : groups) EXPECT_TRUE(group.factors.empty());
}

}  // namespace
}  // namespace gene_clocks::report
