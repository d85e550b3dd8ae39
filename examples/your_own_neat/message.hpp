// Genomes on the wire: frames of version 1 (docs/wire-format.md).
#pragma once

#include <cstdint>
#include <gene_clocks/wire.hpp>
#include <optional>
#include <span>
#include <vector>

#include "genome.hpp"

namespace your_own_neat {

/// What this deployment admits, the same in all its processes.
inline constexpr gene_clocks::WireLimits limits{.frame_bytes = 4096,
                                                .genesis_count = genesis_count,
                                                .neurons = 64,
                                                .connections = 128,
                                                .weight = 10.0f};

/// The frame that carries a genome, with the clock's stamp; nullopt where the limits forbid it.
std::optional<std::vector<std::uint8_t>> encode(const Genome& genome, const GeneClock& clock);

/// The genome in a frame, once the clock has heard its stamp. nullopt, and nothing has changed,
/// where the frame is damaged, forged or beyond the limits, or the clock refuses its stamp.
std::optional<Genome> decode(std::span<const std::uint8_t> bytes, GeneClock& clock);

}  // namespace your_own_neat
