#pragma once

#include <array>
#include <cstdint>
#include <gene_clocks/sim/simulation.hpp>
#include <optional>
#include <string_view>

namespace gene_clocks::report {

/// What a run's marking did (docs/markings.md, "Measures of chronology"), per opportunity.
struct ChronologyShare {
    std::string_view id;                                 ///< in report.json
    std::optional<double> (*of)(const sim::RunResult&);  ///< none: there was no opportunity
};

inline std::optional<double> ratio(std::uint64_t part, std::uint64_t whole) {
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}

/// The ratio of two counts of ChronologyMeasures.
template <auto Part, auto Whole>
std::optional<double> ratio_of(const sim::RunResult& run) {
    return ratio(run.chronology.*Part, run.chronology.*Whole);
}

inline constexpr auto chronology_shares = [] {
    using M = sim::ChronologyMeasures;
    return std::to_array<ChronologyShare>({
        {"concurrent",
         [](const sim::RunResult& run) {
             return ratio(run.chronology.pairs - run.chronology.caused_pairs, run.chronology.pairs);
         }},
        {"cause_inverted", ratio_of<&M::cause_inverted, &M::caused_pairs>},
        {"time_inverted", ratio_of<&M::time_inverted, &M::timed_pairs>},
        {"genome_inverted", ratio_of<&M::genome_inverted, &M::genome_pairs>},
        {"same_collisions", ratio_of<&M::same_collisions, &M::genes>},
        {"different_collisions", ratio_of<&M::different_collisions, &M::genes>},
        {"matching", ratio_of<&M::matching, &M::alignments>},
        {"disjoint", ratio_of<&M::disjoint, &M::alignments>},
        {"excess", ratio_of<&M::excess, &M::alignments>},
        {"missed_homologies", ratio_of<&M::missed_homologies, &M::alignments>},
        {"false_homologies", ratio_of<&M::false_homologies, &M::alignments>},
        {"crossovers",
         [](const sim::RunResult& run) {
             return ratio(run.chronology.crossovers, run.counters.births);
         }},
        {"crossovers_repeated", ratio_of<&M::crossovers_repeated, &M::crossovers>},
        {"message_bytes",
         [](const sim::RunResult& run) {
             return ratio(run.chronology.bytes_sent, run.counters.messages_sent);
         }},
        {"stamp_bytes",
         [](const sim::RunResult& run) {
             return ratio(run.chronology.stamp_bytes, run.counters.messages_sent);
         }},
        {"stamp_largest",
         [](const sim::RunResult& run) {
             return std::optional(static_cast<double>(run.chronology.stamp_largest));
         }},
    });
}();

}  // namespace gene_clocks::report
