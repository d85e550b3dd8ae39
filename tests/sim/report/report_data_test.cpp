#include "sim/report/report_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/statistics/quantiles.hpp"
#include "tests/sim/report/sample_input.hpp"

namespace gene_clocks::report {
namespace {

using Json = nlohmann::ordered_json;

TEST(ReportData, SumsUpWhatWasRun) {
    Input input = sample_input();
    input.arms[3].runs.clear();
    const Json data = report_data(input);
    EXPECT_EQ(data["provenance"]["runs"], 30);
    EXPECT_EQ(data["provenance"]["versions_of_runs"], Json::array({"1.2.3"}));
    EXPECT_EQ(data["provenance"]["cost"]["cpu_seconds"], 15.0);
    EXPECT_EQ(data["provenance"]["cost"]["robot_steps"], (24 * 40000 + 6 * 60000) * 100.0);
    EXPECT_EQ(data["provenance"]["cost"]["robot_steps_per_cpu_second"],
              (24 * 40000 + 6 * 60000) * 100.0 / 15.0);
    EXPECT_EQ(data["missing_arms"], Json::array({"collection-C-timestamp"}));
    EXPECT_EQ(data["comparisons"].size(), 3U);
}

TEST(ReportData, CurvesAreQuartilesOverTheRuns) {
    const Input input = sample_input();
    const Json arm = report_data(input)["comparisons"][0]["arms"][0];
    constexpr std::size_t sample = 123;
    std::vector<double> values;
    for (const report::Run& run : input.arms[0].runs)
        values.push_back(run.result.samples[sample].swarm_fitness);
    EXPECT_EQ(arm["cycles"][sample], 12300);
    const Json& curve = arm["curves"]["swarm_fitness"];
    EXPECT_EQ(curve["median"].size(), 400U);
    EXPECT_EQ(curve["lower_quartile"][sample], statistics::quantile(values, 0.25));
    EXPECT_EQ(curve["median"][sample], statistics::quantile(values, 0.5));
    EXPECT_EQ(curve["upper_quartile"][sample], statistics::quantile(values, 0.75));
    EXPECT_EQ(arm["initial_controller_size"], 32.0);
    EXPECT_EQ(arm["median_counters"]["births"], 1003.5);  // 1000 + seed, seeds 1 to 6
    sim::for_each_counter(sim::RunCounters{}, [&](const char* name, std::uint64_t) {
        EXPECT_TRUE(arm["median_counters"].contains(name)) << name;
    });
}

TEST(ReportData, ChangesAgainstTheProfileAreListed) {
    Input input = sample_input();
    EXPECT_EQ(report_data(input)["comparisons"][0]["changes"], Json::array());
    input.arms[0].settings.radio.loss = 0.25;
    const Json changes = report_data(input)["comparisons"][0]["changes"];
    EXPECT_EQ(changes, Json::array({{{"key", "radio.loss"}, {"profile", 0.0}, {"run", 0.25}}}));
}

TEST(ReportData, FixedValuesOfTable1AreComparedWithAllRuns) {
    const auto rows_that_differ = [](const Input& input) {
        std::vector<std::string> keys;
        const Json data = report_data(input);
        for (const Json& row : data["table_1"]["fixed"])
            if (!row["agrees"]) keys.push_back(row["key"]);
        return keys;
    };
    Input input;
    for (const sim::Task task : {sim::Task::navigation, sim::Task::collection})
        input.arms.push_back(sample_arm({.task = task, .runs = 1}));
    EXPECT_TRUE(rows_that_differ(input).empty());
    input.arms[0].settings.world.items = 7;  // none in navigation, whatever the setting
    EXPECT_TRUE(rows_that_differ(input).empty());
    input.arms[1].settings.world.items = 7;
    input.arms[0].settings.odneat.c_disjoint = 1.0;
    EXPECT_EQ(rows_that_differ(input),
              (std::vector<std::string>{"odneat.c_disjoint", "world.items"}));
}

TEST(ReportData, MeasuresThatTheRunsAreTooShortForAreNull) {
    Input input;
    ArmRuns arm = sample_arm({.runs = 0});
    arm.settings.run.cycles = 4000;
    arm.runs.push_back(sample_run(arm.settings, 160.0, 1));
    input.arms.push_back(arm);
    const Json data = report_data(input);
    EXPECT_TRUE(data["comparisons"][0]["arms"][0]["measures"]["swarm_fitness_at_10000"].is_null());
    EXPECT_TRUE(data["comparisons"][0]["tests"].is_null());
    EXPECT_TRUE(data["comparisons"][0]["trajectories"].is_null());
}

TEST(ReportData, GroupsReferToArmsAndHoldTheirContrasts) {
    const Input input = sample_study("loss");
    const Json data = report_data(input);
    const Json& group = data["groups"].at(0);
    EXPECT_EQ(group["baseline_source"], "gene-clock");
    EXPECT_EQ(group["factors"].at(0)["key"], "radio.loss");
    EXPECT_EQ(group["factors"].at(0)["levels"], Json::parse("[[0.0], [0.5], [0.99]]"));
    ASSERT_EQ(group["arms"].size(), input.arms.size());
    for (const Json& arm : group["arms"]) {
        const Json& numbers = data["comparisons"][arm["comparison"].get<std::size_t>()]["arms"]
                                  [arm["arm"].get<std::size_t>()];
        EXPECT_EQ(arm["name"], numbers["name"]);
    }
    EXPECT_EQ(group["treatment_contrasts"].size(), 6U);
    EXPECT_EQ(group["condition_contrasts"].size(), 6U);
    const Json& row = group["treatment_contrasts"].at(0);
    EXPECT_EQ(group["arms"][row["arm"].get<std::size_t>()]["name"],
              "navigation-gene-clock-no-merge-radio.loss=0");
    EXPECT_EQ(group["arms"][row["baseline"].get<std::size_t>()]["name"],
              "navigation-gene-clock-radio.loss=0");
    EXPECT_EQ(row["identical"], 3);
    EXPECT_EQ(row["shift"], 0.0);
    EXPECT_EQ(row["verdict"], "undecided");  // three runs show nothing
    ASSERT_EQ(group["paired_contrasts"].size(), 2U);
    const Json& paired = group["paired_contrasts"].at(0);
    EXPECT_EQ(paired["changes"], Json::parse(R"(["source=gene-clock-no-merge"])"));
    EXPECT_EQ(paired["arms"], 3);
    EXPECT_EQ(paired["seeds"], 3);
    EXPECT_EQ(paired["identical"], 9);
    EXPECT_EQ(paired["verdict"], "identical");
}

TEST(ReportData, PairedContrastsAreOfArmsUnderTheSameConditions) {
    // Gene clocks stand there once, where drift and offset are 0: the others have no counterpart.
    const Json data = report_data(sample_study("drift"));
    const Json& paired = data["groups"].at(0)["paired_contrasts"];
    ASSERT_EQ(paired.size(), 1U);
    EXPECT_EQ(paired.at(0)["changes"], Json::parse(R"(["source=timestamp"])"));
    EXPECT_EQ(paired.at(0)["arms"], 1);
    // Of a study with one source, choices are what is compared.
    const Json operators = report_data(sample_study("operators"));
    std::vector<std::string> changes;
    for (const Json& row : operators["groups"].at(0)["paired_contrasts"]) {
        EXPECT_EQ(row["arms"], 2);
        changes.push_back(row["changes"].dump());
    }
    EXPECT_EQ(changes, (std::vector<std::string>{
                           R"(["odneat.mismatch=age"])", R"(["odneat.crossover=one-point"])",
                           R"(["odneat.crossover=one-point","odneat.mismatch=age"])"}));
}

TEST(ReportData, AMedianOfZeroMakesNoContrast) {
    Input input = sample_study("markings");
    for (report::Run& run : input.arms[0].runs)
        for (sim::Sample& sample : run.result.samples) sample.swarm_fitness = 0.0;
    const Json data = report_data(input);
    EXPECT_EQ(data["groups"][0]["treatment_contrasts"], Json::array());
    EXPECT_EQ(data["groups"][1]["treatment_contrasts"].size(), 8U);
}

TEST(ReportData, ChronologyIsPerOpportunity) {
    Input input = sample_study("single");
    for (report::Run& run : input.arms[0].runs) {
        sim::ChronologyMeasures& chronology = run.result.chronology;
        chronology = {};
        chronology.caused_pairs = 400;
        chronology.cause_inverted = 10 * run.seed;
        chronology.pairs = 1000;
        chronology.alignments = run.seed == 1 ? 0 : 50;
        chronology.missed_homologies = run.seed == 1 ? 0 : 10 * run.seed;
    }
    const Json shares = report_data(input)["comparisons"][0]["arms"][0]["chronology"];
    EXPECT_EQ(shares["cause_inverted"]["median"], 20.0 / 400.0);
    EXPECT_EQ(shares["cause_inverted"]["count"], 3);
    EXPECT_EQ(shares["concurrent"]["median"], 0.6);
    EXPECT_EQ(shares["missed_homologies"]["count"], 2);  // one run had no alignments
    EXPECT_EQ(shares["missed_homologies"]["median"], 0.5);
    EXPECT_TRUE(shares["same_collisions"].is_null());
}

TEST(ReportData, TheSameRunsInAnotherOrderGiveTheSameNumbers) {
    Input input = sample_input();
    const std::string once = report_data(input).dump();
    for (ArmRuns& arm : input.arms) std::ranges::reverse(arm.runs);
    EXPECT_EQ(report_data(input).dump(), once);
}

}  // namespace
}  // namespace gene_clocks::report
