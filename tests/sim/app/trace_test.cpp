// Runs that are recorded, and the check of what was recorded (docs/trace-format.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"
#include "temporary_folder.hpp"

namespace gene_clocks {
namespace {

using test::Program;
using testing::HasSubstr;
using testing::MatchesRegex;

class TraceTest : public testing::Test {
protected:
    Program::Result run(const Program::Arguments& extra) const {
        Program::Arguments arguments{"run",          "--task", "navigation", "--json",
                                     "--parameters", "B",      "--set",      "run.cycles=1500"};
        arguments.insert(arguments.end(), extra.begin(), extra.end());
        return test::gene_clocks(folder.path(), arguments);
    }
    Program::Result check(const std::string& file) const {
        return test::gene_clocks(folder.path(), {"check-trace", file});
    }
    [[nodiscard]] std::string recorded() const {
        return test::read_all(folder.path() / "run.trace");
    }
    void write(const std::string& text) const {
        std::ofstream(folder.path() / "other.trace", std::ios::binary) << text;
    }
    test::TemporaryFolder folder;
};

TEST_F(TraceTest, ARecordedRunIsTheSameAndKeepsTheProtocol) {
    const auto plain = nlohmann::json::parse(run({}).output);
    const auto observed = nlohmann::json::parse(run({"--trace", "run.trace"}).output);
    EXPECT_EQ(observed["trajectory_hash"], plain["trajectory_hash"]);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "run.trace.part"));

    const auto verdict = check("run.trace");
    EXPECT_EQ(verdict.status, 0) << verdict.messages;
    EXPECT_THAT(verdict.output, MatchesRegex("accepted [0-9]+\n"));

    // Nothing is left out.
    const std::string trace = recorded();
    const auto count = [&](const std::string& kind) {
        std::size_t found = 0;
        for (auto at = trace.find("\n" + kind); at != std::string::npos;
             at = trace.find("\n" + kind, at + 1)) {
            ++found;
        }
        return found;
    };
    EXPECT_GT(count("m "), 0u);
    EXPECT_EQ(count("m "), observed["genes_created"]);
    EXPECT_EQ(count("s "), observed["messages_sent"]);
    EXPECT_EQ(count("r "), observed["messages_received"]);
}

TEST_F(TraceTest, DelayedAndLostMessagesToo) {
    const auto result =
        run({"--trace", "run.trace", "--set", "radio.delay_cycles=7", "--set", "radio.loss=0.3"});
    ASSERT_EQ(result.status, 0) << result.messages;
    EXPECT_THAT(check("run.trace").output, HasSubstr("accepted"));
}

TEST_F(TraceTest, AForgedTraceIsFoundOut) {
    ASSERT_EQ(run({"--trace", "run.trace"}).status, 0);
    const std::string trace = recorded();
    const auto made = trace.find("\nm ");
    const auto counter = trace.find(' ', made + 3) + 1;
    // The gene takes a counter from far ahead.
    write(trace.substr(0, counter) + '1' + trace.substr(counter));
    const auto verdict = check("other.trace");
    EXPECT_EQ(verdict.status, 1);
    EXPECT_THAT(verdict.output, MatchesRegex("line [0-9]+: not-next-counter\n"));
}

TEST_F(TraceTest, WhatIsWrongWithItsInputIsSaid) {
    write("gene-clocks-trace 1\n");
    const auto malformed = check("other.trace");
    EXPECT_EQ(malformed.status, 2);
    EXPECT_EQ(malformed.output, "line 2: malformed\n");
    EXPECT_THAT(malformed.messages, HasSubstr("other.trace: line 2: cut short"));
    EXPECT_THAT(check("absent.trace").messages, HasSubstr("absent.trace: cannot be read"));
    EXPECT_EQ(check("absent.trace").status, 2);

    const auto timestamps = run({"--source", "timestamp", "--trace", "run.trace"});
    EXPECT_EQ(timestamps.status, 2);
    EXPECT_EQ(timestamps.output, "");
    EXPECT_THAT(timestamps.messages, HasSubstr("only robots with gene clocks"));
    const auto unwritable = run({"--trace", "no/such/folder/run.trace"});
    EXPECT_EQ(unwritable.status, 2);
    EXPECT_THAT(unwritable.messages, HasSubstr("cannot be written"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "run.trace"));
}

}  // namespace
}  // namespace gene_clocks
