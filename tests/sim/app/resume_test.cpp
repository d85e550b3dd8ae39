// A study that is stopped or killed and started again ends with the results of one that never was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "tests/sim/app/program.hpp"
#include "tests/sim/app/store_contents.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks {
namespace {

using test::Program;
using testing::HasSubstr;

/// Two arms of runs that take some 20 ms each.
constexpr const char* study = R"(
name = "x"
title = "X"
seeds = 12
settings = { world.robots = 30, run.cycles = 3000 }
[[arm]]
name = "one"
task = "navigation"
source = "gene-clock"
[[arm]]
name = "two"
task = "collection"
source = "timestamp"
)";

class ResumeTest : public testing::Test {
protected:
    void SetUp() override { folder.write("x.toml", study); }

    [[nodiscard]] Program::Arguments arguments(const std::string& store,
                                               const std::string& seeds = "12") const {
        return {"study", "x.toml", "--store", store, "--threads", "2", "--seeds", seeds};
    }
    [[nodiscard]] std::string contents(const std::string& store) const {
        return test::store_contents(folder.path(), store);
    }
    [[nodiscard]] std::string uninterrupted(const std::string& seeds = "12") const {
        EXPECT_EQ(test::gene_clocks(folder.path(), arguments("whole.sqlite", seeds)).status, 0);
        return contents("whole.sqlite");
    }
    test::TemporaryFolder folder;
};

TEST_F(ResumeTest, AKilledStudyEndsAsOneThatWasNot) {
    int kills = 0;
    for (auto delay = std::chrono::milliseconds(20);; delay += std::chrono::milliseconds(20)) {
        Program program(folder.path(), arguments("killed.sqlite"));
        std::this_thread::sleep_for(delay);
        program.signal(SIGKILL);
        const auto result = program.wait();
        if (result.status != -SIGKILL) {
            ASSERT_EQ(result.status, 0) << result.messages;
            break;
        }
        ++kills;
    }
    EXPECT_GE(kills, 3);
    const std::string whole = uninterrupted();
    EXPECT_EQ(std::count(whole.begin(), whole.end(), '\n'), 1 + 24 + 1 + 24 * 30);
    EXPECT_EQ(contents("killed.sqlite"), whole);
}

TEST_F(ResumeTest, AStudyThatIsInterruptedTenTimesEndsAsOneThatWasNot) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const std::string whole = uninterrupted("60");
    const auto duration = Clock::now() - start;
    // Anywhere in what comes after the start: among the runs, or while one enters the store. The
    // ten together leave half of the study's time at least, so that none comes too late.
    std::mt19937 random(20150711);
    const auto share = [&] { return static_cast<double>(random()) * 0x1p-32 / 20; };
    int interruptions = 0;
    int killed = 0;
    while (interruptions < 10) {
        Program program(folder.path(), arguments("interrupted.sqlite", "60"));
        ASSERT_TRUE(program.wait_for_message("executing"));
        std::this_thread::sleep_for(share() * duration);
        const bool kill = random() % 2 == 0;
        program.signal(kill ? SIGKILL : SIGINT);
        const auto result = program.wait();
        ASSERT_EQ(result.status, kill ? -SIGKILL : 130) << result.messages;
        ++interruptions;
        if (kill) ++killed;
    }
    EXPECT_GE(killed, 2);
    EXPECT_LE(killed, 8);
    const auto last = test::gene_clocks(folder.path(), arguments("interrupted.sqlite", "60"));
    ASSERT_EQ(last.status, 0) << last.messages;
    EXPECT_THAT(last.messages, HasSubstr("of 120 runs are finished already"));
    EXPECT_EQ(contents("interrupted.sqlite"), whole);
}

TEST_F(ResumeTest, CtrlCKeepsFinishedRunsAndTellsHowToGoOn) {
    for (const int signal : {SIGINT, SIGTERM}) {
        Program program(folder.path(), arguments("stopped.sqlite", "100000"));
        ASSERT_TRUE(program.wait_for_message("executing"));
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        program.signal(signal);
        const auto result = program.wait();
        EXPECT_EQ(result.status, 130);
        EXPECT_THAT(result.messages,
                    HasSubstr("are kept in stopped.sqlite; the same command goes on from there"));
    }
    const auto result = test::gene_clocks(folder.path(), arguments("stopped.sqlite"));
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(contents("stopped.sqlite"), uninterrupted());
}

TEST_F(ResumeTest, AFinishedStudyIsNotMadeAgain) {
    const std::string whole = uninterrupted("2");
    const std::string bytes = test::read_all(folder / "whole.sqlite");
    const auto again = test::gene_clocks(folder.path(), arguments("whole.sqlite", "2"));
    EXPECT_EQ(again.status, 0);
    EXPECT_THAT(again.messages, HasSubstr("4 of 4 runs are finished already"));
    const auto runs = [&](const char* store) {
        return test::gene_clocks(folder.path(), {"export", store, "--runs", "-"}).output;
    };
    folder.write("before.sqlite", bytes);
    EXPECT_EQ(runs("whole.sqlite"), runs("before.sqlite"));  // the times, too
}

TEST_F(ResumeTest, MoreSeedsOnlyMakeWhatIsMissing) {
    EXPECT_EQ(test::gene_clocks(folder.path(), arguments("more.sqlite", "1")).status, 0);
    const auto result = test::gene_clocks(folder.path(), arguments("more.sqlite", "3"));
    EXPECT_THAT(result.messages, HasSubstr("2 of 6 runs are finished already"));
    EXPECT_THAT(result.messages, HasSubstr("executing 4 runs"));
    EXPECT_EQ(contents("more.sqlite"), uninterrupted("3"));
}

TEST_F(ResumeTest, AStoreIsForOneProcessAtATime) {
    Program first(folder.path(), arguments("shared.sqlite", "100000"));
    ASSERT_TRUE(first.wait_for_message("executing"));
    const auto second = test::gene_clocks(folder.path(), arguments("shared.sqlite"));
    EXPECT_EQ(second.status, 2);
    EXPECT_THAT(second.messages, HasSubstr("shared.sqlite: is in use by another process"));
    first.signal(SIGTERM);
    EXPECT_EQ(first.wait().status, 130);  // not disturbed
}

}  // namespace
}  // namespace gene_clocks
