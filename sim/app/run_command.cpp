#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "sim/app/commands.hpp"
#include "sim/app/selection_options.hpp"
#include "sim/app/stop_signal.hpp"
#include "sim/app/trace_file.hpp"
#include "sim/experiment/store/store.hpp"
#include "sim/experiment/study/measures.hpp"
#include "sim/experiment/study/runner.hpp"
#include "sim/experiment/study/summary.hpp"
#include "sim/settings/arena_file.hpp"
#include "sim/settings/choice_names.hpp"
#include "sim/settings/program_version.hpp"
#include "sim/settings/settings_io.hpp"

namespace gene_clocks::app {
namespace {

using experiment::FinishedRun;
using experiment::RunSummary;

struct RunOptions {
    SelectionOptions selection;
    std::uint64_t seed = 1;
    bool json = false;
    std::optional<std::string> trace;
};

double rate(const sim::RunResult& result) {
    return result.cpu_seconds > 0.0 ? static_cast<double>(result.robot_steps) / result.cpu_seconds
                                    : 0.0;
}

RunSummary summary_of(const FinishedRun& run) {
    const sim::MeasureSettings& measures = run.planned->settings->measures;
    return experiment::summarise(run.result.samples, measures,
                                 experiment::best_of_run(run.result.samples, measures));
}

nlohmann::ordered_json to_json(const sim::ChronologyMeasures& measures) {
    auto json = nlohmann::ordered_json::object();
    sim::for_each_measure(measures,
                          [&](const char* name, const auto& value) { json[name] = value; });
    return json;
}

nlohmann::ordered_json to_json(const RunOptions& options, const FinishedRun& run) {
    const sim::Settings& settings = *run.planned->settings;
    const sim::RunResult& result = run.result;
    const RunSummary summary = summary_of(run);
    nlohmann::ordered_json json = {
        {"task", experiment::name_of(settings.task)},
        {"source", experiment::name_of(settings.source)},
        {"profile", options.selection.profile},
        {"parameters", experiment::parameter_set_of(options.selection.selection())},
        {"seed", run.planned->seed},
    };
    for (const experiment::Measure& measure : experiment::measures) {
        const auto value = measure.of(summary);
        json[std::string(measure.id)] = value ? nlohmann::ordered_json(*value) : nullptr;
    }
    json["best_swarm_fitness"] = summary.best.value;
    json["best_over"] = summary.best.over;
    const auto add = [&](const char* name, const auto& value) { json[name] = value; };
    sim::for_each_counter(result.counters, add);
    json.update({
        {"chronology", to_json(result.chronology)},
        {"trajectory_hash", fmt::format("{:016x}", result.trajectory_hash)},
        {"robot_steps", result.robot_steps},
        {"cpu_seconds", result.cpu_seconds},
        {"robot_steps_per_cpu_second", rate(result)},
        {"settings_hash", run.planned->settings_hash},
        {"program_version", experiment::program_version()},
    });
    return json;
}

void print_text(const FinishedRun& run) {
    const RunSummary summary = summary_of(run);
    const auto line = [](std::string_view name, const std::string& value,
                         std::string_view meaning) {
        fmt::print("{:<20} {:>12}  {}\n", name, value, meaning);
    };
    const auto real = [](double value) { return fmt::format("{:.2f}", value); };
    line("f_c", real(summary.measures.f_c), "mean swarm fitness over the last share of the run");
    line("f_b", real(summary.measures.f_b), "swarm fitness at the budget");
    line("t_f", fmt::format("{:.0f}", summary.measures.t_f), "cycles until the target was reached");
    line("f_a", real(summary.measures.f_a), "swarm fitness above the target, summed");
    line("best swarm fitness", real(summary.best.value),
         "to which t_f and f_a refer; over " + summary.best.over);
    line("final swarm fitness", real(summary.final_swarm_fitness), "");
    if (summary.swarm_fitness_at_10000) {
        line("at cycle 10000", real(*summary.swarm_fitness_at_10000), "");
    }
    line("species", real(summary.species), "per robot, over the last share of the run");
    line("added elements", real(summary.added_elements), "neurons and connections, likewise");
    line("births", fmt::format("{}", run.result.counters.births), "");
    line("matings", fmt::format("{}", run.result.counters.matings),
         "births with two different parents");
    const sim::ChronologyMeasures& chronology = run.result.chronology;
    line("genes", fmt::format("{}", chronology.genes),
         fmt::format("{} of {} pairs marked against cause, {} of {} against time",
                     chronology.cause_inverted, chronology.caused_pairs, chronology.time_inverted,
                     chronology.timed_pairs));
    line("trajectory hash", fmt::format("{:016x}", run.result.trajectory_hash), "");
    line("CPU seconds", real(run.result.cpu_seconds),
         fmt::format("{:.1f} M robot-steps per CPU-second", rate(run.result) / 1e6));
}

int run(const RunOptions& options) {
    const sim::Settings settings = options.selection.settings();
    const sim::Arena arena = experiment::find_arena(settings.world.arena);
    const experiment::PlannedRun planned{
        &settings, &arena, options.seed,
        experiment::hash_of(experiment::canonical_text(settings, arena)),
        fmt::format("seed {}", options.seed)};

    experiment::RunnerOptions runner;
    runner.stop = &watch_stop_signals();
    std::optional<TraceFile> trace;
    if (options.trace) {
        trace.emplace(*options.trace, settings);
        runner.simulate = trace->recording();
    }
    const bool is_watched = isatty(STDERR_FILENO) != 0;
    experiment::Progress progress(is_watched ? stderr : nullptr);
    const auto outcome =
        experiment::execute_runs({planned}, runner, progress, [&](const FinishedRun& finished) {
            if (options.json) {
                fmt::print("{}\n", to_json(options, finished).dump(2));
            } else {
                print_text(finished);
            }
        });
    if (outcome != experiment::Outcome::finished) {
        fmt::print(stderr, "Stopped before the end of the run.\n");
        return interrupted;
    }
    if (trace) trace->finish();
    return success;
}

}  // namespace

void add_run_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand("run", "Execute one run and show its results");
    auto options = std::make_shared<RunOptions>();
    options->selection.add_to(*command);
    command
        ->add_option("--seed", options->seed, "Seed: the same seed and settings give the same run")
        ->capture_default_str()
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62U));
    command->add_flag("--json", options->json, "Print one JSON object instead of a table");
    command
        ->add_option("--trace", options->trace,
                     "Also write the run's trace: every gene, message and reception, for "
                     "`gene-clocks check-trace`")
        ->type_name("FILE");
    command->footer(
        "Examples:\n"
        "  gene-clocks run --task navigation --seed 1\n"
        "  gene-clocks run --task collection --source timestamp --profile gecco15 --seed 7 --json\n"
        "  gene-clocks run --task navigation --set odneat.p_mate=0.5 --set run.cycles=5000\n"
        "  gene-clocks run --task navigation --seed 1 --trace run.trace\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
