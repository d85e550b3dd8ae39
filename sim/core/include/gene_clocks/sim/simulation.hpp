#pragma once

#include <atomic>
#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <gene_clocks/sim/arena.hpp>
#include <gene_clocks/sim/chronology_measures.hpp>
#include <gene_clocks/sim/run_counters.hpp>
#include <gene_clocks/sim/sample.hpp>
#include <gene_clocks/sim/settings.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gene_clocks::sim {

class RunObserver;

/// When a gene was created, for studies of chronology.
struct GeneCreation {
    InnovationNumber mark;
    RobotId robot{};
    double cycle{};
};

/// The record of one run: a pure function of settings, arena and seed, timing apart.
struct RunResult {
    std::vector<Sample> samples;
    RunCounters counters;
    ChronologyMeasures chronology;
    std::vector<GeneCreation> creations;  ///< in order; empty unless record_creation_times is set
    std::uint64_t trajectory_hash{};      ///< XXH3 of all positions and fitnesses at the samples
    std::uint64_t robot_steps{};
    double cpu_seconds{};  ///< of the calling thread
};

/// Lets another thread watch and stop a run.
struct RunControl {
    std::atomic<bool> stop{false};
    std::atomic<std::int64_t> cycles_done{0};
};

/// How many genesis marks the initial genome of such a run carries: gene clocks start above them.
std::uint64_t genesis_count(const Settings& settings);

/// Runs one experiment.
/// Returns nullopt where `control->stop` was set before the end.
/// Throws std::runtime_error where the arena has no free place for a robot or an item, and
/// std::invalid_argument where the settings contradict each other.
std::optional<RunResult> simulate(const Settings& settings, const Arena& arena, std::uint64_t seed,
                                  RunControl* control = nullptr);

/// The same run, told to an observer.
std::optional<RunResult> simulate_observed(const Settings& settings, const Arena& arena,
                                           std::uint64_t seed, RunObserver& observer,
                                           RunControl* control = nullptr);

/// The paper's four performance measures (section 4.1, Figure 2), from the samples of a run.
struct Measures {
    double f_c{};  ///< mean F_s over the last share of the samples
    double f_b{};  ///< F_s at the budget
    double t_f{};  ///< cycle of the first sample at or above target; the last one's where none is
    double f_a{};  ///< sum of what exceeds the target
};
Measures measure(const std::vector<Sample>& samples, const MeasureSettings& settings);

}  // namespace gene_clocks::sim
