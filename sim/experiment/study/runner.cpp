#include "sim/experiment/study/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>

#include "sim/settings/input_error.hpp"

namespace gene_clocks::experiment {
namespace {

using Clock = std::chrono::steady_clock;

/// The threads that execute the runs, and what they share with the thread that waits for them.
class Workers {
public:
    Workers(const std::vector<PlannedRun>& planned_runs, RunFunction simulate, std::size_t count)
        : planned_runs_(planned_runs), simulate_(std::move(simulate)), workers_(count) {
        working_ = count;
        for (Worker& worker : workers_) {
            worker.thread = std::jthread([this, &worker] { work(worker); });
        }
    }
    ~Workers() { stop(); }  // the threads join as their members are destroyed
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// Gives up the runs under way; no further one begins.
    void stop() {
        stopped_ = true;
        for (Worker& worker : workers_) worker.control.stop = true;
    }

    /// Waits a moment for finished runs. False once all threads have ended and all was fetched.
    bool fetch(std::vector<FinishedRun>& finished) {
        constexpr auto moment = std::chrono::milliseconds(100);
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, moment, [this] { return !finished_.empty() || working_ == 0; });
        finished = std::exchange(finished_, {});
        return working_ > 0 || !finished.empty();
    }

    /// Throws what a run threw, if one did.
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

    [[nodiscard]] std::uint64_t robot_steps_under_way() const {
        std::uint64_t steps = 0;
        for (const Worker& worker : workers_) {
            steps += worker.robots * static_cast<std::uint64_t>(worker.control.cycles_done.load());
        }
        return steps;
    }

private:
    struct Worker {
        sim::RunControl control;
        std::atomic<std::uint64_t> robots{0};  ///< of the run under way; 0 between runs
        std::jthread thread;
    };

    void work(Worker& worker) {
        for (;;) {
            const std::size_t index = next_++;
            if (index >= planned_runs_.size() || stopped_) break;
            try {
                if (!execute(planned_runs_[index], worker)) break;
            } catch (...) {
                const std::scoped_lock lock(mutex_);
                if (!failure_) failure_ = with_name(planned_runs_[index]);
                stop();
                break;
            }
        }
        const std::scoped_lock lock(mutex_);
        --working_;
        changed_.notify_one();
    }

    /// False if the run was given up.
    bool execute(const PlannedRun& planned, Worker& worker) {
        worker.control.cycles_done = 0;
        worker.robots = static_cast<std::uint64_t>(planned.settings->world.robots);
        const auto start = Clock::now();
        auto result = simulate_(*planned.settings, *planned.arena, planned.seed, &worker.control);
        const std::chrono::duration<double> wall = Clock::now() - start;
        worker.robots = 0;
        if (!result) return false;
        const std::scoped_lock lock(mutex_);
        finished_.push_back({&planned, *std::move(result), wall.count()});
        changed_.notify_one();
        return true;
    }

    /// The exception being handled, with the run's name before its message.
    static std::exception_ptr with_name(const PlannedRun& planned) {
        const auto text = [&](const std::exception& error) {
            return fmt::format("{}: {}", planned.name, error.what());
        };
        try {
            throw;
        } catch (const std::bad_alloc& error) {
            return std::make_exception_ptr(std::runtime_error(text(error)));
        } catch (const std::invalid_argument& error) {
            return std::make_exception_ptr(InputError(text(error)));
        } catch (const std::runtime_error& error) {
            return std::make_exception_ptr(InputError(text(error)));
        } catch (const std::exception& error) {
            return std::make_exception_ptr(std::runtime_error(text(error)));
        } catch (...) {
            return std::current_exception();
        }
    }

    const std::vector<PlannedRun>& planned_runs_;
    const RunFunction simulate_;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> stopped_{false};

    std::mutex mutex_;  ///< guards the members down to workers_
    std::condition_variable changed_;
    std::vector<FinishedRun> finished_;
    std::exception_ptr failure_;
    std::size_t working_ = 0;

    std::vector<Worker> workers_;  ///< last: destroyed, and so joined, first
};

std::size_t thread_count(const RunnerOptions& options, std::size_t planned_runs) {
    const std::size_t wanted = options.threads > 0 ? static_cast<std::size_t>(options.threads)
                                                   : std::thread::hardware_concurrency();
    return std::clamp<std::size_t>(wanted, 1, std::max<std::size_t>(planned_runs, 1));
}

}  // namespace

void sort_for_execution(std::vector<PlannedRun>& planned_runs) {
    std::ranges::sort(planned_runs, [](const PlannedRun& a, const PlannedRun& b) {
        if (a.robot_steps() != b.robot_steps()) return a.robot_steps() > b.robot_steps();
        return std::tie(a.seed, a.settings_hash) < std::tie(b.seed, b.settings_hash);
    });
}

Outcome execute_runs(std::vector<PlannedRun> planned_runs, const RunnerOptions& options,
                     Progress& progress,
                     const std::function<void(const FinishedRun&)>& on_finished) {
    sort_for_execution(planned_runs);
    ProgressState state;
    state.runs_total = planned_runs.size();
    for (const PlannedRun& planned : planned_runs) state.robot_steps_total += planned.robot_steps();

    std::uint64_t steps_finished = 0;
    {
        Workers workers(planned_runs, options.simulate, thread_count(options, planned_runs.size()));
        std::vector<FinishedRun> finished;
        while (workers.fetch(finished)) {
            if (options.stop != nullptr && *options.stop) workers.stop();
            for (const FinishedRun& run : finished) {
                on_finished(run);
                ++state.runs_finished;
                steps_finished += run.planned->robot_steps();
            }
            state.robot_steps_done =
                std::min(steps_finished + workers.robot_steps_under_way(), state.robot_steps_total);
            progress.update(state);
        }
        progress.finish(state);
        workers.rethrow();
    }
    return state.runs_finished == planned_runs.size() ? Outcome::finished : Outcome::stopped;
}

}  // namespace gene_clocks::experiment
