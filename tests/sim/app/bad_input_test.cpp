// Whatever is wrong with its input, the program says what and where, exits with 2, prints nothing
// on standard output and writes no file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/app/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks {
namespace {

using test::Program;
using testing::HasSubstr;

class BadInputTest : public testing::Test {
protected:
    void expect_refusal(const Program::Arguments& arguments, const std::string& message) const {
        const auto before = files();
        const Program::Result result = test::gene_clocks(folder.path(), arguments);
        const std::string words = testing::PrintToString(arguments);
        EXPECT_EQ(result.status, 2) << words << result.messages;
        EXPECT_EQ(result.output, "") << words;
        EXPECT_THAT(result.messages, testing::StartsWith("gene-clocks: ")) << words;
        EXPECT_THAT(result.messages, HasSubstr(message)) << words;
        EXPECT_EQ(files(), before) << words;
    }
    /// Every file with its text.
    [[nodiscard]] std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
            all[entry.path().string()] =
                entry.is_regular_file() ? test::read_all(entry.path()) : "";
        }
        return all;
    }
    test::TemporaryFolder folder;
};

TEST_F(BadInputTest, CommandsAndOptions) {
    expect_refusal({}, "subcommand is required");
    expect_refusal({"rnu"}, "rnu: there is no such command; did you mean run?");
    expect_refusal({"run"}, "--task is required");
    expect_refusal({"run", "--task"}, "--task");
    expect_refusal({"run", "--taks", "navigation"},
                   "--taks: there is no such option; did you mean --task?");
    expect_refusal({"run", "--task", "navigation", "--sede", "3"},
                   "--sede: there is no such option; did you mean --seed?");
    expect_refusal({"run", "--task", "navigation", "surplus"}, "surplus: one argument too many");
    expect_refusal({"study"}, "STUDY is required");
    expect_refusal({"study", "gecco15", "--threads", "0"}, "--threads");
    expect_refusal({"study", "gecco15", "--seeds", "-1"}, "--seeds");
    expect_refusal({"settings", "--format", "yaml"}, "yaml");
    expect_refusal({"settings", "--format", "toml"}, "--task");
    expect_refusal({"settings", "--task", "navigation"}, "--format text: lists all keys");
    expect_refusal({"settings", "odneat", "--set", "run.cycles=3"},
                   "--format text: lists all keys");
    expect_refusal({"settings", "odneat", "--task", "navigation", "--format", "toml"},
                   "odneat: --format toml shows all settings");
    expect_refusal({"settings", "wolrd"},
                   "wolrd: there is no such key or table; did you mean world?");
    expect_refusal({"settings", "--builtin", "studies/gecco51.toml"},
                   "did you mean studies/gecco15.toml?");
    expect_refusal({"export", "none.sqlite"}, "--runs FILE");
}

TEST_F(BadInputTest, Choices) {
    expect_refusal(
        {"run", "--task", "navigaton"},
        "--task: \"navigaton\" is not navigation or collection; did you mean navigation?");
    expect_refusal({"run", "--task", "navigation", "--source", "clock"},
                   "--source: \"clock\" is not gene-clock, gene-clock-no-merge, timestamp");
    expect_refusal({"run", "--task", "navigation", "--profile", "gecco16"},
                   "profile \"gecco16\": there is none of that name; did you mean gecco15?");
    expect_refusal({"run", "--task", "navigation", "--parameters", "D"}, "parameter set \"D\"");
    for (const char* seed : {"-1", "1.5", "one", "", "99999999999999999999"}) {
        expect_refusal({"run", "--task", "navigation", "--seed", seed}, "--seed");
    }
}

TEST_F(BadInputTest, Assignments) {
    const auto with = [](const std::string& assignment) {
        return Program::Arguments{"run", "--task", "navigation", "--set", assignment};
    };
    expect_refusal(with("odneat.p_mtae=0.5"),
                   "odneat.p_mtae: unknown key; did you mean odneat.p_mate?");
    expect_refusal(with("p_mate=0.5"), "did you mean odneat.p_mate?");
    expect_refusal(with("odneat.p_mate=1.5"), "odneat.p_mate: 1.5 is outside [0, 1]");
    expect_refusal(with("odneat.p_mate=nan"), "outside");
    expect_refusal(with("world.robots=3.5"), "world.robots: expected a whole number");
    expect_refusal(with("world.robots=many"), "world.robots: \"many\" is not a value");
    expect_refusal(with("world.arena=opne"), "did you mean open?");
    expect_refusal(with("radio.range_px=31"), "radio.range_px: 31 exceeds world.sensor_range_px");
    expect_refusal(with("run.cycles=10"), "the run would have no samples");
    expect_refusal(with("odneat.p_mate"), "expected key=value");
}

