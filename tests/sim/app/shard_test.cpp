// A study that was made in parts, and put together, is the study that was made at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/sim/app/program.hpp"
#include "tests/sim/app/store_contents.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks {
namespace {

using test::Program;
using testing::HasSubstr;

constexpr const char* study = R"(
name = "x"
title = "X"
seeds = 5
settings = { world.robots = 8, run.cycles = 500 }
[[arm]]
task = ["navigation", "collection"]
source = ["gene-clock", "timestamp"]
grid = { radio.loss = [0, 0.5] }
)";

class ShardTest : public testing::Test {
protected:
    void SetUp() override { folder.write("x.toml", study); }

    Program::Result run(const Program::Arguments& arguments) const {
        return test::gene_clocks(folder.path(), arguments);
    }
    void expect_success(const Program::Arguments& arguments, const std::string& message) const {
        const auto result = run(arguments);
        EXPECT_EQ(result.status, 0) << result.messages;
        EXPECT_THAT(result.messages, HasSubstr(message));
    }
    /// All of the study's runs, made at once.
    [[nodiscard]] std::string whole() const {
        EXPECT_EQ(run({"study", "x.toml", "--store", "whole.sqlite"}).status, 0);
        const std::string contents = test::store_contents(folder.path(), "whole.sqlite");
        EXPECT_EQ(std::count(contents.begin(), contents.end(), '\n'), 1 + 40 + 1 + 40 * 5);
        return contents;
    }
    test::TemporaryFolder folder;
};

TEST_F(ShardTest, ShardsThatAreMergedAreTheWholeStudy) {
    expect_success({"study", "x.toml", "--shard", "1/3"}, "x-shard-1-of-3.sqlite: all 14 runs");
    expect_success({"study", "x.toml", "--shard", "2/3"}, "x-shard-2-of-3.sqlite: all 13 runs");
    expect_success({"study", "x.toml", "--shard", "3/3"}, "x-shard-3-of-3.sqlite: all 13 runs");
    expect_success({"merge", "all.sqlite", "results/x-shard-1-of-3.sqlite",
                    "results/x-shard-2-of-3.sqlite", "results/x-shard-3-of-3.sqlite"},
                   "all.sqlite: 40 runs were added; it holds 40 now");
    EXPECT_EQ(test::store_contents(folder.path(), "all.sqlite"), whole());
    expect_success({"study", "x.toml", "--store", "all.sqlite"},
                   "40 of 40 runs are finished already");
    expect_success({"merge", "all.sqlite", "results/x-shard-2-of-3.sqlite"},
                   "all.sqlite: 0 runs were added; it holds 40 now");
}

TEST_F(ShardTest, AStudyGoesOnFromMergedShards) {
    expect_success({"study", "x.toml", "--shard", "1/3", "--store", "a.sqlite"}, "all 14 runs");
    expect_success({"merge", "x.sqlite", "a.sqlite"}, "14 runs were added");
    expect_success({"study", "x.toml", "--store", "x.sqlite"},
                   "14 of 40 runs are finished already");
    EXPECT_EQ(test::store_contents(folder.path(), "x.sqlite"), whole());
}

TEST_F(ShardTest, MoreShardsThanRunsLeaveSomeEmpty) {
    expect_success({"study", "x.toml", "--shard", "41/41", "--store", "a.sqlite"}, "");
    expect_success({"merge", "b.sqlite", "a.sqlite"}, "0 runs were added; it holds 0 now");
}

TEST_F(ShardTest, StoresThatContradictEachOtherAreNotMerged) {
    expect_success({"study", "x.toml", "--shard", "1/9", "--store", "a.sqlite"}, "");
    expect_success({"study", "x.toml", "--shard", "2/9", "--store", "b.sqlite", "--seeds", "4"},
                   "");
    folder.write("text.sqlite", std::string(1000, 'x'));
    const std::string before = test::read_all(folder / "a.sqlite");
    const auto refused = [&](const Program::Arguments& arguments, const std::string& message) {
        const auto result = run(arguments);
        EXPECT_EQ(result.status, 2);
        EXPECT_EQ(result.output, "");
        EXPECT_THAT(result.messages, testing::StartsWith("gene-clocks: "));
        EXPECT_THAT(result.messages, HasSubstr(message));
        EXPECT_EQ(test::read_all(folder / "a.sqlite"), before);
        EXPECT_FALSE(std::filesystem::exists(folder / "new.sqlite"));
    };
    refused({"merge", "a.sqlite", "b.sqlite"},
            "b.sqlite: study x differs from that in a.sqlite: it has other seeds");
    refused({"merge", "new.sqlite", "a.sqlite", "b.sqlite"}, "b.sqlite: study x differs from that in a.sqlite");
    refused({"merge", "a.sqlite", "a.sqlite"}, "a.sqlite: is the output store");
    refused({"merge", "new.sqlite", "a.sqlite", "./a.sqlite"}, "./a.sqlite: is named twice");
    refused({"merge", "a.sqlite", "text.sqlite"}, "text.sqlite: is not a store of runs");
    refused({"merge", "new.sqlite", "none.sqlite"}, "none.sqlite: there is no such store");
    refused({"merge", "a.sqlite"}, "IN is required");
    refused({"merge"}, "OUT is required");
}

// docs/clusters.md: its script for Slurm, with Slurm's variables set by hand.
TEST_F(ShardTest, TheScriptForSlurmArraysMakesTheWholeStudy) {
    const std::string page = test::read_all(SOURCE_FOLDER "/docs/clusters.md");
    const auto start = page.find("#!/bin/bash");
    ASSERT_NE(start, std::string::npos);
    std::string script = page.substr(start, page.find("\n```", start) - start) + "\n";
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{"gene-clocks study", PROGRAM " study"},
          {"my-study.toml", "x.toml"}}) {
        ASSERT_NE(script.find(from), std::string::npos);
        for (auto at = script.find(from); at != std::string::npos;
             at = script.find(from, at + to.size()))
            script.replace(at, from.size(), to);
    }
    folder.write("study.sh", script);
    for (const char* task : {"1", "2", "3", "4"}) {
        const std::string command = "cd '" + folder.path().string() +
                                    "' && SLURM_ARRAY_TASK_ID=" + task +
                                    " SLURM_ARRAY_TASK_COUNT=4 SLURM_CPUS_PER_TASK=2 "
                                    "bash study.sh 2> messages";
        ASSERT_EQ(std::system(command.c_str()), 0) << test::read_all(folder / "messages");
    }
    // What the page says to do in the end.
    const std::string line =
        "gene-clocks merge results/my-study.sqlite results/my-study-shard-*-of-4.sqlite";
    ASSERT_NE(page.find(line), std::string::npos);
    const std::string merge = "cd '" + folder.path().string() +
                              "' && " PROGRAM
                              " merge results/x.sqlite "
                              "results/x-shard-*-of-4.sqlite 2> messages";
    ASSERT_EQ(std::system(merge.c_str()), 0) << test::read_all(folder / "messages");
    EXPECT_EQ(test::store_contents(folder.path(), "results/x.sqlite"), whole());
}

}  // namespace
}  // namespace gene_clocks
