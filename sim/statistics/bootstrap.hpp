#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace gene_clocks::statistics {

struct Interval {
    double lower{};
    double upper{};
};

/// The resamples depend on nothing but these: the same on every machine and compiler.
struct BootstrapSettings {
    std::size_t resamples = 10'000;
    double confidence = 0.95;
    std::uint64_t seed = 2015;  ///< of the 64-bit Mersenne Twister
};

using Statistic = std::function<double(std::span<const double>)>;
using TwoSampleStatistic = std::function<double(std::span<const double>, std::span<const double>)>;

/// Percentile interval (Efron 1979) of a statistic of one sample.
/// Throws std::invalid_argument where a sample is empty or holds a value that is not finite, or
/// the settings ask for no resamples or a confidence outside (0, 1).
Interval bootstrap_interval(std::span<const double> sample, const Statistic& statistic,
                            const BootstrapSettings& settings = {});

/// The same for a statistic of two independent samples, each resampled by itself.
Interval bootstrap_interval(std::span<const double> x, std::span<const double> y,
                            const TwoSampleStatistic& statistic,
                            const BootstrapSettings& settings = {});

}  // namespace gene_clocks::statistics
