#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sim/experiment/store/store.hpp"
#include "sim/experiment/study/runner.hpp"
#include "sim/experiment/study/study.hpp"

namespace gene_clocks::experiment {

/// What the speed of a run depends on most.
struct RunKind {
    sim::Task task{};
    std::int64_t robots{};

    explicit RunKind(const sim::Settings& settings)
        : task(settings.task), robots(settings.world.robots) {}
    friend auto operator<=>(const RunKind&, const RunKind&) = default;
};

/// How fast runs of one kind are made, all threads together, and how that is known.
struct KindSpeed {
    double robot_steps_per_second{};
    std::size_t runs{};  ///< that a store has the times of; 0 where it was tried out
};

/// How many runs are made at a time: `threads`, or one for each of the processor's where it is 0.
std::int64_t thread_count(std::int64_t threads);

/// The speeds of the kinds of a study's runs: those that `recorded` runs, by the hash of their
/// settings, were made with. Kinds of which there is none are missing.
std::map<RunKind, KindSpeed> recorded_speeds(const Study& study,
                                             const std::map<std::string, RecordedTime>& recorded,
                                             std::int64_t threads);

/// Makes runs on all threads for a moment, and measures how fast they go. A run that ends before
/// then is begun anew with another seed. What the simulator throws is thrown on.
KindSpeed try_out(const PlannedRun& planned, std::int64_t threads, std::chrono::milliseconds moment,
                  const RunFunction& simulate = sim::simulate);

/// How long it takes to execute planned runs on so many threads, each kind of which must have a
/// speed: as long as all of them shared out evenly, but no shorter than the longest of them.
std::chrono::seconds estimated_time(const std::vector<PlannedRun>& planned_runs,
                                    const std::map<RunKind, KindSpeed>& speeds,
                                    std::int64_t threads);

}  // namespace gene_clocks::experiment
