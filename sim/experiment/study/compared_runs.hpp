#pragma once

#include <cstdint>
#include <gene_clocks/sim/simulation.hpp>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/experiment/study/run_key.hpp"

namespace gene_clocks::experiment {

/// Runs are compared with each other where they have the same task and profile.
using Family = std::pair<sim::Task, std::string>;

/// What t_f and f_a of a run refer to: the best swarm fitness, and the runs that it was taken over.
struct BestSwarmFitness {
    double value{};    ///< energy; 0 where there is no run, or none that ever had any
    std::string over;  ///< which runs, for people to read
};

/// Of one run that is compared with no other: its own, unless the settings fix it.
BestSwarmFitness best_of_run(const std::vector<sim::Sample>& samples,
                             const sim::MeasureSettings& settings);

/// The runs that a command was given. The one home of what "the best of all compared runs" is: the
/// best swarm fitness of all of them that have the task and the profile in question.
class ComparedRuns {
public:
    /// Takes a run in. Runs of the same key are one run, whichever studies or arms they are in.
    void add(const Family& family, const RunKey& run, const std::vector<sim::Sample>& samples);

    /// What runs of that family refer to, unless their settings fix it (measures.best_fitness).
    [[nodiscard]] BestSwarmFitness best(const Family& family,
                                        const sim::MeasureSettings& settings) const;

private:
    struct Known {
        double best{};
        std::set<RunKey> runs;
    };
    std::map<Family, Known> families_;
};

}  // namespace gene_clocks::experiment
