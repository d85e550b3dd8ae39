#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "sim/experiment/study/summary.hpp"

namespace gene_clocks::report {

/// A number that every run comes down to, under the name it has in report.json and published.toml.
struct Measure {
    std::string_view id;
    std::optional<double> (*of)(const experiment::RunSummary&);  ///< none: the run is too short
    bool refers_to_best = false;                                 ///< to RunSummary::best
};

inline constexpr std::array<Measure, 9> measures = {{
    {"f_c", [](const experiment::RunSummary& run) { return std::optional(run.measures.f_c); }},
    {"f_b", [](const experiment::RunSummary& run) { return std::optional(run.measures.f_b); }},
    {"t_f", [](const experiment::RunSummary& run) { return std::optional(run.measures.t_f); },
     true},
    {"f_a", [](const experiment::RunSummary& run) { return std::optional(run.measures.f_a); },
     true},
    {"final_swarm_fitness",
     [](const experiment::RunSummary& run) { return std::optional(run.final_swarm_fitness); }},
    {"swarm_fitness_at_10000",
     [](const experiment::RunSummary& run) { return run.swarm_fitness_at_10000; }},
    {"species", [](const experiment::RunSummary& run) { return std::optional(run.species); }},
    {"added_elements",
     [](const experiment::RunSummary& run) { return std::optional(run.added_elements); }},
    {"controller_size",
     [](const experiment::RunSummary& run) { return std::optional(run.controller_size); }},
}};

/// Whether the measure of that id refers to the best swarm fitness of all compared runs.
constexpr bool refers_to_best(std::string_view id) {
    for (const Measure& measure : measures) {
        if (measure.id == id) return measure.refers_to_best;
    }
    return false;
}

/// The measures of Table 2.
inline constexpr std::array<std::string_view, 4> compared_measures = {"f_c", "f_b", "t_f", "f_a"};

/// The measures in which the methods are tested against each other: those of Table 2 and Figure 11.
inline constexpr std::array<std::string_view, 5> tested_measures = {"f_c", "f_b", "t_f", "f_a",
                                                                    "controller_size"};

}  // namespace gene_clocks::report