TEST_F(BadInputTest, SettingsFiles) {
    const auto with = [&](const std::string& text) {
        folder.write("mine.toml", text);
        return Program::Arguments{"run", "--task", "navigation", "--settings", "mine.toml"};
    };
    expect_refusal(with("[odneat]\np_mtae = 0.5\n"),
                   "mine.toml:2: odneat.p_mtae: unknown key; did you mean odneat.p_mate?");
    expect_refusal(with("[odneat]\np_mate = \"0.5\"\n"),
                   "mine.toml:2: odneat.p_mate: expected a real number, found a text");
    expect_refusal(with("[odneat]\np_mate = 1.5\n"),
                   "mine.toml:2: odneat.p_mate: 1.5 is outside [0, 1]");
    expect_refusal(with("[odneat\n"), "mine.toml:1: ");
    expect_refusal(with("[world]\narena = \"none.toml\"\n"), "none.toml: there is no such file");
    expect_refusal({"run", "--task", "navigation", "--settings", "none.toml"},
                   "none.toml: there is no such file");
    expect_refusal({"run", "--task", "navigation", "--settings", "."}, "is not a regular file");
    expect_refusal({"run", "--task", "navigation", "--profile", "none.toml"},
                   "none.toml: there is no such file");
}

TEST_F(BadInputTest, Arenas) {
    const auto with = [&](const std::string& text) {
        folder.write("arena.toml",
                     "name = \"x\"\nwidth_px = 40\nheight_px = 40\n"
                     "frame = { left_px = 5, top_px = 5, right_px = 5, bottom_px = 5 }\n" +
                         text);
        return Program::Arguments{"run", "--task", "navigation", "--set", "world.arena=arena.toml"};
    };
    expect_refusal(with("walls = [[1, 2, 3, 4]]"), "arena.toml:5: walls[0]: expected five numbers");
    expect_refusal(with("walls = [[1, 2, 3, nan, 5]]"), "walls[0]: nan is outside [0, 40]");
    expect_refusal(with("walls = []\nhegiht_px = 3"), "did you mean height_px?");
    expect_refusal(with("walls = [[0, 20, 40, 20, 40]]"), "free place");  // all wall
    auto crowd = with("walls = []");
    crowd.insert(crowd.end(), {"--set", "world.robots=1000"});
    expect_refusal(crowd, "free place");
}

TEST_F(BadInputTest, Studies) {
    const std::string arm =
        "[[arm]]\nname = \"a\"\ntask = \"navigation\"\nsource = \"gene-clock\"\n";
    const auto with = [&](const std::string& text) {
        folder.write("study.toml", text);
        return Program::Arguments{"study", "study.toml", "--store", "runs.sqlite"};
    };
    const std::string head = "name = \"x\"\ntitle = \"X\"\n";
    expect_refusal({"study", "gecco51"},
                   "study \"gecco51\": there is none of that name; did you mean gecco15?");
    expect_refusal({"study", "none.toml"}, "none.toml: there is no such file");
    expect_refusal(with(head + "sedes = 4\n" + arm),
                   "study.toml:3: sedes: unknown key; did you mean seeds?");
    expect_refusal(with(head), "arm: is missing");
    expect_refusal(with(head + arm + "settings = { odneat.p_mate = 2 }\n"),
                   "study.toml:7: odneat.p_mate: 2 is outside [0, 1]");
    folder.write("full.toml",
                 "name = \"full\"\nwidth_px = 30\nheight_px = 30\nwalls = []\n"
                 "frame = { left_px = 5, top_px = 5, right_px = 5, bottom_px = 5 }\n");
    expect_refusal(with(head + arm + "settings = { world.arena = \"full.toml\" }\n"), "arm a: ");
}

TEST_F(BadInputTest, Shards) {
    for (const char* shard : {"0/4", "5/4", "a/b", "", "3", "1/0", "-1/4", "1/4/4"}) {
        for (const char* dry_run : {"--dry-run", "--quick"}) {
            expect_refusal({"study", "gecco15", "--quick", "--shard", shard, dry_run}, "--shard: ");
        }
    }
    expect_refusal({"study", "gecco15", "--shard"}, "--shard");
}

