#pragma once

#include <bit>
#include <cstdint>

namespace gene_clocks::neat {

/// Four numbers at once; arithmetic and comparison are the compiler's own, lane by lane.
using FourFloats = float __attribute__((vector_size(16)));

namespace detail {

template <class Real, class Integer>
Real exponential(Real x) {
    x = x < -87.0f ? Real{} - 87.0f : x;
    x = x > 87.0f ? Real{} + 87.0f : x;
    // x = n·ln 2 + r with |r| ≤ ln 2 / 2. Adding and subtracting 1.5·2^23 rounds to an integer.
    constexpr float rounder = 0x1.8p23f;
    const Real shifted = x * 1.44269504f + rounder;
    const Real n = shifted - rounder;
    const Real r = (x - n * 0.693359375f) - n * -2.12194440e-4f;
    Real p = r * 1.9875691500e-4f + 1.3981999507e-3f;  // minimax for e^r (Cephes, Moshier)
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    p = p * (r * r) + (r + 1.0f);
    const auto exponent = std::bit_cast<Integer>(shifted) << 23;
    return std::bit_cast<Real>(std::bit_cast<Integer>(p) + exponent);
}

}  // namespace detail

/// exp(x) to a relative error below 1e-6 for |x| ≤ 87; arguments beyond are clamped.
///
/// Our own, from additions and multiplications alone, because libraries' results differ and a
/// trajectory must not.
inline float exponential(float x) {
    return detail::exponential<float, std::int32_t>(x);
}
inline FourFloats exponential(FourFloats x) {
    using FourIntegers = std::int32_t __attribute__((vector_size(16)));
    return detail::exponential<FourFloats, FourIntegers>(x);
}

/// 1 / (1 + exp(−slope·x)), to an absolute error below 1e-6; for one number or four.
template <class Real>
Real logistic(Real x, float slope) {
    return 1.0f / (1.0f + exponential(-slope * x));
}

}  // namespace gene_clocks::neat
