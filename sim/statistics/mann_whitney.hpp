#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gene_clocks::statistics {

enum class NullDistribution : std::uint8_t {
    exact,   ///< every arrangement of the ranks counted
    normal,  ///< normal approximation, corrected for ties and continuity
};

/// What x is suspected of, against y.
enum class Alternative : std::uint8_t { two_sided, less, greater };

struct MannWhitney {
    double u{};  ///< pairs (x, y) with x > y, those with x = y counted half
    double p_value{};
    NullDistribution distribution{};
};

/// Mann–Whitney test of two independent samples, as R's `wilcox.test` does it: exact where both
/// samples hold fewer than 50 values and none occurs twice, else approximate.
/// Where all values are the same the p-value is 1 (R has none).
/// Throws std::invalid_argument where a sample is empty or holds a value that is not finite.
MannWhitney mann_whitney(std::span<const double> x, std::span<const double> y,
                         Alternative alternative = Alternative::two_sided);

/// The smallest u with P(U ≤ u) ≥ `probability` for samples of n and m values (R's `qwilcox`):
/// exact where both are smaller than 50, else by the normal approximation, rounded up.
/// Throws std::invalid_argument where n or m is 0, or `probability` lies outside (0, 1).
std::size_t tail_statistic(std::size_t n, std::size_t m, double probability);

/// Vargha and Delaney's A: the probability that a value of x exceeds one of y, ties counted half
/// (Vargha and Delaney 2000). 0.5 means no difference. Throws as `mann_whitney` does.
double vargha_delaney_a(std::span<const double> x, std::span<const double> y);

}  // namespace gene_clocks::statistics
