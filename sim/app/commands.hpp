#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "sim/experiment/study/run_plan.hpp"
#include "sim/experiment/study/study.hpp"

namespace gene_clocks::app {

/// What the program returns to its caller.
enum ExitStatus : int {
    success = 0,
    failure = 1,        ///< something broke on the way
    bad_input = 2,      ///< nothing was written
    interrupted = 130,  ///< by Ctrl-C or SIGTERM; finished runs are kept
};

/// Executes the runs of a study or a shard, as execute_study() does; `threads` is 0 where the user
/// gave none.
using StudyExecutor =
    std::function<int(const experiment::Study& study, const std::filesystem::path& store,
                      std::int64_t threads, const experiment::Shard& shard)>;

// Each adds one subcommand, whose callback does the work, sets `status` to an ExitStatus, and may
// throw experiment::InputError for bad input.
void add_run_command(CLI::App& app, int& status);
void add_replay_command(CLI::App& app, int& status);
void add_study_command(CLI::App& app, int& status, StudyExecutor executor);
void add_report_command(CLI::App& app, int& status);
void add_reproduce_command(CLI::App& app, int& status);
void add_settings_command(CLI::App& app, int& status);
void add_contrast_command(CLI::App& app, int& status);
void add_export_command(CLI::App& app, int& status);
void add_merge_command(CLI::App& app, int& status);
void add_check_trace_command(CLI::App& app, int& status);
void add_schema_command(CLI::App& app, int& status);

// These two print what the other commands are; so they are to be added after them.
void add_completion_command(CLI::App& app, int& status);
void add_manual_command(CLI::App& app, int& status);

}  // namespace gene_clocks::app
