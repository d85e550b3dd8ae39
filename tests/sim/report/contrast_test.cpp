#include "sim/report/contrast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "sim/settings/input_error.hpp"
#include "sim/statistics/mann_whitney.hpp"
#include "tests/sim/report/sample_input.hpp"

namespace gene_clocks::report {
namespace {

using experiment::InputError;
using enum sim::Task;
using enum sim::Source;

Input input_of(const std::vector<SampleArm>& arms) {
    Input input;
    input.study = "sample";
    for (const SampleArm& arm : arms) input.arms.push_back(sample_arm(arm));
    return input;
}

std::vector<double> final_fitness(const ArmRuns& arm) {
    std::vector<double> values;
    for (const Run& run : arm.runs) values.push_back(run.result.samples.back().swarm_fitness);
    return values;
}

TEST(Contrast, ComparesEachSourceWithGeneClocksInTheSameTask) {
    const Input input = input_of({{.source = timestamp},
                                  {},
                                  {.source = global_counter},
                                  {.task = collection, .parameters = "C"},
                                  {.task = collection, .source = timestamp, .parameters = "C"}});
    const auto contrasts = contrast(input, {}).arms;
    ASSERT_EQ(contrasts.size(), 3U);
    EXPECT_EQ(contrasts[0].arm, &input.arms[0]);
    EXPECT_EQ(contrasts[0].baseline, &input.arms[1]);
    EXPECT_EQ(contrasts[1].arm, &input.arms[2]);
    EXPECT_EQ(contrasts[1].baseline, &input.arms[1]);
    EXPECT_EQ(contrasts[2].arm, &input.arms[4]);
    EXPECT_EQ(contrasts[2].baseline, &input.arms[3]);
}

TEST(Contrast, OfTheSameRunsIsEquivalent) {
    const Input input = input_of({{.runs = 64}, {.source = timestamp, .runs = 64}});
    const Contrast found = contrast(input, {}).arms.front();
    EXPECT_EQ(found.pairs, 64U);
    EXPECT_EQ(found.identical, 64U);
    EXPECT_EQ(found.shift.estimate, 0.0);
    EXPECT_EQ(found.effect, 0.5);
    EXPECT_DOUBLE_EQ(found.margin, 0.05 * found.baseline_median);
    EXPECT_EQ(found.verdict, ContrastVerdict::equivalent);
    EXPECT_GT(found.power.equivalence, 0.9);
}

TEST(Contrast, OfRunsThatLieHigherIsDifferent) {
    const Input input = input_of(
        {{.runs = 40}, {.source = timestamp, .level = 190.0, .first_seed = 100, .runs = 40}});
    const Contrast found = contrast(input, {}).arms.front();
    EXPECT_EQ(found.pairs, 0U);
    EXPECT_GT(found.shift.interval.lower, found.margin);
    EXPECT_GT(found.effect, 0.95);
    EXPECT_DOUBLE_EQ(found.margin, 0.05 * found.baseline_median);
    EXPECT_EQ(found.verdict, ContrastVerdict::different);
}

// 4 apart, with a margin of 8 and little noise: both tests find what they seek.
TEST(Contrast, CanBeBothDifferentAndEquivalent) {
    const Input input = input_of(
        {{.runs = 200}, {.source = timestamp, .level = 164.0, .first_seed = 300, .runs = 200}});
    EXPECT_EQ(contrast(input, {}).arms.front().verdict, ContrastVerdict::small);
}

TEST(Contrast, OfFewRunsIsUndecided) {
    const Input input = input_of(
        {{.runs = 3}, {.source = timestamp, .level = 165.0, .first_seed = 300, .runs = 3}});
    EXPECT_EQ(contrast(input, {}).arms.front().verdict, ContrastVerdict::undecided);
}

TEST(Contrast, TakesTheMeasureAskedFor) {
    const Input input =
        input_of({{.runs = 9}, {.source = timestamp, .level = 170.0, .first_seed = 20, .runs = 8}});
    const Contrast found = contrast(input, {.measure = "final_swarm_fitness"}).arms.front();
    const auto x = final_fitness(input.arms[1]);
    const auto y = final_fitness(input.arms[0]);
    EXPECT_EQ(found.runs, 8U);
    EXPECT_EQ(found.baseline_runs, 9U);
    EXPECT_EQ(found.difference_p_value, statistics::mann_whitney(x, y).p_value);
    EXPECT_EQ(found.effect, statistics::vargha_delaney_a(x, y));
}

// Four contrasts of navigation are one family, the one of collection is another.
TEST(Contrast, CorrectsOverTheArmsOfATask) {
    const Input input =
        input_of({{.runs = 20},
                  {.source = timestamp, .level = 161.0, .first_seed = 40, .runs = 20},
                  {.source = global_counter, .level = 158.0, .first_seed = 80, .runs = 20},
                  {.source = content_hash, .level = 163.0, .first_seed = 120, .runs = 20},
                  {.source = random_identifier, .level = 150.0, .first_seed = 160, .runs = 20},
                  {.task = collection, .parameters = "C", .runs = 20},
                  {.task = collection,
                   .source = timestamp,
                   .parameters = "C",
                   .level = 161.0,
                   .first_seed = 200,
                   .runs = 20}});
    const auto contrasts = contrast(input, {}).arms;
    ASSERT_EQ(contrasts.size(), 5U);
    std::vector<double> family;
    for (std::size_t i = 0; i < 4; ++i) family.push_back(contrasts[i].difference_p_value);
    const auto corrected = statistics::holm(family);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(contrasts[i].difference_p_corrected, corrected[i]) << i;
    EXPECT_GT(corrected[0], family[0]);
    EXPECT_EQ(contrasts[4].difference_p_corrected, contrasts[4].difference_p_value);
    EXPECT_EQ(contrasts[4].equivalence_p_corrected, contrasts[4].equivalence_p_value);
}

TEST(Contrast, JudgesByCorrectedPValues) {
    bool has_lost_an_equivalence = false;
    bool has_lost_a_difference = false;
    const double level = ContrastPlan{}.level;
    for (std::size_t runs = 4; runs <= 40; runs += 4) {
        const Input input =
            input_of({{.runs = runs},
                      {.source = timestamp, .level = 161.0, .first_seed = 100, .runs = runs},
                      {.source = global_counter, .level = 165.0, .first_seed = 200, .runs = runs},
                      {.source = content_hash, .level = 169.0, .first_seed = 300, .runs = runs}});
        for (const Contrast& found : contrast(input, {}).arms) {
            using enum ContrastVerdict;
            const bool is_different = found.verdict == different || found.verdict == small;
            const bool is_equivalent = found.verdict == equivalent || found.verdict == small;
            EXPECT_EQ(is_different, found.difference_p_corrected < level);
            EXPECT_EQ(is_equivalent, found.equivalence_p_corrected < level);
            has_lost_a_difference |= !is_different && found.difference_p_value < level;
            has_lost_an_equivalence |= !is_equivalent && found.equivalence_p_value < level;
        }
    }
    EXPECT_TRUE(has_lost_an_equivalence);
    EXPECT_TRUE(has_lost_a_difference);
}

TEST(Contrast, FindsItsBaselineBySettings) {
    Input input = input_of({{}, {}, {}, {.source = timestamp}});
    input.arms[1].settings.radio.loss = 0.5;
    input.arms[2].settings.radio.loss = 0.9;
    input.arms[3].settings.radio.loss = 0.9;
    const auto [by_loss, paired, left_out] = contrast(input, {.baseline = {"radio.loss=0"}});
    ASSERT_EQ(by_loss.size(), 2U);
    EXPECT_EQ(by_loss[0].arm, &input.arms[1]);
    EXPECT_EQ(by_loss[1].arm, &input.arms[2]);
    EXPECT_EQ(by_loss[0].baseline, &input.arms[0]);
    EXPECT_EQ(left_out, std::vector<std::string>{input.arms[3].name +
                                                 " is left out: there is no arm with runs that has "
                                                 "radio.loss=0 and is otherwise the same"});
    const auto by_both = contrast(input, {.baseline = {"radio.loss=0", "source=gene-clock"}}).arms;
    ASSERT_EQ(by_both.size(), 3U);
    EXPECT_EQ(by_both[2].baseline, &input.arms[0]);
}

TEST(Contrast, ComparesAllOfATaskWithANamedArm) {
    const Input input = input_of({{},
                                  {.source = timestamp},
                                  {.parameters = "A"},
                                  {.task = collection, .parameters = "C"},
                                  {.task = collection, .source = timestamp, .parameters = "C"}});
    const auto of_both =
        contrast(input, {.against = {"navigation-B-timestamp", "collection-C-gene-clock"}});
    ASSERT_EQ(of_both.arms.size(), 3U);
    EXPECT_EQ(of_both.arms[0].arm, &input.arms[0]);
    EXPECT_EQ(of_both.arms[0].baseline, &input.arms[1]);
    EXPECT_EQ(of_both.arms[1].arm, &input.arms[2]);
    EXPECT_EQ(of_both.arms[1].baseline, &input.arms[1]);
    EXPECT_EQ(of_both.arms[2].arm, &input.arms[4]);
    EXPECT_EQ(of_both.arms[2].baseline, &input.arms[3]);
    EXPECT_TRUE(of_both.left_out.empty());
    const auto of_one = contrast(input, {.against = {"navigation-B-timestamp"}});
    EXPECT_EQ(of_one.arms.size(), 2U);
    EXPECT_EQ(of_one.left_out.size(), 2U);
    const auto refuses = [&](std::vector<std::string> against) {
        EXPECT_THROW((void)contrast(input, {.against = std::move(against)}), InputError);
    };
    refuses({"navigation-B-timestamps"});
    refuses({"navigation-B-timestamp", "navigation-A-gene-clock"});
}

TEST(Contrast, AgainstAMedianOfZeroIsLeftOut) {
    Input input = input_of({{},
                            {.source = timestamp},
                            {.task = collection, .parameters = "C"},
                            {.task = collection, .source = timestamp, .parameters = "C"}});
    for (report::Run& run : input.arms[0].runs)
        for (sim::Sample& sample : run.result.samples) sample.swarm_fitness = 0.0;
    const Contrasts found = contrast(input, {});
    ASSERT_EQ(found.arms.size(), 1U);
    EXPECT_EQ(found.arms[0].arm, &input.arms[3]);
    ASSERT_EQ(found.left_out.size(), 1U);
    EXPECT_NE(found.left_out[0].find("is 0, and a margin is a share of that"), std::string::npos);
}

TEST(Contrast, SeedBySeedMayAskForOtherBaselines) {
    Input input = input_of({{}, {.source = timestamp}, {}});
    input.arms[2].settings.radio.loss = 0.5;
    const ContrastPlan by_source;
    const ContrastPlan by_loss = with_baselines({}, {.baseline = {"radio.loss=0"}});
    EXPECT_EQ(with_baselines({}, {.over = {"radio.loss"}}).over,
              std::vector<std::string>{"radio.loss"});
    const Contrasts found = contrast(input, by_source, by_loss);
    ASSERT_EQ(found.arms.size(), 1U);
    EXPECT_EQ(found.arms[0].arm, &input.arms[1]);
    ASSERT_EQ(found.paired.size(), 1U);
    EXPECT_EQ(found.paired[0].first_arm, &input.arms[2]);
}

TEST(Contrast, OfANameThatSeveralArmsHaveIsRefused) {
    Input input = input_of({{}, {.source = timestamp}, {.parameters = "A"}});
    input.arms[2].name = input.arms[0].name;
    EXPECT_THROW((void)contrast(input, {.against = {input.arms[0].name}}), InputError);
}

TEST(Contrast, RefusesWhatCannotBeCompared) {
    const Input two = input_of({{}, {.source = timestamp}});
    EXPECT_THROW((void)contrast(input_of({{}}), {}), InputError);
    EXPECT_THROW((void)contrast(Input{}, {}), InputError);
    EXPECT_THROW((void)contrast(two, {.baseline = {"radio.los=0"}}), InputError);
    EXPECT_THROW((void)contrast(two, {.measure = "f_d"}), InputError);
    EXPECT_THROW((void)contrast(two, {.margin_share = 0.0}), InputError);
    EXPECT_THROW((void)contrast(two, {.level = 1.0}), InputError);
    EXPECT_THROW((void)contrast(two, {.over = {"radio.los"}}), InputError);
    Input other_profile = two;
    other_profile.arms[1].profile = "mended";
    EXPECT_THROW((void)contrast(other_profile, {}), InputError);
}

}  // namespace
}  // namespace gene_clocks::report
