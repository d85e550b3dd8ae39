#include "sim/report/verdicts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim/report/sample_input.hpp"

namespace gene_clocks::report {
namespace {

/// Runs whose every sample has the same values.
ArmRuns constant_arm(const SampleArm& sample, double species, double added) {
    ArmRuns arm = sample_arm(sample);
    for (report::Run& run : arm.runs) {
        for (sim::Sample& each : run.result.samples) {
            each.swarm_fitness = sample.level;
            each.species = species;
            each.added_elements = added;
            each.controller_size = 32.0 + added;
        }
    }
    return arm;
}

Exhibit find(const std::vector<Exhibit>& exhibits, const std::string& id) {
    return *std::ranges::find(exhibits, id, &Exhibit::id);
}

std::optional<bool> range_agrees(const Exhibit& exhibit, std::string_view origin,
                                 const std::string& measure) {
    for (const RangeVerdict& verdict : exhibit.ranges) {
        if (verdict.origin == origin && verdict.measure == measure) return verdict.agrees;
    }
    ADD_FAILURE() << exhibit.id << " has no " << measure << " of " << origin;
    return std::nullopt;
}

/// The exhibits of one navigation arm with set B.
std::vector<Exhibit> judge_constant(double level, double species, double added) {
    Input input;
    input.arms.push_back(constant_arm({.level = level}, species, added));
    return judge(compare(input).front());
}

TEST(Verdicts, AMedianAgreesUpToTheEndsOfTheRange) {
    // Paper, section 4.2: 150 to 180; the reference system's f_c: 140 to 173.
    for (const double level : {150.0, 165.0, 173.0}) {
        const auto exhibits = judge_constant(level, 2.0, 2.0);
        EXPECT_EQ(range_agrees(find(exhibits, "figure-3"), "paper", "final_swarm_fitness"), true);
        EXPECT_EQ(range_agrees(find(exhibits, "figure-5"), "reference", "f_c"), true);
    }
    const auto low = judge_constant(149.9, 1.89, 1.21);
    EXPECT_EQ(range_agrees(find(low, "figure-3"), "paper", "final_swarm_fitness"), false);
    EXPECT_EQ(range_agrees(find(low, "figure-3"), "reference", "swarm_fitness_at_10000"), true);
    EXPECT_EQ(range_agrees(find(low, "figure-7"), "reference", "species"), false);
    EXPECT_EQ(range_agrees(find(low, "figure-9"), "reference", "added_elements"), false);
    const auto high = judge_constant(173.1, 2.21, 3.25);
    EXPECT_EQ(range_agrees(find(high, "figure-5"), "reference", "f_c"), false);
    EXPECT_EQ(range_agrees(find(high, "figure-7"), "reference", "species"), true);
    EXPECT_EQ(range_agrees(find(high, "figure-9"), "reference", "added_elements"), true);
    EXPECT_EQ(range_agrees(find(high, "figure-9"), "paper", "added_elements"), true);
}

TEST(Verdicts, TheReferenceSystemIsComparedWithItsOwnParametersOnly) {
    Input input;
    input.arms.push_back(constant_arm({.parameters = "A"}, 2.0, 0.1));
    const auto exhibits = judge(compare(input).front());
    EXPECT_EQ(range_agrees(find(exhibits, "figure-9"), "reference", "added_elements"), true);
    EXPECT_EQ(range_agrees(find(exhibits, "figure-9"), "paper", "added_elements"), false);
    input.arms[0] = constant_arm({.parameters = "C"}, 2.0, 0.1);
    const auto other = judge(compare(input).front());
    for (const RangeVerdict& verdict : find(other, "figure-9").ranges)
        EXPECT_EQ(verdict.origin, "paper");
}

TEST(Verdicts, RunsOfAnotherScaleAreNotJudged) {
    const auto agreement_of = [](auto&& change) {
        Input input;
        ArmRuns arm = sample_arm({});
        change(arm.settings);
        arm.runs.clear();
        for (std::uint64_t seed = 1; seed <= 3; ++seed)
            arm.runs.push_back(sample_run(arm.settings, 160.0, seed));
        input.arms.push_back(arm);
        return judge(compare(input).front());
    };
    const auto fewer = agreement_of([](sim::Settings& settings) { settings.world.robots = 50; });
    EXPECT_EQ(range_agrees(find(fewer, "figure-5"), "reference", "f_c"), std::nullopt);
    EXPECT_EQ(count_agreement(find(fewer, "figure-3")).compared, 0U);

    const auto half = agreement_of([](sim::Settings& settings) { settings.run.cycles = 20000; });
    const Exhibit& fitness = find(half, "figure-3");
    EXPECT_EQ(range_agrees(fitness, "paper", "final_swarm_fitness"), std::nullopt);
    // Cycle 10 000 is the same in a run of half the length.
    EXPECT_TRUE(range_agrees(fitness, "reference", "swarm_fitness_at_10000").has_value());

    const auto brief = agreement_of([](sim::Settings& settings) { settings.run.cycles = 5000; });
    EXPECT_EQ(range_agrees(find(brief, "figure-3"), "reference", "swarm_fitness_at_10000"),
              std::nullopt);
}

TEST(Verdicts, AMethodThatWasNotRunIsNotJudged) {
    const auto exhibits = judge_constant(160.0, 2.0, 2.0);
    for (const RangeVerdict& verdict : find(exhibits, "figure-3").ranges) {
        const bool ran = verdict.source == sim::Source::gene_clock;
        EXPECT_EQ(verdict.ours.has_value(), ran);
        EXPECT_EQ(verdict.agrees.has_value(), ran);
    }
    for (const TestVerdict& verdict : find(exhibits, "table-2").tests)
        EXPECT_EQ(verdict.ours, std::nullopt);
    EXPECT_EQ(count_agreement(find(exhibits, "table-2")).compared, 0U);
}

TEST(Verdicts, TestsAgreeOnTheSameSideOfTheSignificanceLevel) {
    const auto tests_with = [](double level_of_timestamps, std::uint64_t first_seed) {
        Input input;
        input.arms.push_back(sample_arm({.level = 160.0, .runs = 20}));
        input.arms.push_back(sample_arm({.source = sim::Source::timestamp,
                                         .level = level_of_timestamps,
                                         .first_seed = first_seed,
                                         .runs = 20}));
        return find(judge(compare(input).front()), "table-2");
    };
    for (const TestVerdict& verdict : tests_with(160.0, 1000).tests) {
        EXPECT_GE(verdict.ours, 0.05) << verdict.measure;
        EXPECT_EQ(verdict.agrees, true) << verdict.measure;
    }
    for (const TestVerdict& verdict : tests_with(190.0, 1000).tests) {
        EXPECT_LT(verdict.ours, 0.05) << verdict.measure;
        EXPECT_EQ(verdict.agrees, false) << verdict.measure;
    }
}

TEST(Verdicts, IdenticalRunsShowNoDifference) {
    Input input;
    input.arms.push_back(sample_arm({.runs = 20}));
    input.arms.push_back(sample_arm({.source = sim::Source::timestamp, .runs = 20}));
    for (const TestVerdict& verdict : find(judge(compare(input).front()), "table-2").tests)
        EXPECT_EQ(verdict.ours, 1.0);
}

}  // namespace
}  // namespace gene_clocks::report
