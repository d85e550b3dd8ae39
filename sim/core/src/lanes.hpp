#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// Compiles a function for several x86-64 levels; the processor's best is picked at start-up.
/// The same operations run in the same order on every lane, and none is fused, so that all
/// versions give the same bits. Off under sanitizers, whose run-time is not ready when the choice
/// is made.
#if defined(GENE_CLOCKS_MULTIVERSION)
// Set from outside: the tests compare with a build that has one version only.
#elif defined(__x86_64__) && defined(__linux__) && defined(__OPTIMIZE__) && \
    !defined(GENE_CLOCKS_SANITIZED)
#define GENE_CLOCKS_MULTIVERSION __attribute__((target_clones("default", "avx2", "arch=x86-64-v4")))
#else
#define GENE_CLOCKS_MULTIVERSION
#endif

/// For every function with lanes in its signature: versions of a function for different processors
/// pass them differently, so that none may be called by another version.
#define GENE_CLOCKS_INLINE inline __attribute__((always_inline))

namespace gene_clocks::sim {

/// Eight numbers at once, one for each proximity ray. Arithmetic and comparison are the
/// compiler's own, lane by lane, on registers of whatever width the processor has.
using FloatLanes = float __attribute__((vector_size(32)));
using IntLanes = std::int32_t __attribute__((vector_size(32)));  ///< a mask lane is 0 or −1

inline constexpr std::size_t lane_count = 8;

GENE_CLOCKS_INLINE FloatLanes lanes(float value) {
    return FloatLanes{} + value;
}

/// Where one side is not a number, these return `b`.
GENE_CLOCKS_INLINE FloatLanes lanes_min(FloatLanes a, FloatLanes b) {
    return a < b ? a : b;
}
GENE_CLOCKS_INLINE FloatLanes lanes_max(FloatLanes a, FloatLanes b) {
    return a > b ? a : b;
}

GENE_CLOCKS_INLINE FloatLanes lanes_sqrt(FloatLanes values) {
    FloatLanes roots;
    for (std::size_t lane = 0; lane < lane_count; ++lane) roots[lane] = std::sqrt(values[lane]);
    return roots;
}

template <class Lanes, class Value>
GENE_CLOCKS_INLINE void store(Lanes values, std::array<Value, lane_count>& to) {
    static_assert(sizeof values == sizeof to);
    std::memcpy(to.data(), &values, sizeof values);
}

GENE_CLOCKS_INLINE bool any(IntLanes mask) {
    using Words = std::int64_t __attribute__((vector_size(32)));
    const auto words = std::bit_cast<Words>(mask);
    return ((words[0] | words[1]) | (words[2] | words[3])) != 0;
}

GENE_CLOCKS_INLINE float smallest(FloatLanes values) {
    values = lanes_min(values, __builtin_shufflevector(values, values, 4, 5, 6, 7, 0, 1, 2, 3));
    values = lanes_min(values, __builtin_shufflevector(values, values, 2, 3, 0, 1, 6, 7, 4, 5));
    values = lanes_min(values, __builtin_shufflevector(values, values, 1, 0, 3, 2, 5, 4, 7, 6));
    return values[0];
}

}  // namespace gene_clocks::sim
