#include "sim/experiment/store/run_estimate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "sim/experiment/study/run_plan.hpp"
#include "tests/sim/experiment/example_study.hpp"

namespace gene_clocks::experiment {
namespace {

using test::example_study;

TEST(RunEstimate, SpeedsAreThoseOfTheRunsThatAreThere) {
    const Study study = example_study();  // both arms: 100 robots in navigation
    std::map<std::string, RecordedTime> recorded;
    EXPECT_TRUE(recorded_speeds(study, recorded, 1).empty());
    recorded["some other study's"] = {100, 1000, 1e-6};
    EXPECT_TRUE(recorded_speeds(study, recorded, 1).empty());
    recorded[study.arms[0].settings_hash] = {3, 1000, 2.0};
    recorded[study.arms[1].settings_hash] = {1, 5000, 1.0};
    const auto speeds = recorded_speeds(study, recorded, 1);
    ASSERT_EQ(speeds.size(), 1U);
    const KindSpeed& speed = speeds.at(RunKind(study.arms[0].settings));
    EXPECT_EQ(speed.runs, 4U);
    EXPECT_DOUBLE_EQ(speed.robot_steps_per_second, 2000.0);
}

TEST(RunEstimate, ArmsWithTheSameSettingsCountOnce) {
    Study study = example_study();
    study.arms.push_back(study.arms[0]);
    const auto speeds = recorded_speeds(study, {{study.arms[0].settings_hash, {3, 1000, 2.0}}}, 1);
    EXPECT_EQ(speeds.at(RunKind(study.arms[0].settings)).runs, 3U);
}

TEST(RunEstimate, ThreadsBeyondTheProcessorsMakeNothingFaster) {
    const Study study = example_study();
    const std::map<std::string, RecordedTime> recorded = {
        {study.arms[0].settings_hash, {1, 1000, 1.0}}};
    const auto speed = [&](std::int64_t threads) {
        return recorded_speeds(study, recorded, threads).begin()->second.robot_steps_per_second;
    };
    const std::int64_t processors = thread_count(0);
    EXPECT_DOUBLE_EQ(speed(1), 1000.0);
    EXPECT_DOUBLE_EQ(speed(processors), 1000.0 * static_cast<double>(processors));
    EXPECT_DOUBLE_EQ(speed(0), speed(processors));
    EXPECT_DOUBLE_EQ(speed(1000 * processors), speed(processors));
}

TEST(RunEstimate, TimeIsThatOfAllRunsAtTheirSpeedsButNoLessThanThatOfTheLongest) {
    Study study = example_study();
    study.seeds = 4;
    study.arms[0].settings.world.robots = 10;
    study.arms[0].settings.run.cycles = 1000;
    study.arms[1].settings.world.robots = 20;
    study.arms[1].settings.run.cycles = 1000;
    const std::map<RunKind, KindSpeed> speeds = {{RunKind(study.arms[0].settings), {1000.0, 0}},
                                                 {RunKind(study.arms[1].settings), {500.0, 0}}};
    const auto planned_runs = plan_runs(study);
    EXPECT_EQ(estimated_time(planned_runs, speeds, 1).count(), 4 * 10 + 4 * 40);
    EXPECT_EQ(estimated_time({}, speeds, 1).count(), 0);
    const std::vector<PlannedRun> one{planned_runs.back()};
    EXPECT_EQ(estimated_time(one, speeds, 1).count(), 40);
    // 500 is what all threads make together: of one run, only one thread's part.
    EXPECT_EQ(estimated_time(one, speeds, 0).count(), 40 * thread_count(0));
}

TEST(TryOut, RunsOnAllThreadsAtOnceWithSeedsOfTheirOwn) {
    const Study study = example_study();
    const auto planned_runs = plan_runs(study);
    constexpr int threads = 3;
    std::mutex mutex;
    std::set<std::uint64_t> seeds;
    std::atomic<int> running{0};
    const KindSpeed speed =
        try_out(planned_runs[0], threads, std::chrono::milliseconds(20),
                [&](const auto&, const auto&, std::uint64_t seed, sim::RunControl* control) {
                    {
                        const std::scoped_lock lock(mutex);
                        seeds.insert(seed);
                    }
                    ++running;
                    while (running < threads || !control->stop) std::this_thread::yield();
                    control->cycles_done = 1000;
                    return std::optional<sim::RunResult>();
                });
    EXPECT_EQ(seeds.size(), 3U);
    EXPECT_GT(speed.robot_steps_per_second, 0.0);
    EXPECT_LE(speed.robot_steps_per_second, 3 * 1000 * 100 / 0.02);
    EXPECT_EQ(speed.runs, 0U);
}

TEST(TryOut, BeginsShortRunsAnewWithOtherSeeds) {
    const Study study = example_study();
    const auto planned_runs = plan_runs(study);
    std::set<std::uint64_t> seeds;
    try_out(planned_runs[0], 1, std::chrono::milliseconds(1),
            [&](const auto&, const auto&, std::uint64_t seed, sim::RunControl* control) {
                EXPECT_TRUE(seeds.insert(seed).second);
                while (seeds.size() >= 3 && !control->stop) std::this_thread::yield();
                return std::optional(sim::RunResult{});
            });
    ASSERT_FALSE(seeds.empty());
    EXPECT_EQ(*seeds.begin(), planned_runs[0].seed);
}

TEST(TryOut, ThrowsOnWhatARunThrows) {
    const Study study = example_study();
    const auto planned_runs = plan_runs(study);
    EXPECT_THROW(try_out(planned_runs[0], 2, std::chrono::milliseconds(1),
                         [](const auto&, const auto&, std::uint64_t,
                            auto*) -> std::optional<sim::RunResult> {
                             throw std::runtime_error("no free place");
                         }),
                 std::runtime_error);
}

}  // namespace
}  // namespace gene_clocks::experiment
