#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

/// Compiles a function for several x86-64 levels; the processor's best is picked at start-up.
/// The same operations run in the same order on every lane, and none is fused, so that all
/// versions give the same bits. Off under sanitizers, whose run-time is not ready when the choice
/// is made.
#if defined(__x86_64__) && defined(__linux__) && defined(__OPTIMIZE__) && \
    !defined(GENE_CLOCKS_SANITIZED)
#define GENE_CLOCKS_MULTIVERSION \
    __attribute__((target_clones("default", "avx2", "arch=skylake-avx512")))
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

inline constexpr int lane_count = 8;

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
    for (int lane = 0; lane < lane_count; ++lane) roots[lane] = std::sqrt(values[lane]);
    return roots;
}

GENE_CLOCKS_INLINE bool any(IntLanes mask) {
    using Words = std::int64_t __attribute__((vector_size(32)));
    const auto words = std::bit_cast<Words>(mask);
    return ((words[0] | words[1]) | (words[2] | words[3])) != 0;
}

GENE_CLOCKS_INLINE float smallest(FloatLanes values) {
    float least = values[0];
    for (int lane = 1; lane < lane_count; ++lane) {
        least = values[lane] < least ? values[lane] : least;
    }
    return least;
}

}  // namespace gene_clocks::sim
