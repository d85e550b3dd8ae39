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

/// The threads that make the runs, and what they share with the thread that waits for them.
class Workers {
public:
    Workers(const std::vector<Task>& tasks, RunFunction simulate, std::size_t count)
        : tasks_(tasks), simulate_(std::move(simulate)), workers_(count) {
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
    bool fetch(std::vector<FinishedTask>& finished) {
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
            if (index >= tasks_.size() || stopped_) break;
            try {
                if (!make_run(tasks_[index], worker)) break;
            } catch (...) {
                const std::scoped_lock lock(mutex_);
                if (!failure_) failure_ = with_name(tasks_[index]);
                stop();
                break;
            }
        }
        const std::scoped_lock lock(mutex_);
        --working_;
        changed_.notify_one();
    }

    /// False if the run was given up.
    bool make_run(const Task& task, Worker& worker) {
        worker.control.cycles_done = 0;
        worker.robots = static_cast<std::uint64_t>(task.settings->world.robots);
        const auto start = Clock::now();
        auto result = simulate_(*task.settings, *task.arena, task.seed, &worker.control);
        const std::chrono::duration<double> wall = Clock::now() - start;
        worker.robots = 0;
        if (!result) return false;
        const std::scoped_lock lock(mutex_);
        finished_.push_back({&task, *std::move(result), wall.count()});
        changed_.notify_one();
        return true;
    }

    /// The exception being handled, with the run's name before its message.
    static std::exception_ptr with_name(const Task& task) {
        const auto text = [&](const std::exception& error) {
            return fmt::format("{}: {}", task.name, error.what());
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

    const std::vector<Task>& tasks_;
    const RunFunction simulate_;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> stopped_{false};

    std::mutex mutex_;  ///< guards the members down to workers_
    std::condition_variable changed_;
    std::vector<FinishedTask> finished_;
    std::exception_ptr failure_;
    std::size_t working_ = 0;

    std::vector<Worker> workers_;  ///< last: destroyed, and so joined, first
};

std::size_t thread_count(const RunnerOptions& options, std::size_t tasks) {
    const std::size_t wanted = options.threads > 0 ? static_cast<std::size_t>(options.threads)
                                                   : std::thread::hardware_concurrency();
    return std::clamp<std::size_t>(wanted, 1, std::max<std::size_t>(tasks, 1));
}

}  // namespace

void sort_for_making(std::vector<Task>& tasks) {
    std::ranges::sort(tasks, [](const Task& a, const Task& b) {
        if (a.robot_steps() != b.robot_steps()) return a.robot_steps() > b.robot_steps();
        return std::tie(a.seed, a.settings_hash) < std::tie(b.seed, b.settings_hash);
    });
}

Outcome make_runs(std::vector<Task> tasks, const RunnerOptions& options, Progress& progress,
                  const std::function<void(const FinishedTask&)>& on_finished) {
    sort_for_making(tasks);
    ProgressState state;
    state.runs_total = tasks.size();
    for (const Task& task : tasks) state.robot_steps_total += task.robot_steps();

    std::uint64_t steps_finished = 0;
    {
        Workers workers(tasks, options.simulate, thread_count(options, tasks.size()));
        std::vector<FinishedTask> finished;
        while (workers.fetch(finished)) {
            if (options.stop != nullptr && *options.stop) workers.stop();
            for (const FinishedTask& run : finished) {
                on_finished(run);
                ++state.runs_finished;
                steps_finished += run.task->robot_steps();
            }
            state.robot_steps_done =
                std::min(steps_finished + workers.robot_steps_under_way(), state.robot_steps_total);
            progress.update(state);
        }
        progress.finish(state);
        workers.rethrow();
    }
    return state.runs_finished == tasks.size() ? Outcome::finished : Outcome::stopped;
}

}  // namespace gene_clocks::experiment
