#pragma once

#include <array>
#include <cstdint>

namespace gene_clocks::neat {

/// A portable stream of random numbers: xoshiro256++ (Blackman & Vigna 2019), seeded by
/// SplitMix64. Streams of one seed are independent of each other, so that a robot's draws do not
/// depend on how many the others made.
///
/// Distributions of our own, because those of the standard library differ between libraries.
class RandomStream {
public:
    RandomStream(std::uint64_t seed, std::uint64_t stream);

    /// 64 uniform bits.
    std::uint64_t bits() {
        const std::uint64_t result = rotate_left(state_[0] + state_[3], 23) + state_[0];
        const std::uint64_t shifted = state_[1] << 17;
        state_[2] ^= state_[0];
        state_[3] ^= state_[1];
        state_[1] ^= state_[2];
        state_[0] ^= state_[3];
        state_[2] ^= shifted;
        state_[3] = rotate_left(state_[3], 45);
        return result;
    }

    /// Uniform in [0, 1), with 53 bits.
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// True with the given probability.
    bool chance(double probability) { return uniform() < probability; }

    /// Uniform in [0, bound); precondition: bound > 0. The bias is below 2^-32 (multiply-shift).
    std::uint32_t below(std::uint32_t bound) {
        return static_cast<std::uint32_t>(((bits() >> 32) * bound) >> 32);
    }

    /// Standard normal (Marsaglia's polar method).
    double normal();

private:
    static constexpr std::uint64_t rotate_left(std::uint64_t value, int by) {
        return (value << by) | (value >> (64 - by));
    }

    std::array<std::uint64_t, 4> state_;
};

}  // namespace gene_clocks::neat
