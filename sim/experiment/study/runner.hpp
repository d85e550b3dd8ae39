#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <gene_clocks/sim/simulation.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/experiment/study/progress.hpp"

namespace gene_clocks::experiment {

/// Executes one run; sim::simulate, or a stand-in in tests. Called from several threads at once.
using RunFunction = std::function<std::optional<sim::RunResult>(
    const sim::Settings&, const sim::Arena&, std::uint64_t seed, sim::RunControl*)>;

/// A run that is to be executed.
struct PlannedRun {
    const sim::Settings* settings = nullptr;  ///< never null; must outlive the runner
    const sim::Arena* arena = nullptr;        ///< never null; must outlive the runner
    std::uint64_t seed{};
    std::string settings_hash;
    std::string name;  ///< for messages

    [[nodiscard]] std::uint64_t robot_steps() const {
        return static_cast<std::uint64_t>(settings->world.robots * settings->run.cycles);
    }
};

/// A run that was executed.
struct FinishedRun {
    const PlannedRun* planned = nullptr;
    sim::RunResult result;
    double wall_seconds{};
};

struct RunnerOptions {
    std::int64_t threads = 0;  ///< 0: one for each of the processor's
    RunFunction simulate = sim::simulate;
    const std::atomic<bool>* stop = nullptr;  ///< watched, if there is one
};

enum class Outcome { finished, stopped };

/// Sorts runs into the order in which they are best begun: longest first, so that none is left
/// alone with a long run at the end; else seed by seed, so that a study that is stopped has
/// compared its arms on the same seeds.
void sort_for_execution(std::vector<PlannedRun>& planned_runs);

/// Executes all runs, longest first, each on one thread, and calls `on_finished` from the calling
/// thread with each as soon as it is finished. When `stop` is set, or `on_finished` throws, runs
/// under way are given up; those already finished are still handed over.
///
/// What a run throws is thrown on, with the run's name before its message: InputError for
/// settings or an arena that the simulator refuses, std::runtime_error for all else.
Outcome execute_runs(std::vector<PlannedRun> planned_runs, const RunnerOptions& options,
                     Progress& progress,
                     const std::function<void(const FinishedRun&)>& on_finished);

}  // namespace gene_clocks::experiment
