// What t_f and f_a refer to is the same in every output that is made of the same runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "sim/experiment/store/csv_export.hpp"
#include "sim/experiment/store/store.hpp"
#include "sim/report/comparison.hpp"
#include "sim/report/contrast.hpp"
#include "sim/report/report_data.hpp"
#include "sim/settings/document.hpp"
#include "sim/statistics/quantiles.hpp"
#include "tests/sim/report/sample_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::report {
namespace {

using experiment::Store;
using experiment::Study;

/// What one output says of one run.
struct Said {
    double t_f{};
    double f_a{};
    double best{};
    std::string over;
    friend bool operator==(const Said&, const Said&) = default;
};
void PrintTo(const Said& said, std::ostream* out) {
    *out << said.t_f << " " << said.f_a << " best " << said.best << " over " << said.over;
}
using ByRun = std::map<std::pair<std::string, std::uint64_t>, Said>;  // by arm and seed

/// Two tasks, two profiles; in each three arms that differ in marking and in a setting.
Study example() {
    return experiment::read_study(experiment::parse_document(R"(
name = "example"
title = "An example"
seeds = 3
settings.run.cycles = 12000
[[arm]]
name = "clock"
task = ["navigation", "collection"]
profile = ["mended", "gecco15"]
source = "gene-clock"
[[arm]]
name = "stamp"
task = ["navigation", "collection"]
profile = ["mended", "gecco15"]
source = "timestamp"
[[arm]]
name = "lossy"
task = ["navigation", "collection"]
profile = ["mended", "gecco15"]
source = "timestamp"
settings.radio.loss = 0.5
)",
                                                             "example.toml"));
}

class BestSwarmFitnessTest : public testing::Test {
protected:
    /// Puts a study's runs that are not there yet, the arms the better the later they come in it.
    void put(const Study& study) {
        Store store = Store::open_for_writing(file);
        store.put_study(study);
        const auto finished = store.finished();
        double level = 120.0;
        for (const experiment::Arm& arm : study.arms) {
            level += 9.0;
            for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(study.seeds); ++seed) {
                const report::Run run = sample_run(arm.settings, level, study.first_seed + seed);
                if (finished.contains({arm.settings_hash, run.seed})) continue;
                store.put_run({arm.settings_hash, run.seed, run.result, 1.0, "2015-07-11T12:00:00Z",
                               run.program_version});
            }
        }
    }

    /// Of `gene-clocks export --runs`. No name here has a comma.
    [[nodiscard]] ByRun said_by_csv() const {
        const Store store = Store::open_for_reading(file);
        std::stringstream csv;
        experiment::write_runs_csv(store, store.studies(), csv);
        const auto cells = [&csv] {
            std::string line;
            std::vector<std::string> found;
            if (!std::getline(csv, line)) return found;
            std::stringstream stream(line);
            for (std::string cell; std::getline(stream, cell, ',');) found.push_back(cell);
            return found;
        };
        const std::vector<std::string> header = cells();
        ByRun said;
        for (auto row = cells(); !row.empty(); row = cells()) {
            std::map<std::string, std::string> of;
            for (std::size_t i = 0; i < header.size(); ++i) of[header[i]] = row.at(i);
            said[{of["arm"], std::stoull(of["seed"])}] = {
                std::stod(of["t_f"]), std::stod(of["f_a"]), std::stod(of["best_swarm_fitness"]),
                of["best_over"]};
        }
        return said;
    }

    /// Of what `gene-clocks contrast` compares.
    [[nodiscard]] ByRun said_by_contrast() const {
        const Input input = read_input(file, {});
        ByRun said;
        for (const ArmNumbers& numbers : arm_numbers(input)) {
            for (std::size_t i = 0; i < numbers.runs.size(); ++i) {
                said[{numbers.arm->name, numbers.runs[i]->seed}] = {
                    numbers.values.at("t_f")[i], numbers.values.at("f_a")[i], numbers.best.value,
                    numbers.best.over};
            }
        }
        return said;
    }

    /// Of report.json.
    [[nodiscard]] ByRun said_by_report() const {
        const auto data = report_data(read_input(file, {}));
        ByRun said;
        for (const auto& comparison : data["comparisons"]) {
            for (const auto& arm : comparison["arms"]) {
                for (std::size_t i = 0; i < arm["seeds"].size(); ++i) {
                    said[{arm["name"], arm["seeds"][i]}] = {
                        arm["measures"]["t_f"]["values"][i], arm["measures"]["f_a"]["values"][i],
                        comparison["best_swarm_fitness"], comparison["best_over"]};
                }
            }
        }
        return said;
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "runs.sqlite";
};

