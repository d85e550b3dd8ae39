#pragma once

#include <bit>
#include <cstdint>

namespace gene_clocks::neat {

/// exp(x) to a relative error below 1e-6 for |x| ≤ 87; arguments beyond are clamped.
///
/// Our own, from additions and multiplications alone, because libraries' results differ and a
/// trajectory must not. Free of branches, so that loops over it vectorize.
inline float exponential(float x) {
    x = x < -87.0f ? -87.0f : x;
    x = x > 87.0f ? 87.0f : x;
    // x = n·ln 2 + r with |r| ≤ ln 2 / 2. Adding and subtracting 1.5·2^23 rounds to an integer.
    constexpr float rounder = 0x1.8p23f;
    const float shifted = x * 1.44269504f + rounder;
    const float n = shifted - rounder;
    const float r = (x - n * 0.693359375f) - n * -2.12194440e-4f;
    float p = 1.9875691500e-4f;  // minimax polynomial for e^r (Cephes, Moshier)
    p = p * r + 1.3981999507e-3f;
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    p = p * (r * r) + (r + 1.0f);
    const auto exponent = std::bit_cast<std::int32_t>(shifted) << 23;
    return std::bit_cast<float>(std::bit_cast<std::int32_t>(p) + exponent);
}

/// 1 / (1 + exp(−slope·x)), to an absolute error below 1e-6.
inline float logistic(float x, float slope) {
    return 1.0f / (1.0f + exponential(-slope * x));
}

}  // namespace gene_clocks::neat
