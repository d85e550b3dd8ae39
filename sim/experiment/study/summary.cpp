#include "sim/experiment/study/summary.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <stdexcept>

namespace gene_clocks::experiment {
namespace {

double mean_of(std::span<const sim::Sample> samples, double sim::Sample::*field) {
    const double sum = std::accumulate(
        samples.begin(), samples.end(), 0.0,
        [field](double total, const sim::Sample& sample) { return total + sample.*field; });
    return sum / static_cast<double>(samples.size());
}

}  // namespace

RunSummary summarise(const std::vector<sim::Sample>& samples, sim::MeasureSettings settings,
                     const BestSwarmFitness& best) {
    if (samples.empty()) throw std::invalid_argument("a run without samples has no summary");
    settings.best_fitness = best.value;
    RunSummary summary;
    summary.best = best;
    summary.measures = sim::measure(samples, settings);
    summary.final_swarm_fitness = samples.back().swarm_fitness;
    constexpr std::int64_t comparison_cycle = 10'000;
    if (samples.back().cycle >= comparison_cycle) {
        const auto after =
            std::ranges::upper_bound(samples, comparison_cycle, {}, &sim::Sample::cycle);
        if (after != samples.begin())
            summary.swarm_fitness_at_10000 = std::prev(after)->swarm_fitness;
    }
    // As sim::measure counts them for f_c.
    const auto share = settings.accumulated_share * static_cast<double>(samples.size());
    const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(share));
    const auto tail = std::span(samples).last(count);
    summary.species = mean_of(tail, &sim::Sample::species);
    summary.added_elements = mean_of(tail, &sim::Sample::added_elements);
    summary.controller_size = mean_of(tail, &sim::Sample::controller_size);
    return summary;
}

}  // namespace gene_clocks::experiment