TEST_F(BestSwarmFitnessTest, IsTheSameInCsvContrastAndReportRunByRun) {
    put(example());
    const ByRun csv = said_by_csv();
    ASSERT_EQ(csv.size(), 2U * 2U * 3U * 3U);
    EXPECT_EQ(csv, said_by_contrast());
    EXPECT_EQ(csv, said_by_report());
}

TEST_F(BestSwarmFitnessTest, IsThatOfTheSameTaskAndProfile) {
    const Study study = example();
    put(study);
    const ByRun said = said_by_csv();
    for (const experiment::Arm& arm : study.arms) {
        double best = 0.0;
        for (const experiment::Arm& other : study.arms) {
            if (other.settings.task != arm.settings.task || other.profile != arm.profile) continue;
            const double level = 120.0 + 9.0 * static_cast<double>(&other - &study.arms[0] + 1);
            for (std::uint64_t seed = 1; seed <= 3; ++seed)
                for (const auto& sample : sample_run(other.settings, level, seed).result.samples)
                    best = std::max(best, sample.swarm_fitness);
        }
        const Said& first = said.at({arm.name, 1});
        EXPECT_EQ(first.best, best) << arm.name;
        EXPECT_EQ(first.over, "9 runs of " + std::string(experiment::name_of(arm.settings.task)) +
                                  " under profile " + arm.profile);
    }
}

TEST_F(BestSwarmFitnessTest, IsTakenOverAllStudiesThatTheCommandIsGiven) {
    put(example());
    Study other = example();
    other.name = "other";
    other.first_seed = 3;  // one seed that the first study has, too, and two more
    put(other);
    const ByRun csv = said_by_csv();
    EXPECT_EQ(csv.at({"lossy-navigation-mended", 1}).over,
              "15 runs of navigation under profile mended");
    EXPECT_EQ(csv, said_by_contrast());
    EXPECT_EQ(csv, said_by_report());
    const Input one = read_input(file, {"example"});
    EXPECT_EQ(arm_numbers(one).front().best.over, "9 runs of navigation under profile mended");
}

TEST_F(BestSwarmFitnessTest, IsThatOfTheSettingsWhereTheyFixIt) {
    Study study = example();
    for (experiment::Arm& arm : study.arms) arm.settings.measures.best_fitness = 90.0;
    put(study);
    const ByRun csv = said_by_csv();
    for (const auto& [run, said] : csv) {
        EXPECT_EQ(said.best, 90.0);
        EXPECT_EQ(said.over, "no runs (measures.best_fitness fixes it)");
        EXPECT_EQ(said.t_f, 0.0);  // every run begins at 100
    }
    EXPECT_EQ(csv, said_by_contrast());
    EXPECT_EQ(csv, said_by_report());
}

TEST_F(BestSwarmFitnessTest, ContrastsNameItAndCompareNoOthers) {
    put(example());
    Input input = read_input(file, {});
    const ContrastPlan plan{.measure = "t_f"};
    const Contrasts all = contrast(input, plan);
    ASSERT_EQ(all.arms.size(), 4U);
    for (const Contrast& found : all.arms) {
        EXPECT_EQ(found.best.over, "9 runs of " +
                                       std::string(experiment::name_of(found.arm->settings.task)) +
                                       " under profile " + found.arm->profile);
    }
    const auto timestamps =
        std::ranges::find(input.arms, "stamp-navigation-mended", &ArmRuns::name);
    ASSERT_NE(timestamps, input.arms.end()) << input.arms[4].name;
    timestamps->settings.measures.best_fitness = 100.0;
    const ContrastPlan against{.against = {"clock-navigation-mended"}, .measure = "t_f"};
    const Contrasts mixed = contrast(input, against);
    ASSERT_EQ(mixed.arms.size(), 1U);
    EXPECT_EQ(mixed.arms[0].arm->name, "lossy-navigation-mended");
    const auto refers_to_another = [](const std::string& what) {
        return what.find("its t_f refers to the best swarm fitness over no runs") != what.npos;
    };
    EXPECT_EQ(std::ranges::count_if(mixed.left_out, refers_to_another), 1);
}

}  // namespace
}  // namespace gene_clocks::report
