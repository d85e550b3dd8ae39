#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "sim/experiment/study/progress.hpp"
#include "sim/experiment/study/run_plan.hpp"
#include "sim/experiment/study/runner.hpp"
#include "sim/experiment/study/study.hpp"

namespace gene_clocks::app {

/// Executes runs, and hands each over as soon as it is finished; as experiment::execute_runs.
using RunExecutor = std::function<experiment::Outcome(
    std::vector<experiment::PlannedRun> planned_runs, const std::atomic<bool>& stop,
    experiment::Progress& progress,
    const std::function<void(const experiment::FinishedRun&)>& on_finished)>;

/// Executes the runs of a study, or of one shard of it, that its store does not hold yet, each
/// entering it when finished, and says on standard error how it goes. Stops cleanly on Ctrl-C and
/// SIGTERM. Returns an ExitStatus: success or interrupted. Throws InputError, before anything is
/// written.
int execute_study(const experiment::Study& study, const std::filesystem::path& store,
                  const experiment::Shard& shard, const RunExecutor& execute_runs);

/// The same, on so many threads of this process; 0: one for each of the processor's.
int execute_study(const experiment::Study& study, const std::filesystem::path& store,
                  std::int64_t threads, const experiment::Shard& shard = {});

}  // namespace gene_clocks::app
