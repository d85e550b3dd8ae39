#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/statistics/bootstrap.hpp"

namespace gene_clocks::statistics {

/// By how much the values of x lie above those of y.
struct Shift {
    double estimate{};  ///< Hodges and Lehmann's: the median of all differences x − y
    Interval interval;  ///< Moses's: the differences that a Mann–Whitney test does not refuse
};

/// Shift of location between two independent samples (Hodges and Lehmann 1963), with the interval
/// that R's `wilcox.test` gives: exact where the test is, else by the normal approximation.
/// Throws std::invalid_argument where a sample is empty or holds a value that is not finite, or
/// the confidence lies outside (0, 1).
Shift shift_of_location(std::span<const double> x, std::span<const double> y,
                        double confidence = 0.95);

/// Two one-sided Mann–Whitney tests (Schuirmann 1987): the p-value of "x lies at least `margin`
/// above or below y", the larger of the two. Where it is small, x and y are shown to be equal but
/// for less than the margin.
/// Throws as `mann_whitney` does, and std::invalid_argument unless the margin is positive.
double equivalence_p_value(std::span<const double> x, std::span<const double> y, double margin);

/// How often tests of two samples of these sizes would find what is there to be found.
struct Power {
    double equivalence{};  ///< that two samples of one distribution are found equivalent
    double difference{};   ///< that two samples `margin` apart are found different (two-sided)
};

struct PowerSettings {
    double level = 0.05;
    std::size_t resamples = 1'000;
    std::uint64_t seed = 2015;  ///< of the 64-bit Mersenne Twister
};

/// Power by resampling: both samples are drawn, with replacement, from x and y pooled about their
/// medians. Throws as `equivalence_p_value` does.
Power power(std::span<const double> x, std::span<const double> y, double margin,
            const PowerSettings& settings = {});

/// p-values corrected for their number (Holm 1979), in the same order: the chance that any of
/// those below a level is there by accident is below that level.
/// Throws std::invalid_argument where one lies outside [0, 1].
std::vector<double> holm(std::span<const double> p_values);

}  // namespace gene_clocks::statistics
