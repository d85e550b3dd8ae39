#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/sim/app/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks {
namespace {

using test::Program;
using testing::HasSubstr;

class CommandLineTest : public testing::Test {
protected:
    /// What the program prints; it must succeed.
    std::string output_of(const Program::Arguments& arguments) const {
        const Program::Result result = test::gene_clocks(folder.path(), arguments);
        EXPECT_EQ(result.status, 0) << testing::PrintToString(arguments) << result.messages;
        return result.output;
    }
    /// The JSON of a short run of few robots.
    [[nodiscard]] nlohmann::json short_run(Program::Arguments arguments) const {
        arguments.insert(arguments.begin(),
                         {"run", "--json", "--set", "run.cycles=400", "world.robots=8"});
        return nlohmann::json::parse(output_of(arguments));
    }
    test::TemporaryFolder folder;
};

/// A CSV text of so many lines, each with as many commas.
void expect_rectangular(const std::string& csv, std::ptrdiff_t lines) {
    EXPECT_EQ(std::ranges::count(csv, '\n'), lines) << csv;
    const auto commas = std::count(csv.begin(), std::ranges::find(csv, '\n'), ',');
    std::istringstream stream(csv);
    for (std::string line; std::getline(stream, line);)
        EXPECT_EQ(std::ranges::count(line, ','), commas) << line;
}

TEST_F(CommandLineTest, HelpIsThereForEveryCommand) {
    EXPECT_THAT(output_of({"--help"}), HasSubstr("gene-clocks run --task navigation"));
    for (const char* command : {"run", "study", "report", "reproduce", "settings", "contrast",
                                "export", "merge", "check-trace"}) {
        EXPECT_THAT(output_of({command, "--help"}),
                    HasSubstr(std::string("gene-clocks ") + command))
            << command;
    }
}

TEST_F(CommandLineTest, RunPrintsTheFieldsThatScriptsCountOn) {
    const auto json = short_run({"--task", "navigation", "--seed", "3"});
    for (const char* field :
         {"f_c", "f_b", "t_f", "f_a", "final_swarm_fitness", "species", "added_elements",
          "robot_steps", "cpu_seconds", "robot_steps_per_cpu_second"}) {
        ASSERT_TRUE(json.contains(field)) << field;
        EXPECT_TRUE(json[field].is_number()) << field;
    }
    EXPECT_TRUE(json.contains("swarm_fitness_at_10000"));
    EXPECT_TRUE(json["trajectory_hash"].is_string());
    EXPECT_EQ(json["seed"], 3);
    EXPECT_EQ(json["robot_steps"], 400 * 8);
    EXPECT_GT(json["f_c"], 0.0);
}

TEST_F(CommandLineTest, ARunIsAFunctionOfSettingsAndSeed) {
    const auto hash = [&](const Program::Arguments& arguments) {
        return short_run(arguments)["trajectory_hash"];
    };
    const auto first = hash({"--task", "navigation", "--seed", "1"});
    EXPECT_EQ(hash({"--task", "navigation", "--seed", "1"}), first);
    EXPECT_NE(hash({"--task", "navigation", "--seed", "2"}), first);
    EXPECT_NE(hash({"--task", "collection", "--seed", "1"}), first);
    EXPECT_NE(hash({"--task", "navigation", "--seed", "1", "--set", "world.sensor_range_px=40"}),
              first);
}

TEST_F(CommandLineTest, WithoutParametersTheTasksOwnSetIsUsed) {
    const auto hash = [&](const Program::Arguments& arguments) {
        return short_run(arguments)["settings_hash"];
    };
    EXPECT_EQ(hash({"--task", "navigation"}), hash({"--task", "navigation", "--parameters", "B"}));
    EXPECT_EQ(hash({"--task", "collection"}), hash({"--task", "collection", "--parameters", "C"}));
    EXPECT_NE(hash({"--task", "navigation"}), hash({"--task", "navigation", "--parameters", "A"}));
    EXPECT_EQ(short_run({"--task", "navigation"})["profile"], "mended");
    EXPECT_EQ(short_run({"--task", "collection"})["parameters"], "C");
}

TEST_F(CommandLineTest, EveryProfileAndSourceRuns) {
    for (const char* task : {"navigation", "collection"}) {
        for (const char* source : {"gene-clock", "timestamp"}) {
            for (const char* profile : {"gecco15", "mended", "text"}) {
                const auto json =
                    short_run({"--task", task, "--source", source, "--profile", profile});
                EXPECT_EQ(json["task"], task);
                EXPECT_EQ(json["source"], source);
                EXPECT_EQ(json["profile"], profile);
            }
        }
    }
}

TEST_F(CommandLineTest, RunSpeaksToPeopleToo) {
    EXPECT_THAT(
        output_of({"run", "--task", "navigation", "--set", "run.cycles=200", "world.robots=3"}),
        testing::AllOf(HasSubstr("f_c"), HasSubstr("trajectory hash")));
}

TEST_F(CommandLineTest, SettingsThatWereWrittenGiveTheSameRun) {
    const Program::Arguments choice{"--task",  "collection", "--profile",
                                    "gecco15", "--source",   "timestamp"};
    Program::Arguments show{"settings", "--format", "toml"};
    show.insert(show.end(), choice.begin(), choice.end());
    folder.write("mine.toml", output_of(show));
    const auto expected = short_run(choice);
    // The profile that it starts from no longer matters: the file has every key.
    EXPECT_EQ(short_run({"--task", "navigation", "--profile", "text", "--settings",
                         "mine.toml"})["trajectory_hash"],
              expected["trajectory_hash"]);
}

TEST_F(CommandLineTest, SettingsAreShownAsJson) {
    const auto json =
        nlohmann::json::parse(output_of({"settings", "--task", "navigation", "--parameters", "A",
                                         "--format", "json", "--set", "world.robots=7"}));
    EXPECT_EQ(json["odneat"]["p_mate"], 0.842);
    EXPECT_EQ(json["world"]["robots"], 7);
}

TEST_F(CommandLineTest, SettingsAreListed) {
    EXPECT_THAT(output_of({"settings"}),
                testing::AllOf(HasSubstr("odneat.p_mate = 0.212"), HasSubstr("Table 1")));
    EXPECT_THAT(output_of({"settings", "radio"}), testing::Not(HasSubstr("odneat.p_mate")));
    EXPECT_EQ(output_of({"settings", "--format", "markdown"}),
              test::read_all(SOURCE_FOLDER "/docs/settings.md"));
}

TEST_F(CommandLineTest, BuiltinFilesCanBeCopied) {
    EXPECT_EQ(output_of({"settings", "--builtin", "arenas/gecco15.toml"}),
              test::read_all(SOURCE_FOLDER "/sim/arenas/gecco15.toml"));
    folder.write("copy.toml", output_of({"settings", "--builtin", "studies/gecco15.toml"}));
    const auto plan = [&](const char* study) {
        const std::string output = output_of({"study", study, "--dry-run"});
        return output.substr(0, output.find("\nabout "));  // the time depends on the moment
    };
    EXPECT_EQ(plan("copy.toml"), plan("gecco15"));
}

TEST_F(CommandLineTest, DryRunOnlyShowsThePlan) {
    const std::string plan = output_of({"study", "gecco15", "--dry-run", "--threads", "1"});
    EXPECT_THAT(
        plan,
        HasSubstr("4 arms x 64 seeds = 256 runs, 1280.0 M robot-steps\n"
                  "results/gecco15.sqlite: does not exist yet; the study will create it\nabout "));
    EXPECT_THAT(plan, HasSubstr(" on this machine with 1 thread, judged by trying out"));
    EXPECT_THAT(output_of({"study", "gecco15", "--quick", "--dry-run"}),
                HasSubstr("4 arms x 8 seeds = 32 runs"));
    EXPECT_THAT(output_of({"study", "gecco15", "--dry-run", "--shard", "3/10"}),
                HasSubstr("\nshard 3 of 10: 26 runs, 130.0 M robot-steps\n"
                          "results/gecco15-shard-3-of-10.sqlite: does not exist yet; the study "
                          "will create it\n"));
    EXPECT_TRUE(folder.is_empty());
}

TEST_F(CommandLineTest, DryRunTellsWhatIsStillMissing) {
    const auto study = [](const char* seeds) {
        return Program::Arguments{"study",           "gecco15",       "--quick", "--store",
                                  "x.sqlite",        "--seeds",       seeds,     "--set",
                                  "run.cycles=1000", "world.robots=3"};
    };
    output_of(study("2"));
    const std::string store = test::read_all(folder / "x.sqlite");
    Program::Arguments dry_run = study("5");
    dry_run.emplace_back("--dry-run");
    const std::string plan = output_of(dry_run);
    EXPECT_THAT(plan, HasSubstr("x.sqlite: 8 of 20 runs are finished, 12 are missing, "
                                "0.0 M robot-steps\n"));
    EXPECT_THAT(plan, testing::ContainsRegex("\nabout [0-9]+:[0-9][0-9] on this machine"));
    EXPECT_THAT(plan, HasSubstr("judged by the 8 runs in the store\n"));
    dry_run = study("2");
    dry_run.emplace_back("--dry-run");
    EXPECT_THAT(output_of(dry_run), testing::EndsWith("8 of 8 runs are finished, 0 are "
                                                      "missing, 0.0 M robot-steps\n"));
    EXPECT_EQ(test::read_all(folder / "x.sqlite"), store);
}

TEST_F(CommandLineTest, ResultsGoToTheirOwnFolder) {
    output_of({"study", "gecco15", "--quick", "--seeds", "1", "--set", "run.cycles=100",
               "world.robots=3"});
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "results/gecco15-quick.sqlite"));
    const std::string csv = output_of({"export", "results/gecco15-quick.sqlite", "--runs", "-"});
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4);
    output_of({"export", "results/gecco15-quick.sqlite", "--runs", "runs.csv", "--samples",
               "samples.csv"});
    EXPECT_EQ(test::read_all(folder / "runs.csv"), csv);
    EXPECT_THAT(test::read_all(folder / "samples.csv"), testing::StartsWith("study,arm,task,"));
}

