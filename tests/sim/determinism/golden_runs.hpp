#pragma once

#include <cstdint>
#include <gene_clocks/sim/arena.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gene_clocks::test {

/// A run whose outcome is kept.
struct GoldenRun {
    std::string name;  ///< what it sets, as in "task=collection energy.decay=0.5"
    std::optional<std::string> differs_from;  ///< the run without the last of these, if that is one
    sim::Settings settings;
    sim::Arena arena;
    std::uint64_t seed{};
};

/// All of them, in the order of the file: every task with every innovation source; every setting on
/// the other side of its switch, one by one; and longer ones, as published and as nobody published.
/// Throws std::runtime_error with the key of a setting that has no value on the other side.
std::vector<GoldenRun> golden_runs();

/// What a run came to, as "name: word word …". Each word is "what=value", and says the same only
/// where it is the same to the last bit.
std::string describe(const GoldenRun& run, const sim::RunResult& result);

}  // namespace gene_clocks::test
