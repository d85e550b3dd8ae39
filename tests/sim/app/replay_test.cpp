// Runs that become a page to watch, and a table of where their genes come from (docs/replay.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/sim/app/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks {
namespace {

using test::Program;
using testing::HasSubstr;
using testing::StartsWith;

class ReplayTest : public testing::Test {
protected:
    Program::Result replay(const Program::Arguments& extra) const {
        Program::Arguments arguments{"replay",          "--task", "navigation",     "--set",
                                     "run.cycles=1500", "--set",  "world.robots=30"};
        arguments.insert(arguments.end(), extra.begin(), extra.end());
        return test::gene_clocks(folder.path(), arguments);
    }
    [[nodiscard]] std::string read(const std::string& file) const {
        return test::read_all(folder.path() / file);
    }
    [[nodiscard]] nlohmann::json recording(const std::string& file) const {
        const std::string page = read(file);
        const std::string begin = "id=\"recording\">";
        const auto at = page.find(begin) + begin.size();
        return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
    }
    [[nodiscard]] std::size_t entries() const {
        const std::filesystem::directory_iterator all(folder.path());
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }
    test::TemporaryFolder folder;
};

TEST_F(ReplayTest, WritesAPageOfTheVeryRun) {
    const auto result = replay({"--output", "run.html", "--seed", "3"});
    ASSERT_EQ(result.status, 0) << result.messages;
    EXPECT_EQ(result.output, "run.html: 1501 frames, one every 1 cycles\n");
    const auto data = recording("run.html");
    EXPECT_EQ(data["robots"], 30);
    EXPECT_EQ(data["frames"]["to"], 1500);
    const auto run = nlohmann::json::parse(
        test::gene_clocks(folder.path(), {"run", "--task", "navigation", "--seed", "3", "--json",
                                          "--set", "run.cycles=1500", "--set", "world.robots=30"})
            .output);
    EXPECT_THAT(data["facts"].dump(), HasSubstr(run["trajectory_hash"].get<std::string>()));
    EXPECT_EQ(data["genes"]["counter"].size() - data["genes"]["genesis"].get<std::size_t>(),
              run["genes_created"]);
    EXPECT_EQ(data["activations"]["count"], 30 + run["births"].get<int>());
    EXPECT_EQ(entries(), 1u);
}

TEST_F(ReplayTest, WritesTheGenealogyAsATable) {
    const auto result = replay({"--genealogy", "genes.csv"});
    ASSERT_EQ(result.status, 0) << result.messages;
    const std::string table = read("genes.csv");
    EXPECT_THAT(table, StartsWith("mark,counter,robot,kind,"));
    const auto rows = std::count(table.begin(), table.end(), '\n') - 1;
    EXPECT_GT(rows, 5);
    EXPECT_EQ(result.output, "genes.csv: " + std::to_string(rows) + " genes of the final swarm\n");
    EXPECT_EQ(entries(), 1u);
    ASSERT_EQ(replay({"--genealogy", "again.csv", "--output", "run.html", "--every", "500"}).status,
              0);
    EXPECT_EQ(read("again.csv"), table);
}

TEST_F(ReplayTest, ShowsTheCyclesAskedFor) {
    ASSERT_EQ(
        replay({"--output", "run.html", "--from", "100", "--to", "333", "--every", "50"}).status,
        0);
    const auto frames = recording("run.html")["frames"];
    EXPECT_EQ(frames["from"], 100);
    EXPECT_EQ(frames["to"], 333);
    EXPECT_EQ(frames["every"], 50);
    EXPECT_EQ(frames["count"], 6);
}

TEST_F(ReplayTest, WithoutEveryThePageKeepsToItsUsualSize) {
    ASSERT_EQ(test::gene_clocks(folder.path(), {"replay", "--task", "navigation", "--output",
                                                "run.html", "--set", "run.cycles=6000", "--set",
                                                "world.robots=300", "--set", "world.arena=open"})
                  .status,
              0);
    EXPECT_EQ(recording("run.html")["frames"]["every"], 2);
    EXPECT_LT(std::filesystem::file_size(folder / "run.html"), 14'000'000u);
}

TEST_F(ReplayTest, AnyMarkingWillDo) {
    for (const char* source : {"timestamp-drift", "random-identifier", "global-counter",
                               "congruence-class", "content-hash", "hybrid-logical-clock"}) {
        const auto result = replay({"--output", "run.html", "--genealogy", "genes.csv", "--source",
                                    source, "--every", "100"});
        EXPECT_EQ(result.status, 0) << result.messages;
        EXPECT_EQ(recording("run.html")["source"], source);
    }
}

TEST_F(ReplayTest, WhatCannotBeShownIsRefusedAndNothingIsWritten) {
    const auto refused = [&](const Program::Arguments& arguments, const std::string& message) {
        const std::size_t before = entries();
        const auto result = replay(arguments);
        const std::string words = testing::PrintToString(arguments);
        EXPECT_EQ(result.status, 2) << words;
        EXPECT_EQ(result.output, "") << words;
        EXPECT_THAT(result.messages, StartsWith("gene-clocks: ")) << words;
        EXPECT_THAT(result.messages, HasSubstr(message)) << words;
        EXPECT_EQ(entries(), before) << words;
    };
    refused({}, "nothing to write");
    refused({"--output"}, "--output");
    refused({"--ouput", "run.html"}, "did you mean --output?");
    refused({"--output", "run.html", "--set", "run.cycels=5"}, "did you mean run.cycles?");
    refused({"--output", "run.html", "--source", "gene-clok"}, "did you mean gene-clock?");
    refused({"--output", "run.html", "--to", "1501"}, "--to: the run has only 1500 cycles");
    refused({"--output", "run.html", "--from", "1500"}, "--from: must come before");
    refused({"--output", "run.html", "--from", "20", "--to", "20"}, "--from: must come before");
    refused({"--output", "run.html", "--from", "-1"}, "--from");
    refused({"--output", "run.html", "--every", "0"}, "--every");
    refused({"--output", "run.html", "--every", "soon"}, "--every");
    refused({"--output", "run.html", "--seed", "-1"}, "--seed");
    refused({"--output", "run.html", "--every", "1", "--set", "run.cycles=1000000"},
            "--every: 1000001 frames of 30 robots make a page of about 240 MB, more than 200");
    refused({"--output", ""}, "the name of an output file is empty");
    refused({"--output", "-"}, "cannot go to standard output");
    refused({"--output", "."}, "not a regular file");
    refused({"--output", "no/such/folder/run.html"}, "cannot be written there");
    refused({"--output", "run.html", "--genealogy", "./run.html"},
            "--genealogy: --output goes to ./run.html already");
    refused({"--output", "run.html", "--genealogy", "no/such/genes.csv"},
            "cannot be written there");
    folder.write("link.toml", "name = 1");
    refused({"--output", "run.html", "--set", "world.arena=link.toml"}, "link.toml:1: name");
}

TEST_F(ReplayTest, ARunThatIsCutShortLeavesNothing) {
    Program program(folder.path(), {"replay", "--task", "navigation", "--set", "run.cycles=1000000",
                                    "--to", "10", "--output", "run.html"});
    ASSERT_TRUE(
        program.wait_until([&] { return std::filesystem::exists(folder / "run.html.part"); }));
    program.signal(SIGTERM);
    EXPECT_EQ(program.wait().status, 130);
    EXPECT_EQ(std::filesystem::exists(folder / "run.html"), false);
    EXPECT_EQ(std::filesystem::exists(folder / "run.html.part"), false);
}

TEST_F(ReplayTest, AnArenasNameIsOnlyText) {
    folder.write("arena.toml",
                 "name = \"</script><script>alert(1)</script>\"\n"
                 "width_px = 200\nheight_px = 200\nwalls = []\n"
                 "frame = { left_px = 5, top_px = 5, right_px = 5, bottom_px = 5 }\n");
    ASSERT_EQ(replay({"--output", "plain.html", "--every", "100"}).status, 0);
    const auto result =
        replay({"--output", "run.html", "--set", "world.arena=arena.toml", "--every", "100"});
    ASSERT_EQ(result.status, 0) << result.messages;
    EXPECT_EQ(recording("run.html")["arena"]["name"], "</script><script>alert(1)</script>");
    EXPECT_THAT(read("run.html"), testing::Not(HasSubstr("alert(1)</script>")));
}

}  // namespace
}  // namespace gene_clocks