TEST_F(BadInputTest, Stores) {
    const auto study = [](const std::string& store) {
        return Program::Arguments{"study", "gecco15", "--quick", "--store", store};
    };
    folder.write("text.sqlite", "seed,f_c\n" + std::string(500, '1'));
    expect_refusal(study("text.sqlite"), "text.sqlite: is not a store of runs");
    expect_refusal({"export", "text.sqlite", "--runs", "runs.csv"},
                   "text.sqlite: is not a store of runs");
    expect_refusal({"study", "gecco15", "--store", "text.sqlite", "--dry-run"},
                   "text.sqlite: is not a store of runs");
    expect_refusal(study("."), "is a folder");
    expect_refusal(study("text.sqlite/runs.sqlite"), "the folder text.sqlite cannot be created");
    expect_refusal(study("/proc/runs.sqlite"),
                   "/proc/runs.sqlite: cannot be opened or created there");
    expect_refusal({"export", "none.sqlite", "--runs", "runs.csv"},
                   "none.sqlite: there is no such store");
    expect_refusal({"report", "none.sqlite"}, "none.sqlite: there is no such store");
    expect_refusal({"report", "text.sqlite"}, "text.sqlite: is not a store of runs");
}

TEST_F(BadInputTest, OtherStudiesAndPathsOnExport) {
    ASSERT_EQ(test::gene_clocks(folder.path(),
                                {"study", "gecco15", "--quick", "--seeds", "1", "--store",
                                 "runs.sqlite", "--set", "run.cycles=100", "world.robots=3"})
                  .status,
              0);
    expect_refusal({"export", "runs.sqlite", "--study", "gecco51", "--runs", "-"},
                   "holds no study \"gecco51\"; there is gecco15-quick");
    expect_refusal({"report", "runs.sqlite", "--study", "gecco51"}, "holds no study \"gecco51\"");
    expect_refusal({"export", "runs.sqlite", "--runs", "none/runs.csv"},
                   "none/runs.csv: cannot be written there");
    const auto contrast = [](const std::string& option, const std::string& value) {
        return Program::Arguments{"contrast", "runs.sqlite", option, value};
    };
    expect_refusal(contrast("--csv", "none/contrast.csv"), "none/contrast.csv: cannot be written");
    expect_refusal(contrast("--measure", "f_d"), "no measure \"f_d\"; did you mean f_c?");
    expect_refusal(contrast("--margin", "0"), "--margin: is not between 0 and 1");
    expect_refusal(contrast("--level", "2"), "--level: is not between 0 and 1");
    expect_refusal(contrast("--paired-csv", "none/paired.csv"),
                   "none/paired.csv: cannot be written");
    expect_refusal({"contrast", "runs.sqlite", "--against", "some", "--baseline", "radio.loss=0"},
                   "--baseline excludes --against");
    expect_refusal(contrast("--against", "some"), "--against: there is no arm \"some\" with runs");
    expect_refusal(contrast("--over", "radio.los"),
                   "--over: there is no setting \"radio.los\"; did you mean radio.loss?");
    expect_refusal({"contrast", "runs.sqlite", "--csv", "-", "--paired-csv", "-"},
                   "--paired-csv: --csv goes to - already");
    expect_refusal({"contrast", "runs.sqlite", "--csv", "a.csv", "--paired-csv", "./a.csv"},
                   "--paired-csv: --csv goes to ./a.csv already");
    expect_refusal({"export", "runs.sqlite", "--runs", "a.csv", "--samples", "none/../a.csv"},
                   "--samples: --runs goes to none/../a.csv already");
    expect_refusal({"contrast", "runs.sqlite", "--csv", "a.csv", "--paired-csv", "none/b.csv"},
                   "none/b.csv: cannot be written");
    expect_refusal(contrast("--baseline", "radio.los=0"),
                   "--baseline radio.los=0: radio.los: unknown key; did you mean radio.loss?");
    const auto nothing =
        test::gene_clocks(folder.path(), contrast("--baseline", "odneat.population=7"));
    EXPECT_EQ(nothing.status, 2);
    for (const char* part : {"study \"gecco15-quick\": there is nothing to compare",
                             "is left out: there is no arm with runs that has odneat.population=7 "
                             "and is otherwise the "
                             "same",
                             "choose what is compared by --baseline KEY=VALUE or --against ARM"})
        EXPECT_THAT(nothing.messages, testing::HasSubstr(part));
    expect_refusal({"contrast", "none.sqlite"}, "none.sqlite: there is no such store");
}

}  // namespace
}  // namespace gene_clocks
