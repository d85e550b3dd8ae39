#include "sim/experiment/store/csv_export.hpp"

#include <fmt/ostream.h>

#include <iomanip>
#include <sstream>
#include <string>

#include "sim/experiment/study/compared_runs.hpp"
#include "sim/experiment/study/measures.hpp"
#include "sim/experiment/study/summary.hpp"
#include "sim/settings/choice_names.hpp"

namespace gene_clocks::experiment {
namespace {

ComparedRuns compared_runs(const Store& store, const std::vector<StoredStudy>& studies) {
    ComparedRuns compared;
    for (const StoredStudy& study : studies) {
        for (const StoredArm& arm : study.arms) {
            for (const RunRecord& run : store.runs(study, arm)) {
                compared.add({arm.settings.task, arm.profile}, {run.settings_hash, run.seed},
                             run.result.samples);
            }
        }
    }
    return compared;
}

/// The columns that say which run a line is about. Names have no commas or quotes, read_study sees
/// to it; a profile may be any file.
std::string identity(const StoredStudy& study, const StoredArm& arm, const RunRecord& run) {
    return fmt::format("{},{},{},{},{},{},{}", study.name, arm.name, name_of(arm.settings.task),
                       name_of(arm.settings.source), csv_field(arm.profile), arm.parameters,
                       run.seed);
}
constexpr std::string_view identity_header = "study,arm,task,source,profile,parameters,seed";

void write_run(const StoredStudy& study, const StoredArm& arm, const RunRecord& run,
               const BestSwarmFitness& best, std::ostream& out) {
    const RunSummary summary = summarise(run.result.samples, arm.settings.measures, best);
    fmt::print(out, "{},", identity(study, arm, run));
    for (const Measure& measure : measures) {
        const auto value = measure.of(summary);
        fmt::print(out, "{},", value ? fmt::format("{}", *value) : "");
    }
    fmt::print(out, "{},{},", best.value, csv_field(best.over));
    sim::for_each_counter(run.result.counters,
                          [&](const char*, const auto& value) { fmt::print(out, "{},", value); });
    sim::for_each_measure(run.result.chronology,
                          [&](const char*, const auto& value) { fmt::print(out, "{},", value); });
    fmt::print(out, "{:016x},{},{},{},{},{},{}\n", run.result.trajectory_hash,
               run.result.robot_steps, run.result.cpu_seconds, run.wall_seconds, run.finished_at,
               run.program_version, run.settings_hash);
}

}  // namespace

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::ostringstream stream;
    stream << std::quoted(text, '"', '"');
    return stream.str();
}

void write_runs_csv(const Store& store, const std::vector<StoredStudy>& studies,
                    std::ostream& out) {
    const auto name_column = [&](const char* name, const auto&) { fmt::print(out, "{},", name); };
    fmt::print(out, "{},", identity_header);
    for (const Measure& measure : measures) fmt::print(out, "{},", measure.id);
    fmt::print(out, "best_swarm_fitness,best_over,");
    sim::for_each_counter(sim::RunCounters{}, name_column);
    sim::for_each_measure(sim::ChronologyMeasures{}, name_column);
    fmt::print(out,
               "trajectory_hash,robot_steps,cpu_seconds,wall_seconds,finished_at,"
               "program_version,settings_hash\n");
    const ComparedRuns compared = compared_runs(store, studies);
    for (const StoredStudy& study : studies) {
        for (const StoredArm& arm : study.arms) {
            const BestSwarmFitness best =
                compared.best({arm.settings.task, arm.profile}, arm.settings.measures);
            for (const RunRecord& run : store.runs(study, arm)) {
                write_run(study, arm, run, best, out);
            }
        }
    }
}

void write_samples_csv(const Store& store, const std::vector<StoredStudy>& studies,
                       std::ostream& out) {
    fmt::print(out, "{}", identity_header);
    sim::for_each_value(sim::Sample{},
                        [&](const char* name, const auto&) { fmt::print(out, ",{}", name); });
    fmt::print(out, "\n");
    for (const StoredStudy& study : studies) {
        for (const StoredArm& arm : study.arms) {
            for (const RunRecord& run : store.runs(study, arm)) {
                const std::string start = identity(study, arm, run);
                for (const sim::Sample& sample : run.result.samples) {
                    fmt::print(out, "{}", start);
                    sim::for_each_value(sample, [&](const char*, const auto& value) {
                        fmt::print(out, ",{}", value);
                    });
                    fmt::print(out, "\n");
                }
            }
        }
    }
}

}  // namespace gene_clocks::experiment
