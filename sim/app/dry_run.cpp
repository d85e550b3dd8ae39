#include "sim/app/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/app/commands.hpp"
#include "sim/experiment/store/run_estimate.hpp"
#include "sim/experiment/store/store.hpp"
#include "sim/experiment/study/progress.hpp"
#include "sim/settings/choice_names.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::app {
namespace {

using experiment::KindSpeed;
using experiment::PlannedRun;
using experiment::RunKind;
using experiment::Store;
using experiment::Study;

std::string steps_text(const std::vector<PlannedRun>& planned_runs) {
    double steps = 0.0;
    for (const PlannedRun& planned : planned_runs)
        steps += static_cast<double>(planned.robot_steps());
    return fmt::format("{:.1f} M robot-steps", steps / 1e6);
}

void print_arms(const Study& study) {
    std::size_t width = 0;
    for (const experiment::Arm& arm : study.arms) width = std::max(width, arm.name.size());
    fmt::print("{}: {}\n{}\n", study.name, study.title, study.description);
    for (const experiment::Arm& arm : study.arms) {
        const sim::Settings& settings = arm.settings;
        fmt::print(
            "  {:<{}}  {}, {}, profile {}, parameters {}: {} robots, {} cycles; settings {}\n",
            arm.name, width, experiment::name_of(settings.task),
            experiment::name_of(settings.source), arm.profile,
            arm.parameters.empty() ? "none" : arm.parameters, settings.world.robots,
            settings.run.cycles, arm.settings_hash);
    }
}

void print_runs(const Study& study, const std::vector<PlannedRun>& all) {
    const std::size_t runs = study.arms.size() * static_cast<std::size_t>(study.seeds);
    fmt::print("{} arms x {} seeds = {} runs", study.arms.size(), study.seeds, runs);
    if (all.size() != runs) fmt::print(", {} of them different", all.size());
    fmt::print(", {}\n", steps_text(all));
}

/// Tries out each kind of run of which no speed is known, some seconds long in all. Returns how
/// many there were.
std::size_t add_missing_speeds(const std::vector<PlannedRun>& planned_runs, std::int64_t threads,
                               std::map<RunKind, KindSpeed>& speeds) {
    std::map<RunKind, const PlannedRun*> missing;
    for (const PlannedRun& planned : planned_runs) {
        const RunKind kind(*planned.settings);
        if (!speeds.contains(kind)) missing.emplace(kind, &planned);
    }
    constexpr std::chrono::milliseconds most{400};
    constexpr std::chrono::milliseconds altogether{10'000};
    for (const auto& [kind, planned] : missing) {
        const auto share = altogether / static_cast<std::int64_t>(missing.size());
        speeds[kind] = experiment::try_out(*planned, threads, std::min(most, share));
    }
    return missing.size();
}

void print_time(const Study& study, const std::vector<PlannedRun>& missing, const Store* store,
                std::int64_t threads) {
    std::map<RunKind, KindSpeed> speeds;
    if (store != nullptr) {
        speeds = experiment::recorded_speeds(study, store->recorded_times(), threads);
    }
    std::size_t runs = 0;
    for (const auto& [kind, speed] : speeds) runs += speed.runs;
    const std::size_t tried = add_missing_speeds(missing, threads, speeds);
    std::vector<std::string> grounds;
    if (runs > 0) grounds.push_back(fmt::format("the {} runs in the store", runs));
    if (tried > 0) grounds.emplace_back("trying out the beginning of some runs");
    const auto time = experiment::estimated_time(missing, speeds, threads);
    const std::int64_t count = experiment::thread_count(threads);
    fmt::print("about {} on this machine with {} thread{}, judged by {}\n",
               experiment::duration_text(time), count, count == 1 ? "" : "s",
               experiment::list_of(grounds));
}

}  // namespace

int dry_run(const Study& study, const std::filesystem::path& file, std::int64_t threads,
            const experiment::Shard& shard) {
    std::optional<Store> store;
    if (std::filesystem::exists(file)) store = Store::open_for_reading(file);
    experiment::rehearse(study);
    print_arms(study);
    print_runs(study, experiment::plan_runs(study));

    std::vector<PlannedRun> planned_runs = experiment::plan_runs(study, shard);
    if (!shard.is_all()) {
        fmt::print("shard {} of {}: {} runs, {}\n", shard.index, shard.count, planned_runs.size(),
                   steps_text(planned_runs));
    }
    const std::size_t all = planned_runs.size();
    if (store) {
        const auto finished = store->finished();
        std::erase_if(planned_runs, [&](const PlannedRun& planned) {
            return finished.contains({planned.settings_hash, planned.seed});
        });
        fmt::print("{}: {} of {} runs are finished, {} are missing, {}\n", file.string(),
                   all - planned_runs.size(), all, planned_runs.size(), steps_text(planned_runs));
    } else {
        fmt::print("{}: does not exist yet; the study will create it\n", file.string());
    }
    if (!planned_runs.empty()) print_time(study, planned_runs, store ? &*store : nullptr, threads);
    return success;
}

}  // namespace gene_clocks::app
