#include "sim/experiment/study/compared_runs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/settings/choice_names.hpp"

namespace gene_clocks::experiment {
namespace {

double best_in(const std::vector<sim::Sample>& samples) {
    double best = 0.0;
    for (const sim::Sample& sample : samples) best = std::max(best, sample.swarm_fitness);
    return best;
}

bool is_fixed(const sim::MeasureSettings& settings) {
    return settings.best_fitness > 0.0;
}

BestSwarmFitness fixed_best(const sim::MeasureSettings& settings) {
    return {settings.best_fitness, "no runs (measures.best_fitness fixes it)"};
}

}  // namespace

BestSwarmFitness best_of_run(const std::vector<sim::Sample>& samples,
                             const sim::MeasureSettings& settings) {
    if (is_fixed(settings)) return fixed_best(settings);
    return {best_in(samples), "this run alone"};
}

void ComparedRuns::add(const Family& family, const RunKey& run,
                       const std::vector<sim::Sample>& samples) {
    Known& known = families_[family];
    known.best = std::max(known.best, best_in(samples));
    known.runs.insert(run);
}

BestSwarmFitness ComparedRuns::best(const Family& family,
                                    const sim::MeasureSettings& settings) const {
    if (is_fixed(settings)) return fixed_best(settings);
    const auto found = families_.find(family);
    static const Known none;
    const Known& known = found == families_.end() ? none : found->second;
    const auto& [task, profile] = family;
    return {known.best, fmt::format("{} run{} of {} under profile {}", known.runs.size(),
                                    known.runs.size() == 1 ? "" : "s", name_of(task), profile)};
}

}  // namespace gene_clocks::experiment
