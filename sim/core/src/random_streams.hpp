#pragma once

#include <cstdint>
#include <gene_clocks/neat/random.hpp>

namespace gene_clocks::sim {

/// Streams of random numbers of one run: independent of each other, so that what one draws more
/// changes nothing elsewhere. Those from `robots` on, one for each robot, are the agents' own.
enum class Stream : std::uint64_t {
    placement = 1,
    order = 2,
    radio = 3,
    clocks = 4,
    reboots = 5,
    joining = 6,
    robots = 1000,
    identifiers = std::uint64_t{1} << 40,      // one for each robot, and each of its lives
    synchronisation = std::uint64_t{2} << 40,  // one for each robot
};

inline neat::RandomStream make_stream(std::uint64_t seed, Stream stream, std::uint64_t offset = 0) {
    return {seed, static_cast<std::uint64_t>(stream) + offset};
}

}  // namespace gene_clocks::sim
