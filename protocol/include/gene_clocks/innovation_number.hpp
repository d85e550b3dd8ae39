#pragma once

#include <gene_clocks/kernel.h>

#include <compare>
#include <concepts>
#include <cstdint>

namespace gene_clocks {

/// Identity of a robot (or process), unique in the fleet. Zero is reserved for genesis marks.
enum class RobotId : std::uint32_t {};

/// The reserved id under which all robots share the marks of their initial genes.
inline constexpr RobotId genesis_robot{0};

/// The next unused counter of the robot that sent it; every message carries one.
///
/// A type of its own, because the protocol is only right when the *next unused* counter is sent:
/// the receiver takes the maximum without adding one (paper, section 3.1).
template <std::unsigned_integral Counter>
struct BasicStamp {
    Counter value{};
    friend constexpr auto operator<=>(BasicStamp, BasicStamp) = default;
};
using Stamp = BasicStamp<std::uint64_t>;

/// The mark of a gene: the paper's ⟨r, c_r⟩, ordered by counter first and then by robot.
///
/// The order is a strict total order, the same on every robot, and extends happened-before:
/// a gene created by a robot that already knew another gene sorts after it.
template <std::unsigned_integral Counter>
struct BasicInnovationNumber {
    Counter counter{};
    RobotId robot{};

    friend constexpr bool operator==(BasicInnovationNumber, BasicInnovationNumber) = default;

    friend constexpr bool operator<(BasicInnovationNumber a, BasicInnovationNumber b) {
        return kernel::gene_clocks_less(a.kernel_mark(), b.kernel_mark());
    }
    friend constexpr std::strong_ordering operator<=>(BasicInnovationNumber a,
                                                      BasicInnovationNumber b) {
        if (a < b) return std::strong_ordering::less;
        if (b < a) return std::strong_ordering::greater;
        return std::strong_ordering::equal;
    }

    /// The same mark as the kernel and C firmware have it.
    [[nodiscard]] constexpr kernel::gene_clocks_mark<Counter> kernel_mark() const {
        return {counter, static_cast<std::uint32_t>(robot)};
    }
};
using InnovationNumber = BasicInnovationNumber<std::uint64_t>;

}  // namespace gene_clocks
