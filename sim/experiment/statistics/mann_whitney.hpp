#pragma once

#include <cstdint>
#include <span>

namespace gene_clocks::statistics {

enum class NullDistribution : std::uint8_t {
    exact,   ///< every arrangement of the ranks counted
    normal,  ///< normal approximation, corrected for ties and continuity
};

struct MannWhitney {
    double u{};        ///< pairs (x, y) with x > y, those with x = y counted half
    double p_value{};  ///< two-sided
    NullDistribution distribution{};
};

/// Two-sided Mann–Whitney test of two independent samples, as R's `wilcox.test` does it: exact
/// where both samples hold fewer than 50 values and none occurs twice, else approximate.
/// Where all values are the same the p-value is 1 (R has none).
/// Throws std::invalid_argument where a sample is empty or holds a value that is not finite.
MannWhitney mann_whitney(std::span<const double> x, std::span<const double> y);

/// Vargha and Delaney's A: the probability that a value of x exceeds one of y, ties counted half
/// (Vargha and Delaney 2000). 0.5 means no difference. Throws as `mann_whitney` does.
double vargha_delaney_a(std::span<const double> x, std::span<const double> y);

}  // namespace gene_clocks::statistics