TEST_F(CommandLineTest, ContrastHoldsArmsAgainstEachOther) {
    output_of({"study", "gecco15", "--quick", "--seeds", "4", "--set", "run.cycles=300",
               "world.robots=5"});
    const std::string store = "results/gecco15-quick.sqlite";
    const std::string table = output_of({"contrast", store, "--csv", "contrast.csv"});
    EXPECT_THAT(table, HasSubstr("f_c against navigation-gene-clock"));
    EXPECT_THAT(table, HasSubstr("collection-timestamp"));
    EXPECT_THAT(table, HasSubstr("navigation, source=timestamp"));
    const std::string csv = output_of({"contrast", store, "--csv", "-"});
    EXPECT_EQ(test::read_all(folder / "contrast.csv"), csv);
    EXPECT_THAT(csv, testing::StartsWith("measure,task,profile,arm,baseline,runs,"));
    expect_rectangular(csv, 1 + 2);
    const std::string paired = output_of({"contrast", store, "--paired-csv", "-"});
    EXPECT_THAT(paired, testing::StartsWith("measure,task,profile,change,first_arm,arms,seeds,"));
    EXPECT_THAT(paired,
                HasSubstr("\nf_c,collection,gecco15,source=timestamp,collection-timestamp,1,4,"));
    expect_rectangular(paired, 1 + 2);
}

