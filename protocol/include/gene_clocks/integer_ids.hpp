#pragma once

#include <concepts>
#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <limits>
#include <optional>

namespace gene_clocks {

/// A mark as one integer, for a NEAT whose genes have those: the counter above the robot, which has
/// the lowest `robot_bits`. In the order of marks, and never negative. Nullopt where the robot or
/// the counter has more bits than there are: with 32-bit `int` and 11 bits for 2047 robots,
/// counters end at 2^20 − 1, so a clock with `Limits::maximum` = 2^20 says in time that it is
/// exhausted.
template <std::integral Integer>
[[nodiscard]] constexpr std::optional<Integer> pack(InnovationNumber mark, unsigned robot_bits) {
    constexpr unsigned bits = std::numeric_limits<Integer>::digits;
    if (robot_bits >= bits || robot_bits > 32) return std::nullopt;
    const auto robot = static_cast<std::uint64_t>(mark.robot);
    if (robot >> robot_bits != 0) return std::nullopt;
    const auto counters =
        static_cast<std::uint64_t>(std::numeric_limits<Integer>::max()) >> robot_bits;
    if (mark.counter > counters) return std::nullopt;
    return static_cast<Integer>(mark.counter << robot_bits | robot);
}

/// The mark that `pack` made this integer of; nullopt for a negative one.
template <std::integral Integer>
[[nodiscard]] constexpr std::optional<InnovationNumber> unpack(Integer id, unsigned robot_bits) {
    if (id < 0 || robot_bits >= std::numeric_limits<Integer>::digits || robot_bits > 32) {
        return std::nullopt;
    }
    const auto number = static_cast<std::uint64_t>(id);
    const std::uint64_t robot = number & ((std::uint64_t{1} << robot_bits) - 1);
    return InnovationNumber{number >> robot_bits, RobotId{static_cast<std::uint32_t>(robot)}};
}

}  // namespace gene_clocks
