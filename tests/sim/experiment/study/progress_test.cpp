#include "sim/experiment/study/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace gene_clocks::experiment {
namespace {

using namespace std::chrono_literals;

TEST(Progress, WritesDurations) {
    EXPECT_EQ(duration_text(0s), "0:00");
    EXPECT_EQ(duration_text(83s), "1:23");
    EXPECT_EQ(duration_text(3723s), "1:02:03");
}

TEST(Progress, TellsRunsRateAndTimeLeft) {
    const ProgressState state{.runs_total = 256,
                              .runs_finished = 37,
                              .robot_steps_total = 1'000'000'000,
                              .robot_steps_done = 100'000'000};
    EXPECT_EQ(progress_text(state, 10s), "37 of 256 runs, 10.0 M robot-steps/s, 1:30 left");
}

TEST(Progress, TellsTheTimeTakenAtTheEnd) {
    const ProgressState state{.runs_total = 2,
                              .runs_finished = 2,
                              .robot_steps_total = 4'000'000,
                              .robot_steps_done = 4'000'000};
    EXPECT_EQ(progress_text(state, 2s), "2 of 2 runs, 2.0 M robot-steps/s, 0:02");
}

TEST(Progress, GuessesNoRateBeforeAnythingIsDone) {
    EXPECT_EQ(progress_text({.runs_total = 2, .robot_steps_total = 4}, 1s), "0 of 2 runs");
}

/// What Progress writes to a stream that is no terminal.
class PlainProgressTest : public testing::Test {
protected:
    std::string written() {
        std::rewind(stream.get());
        std::array<char, 4096> buffer{};
        return {buffer.data(), std::fread(buffer.data(), 1, buffer.size(), stream.get())};
    }
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream{std::tmpfile(), std::fclose};
    ProgressState state{
        .runs_total = 2, .runs_finished = 1, .robot_steps_total = 4, .robot_steps_done = 2};
};

TEST_F(PlainProgressTest, WritesALineEveryTenSecondsAtMost) {
    const auto start = Progress::Clock::now();
    Progress progress(stream.get());
    for (int tenths = 0; tenths <= 255; ++tenths) progress.update(state, start + tenths * 100ms);
    const std::string text = written();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("\r")));
    EXPECT_THAT(text, testing::HasSubstr("1 of 2 runs"));
}

TEST_F(PlainProgressTest, AlwaysWritesTheEnd) {
    Progress(stream.get()).finish(state);
    EXPECT_THAT(written(), testing::StartsWith("1 of 2 runs"));
}

TEST_F(PlainProgressTest, WithoutAStreamIsSilent) {
    Progress progress(nullptr);
    progress.update(state);
    progress.finish(state);
}

}  // namespace
}  // namespace gene_clocks::experiment
