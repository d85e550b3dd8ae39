#include "sim/report/verdicts.hpp"

#include <algorithm>
#include <array>

#include "sim/report/compared_measures.hpp"
#include "sim/statistics/mann_whitney.hpp"
#include "sim/statistics/quantiles.hpp"

namespace gene_clocks::report {
namespace {

/// Where the paper shows what: the number of its figure for navigation; collection's is the next.
struct Place {
    int navigation_figure;
    std::vector<std::string_view> measures;
};

const std::array<Place, 4> places = {{
    {3, {"final_swarm_fitness", "swarm_fitness_at_10000"}},
    {5, {"f_c"}},
    {7, {"species"}},
    {9, {"added_elements"}},
}};

/// Whether the runs are as long as the paper's, with as many robots and items. What a swarm reaches
/// can only then be compared with the paper.
bool paper_scale(const sim::Settings& settings, bool full_length) {
    const Published& paper = published();
    const auto equals = [&](std::int64_t value, const char* key) {
        return static_cast<double>(value) == paper.fixed.at(key);
    };
    const bool items =
        settings.task != sim::Task::collection || equals(settings.world.items, "world.items");
    const bool length = !full_length || settings.run.cycles == paper.tasks.at(settings.task).cycles;
    return equals(settings.world.robots, "world.robots") && items && length;
}

void judge_ranges(const Comparison& comparison, std::string_view origin,
                  const std::vector<PublishedRuns>& all, std::string_view measure,
                  std::vector<RangeVerdict>& verdicts) {
    for (const PublishedRuns& runs : all) {
        const auto range = runs.ranges.find(std::string(measure));
        if (runs.task != comparison.settings.task || range == runs.ranges.end()) continue;
        if (!runs.parameters.empty() && runs.parameters != comparison.parameters) continue;
        RangeVerdict& verdict = verdicts.emplace_back();
        verdict.origin = origin;
        verdict.source = runs.source;
        verdict.measure = measure;
        verdict.published = range->second;
        const ArmNumbers* arm = comparison.arm(runs.source);
        if (arm == nullptr || !arm->values.contains(measure)) continue;
        const std::vector<double>& values = arm->values.at(measure);
        verdict.ours = statistics::median(values);
        verdict.ours_interval = statistics::bootstrap_interval(values, statistics::median);
        if (paper_scale(comparison.settings, measure != "swarm_fitness_at_10000"))
            verdict.agrees = verdict.published.contains(*verdict.ours);
    }
}

/// The p-value of Gene Clocks against timestamps; none where one of them was not run.
std::optional<double> p_value_of(const Comparison& comparison, const std::string& measure) {
    const ArmNumbers* gene_clock = comparison.arm(sim::Source::gene_clock);
    const ArmNumbers* timestamp = comparison.arm(sim::Source::timestamp);
    if (gene_clock == nullptr || timestamp == nullptr) return std::nullopt;
    return statistics::mann_whitney(gene_clock->values.at(measure), timestamp->values.at(measure))
        .p_value;
}

TestVerdict judge_test(const Comparison& comparison, const std::string& measure, double p_value,
                       bool is_lower_bound) {
    TestVerdict verdict{measure, p_value, is_lower_bound, p_value_of(comparison, measure), {}};
    if (verdict.ours && paper_scale(comparison.settings, true)) {
        const double level = published().significance_level;
        verdict.agrees = (*verdict.ours < level) == (p_value < level);
    }
    return verdict;
}

}  // namespace

Agreement count_agreement(const Exhibit& exhibit) {
    Agreement agreement;
    const auto count = [&](const auto& verdict) {
        if (!verdict.agrees) return;
        ++agreement.compared;
        if (*verdict.agrees) ++agreement.agreeing;
    };
    std::ranges::for_each(exhibit.ranges, count);
    std::ranges::for_each(exhibit.tests, count);
    return agreement;
}

std::vector<Exhibit> judge(const Comparison& comparison) {
    const sim::Task task = comparison.settings.task;
    const PublishedTask& paper = published().tasks.at(task);
    std::vector<Exhibit> exhibits;
    for (const Place& place : places) {
        const int number = place.navigation_figure + (task == sim::Task::collection ? 1 : 0);
        Exhibit& exhibit = exhibits.emplace_back();
        exhibit.id = "figure-" + std::to_string(number);
        exhibit.task = task;
        for (const std::string_view measure : place.measures) {
            judge_ranges(comparison, "paper", published().paper, measure, exhibit.ranges);
            judge_ranges(comparison, "reference", published().reference, measure, exhibit.ranges);
        }
    }
    Exhibit table_2{"table-2", task, {}, {}};
    for (const std::string_view measure : compared_measures) {
        const std::string id(measure);
        table_2.tests.push_back(judge_test(comparison, id, paper.p_values.at(id), false));
    }
    Exhibit figure_11{"figure-11", task, {}, {}};
    figure_11.tests.push_back(
        judge_test(comparison, "controller_size", paper.controller_size_p_value_above, true));
    exhibits.push_back(std::move(figure_11));
    exhibits.push_back(std::move(table_2));
    return exhibits;
}

}  // namespace gene_clocks::report
