#pragma once

#include <cstdint>
#include <gene_clocks/sim/simulation.hpp>
#include <span>
#include <string>
#include <vector>

namespace gene_clocks::experiment {

/// A run that was made in another process.
struct RunMessage {
    std::string settings_hash;
    std::uint64_t seed{};
    sim::RunResult result;
    double wall_seconds{};
};

/// The message as bytes: XXH3-64 of all that follows, then CBOR: version of the format, version of
/// the program, and the fields of the message in their order, without names.
std::vector<std::uint8_t> encode(const RunMessage& message);

/// The reverse. Throws std::runtime_error where the bytes are not exactly what `encode` of the same
/// version of the program makes of some message.
RunMessage decode(std::span<const std::uint8_t> bytes);

}  // namespace gene_clocks::experiment
