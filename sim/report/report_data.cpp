#include "sim/report/report_data.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/experiment/study/measures.hpp"
#include "sim/report/chronology_shares.hpp"
#include "sim/report/compared_measures.hpp"
#include "sim/report/comparison.hpp"
#include "sim/report/group_data.hpp"
#include "sim/report/interval_json.hpp"
#include "sim/report/published.hpp"
#include "sim/report/verdicts.hpp"
#include "sim/settings/choice_names.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/profile.hpp"
#include "sim/settings/settings_table.hpp"
#include "sim/statistics/bootstrap.hpp"
#include "sim/statistics/mann_whitney.hpp"
#include "sim/statistics/quantiles.hpp"

namespace gene_clocks::report {
namespace {

using experiment::name_of;
using report::to_json;
using Json = nlohmann::ordered_json;

constexpr int format = 1;

/// What is drawn over time.
constexpr std::array<std::pair<const char*, double sim::Sample::*>, 3> curves = {{
    {"swarm_fitness", &sim::Sample::swarm_fitness},
    {"species", &sim::Sample::species},
    {"controller_size", &sim::Sample::controller_size},
}};

template <typename Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json to_json(const experiment::Value& value) {
    return std::visit([](const auto& held) { return Json(held); }, value);
}

std::string_view name_of_role(Role role) {
    switch (role) {
        case Role::as_run:
            return "as-run";
        case Role::as_printed:
            return "as-printed";
        case Role::other:
            break;
    }
    return "other";
}

Json summary_json(const std::vector<double>& values) {
    const statistics::BoxSummary box = statistics::summarize(values);
    return {
        {"count", box.count},
        {"minimum", box.minimum},
        {"lower_whisker", box.lower_whisker},
        {"lower_quartile", box.lower_quartile},
        {"median", box.median},
        {"upper_quartile", box.upper_quartile},
        {"upper_whisker", box.upper_whisker},
        {"maximum", box.maximum},
        {"median_interval", to_json(statistics::bootstrap_interval(values, statistics::median))},
        {"values", values}};
}

/// Median and quartiles over the runs, sample by sample.
Json curve_json(const ArmNumbers& numbers, double sim::Sample::*field) {
    Json curve = {{"lower_quartile", Json::array()},
                  {"median", Json::array()},
                  {"upper_quartile", Json::array()}};
    std::vector<double> values(numbers.runs.size());
    for (std::size_t i = 0; i < numbers.runs.front()->result.samples.size(); ++i) {
        for (std::size_t run = 0; run < values.size(); ++run)
            values[run] = numbers.runs[run]->result.samples[i].*field;
        curve["lower_quartile"].push_back(statistics::quantile(values, 0.25));
        curve["median"].push_back(statistics::median(values));
        curve["upper_quartile"].push_back(statistics::quantile(values, 0.75));
    }
    return curve;
}

/// Each share's median and quartiles over the runs that have one; null where none has.
Json chronology_json(const ArmNumbers& numbers) {
    Json json;
    for (const ChronologyShare& share : chronology_shares) {
        std::vector<double> values;
        for (const Run* run : numbers.runs) {
            if (const auto value = share.of(run->result)) values.push_back(*value);
        }
        Json& entry = json[std::string(share.id)];
        if (values.empty()) continue;
        entry = {{"count", values.size()},
                 {"lower_quartile", statistics::quantile(values, 0.25)},
                 {"median", statistics::median(values)},
                 {"upper_quartile", statistics::quantile(values, 0.75)}};
    }
    return json;
}

Json cost_json(double cpu_seconds, double robot_steps) {
    Json rate = nullptr;
    if (cpu_seconds > 0.0) rate = robot_steps / cpu_seconds;
    return {{"cpu_seconds", cpu_seconds},
            {"robot_steps", robot_steps},
            {"robot_steps_per_cpu_second", rate}};
}

Json median_counters_json(const ArmNumbers& numbers) {
    std::map<std::string_view, std::vector<double>> values;
    for (const Run* run : numbers.runs) {
        sim::for_each_counter(run->result.counters, [&](const char* name, std::uint64_t value) {
            values[name].push_back(static_cast<double>(value));
        });
    }
    Json json;
    sim::for_each_counter(sim::RunCounters{}, [&](const char* name, std::uint64_t) {
        json[name] = statistics::median(values.at(name));
    });
    return json;
}

Json arm_json(const ArmNumbers& numbers) {
    Json json = {{"name", numbers.arm->name},
                 {"source", name_of(numbers.arm->settings.source)},
                 {"runs", numbers.runs.size()}};
    Json seeds = Json::array();
    double cpu_seconds = 0.0;
    double robot_steps = 0.0;
    for (const Run* run : numbers.runs) {
        seeds.push_back(run->seed);
        cpu_seconds += run->result.cpu_seconds;
        robot_steps += static_cast<double>(run->result.robot_steps);
    }
    json["seeds"] = std::move(seeds);
    json["cost"] = cost_json(cpu_seconds, robot_steps);
    json["median_counters"] = median_counters_json(numbers);
    const std::vector<sim::Sample>& samples = numbers.runs.front()->result.samples;
    json["cycles"] = Json::array();
    for (const sim::Sample& sample : samples) json["cycles"].push_back(sample.cycle);
    for (const auto& [name, field] : curves) json["curves"][name] = curve_json(numbers, field);
    // The same on every robot of every run: the task's inputs and outputs, fully connected.
    json["initial_controller_size"] =
        samples.front().controller_size - samples.front().added_elements;
    for (const experiment::Measure& measure : experiment::measures) {
        const auto found = numbers.values.find(measure.id);
        json["measures"][std::string(measure.id)] =
            found == numbers.values.end() ? Json(nullptr) : summary_json(found->second);
    }
    json["chronology"] = chronology_json(numbers);
    return json;
}

/// Two samples against each other. x: Gene Clocks, y: timestamps.
Json test_json(const std::vector<double>& x, const std::vector<double>& y) {
    const statistics::MannWhitney test = statistics::mann_whitney(x, y);
    return {{"gene_clock_runs", x.size()},
            {"timestamp_runs", y.size()},
            {"u", test.u},
            {"p_value", test.p_value},
            {"exact", test.distribution == statistics::NullDistribution::exact},
            {"effect", statistics::vargha_delaney_a(x, y)}};
}

double median_difference(std::span<const double> x, std::span<const double> y) {
    return statistics::median(x) - statistics::median(y);
}

/// Gene Clocks against timestamps, by measure: all runs, and independent halves of the seeds.
Json tests_json(const ArmNumbers& gene_clock, const ArmNumbers& timestamp) {
    Json json;
    for (const std::string_view measure : tested_measures) {
        const std::vector<double>& x = gene_clock.values.at(measure);
        const std::vector<double>& y = timestamp.values.at(measure);
        const auto halves = independent_halves(gene_clock, timestamp, measure);
        json[std::string(measure)] = {
            {"all", test_json(x, y)},
            {"halves", halves ? test_json(halves->first, halves->second) : Json(nullptr)},
            {"effect_interval",
             to_json(statistics::bootstrap_interval(x, y, statistics::vargha_delaney_a))},
            {"median_difference", median_difference(x, y)},
            {"median_difference_interval",
             to_json(statistics::bootstrap_interval(x, y, median_difference))}};
    }
    return json;
}

Json trajectories_json(const ArmNumbers& gene_clock, const ArmNumbers& timestamp) {
    const SharedTrajectories shared = share_trajectories(gene_clock, timestamp);
    Json json = {{"pairs", shared.pairs},
                 {"identical", shared.identical},
                 {"median_first_difference_cycle", nullptr}};
    if (!shared.first_difference_cycles.empty())
        json["median_first_difference_cycle"] = statistics::median(shared.first_difference_cycles);
    return json;
}

Json exhibits_json(const std::vector<Exhibit>& exhibits) {
    Json json = Json::array();
    for (const Exhibit& exhibit : exhibits) {
        Json entry = {{"id", exhibit.id}, {"ranges", Json::array()}, {"tests", Json::array()}};
        for (const RangeVerdict& verdict : exhibit.ranges) {
            entry["ranges"].push_back(
                {{"origin", verdict.origin},
                 {"source", name_of(verdict.source)},
                 {"measure", verdict.measure},
                 {"lower", verdict.published.lower},
                 {"median", or_null(verdict.published.median)},
                 {"upper", verdict.published.upper},
                 {"ours", or_null(verdict.ours)},
                 {"ours_interval", verdict.ours ? to_json(verdict.ours_interval) : Json(nullptr)},
                 {"agrees", or_null(verdict.agrees)}});
        }
        for (const TestVerdict& verdict : exhibit.tests) {
            entry["tests"].push_back({{"measure", verdict.measure},
                                      {"p_value", verdict.published},
                                      {"is_lower_bound", verdict.is_lower_bound},
                                      {"ours", or_null(verdict.ours)},
                                      {"agrees", or_null(verdict.agrees)}});
        }
        const auto [agreeing, compared] = count_agreement(exhibit);
        entry["agreeing"] = agreeing;
        entry["compared"] = compared;
        json.push_back(std::move(entry));
    }
    return json;
}

/// Where the settings differ from those that profile and parameter set give by themselves.
Json changes_json(const Comparison& comparison) {
    Json json = Json::array();
    experiment::Selection selection{.task = comparison.settings.task,
                                    .source = comparison.settings.source,
                                    .profile = comparison.profile,
                                    .parameters = {}};
    if (!comparison.parameters.empty()) selection.parameters = comparison.parameters;
    std::optional<sim::Settings> plain;
    try {
        plain = experiment::select(selection);
    } catch (const experiment::InputError&) {
        return nullptr;  // a profile that was a file, and is gone
    }
    for (const experiment::Setting& setting : experiment::settings_table()) {
        if (setting.get(*plain) == setting.get(comparison.settings)) continue;
        json.push_back({{"key", setting.key},
                        {"profile", to_json(setting.get(*plain))},
                        {"run", to_json(setting.get(comparison.settings))}});
    }
    return json;
}

Json settings_json(const sim::Settings& settings) {
    Json json = Json::array();
    for (const experiment::Setting& setting : experiment::settings_table()) {
        json.push_back({{"key", setting.key},
                        {"value", to_json(setting.get(settings))},
                        {"unit", setting.unit},
                        {"description", setting.description}});
    }
    return json;
}

Json comparison_json(const Comparison& comparison) {
    const sim::Settings& settings = comparison.settings;
    Json json = {{"task", name_of(settings.task)},
                 {"profile", comparison.profile},
                 {"parameters", comparison.parameters},
                 {"role", name_of_role(comparison.role)},
                 {"best_swarm_fitness", comparison.best.value},
                 {"best_over", comparison.best.over},
                 {"target_swarm_fitness", settings.measures.target_share * comparison.best.value},
                 {"settings", settings_json(settings)},
                 {"changes", changes_json(comparison)},
                 {"arms", Json::array()},
                 {"tests", nullptr},
                 {"trajectories", nullptr},
                 {"exhibits", exhibits_json(judge(comparison))}};
    for (const ArmNumbers& numbers : comparison.arms) json["arms"].push_back(arm_json(numbers));
    const ArmNumbers* gene_clock = comparison.arm(sim::Source::gene_clock);
    const ArmNumbers* timestamp = comparison.arm(sim::Source::timestamp);
    if (gene_clock != nullptr && timestamp != nullptr) {
        json["tests"] = tests_json(*gene_clock, *timestamp);
        json["trajectories"] = trajectories_json(*gene_clock, *timestamp);
    }
    return json;
}

/// Table 1's fixed values, and whether all runs have them. Navigation has no items.
Json fixed_json(const std::vector<Comparison>& comparisons) {
    Json rows = Json::array();
    for (const auto& [key, value] : published().fixed) {
        const experiment::Setting& setting = *experiment::find_setting(key);
        const auto agrees = [&](const Comparison& comparison) {
            const sim::Settings& settings = comparison.settings;
            return to_json(setting.get(settings)) == Json(value) ||
                   (key == "world.items" && settings.task == sim::Task::navigation);
        };
        rows.push_back({{"key", key},
                        {"value", value},
                        {"description", setting.description},
                        {"agrees", std::ranges::all_of(comparisons, agrees)}});
    }
    return rows;
}

/// Table 1: the parameter sets, and which task each is printed for and was run for.
Json table_1_json(const std::vector<Comparison>& comparisons) {
    Json json;
    for (const std::string_view key : tuned_keys) {
        const experiment::Setting& setting = *experiment::find_setting(key);
        Json row = {{"key", setting.key}, {"unit", setting.unit}};
        for (const std::string& name : experiment::parameter_set_names())
            row["values"][name] = to_json(setting.get(experiment::select({.parameters = name})));
        json["rows"].push_back(std::move(row));
    }
    json["fixed"] = fixed_json(comparisons);
    for (const auto& [task, numbers] : published().tasks) {
        json["printed"][std::string(name_of(task))] = numbers.printed_parameters;
        json["as_run"][std::string(name_of(task))] = numbers.run_parameters;
    }
    return json;
}

/// How the page calls and draws each source.
Json sources_json() {
    Json json;
    for (const sim::SourceDisplay& source : sim::sources) {
        json[std::string(source.name)] = {{"title", source.title},
                                          {"colour", source.colour},
                                          {"dark_colour", source.dark_colour},
                                          {"dashes", source.dashes},
                                          {"marker", source.marker}};
    }
    return json;
}

Json provenance_json(const Input& input) {
    std::set<std::string> versions;
    double cpu_seconds = 0.0;
    double robot_steps = 0.0;
    std::size_t runs = 0;
    for (const ArmRuns& arm : input.arms) {
        for (const Run& run : arm.runs) {
            ++runs;
            versions.insert(run.program_version);
            cpu_seconds += run.result.cpu_seconds;
            robot_steps += static_cast<double>(run.result.robot_steps);
        }
    }
    return {{"study", input.study},
            {"title", input.title},
            {"command", input.command},
            {"program_version", input.program_version},
            {"versions_of_runs", versions},
            {"runs", runs},
            {"cost", cost_json(cpu_seconds, robot_steps)}};
}

}  // namespace

nlohmann::ordered_json report_data(const Input& input) {
    const std::vector<Comparison> comparisons = compare(input);
    Json json = {{"format", format}, {"provenance", provenance_json(input)}};
    json["paper"] = {{"runs", published().runs},
                     {"significance_level", published().significance_level}};
    for (const auto& [task, numbers] : published().tasks)
        json["paper"]["cycles"][std::string(name_of(task))] = numbers.cycles;
    json["bootstrap"] = {{"resamples", statistics::BootstrapSettings{}.resamples},
                         {"confidence", statistics::BootstrapSettings{}.confidence}};
    json["sources"] = sources_json();
    json["table_1"] = table_1_json(comparisons);
    json["missing_arms"] = Json::array();
    for (const ArmRuns& arm : input.arms) {
        if (arm.runs.empty()) json["missing_arms"].push_back(arm.name);
    }
    json["comparisons"] = Json::array();
    for (const Comparison& comparison : comparisons)
        json["comparisons"].push_back(comparison_json(comparison));
    json["groups"] = groups_json(comparisons);
    return json;
}

}  // namespace gene_clocks::report
