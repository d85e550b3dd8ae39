#include "sim/app/execute_study.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <system_error>

#include "sim/app/commands.hpp"
#include "sim/app/stop_signal.hpp"
#include "sim/experiment/store/store.hpp"
#include "sim/experiment/study/runner.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/program_version.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::app {
namespace {

using experiment::PlannedRun;
using experiment::Store;
using experiment::Study;

std::string utc_now() {
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

void report_stored_runs(const Store& store, const std::filesystem::path& file, std::size_t all,
                        std::size_t missing) {
    if (!store.new_keys().empty()) {
        fmt::print(
            stderr,
            "{}: the settings have been extended since it was written; its runs count as made "
            "with the defaults of {}\n",
            file.string(), experiment::list_of(store.new_keys()));
    }
    if (missing < all) {
        fmt::print(stderr, "{}: {} of {} runs are finished already\n", file.string(), all - missing,
                   all);
    }
    if (const auto others = store.runs_of_other_versions(); others > 0) {
        fmt::print(stderr,
                   "{}: {} runs were executed by another version of gene-clocks; this is {}\n",
                   file.string(), others, experiment::program_version());
    }
}

void report_superseded_arms(const Store& store, const Study& study,
                            const std::filesystem::path& file) {
    for (const experiment::StoredStudy& known : store.studies()) {
        if (known.name != study.name) continue;
        const auto is_gone = [&](const experiment::StoredArm& arm) {
            return std::ranges::find(study.arms, arm.settings_hash,
                                     &experiment::Arm::settings_hash) == study.arms.end();
        };
        if (const auto gone = std::ranges::count_if(known.arms, is_gone); gone > 0) {
            fmt::print(stderr,
                       "{}: {} of the {} arms that it held of this study are no longer in the "
                       "study, or have other settings now; their runs stay there\n",
                       file.string(), gone, known.arms.size());
        }
    }
}

void make_folder_of(const std::filesystem::path& file) {
    if (!file.has_parent_path()) return;
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error) {
        throw experiment::InputError(fmt::format("{}: the folder {} cannot be created: {}",
                                                 file.string(), file.parent_path().string(),
                                                 error.message()));
    }
}

}  // namespace

int execute_study(const Study& study, const std::filesystem::path& file,
                  const experiment::Shard& shard, const RunExecutor& execute_runs) {
    experiment::rehearse(study);
    const auto& stop = watch_stop_signals();
    make_folder_of(file);
    Store store = Store::open_for_writing(file);
    report_superseded_arms(store, study, file);
    store.put_study(study);

    std::vector<PlannedRun> planned_runs = experiment::plan_runs(study, shard);
    const std::size_t all = planned_runs.size();
    const auto finished = store.finished();
    std::erase_if(planned_runs, [&](const PlannedRun& planned) {
        return finished.contains({planned.settings_hash, planned.seed});
    });
    std::size_t kept = all - planned_runs.size();
    report_stored_runs(store, file, all, planned_runs.size());
    if (planned_runs.empty()) return success;

    fmt::print(stderr, "{}: executing {} runs\n", study.name, planned_runs.size());
    experiment::Outcome outcome{};
    {
        experiment::Progress progress(stderr);
        outcome = execute_runs(
            std::move(planned_runs), stop, progress, [&](const experiment::FinishedRun& run) {
                store.put_run({run.planned->settings_hash, run.planned->seed, run.result,
                               run.wall_seconds, utc_now(), experiment::program_version()});
                ++kept;
            });
    }
    if (outcome == experiment::Outcome::finished) {
        fmt::print(stderr, "{}: all {} runs are finished\n", file.string(), all);
        return success;
    }
    fmt::print(stderr,
               "Stopped. {} of {} runs are kept in {}; the same command goes on from there.\n",
               kept, all, file.string());
    return interrupted;
}

int execute_study(const Study& study, const std::filesystem::path& file, std::int64_t threads,
                  const experiment::Shard& shard) {
    return execute_study(
        study, file, shard,
        [threads](std::vector<PlannedRun> planned_runs, const std::atomic<bool>& stop,
                  experiment::Progress& progress, const auto& on_finished) {
            experiment::RunnerOptions options;
            options.threads = threads;
            options.stop = &stop;
            return experiment::execute_runs(std::move(planned_runs), options, progress,
                                            on_finished);
        });
}

}  // namespace gene_clocks::app
