#include "sim/experiment/store/run_estimate.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <set>
#include <thread>

namespace gene_clocks::experiment {
namespace {

using Clock = std::chrono::steady_clock;

std::int64_t processors() {
    return std::max<std::int64_t>(1, std::thread::hardware_concurrency());
}

/// One thread's part in trying out a planned run.
class Trial {
public:
    Trial(const PlannedRun& planned, std::uint64_t seed, const RunFunction& simulate)
        : planned_(planned), seed_(seed), simulate_(simulate), thread_([this] { work(); }) {}

    /// Ends it, and returns how many robot-steps it made. Throws what a run threw.
    std::uint64_t end() {
        stopped_ = true;
        control_.stop = true;
        thread_.join();
        if (failure_) std::rethrow_exception(failure_);
        return steps_;
    }
    ~Trial() {
        stopped_ = true;
        control_.stop = true;
    }
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;

private:
    void work() {
        const auto robots = static_cast<std::uint64_t>(planned_.settings->world.robots);
        try {
            for (; !stopped_; ++seed_) {
                control_.cycles_done = 0;
                simulate_(*planned_.settings, *planned_.arena, seed_, &control_);
                steps_ += robots * static_cast<std::uint64_t>(control_.cycles_done.load());
            }
        } catch (...) {
            failure_ = std::current_exception();
        }
    }

    const PlannedRun& planned_;
    std::uint64_t seed_;
    const RunFunction& simulate_;
    sim::RunControl control_;
    std::atomic<bool> stopped_{false};
    std::uint64_t steps_ = 0;     ///< of the thread, until it has ended
    std::exception_ptr failure_;  ///< likewise
    std::jthread thread_;         ///< last: joined before what it uses goes
};

}  // namespace

std::int64_t thread_count(std::int64_t threads) {
    return threads > 0 ? threads : processors();
}

std::map<RunKind, KindSpeed> recorded_speeds(const Study& study,
                                             const std::map<std::string, RecordedTime>& recorded,
                                             std::int64_t threads) {
    std::map<RunKind, RecordedTime> sums;
    std::set<std::string> counted;
    for (const Arm& arm : study.arms) {
        const auto found = recorded.find(arm.settings_hash);
        if (found == recorded.end() || !counted.insert(arm.settings_hash).second) continue;
        RecordedTime& sum = sums[RunKind(arm.settings)];
        sum.runs += found->second.runs;
        sum.robot_steps += found->second.robot_steps;
        sum.wall_seconds += found->second.wall_seconds;
    }
    // A run's own time already has in it what runs beside it cost it; but threads beyond the
    // processors' make nothing faster.
    const auto at_a_time = static_cast<double>(std::min(thread_count(threads), processors()));
    std::map<RunKind, KindSpeed> speeds;
    for (const auto& [kind, sum] : sums) {
        if (sum.wall_seconds <= 0.0) continue;
        speeds[kind] = {at_a_time * static_cast<double>(sum.robot_steps) / sum.wall_seconds,
                        sum.runs};
    }
    return speeds;
}

KindSpeed try_out(const PlannedRun& planned, std::int64_t threads, std::chrono::milliseconds moment,
                  const RunFunction& simulate) {
    const auto start = Clock::now();
    std::vector<std::unique_ptr<Trial>> trials;
    for (std::int64_t i = 0; i < thread_count(threads); ++i) {
        // Seeds far from each other: no two threads make the same run.
        const auto seed = planned.seed + 1'000'000'000 * static_cast<std::uint64_t>(i);
        trials.push_back(std::make_unique<Trial>(planned, seed, simulate));
    }
    std::this_thread::sleep_for(moment);
    std::uint64_t steps = 0;
    for (const auto& trial : trials) steps += trial->end();
    const std::chrono::duration<double> elapsed = Clock::now() - start;
    return {static_cast<double>(std::max<std::uint64_t>(steps, 1)) / elapsed.count(), 0};
}

std::chrono::seconds estimated_time(const std::vector<PlannedRun>& planned_runs,
                                    const std::map<RunKind, KindSpeed>& speeds,
                                    std::int64_t threads) {
    const auto at_a_time = static_cast<double>(std::min(thread_count(threads), processors()));
    double shared_seconds = 0.0;
    double longest_seconds = 0.0;
    for (const PlannedRun& planned : planned_runs) {
        const double seconds = static_cast<double>(planned.robot_steps()) /
                               speeds.at(RunKind(*planned.settings)).robot_steps_per_second;
        shared_seconds += seconds;
        longest_seconds = std::max(longest_seconds, seconds * at_a_time);
    }
    return std::chrono::seconds(
        static_cast<std::int64_t>(std::max(shared_seconds, longest_seconds) + 0.5));
}

}  // namespace gene_clocks::experiment