TEST_F(CommandLineTest, AStudyThatHasChangedSaysWhatStaysBehind) {
    Program::Arguments study{"study", "gecco15", "--quick",        "--seeds",
                             "1",     "--set",   "run.cycles=100", "world.robots=3"};
    output_of(study);
    EXPECT_EQ(test::gene_clocks(folder.path(), study).messages.find("no longer"),
              std::string::npos);
    study.back() = "world.robots=4";
    EXPECT_THAT(
        test::gene_clocks(folder.path(), study).messages,
        HasSubstr("results/gecco15-quick.sqlite: 4 of the 4 arms that it held of this study "
                  "are no longer in the study, or have other settings now"));
}

TEST_F(CommandLineTest, WhatStudiesHaveInCommonCountsOnce) {
    const std::string arms =
        "title = \"x\"\nseeds = 3\n[settings]\nrun.cycles = 300\nworld.robots = 5\n"
        "[[arm]]\ntask = \"navigation\"\nsource = [\"gene-clock\", \"timestamp\"]\n";
    for (const char* name : {"one", "two"}) {
        folder.write(std::string(name) + ".toml", "name = \"" + std::string(name) + "\"\n" + arms);
        output_of({"study", std::string(name) + ".toml", "--store", "both.sqlite"});
    }
    output_of({"study", "two.toml", "--store", "both.sqlite", "--seeds", "4"});
    const std::string both = output_of({"contrast", "both.sqlite", "--csv", "-"});
    EXPECT_EQ(both, output_of({"contrast", "both.sqlite", "--study", "two", "--csv", "-"}));
    EXPECT_EQ(both, output_of({"contrast", "both.sqlite", "--study", "one", "--study", "two",
                               "--study", "one", "--csv", "-"}));
    expect_rectangular(both, 1 + 1);
    const std::string one = output_of({"contrast", "--study", "one", "both.sqlite", "--csv", "-"});
    EXPECT_NE(one, both);
}

