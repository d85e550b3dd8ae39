#include "sim/experiment/study/runner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "tests/sim/experiment/expect_input_error.hpp"

namespace gene_clocks::experiment {
namespace {

using test::input_error;

class RunnerTest : public testing::Test {
protected:
    /// Runs with seeds 1 to `count`, each of so many cycles.
    std::vector<PlannedRun> planned_runs(std::size_t count) {
        std::vector<PlannedRun> all;
        for (std::size_t i = 0; i < count; ++i) {
            all.push_back({&settings, &arena, i + 1, "hash", "seed " + std::to_string(i + 1)});
        }
        return all;
    }
    static sim::RunResult result_of(std::uint64_t seed) {
        sim::RunResult result;
        result.trajectory_hash = seed * seed;
        return result;
    }
    Outcome execute(std::vector<PlannedRun> all, const RunnerOptions& options) {
        return execute_runs(std::move(all), options, silent, [this](const FinishedRun& run) {
            EXPECT_EQ(std::this_thread::get_id(), test_thread);
            EXPECT_EQ(run.result.trajectory_hash, run.planned->seed * run.planned->seed);
            finished.push_back(run.planned->seed);
        });
    }
    sim::Settings settings;
    sim::Arena arena;
    Progress silent{nullptr};
    std::vector<std::uint64_t> finished;
    std::thread::id test_thread = std::this_thread::get_id();
};

TEST_F(RunnerTest, MakesEveryRunOnce) {
    for (const std::int64_t threads : {1, 2, 7}) {
        finished.clear();
        RunnerOptions options{.threads = threads};
        options.simulate = [](const auto&, const auto&, std::uint64_t seed, auto*) {
            return std::optional(result_of(seed));
        };
        EXPECT_EQ(execute(planned_runs(50), options), Outcome::finished);
        EXPECT_EQ(finished.size(), 50U);
        EXPECT_EQ(std::set(finished.begin(), finished.end()).size(), 50U);
    }
}

TEST_F(RunnerTest, NothingToDoIsFinished) {
    EXPECT_EQ(execute({}, {}), Outcome::finished);
}

TEST_F(RunnerTest, UsesSoManyThreads) {
    constexpr int threads = 3;
    std::atomic<int> running{0};
    RunnerOptions options{.threads = threads};
    options.simulate = [&](const auto&, const auto&, std::uint64_t seed, auto*) {
        // Returns only when all of them are here: with fewer threads the test would not end.
        ++running;
        while (running < threads) std::this_thread::yield();
        return std::optional(result_of(seed));
    };
    EXPECT_EQ(execute(planned_runs(threads), options), Outcome::finished);
}

TEST_F(RunnerTest, MakesLongRunsFirstAndElseGoesSeedBySeed) {
    sim::Settings longer;
    longer.run.cycles = settings.run.cycles + 1;
    auto all = planned_runs(4);
    all[2].settings = &longer;
    all[3].seed = 1;
    all[3].settings_hash = "another arm";
    std::vector<std::pair<std::string, std::uint64_t>> order;
    RunnerOptions options{.threads = 1};
    options.simulate = [](const auto&, const auto&, std::uint64_t seed, auto*) {
        return std::optional(result_of(seed));
    };
    execute_runs(all, options, silent, [&](const FinishedRun& run) {
        order.emplace_back(run.planned->settings_hash, run.planned->seed);
    });
    using Key = std::pair<std::string, std::uint64_t>;
    EXPECT_THAT(order, testing::ElementsAre(Key{"hash", 3}, Key{"another arm", 1}, Key{"hash", 1},
                                            Key{"hash", 2}));
}

TEST_F(RunnerTest, StopsRunsUnderWayAndKeepsFinishedOnes) {
    std::atomic<bool> stop{false};
    RunnerOptions options{.threads = 2, .stop = &stop};
    options.simulate = [&](const auto&, const auto&, std::uint64_t seed,
                           sim::RunControl* control) -> std::optional<sim::RunResult> {
        if (seed <= 4) return result_of(seed);
        stop = true;  // a run that only ends by being stopped
        while (!control->stop) std::this_thread::yield();
        return std::nullopt;
    };
    EXPECT_EQ(execute(planned_runs(100), options), Outcome::stopped);
    EXPECT_THAT(finished, testing::UnorderedElementsAre(1, 2, 3, 4));
}

TEST_F(RunnerTest, ThrowsOnWhatARunThrewWithItsName) {
    for (const std::int64_t threads : {1, 2}) {
        RunnerOptions options{.threads = threads};
        options.simulate = [](const auto&, const auto&, std::uint64_t seed, auto*) {
            if (seed == 3) throw std::runtime_error("no free place");
            return std::optional(result_of(seed));
        };
        EXPECT_EQ(input_error([&] { execute(planned_runs(9), options); }), "seed 3: no free place");
    }
}

TEST_F(RunnerTest, IsAFailureOfTheProgramWhereARunBreaksAnInvariant) {
    RunnerOptions options{.threads = 1};
    options.simulate = [](const auto&, const auto&, std::uint64_t,
                          auto*) -> std::optional<sim::RunResult> {
        throw std::logic_error("broken");
    };
    try {
        execute(planned_runs(1), options);
        FAIL();
    } catch (const InputError&) {
        FAIL() << "not the user's fault";
    } catch (const std::exception& error) {
        EXPECT_STREQ(error.what(), "seed 1: broken");
    }
}

TEST_F(RunnerTest, EndsItsThreadsWhenTheResultCannotBeKept) {
    RunnerOptions options{.threads = 2};
    options.simulate = [](const auto&, const auto&, std::uint64_t seed, auto*) {
        return std::optional(result_of(seed));
    };
    const auto full_disk = [](const FinishedRun&) { throw std::runtime_error("disk full"); };
    EXPECT_THROW(execute_runs(planned_runs(50), options, silent, full_disk), std::runtime_error);
}

TEST_F(RunnerTest, GivesTheSameResultsWithAnyNumberOfThreads) {
    settings.run.cycles = 200;
    settings.world.robots = 5;
    arena = {"box", 100, 100, 5, 5, 5, 5, {}};
    const auto hashes = [&](std::int64_t threads) {
        std::map<std::uint64_t, std::uint64_t> by_seed;
        execute_runs(planned_runs(6), {.threads = threads}, silent, [&](const FinishedRun& run) {
            by_seed[run.planned->seed] = run.result.trajectory_hash;
        });
        return by_seed;
    };
    const auto alone = hashes(1);
    EXPECT_EQ(alone.size(), 6U);
    EXPECT_EQ(hashes(4), alone);
}

}  // namespace
}  // namespace gene_clocks::experiment
