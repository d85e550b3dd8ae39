#pragma once

#include <cstddef>
#include <span>

namespace gene_clocks::statistics {

/// The sample quantile of Hyndman and Fan's type 7 (R's and NumPy's default): linear
/// interpolation between order statistics, the k-th of n at probability (k − 1)/(n − 1).
/// Throws std::invalid_argument where the sample is empty or holds a value that is not finite, or
/// `probability` lies outside [0, 1].
double quantile(std::span<const double> sample, double probability);

double median(std::span<const double> sample);

/// What a box plot shows. Quartiles are of type 7.
struct BoxSummary {
    std::size_t count{};
    double minimum{};
    double lower_whisker{};  ///< smallest value within 1.5 interquartile ranges of the box
    double lower_quartile{};
    double median{};
    double upper_quartile{};
    double upper_whisker{};  ///< largest value within 1.5 interquartile ranges of the box
    double maximum{};
};

/// Throws as `quantile` does.
BoxSummary summarize(std::span<const double> sample);

}  // namespace gene_clocks::statistics
