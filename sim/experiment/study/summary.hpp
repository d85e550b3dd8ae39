#pragma once

#include <gene_clocks/sim/simulation.hpp>
#include <optional>

namespace gene_clocks::experiment {

/// What a run comes down to: the numbers that runs are compared by.
struct RunSummary {
    sim::Measures measures;
    double final_swarm_fitness{};  ///< F_s of the last sample
    /// F_s of the last sample up to cycle 10 000; none for shorter runs.
    std::optional<double> swarm_fitness_at_10000;
    /// Means over the last share of the samples that f_c is taken over, too.
    double species{};
    double added_elements{};
    double controller_size{};
};

/// Throws std::invalid_argument for a run without samples.
RunSummary summarise(const std::vector<sim::Sample>& samples, const sim::MeasureSettings& settings);

/// The best F_s of a run: t_f and f_a of compared runs refer to the best of them all.
double best_swarm_fitness(const std::vector<sim::Sample>& samples);

}  // namespace gene_clocks::experiment
