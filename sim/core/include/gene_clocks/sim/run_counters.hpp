#pragma once

#include <cstddef>
#include <cstdint>

namespace gene_clocks::sim {

/// Counts of what happened in a run.
struct RunCounters {
    std::uint64_t births{};
    std::uint64_t matings{};  ///< births with two different parents
    std::uint64_t mutations{};
    std::uint64_t genes_created{};
    std::uint64_t messages_sent{};
    std::uint64_t messages_received{};
    std::uint64_t genomes_accepted{};
    std::uint64_t collisions{};
    std::uint64_t reboots{};
};

/// Calls `visit(name, value)` for each field, in order; `counters` may be const. Every list of what
/// is counted comes from here.
template <class Counters, class Visit>
constexpr void for_each_counter(Counters&& counters, Visit visit) {
    visit("births", counters.births);
    visit("matings", counters.matings);
    visit("mutations", counters.mutations);
    visit("genes_created", counters.genes_created);
    visit("messages_sent", counters.messages_sent);
    visit("messages_received", counters.messages_received);
    visit("genomes_accepted", counters.genomes_accepted);
    visit("collisions", counters.collisions);
    visit("reboots", counters.reboots);
}

/// How many counters for_each_counter visits: all fields.
inline constexpr std::size_t run_counters = [] {
    std::size_t count = 0;
    for_each_counter(RunCounters{}, [&](const char*, const auto&) { ++count; });
    return count;
}();
static_assert(sizeof(RunCounters) == run_counters * sizeof(std::uint64_t),
              "for_each_counter leaves a field out");

}  // namespace gene_clocks::sim
