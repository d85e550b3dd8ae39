// Runs that are recorded, and the check of what was recorded (docs/trace-format.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
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
using testing::MatchesRegex;
using testing::StartsWith;

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
    test::TemporaryFolder folder;
};

TEST_F(TraceTest, ARecordedRunIsTheSameAndKeepsTheProtocol) {
    const auto plain = nlohmann::json::parse(run({}).output);
    const auto observed = nlohmann::json::parse(run({"--trace", "run.trace"}).output);
    EXPECT_EQ(observed["trajectory_hash"], plain["trajectory_hash"]);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "run.trace.part"));

    const auto verdict = check("run.trace");
    EXPECT_EQ(verdict.status, 0) << verdict.messages;
    EXPECT_THAT(verdict.output, MatchesRegex("run.trace: [0-9]+ entries accepted: .*\n"));

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
    folder.write("other.trace", trace.substr(0, counter) + '1' + trace.substr(counter));
    const auto verdict = check("other.trace");
    EXPECT_EQ(verdict.status, 1);
    const auto line = 2 + std::count(trace.begin(), trace.begin() + static_cast<long>(made), '\n');
    EXPECT_THAT(verdict.output,
                StartsWith("other.trace:" + std::to_string(line) +
                           ": not-next-counter: a gene took a counter that is not its robot's "
                           "next (robot "));
    EXPECT_THAT(verdict.output, HasSubstr("\n    m "));
}

TEST_F(TraceTest, WhatIsNoTraceIsRefused) {
    ASSERT_EQ(run({"--trace", "run.trace"}).status, 0);
    const std::string trace = recorded();
    const auto refused = [&](const std::string& file, const std::string& message) {
        const auto verdict = check(file);
        EXPECT_EQ(verdict.status, 2) << file;
        EXPECT_EQ(verdict.output, "") << file;
        EXPECT_THAT(verdict.messages, StartsWith("gene-clocks: ")) << file;
        EXPECT_THAT(verdict.messages, HasSubstr(message)) << file;
    };
    refused("absent.trace", "absent.trace: cannot be read");
    refused(".", ".: is a folder");
    folder.write("other.trace", "");
    refused("other.trace", "other.trace:1: not a trace of version 1");
    folder.write("other.trace", "gene-clocks-trace 2\n");
    refused("other.trace", "other.trace:1: not a trace of version 1");
    folder.write("other.trace", std::string("\x1f\x8b\x08\x00\x1b[31m\n", 9));
    refused("other.trace", "other.trace:1: not a trace of version 1 (is it compressed?)");
    refused(PROGRAM, ":1: not a trace of version 1");
    // Wherever a trace is cut, it is no longer one.
    const std::size_t size = trace.size();
    for (const std::size_t length : {size / 7, size / 3, size - 30, size - 3, size - 2, size - 1}) {
        folder.write("other.trace", trace.substr(0, length));
        refused("other.trace", "cut short");
    }
}

TEST_F(TraceTest, NothingIsWrittenWhereNoTraceCanBe) {
    const auto refused = [&](const Program::Arguments& arguments, const std::string& message) {
        const auto result = run(arguments);
        EXPECT_EQ(result.status, 2) << result.messages;
        EXPECT_EQ(result.output, "");
        EXPECT_THAT(result.messages, HasSubstr(message));
    };
    folder.write("old.trace", "old");
    refused({"--source", "timestamp", "--trace", "old.trace"}, "only robots with gene clocks");
    refused({"--trace", "no/such/folder/run.trace"}, "folder/run.trace: cannot be written there");
    refused({"--trace", "."}, ".: exists and is not a regular file");
    refused({"--trace", ""}, "the name of an output file is empty");
    refused({"--trace", "-"}, "needs a file");
    std::filesystem::create_symlink("old.trace", folder / "link");
    refused({"--trace", "link"}, "link: exists and is not a regular file");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(test::read_all(folder / "old.trace"), "old");
    EXPECT_FALSE(std::filesystem::exists(folder / "old.trace.part"));
}

TEST_F(TraceTest, ARunThatIsCutShortLeavesNoWholeTrace) {
    for (const int signal : {SIGTERM, SIGKILL}) {
        Program program(folder.path(), {"run", "--task", "navigation", "--set",
                                        "run.cycles=1000000", "--trace", "run.trace"});
        const auto unfinished = folder / "run.trace.part";
        ASSERT_TRUE(program.wait_until([&] { return !test::read_all(unfinished).empty(); }));
        program.signal(signal);
        const auto result = program.wait();
        EXPECT_EQ(result.status, signal == SIGTERM ? 130 : -SIGKILL);
        EXPECT_FALSE(std::filesystem::exists(folder / "run.trace"));
        EXPECT_EQ(std::filesystem::exists(unfinished), signal == SIGKILL);
    }
    EXPECT_EQ(check("run.trace.part").status, 2);
    // What a killed run left is not in the way of the next.
    EXPECT_EQ(run({"--trace", "run.trace"}).status, 0);
    EXPECT_EQ(check("run.trace").status, 0);
}

}  // namespace
}  // namespace gene_clocks
