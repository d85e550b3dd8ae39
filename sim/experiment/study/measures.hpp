#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "sim/experiment/study/summary.hpp"

namespace gene_clocks::experiment {

/// A number that every run comes down to, under the name that it has in all outputs.
struct Measure {
    std::string_view id;
    std::optional<double> (*of)(const RunSummary&);  ///< none: the run is too short
    bool refers_to_best = false;                     ///< to RunSummary::best
};

inline constexpr std::array<Measure, 9> measures = {{
    {"f_c", [](const RunSummary& run) { return std::optional(run.measures.f_c); }},
    {"f_b", [](const RunSummary& run) { return std::optional(run.measures.f_b); }},
    {"t_f", [](const RunSummary& run) { return std::optional(run.measures.t_f); }, true},
    {"f_a", [](const RunSummary& run) { return std::optional(run.measures.f_a); }, true},
    {"final_swarm_fitness",
     [](const RunSummary& run) { return std::optional(run.final_swarm_fitness); }},
    {"swarm_fitness_at_10000", [](const RunSummary& run) { return run.swarm_fitness_at_10000; }},
    {"species", [](const RunSummary& run) { return std::optional(run.species); }},
    {"added_elements", [](const RunSummary& run) { return std::optional(run.added_elements); }},
    {"controller_size", [](const RunSummary& run) { return std::optional(run.controller_size); }},
}};

/// Whether the measure of that id refers to the best swarm fitness of all compared runs.
constexpr bool refers_to_best(std::string_view id) {
    for (const Measure& measure : measures) {
        if (measure.id == id) return measure.refers_to_best;
    }
    return false;
}

}  // namespace gene_clocks::experiment
