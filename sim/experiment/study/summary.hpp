#pragma once

#include <gene_clocks/sim/simulation.hpp>
#include <optional>
#include <vector>

#include "sim/experiment/study/compared_runs.hpp"

namespace gene_clocks::experiment {

/// What a run comes down to: the numbers that runs are compared by.
struct RunSummary {
    sim::Measures measures;
    BestSwarmFitness best;         ///< that t_f and f_a refer to
    double final_swarm_fitness{};  ///< F_s of the last sample
    /// F_s of the last sample up to cycle 10 000; none for shorter runs.
    std::optional<double> swarm_fitness_at_10000;
    /// Means over the last share of the samples that f_c is taken over, too.
    double species{};
    double added_elements{};
    double controller_size{};
};

/// `best` is what t_f and f_a refer to; the settings' own best_fitness no longer counts.
/// Throws std::invalid_argument for a run without samples.
RunSummary summarise(const std::vector<sim::Sample>& samples, sim::MeasureSettings settings,
                     const BestSwarmFitness& best);

}  // namespace gene_clocks::experiment