TEST_F(CommandLineTest, AStudySaysWhatItsArmsAreComparedWith) {
    const auto make = [&](const std::string& name, const std::string& contrast) {
        folder.write(name + ".toml", "name = \"" + name + R"("
title = "x"
seeds = 3
[settings]
run.cycles = 300
world.robots = 5
[contrast]
)" + contrast + R"(
[[arm]]
task = "navigation"
source = ["gene-clock", "timestamp"]
grid.radio.loss = [0, 0.5]
)");
        output_of({"study", name + ".toml", "--store", "both.sqlite"});
    };
    const auto first_rows = [&](Program::Arguments arguments) {
        arguments.insert(arguments.begin(), {"contrast", "both.sqlite"});
        arguments.insert(arguments.end(), {"--csv", "arms.csv", "--paired-csv", "-"});
        const auto second_line = [](const std::string& csv) {
            std::istringstream stream(csv);
            std::string line;
            std::getline(stream, line);
            std::getline(stream, line);
            return line + "\n";
        };
        const std::string paired = second_line(output_of(arguments));
        return second_line(test::read_all(folder / "arms.csv")) + paired;
    };
    make("one",
         "baseline = [\"radio.loss=0\"]\npaired.baseline = [\"source=gene-clock\"]\n"
         "paired.over = [\"radio.loss\"]");
    EXPECT_THAT(first_rows({}),
                testing::AllOf(HasSubstr("navigation-gene-clock-loss-0p5,navigation-gene-clock-"
                                         "loss-0,"),
                               HasSubstr(",source=timestamp,navigation-timestamp-loss-0,2,3,")));
    EXPECT_THAT(first_rows({"--baseline", "source=gene-clock"}),
                HasSubstr("navigation-timestamp-loss-0,navigation-gene-clock-loss-0,"));
    make("two", "baseline = [\"source=gene-clock\"]");
    EXPECT_THAT(first_rows({"--study", "two"}),
                HasSubstr("navigation-timestamp-loss-0,navigation-gene-clock-loss-0,"));
    const auto both = test::gene_clocks(folder.path(), {"contrast", "both.sqlite"});
    EXPECT_EQ(both.status, 2);
    EXPECT_THAT(both.messages, HasSubstr("the studies one and two say different things"));
}

TEST_F(CommandLineTest, ContrastsNameTheBestThatTheyReferTo) {
    output_of({"study", "gecco15", "--quick", "--seeds", "3", "--set", "run.cycles=300",
               "world.robots=5"});
    const std::string store = "results/gecco15-quick.sqlite";
    EXPECT_THAT(output_of({"contrast", store, "--measure", "f_b"}),
                testing::Not(HasSubstr("best swarm fitness")));
    const std::string over = "over 6 runs of navigation under profile gecco15";
    EXPECT_THAT(output_of({"contrast", store, "--measure", "f_b"}), HasSubstr("f_b against"));
    EXPECT_THAT(output_of({"contrast", store, "--measure", "f_a"}), HasSubstr(over));
    for (const char* option : {"--csv", "--paired-csv"}) {
        const std::string csv = output_of({"contrast", store, "--measure", "f_a", option, "-"});
        EXPECT_THAT(csv, HasSubstr(",best_swarm_fitness,best_over\n"));
        EXPECT_THAT(csv, HasSubstr(",6 runs of navigation under profile gecco15\n"));
    }
}

TEST_F(CommandLineTest, ReproduceLeavesAStoreAndAReport) {
    output_of(
        {"reproduce", "--quick", "--seeds", "2", "--set", "run.cycles=300", "world.robots=5"});
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "results/gecco15-quick/index.html"));
    const std::string csv = output_of({"export", "results/gecco15-quick.sqlite", "--runs", "-"});
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 * 2);
}

TEST_F(CommandLineTest, OutputThatIsLostIsAFailure) {
    const std::string command = std::string(PROGRAM) + " settings > /dev/full 2> /dev/null";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
}

}  // namespace
}  // namespace gene_clocks
