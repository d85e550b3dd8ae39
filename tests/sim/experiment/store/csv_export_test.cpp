#include "sim/experiment/store/csv_export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "sim/experiment/study/compared_runs.hpp"
#include "tests/sim/experiment/example_study.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::experiment {
namespace {

using test::example_run;

/// The lines of a CSV text without quotes, by column.
std::vector<std::map<std::string, std::string>> parse(const std::string& csv) {
    const auto cells = [](const std::string& line) {
        std::vector<std::string> found;
        std::stringstream stream(line + ",");
        for (std::string cell; std::getline(stream, cell, ',');) found.push_back(cell);
        return found;
    };
    std::stringstream stream(csv);
    std::string line;
    std::getline(stream, line);
    const auto header = cells(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(stream, line)) {
        const auto values = cells(line);
        EXPECT_EQ(values.size(), header.size()) << line;
        for (auto& row = rows.emplace_back(); const auto& name : header) {
            row[name] = values.at(static_cast<std::size_t>(&name - header.data()));
        }
    }
    return rows;
}

class CsvTest : public testing::Test {
protected:
    void SetUp() override {
        store.put_study(study);
        store.put_run(example_run(study.arms[0], 3));
        store.put_run(example_run(study.arms[0], 5));
        store.put_run(example_run(study.arms[1], 4));
    }
    test::TemporaryFolder folder;
    Study study = test::example_study();
    Store store = Store::open_for_writing(folder / "runs.sqlite");
    std::ostringstream out;
};

TEST(CsvField, IsQuotedWhereItMustBe) {
    EXPECT_EQ(csv_field("mended"), "mended");
    EXPECT_EQ(csv_field("my profiles/a b.toml"), "my profiles/a b.toml");
    EXPECT_EQ(csv_field("a,b.toml"), "\"a,b.toml\"");
    EXPECT_EQ(csv_field("a\"b.toml"), "\"a\"\"b.toml\"");
    EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
}

TEST_F(CsvTest, HasALineForEachRun) {
    write_runs_csv(store, store.studies(), out);
    const auto rows = parse(out.str());
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].at("arm"), "one");
    EXPECT_EQ(rows[0].at("seed"), "3");
    EXPECT_EQ(rows[1].at("seed"), "5");
    EXPECT_EQ(rows[2].at("arm"), "two");
    EXPECT_EQ(rows[2].at("source"), "timestamp");
    EXPECT_EQ(rows[2].at("parameters"), "A");
    EXPECT_EQ(rows[1].at("births"), "5");
    EXPECT_EQ(rows[1].at("genes"), "6");  // see example_run
    EXPECT_EQ(rows[1].at("stamp_bytes"), "30");
    EXPECT_EQ(rows[1].at("trajectory_hash"), "f000000000000005");
    EXPECT_EQ(rows[1].at("settings_hash"), study.arms[0].settings_hash);
    EXPECT_EQ(rows[1].at("swarm_fitness_at_10000"), "");  // the runs are too short
}

TEST_F(CsvTest, HasEveryCounterMeasureAndValue) {
    write_runs_csv(store, store.studies(), out);
    const auto rows = parse(out.str());
    const sim::RunResult run = example_run(study.arms[0], 3).result;
    const auto expect_column = [&](const char* name, const auto& value) {
        EXPECT_EQ(std::stod(rows[0].at(name)), static_cast<double>(value)) << name;
    };
    sim::for_each_counter(run.counters, expect_column);
    sim::for_each_measure(run.chronology, expect_column);
    std::ostringstream samples;
    write_samples_csv(store, store.studies(), samples);
    const auto lines = parse(samples.str());
    sim::for_each_value(run.samples[1], [&](const char* name, const auto& value) {
        EXPECT_EQ(std::stod(lines[1].at(name)), static_cast<double>(value)) << name;
    });
}

TEST_F(CsvTest, MeasuresReferToTheBestOfAllComparedRuns) {
    write_runs_csv(store, store.studies(), out);
    const auto rows = parse(out.str());
    const double best = best_of_run(example_run(study.arms[0], 5).result.samples, {}).value;
    for (const auto& row : rows) {
        const std::uint64_t seed = std::stoull(row.at("seed"));
        const Arm& arm = study.arms[row.at("arm") == "one" ? 0 : 1];
        sim::MeasureSettings settings = arm.settings.measures;  // arm two has a target of its own
        settings.best_fitness = best;
        const auto measures = sim::measure(example_run(arm, seed).result.samples, settings);
        EXPECT_EQ(std::stod(row.at("f_c")), measures.f_c);
        EXPECT_EQ(std::stod(row.at("f_b")), measures.f_b);
        EXPECT_EQ(std::stod(row.at("t_f")), measures.t_f);
        EXPECT_EQ(std::stod(row.at("f_a")), measures.f_a);
        EXPECT_EQ(std::stod(row.at("best_swarm_fitness")), best);
        EXPECT_EQ(row.at("best_over"), "3 runs of navigation under profile mended");
    }
}

TEST_F(CsvTest, KeepsEveryDigitOfSamples) {
    write_samples_csv(store, store.studies(), out);
    const auto rows = parse(out.str());
    ASSERT_EQ(rows.size(), 3U * 20U);
    const auto samples = example_run(study.arms[0], 3).result.samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        EXPECT_EQ(std::stoll(rows[i].at("cycle")), samples[i].cycle);
        EXPECT_EQ(std::stod(rows[i].at("swarm_fitness")), samples[i].swarm_fitness);
        EXPECT_EQ(std::stod(rows[i].at("controller_size")), samples[i].controller_size);
    }
}

}  // namespace
}  // namespace gene_clocks::experiment
