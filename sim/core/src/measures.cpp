#include <algorithm>
#include <cmath>
#include <gene_clocks/sim/simulation.hpp>
#include <stdexcept>

namespace gene_clocks::sim {

Measures measure(const std::vector<Sample>& samples, const MeasureSettings& settings) {
    if (samples.empty()) throw std::invalid_argument("a run without samples has no measures");
    const auto count = static_cast<double>(samples.size());
    const auto last =
        std::max<std::size_t>(1, static_cast<std::size_t>(count * settings.accumulated_share));
    double sum = 0.0;
    for (std::size_t i = samples.size() - last; i < samples.size(); ++i) {
        sum += samples[i].swarm_fitness;
    }
    Measures measures;
    measures.f_c = sum / static_cast<double>(last);

    const auto budget = static_cast<std::size_t>(count * settings.budget_share);
    measures.f_b = samples[std::min(budget, samples.size() - 1)].swarm_fitness;

    const auto own_best = std::max_element(
        samples.begin(), samples.end(),
        [](const Sample& a, const Sample& b) { return a.swarm_fitness < b.swarm_fitness; });
    const double best =
        settings.best_fitness > 0.0 ? settings.best_fitness : own_best->swarm_fitness;
    const double target = settings.target_share * best;
    const auto reached = std::find_if(samples.begin(), samples.end(), [&](const Sample& sample) {
        return sample.swarm_fitness >= target;
    });
    measures.t_f =
        static_cast<double>(reached != samples.end() ? reached->cycle : samples.back().cycle);
    for (const Sample& sample : samples) {
        measures.f_a += std::max(sample.swarm_fitness - target, 0.0);
    }
    return measures;
}

}  // namespace gene_clocks::sim
