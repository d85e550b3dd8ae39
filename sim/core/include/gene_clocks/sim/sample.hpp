#pragma once

#include <cstddef>
#include <cstdint>

namespace gene_clocks::sim {

/// What the paper measures every 100 cycles (section 4.1); means over all robots that are switched
/// on (see JoinSettings).
struct Sample {
    std::int64_t cycle{};
    double swarm_fitness{};  ///< F_s
    double species{};        ///< species in the local population
    /// Neurons and connections beyond the initial ones, disabled ones included.
    double added_elements{};
    double controller_size{};  ///< neurons and connections of the active genome
};

/// Calls `visit(name, value)` for each field, in order; `sample` may be const. Every list of what a
/// sample holds comes from here.
template <class AnySample, class Visit>
constexpr void for_each_value(AnySample&& sample, Visit visit) {
    visit("cycle", sample.cycle);
    visit("swarm_fitness", sample.swarm_fitness);
    visit("species", sample.species);
    visit("added_elements", sample.added_elements);
    visit("controller_size", sample.controller_size);
}

/// How many values for_each_value visits: all fields, each of which takes eight bytes.
inline constexpr std::size_t sample_values = [] {
    std::size_t count = 0;
    for_each_value(Sample{}, [&](const char*, const auto&) { ++count; });
    return count;
}();
static_assert(sizeof(Sample) == sample_values * 8, "for_each_value leaves a field out");

}  // namespace gene_clocks::sim
