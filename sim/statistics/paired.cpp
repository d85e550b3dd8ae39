#include "sim/statistics/paired.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/statistics/finite_sample.hpp"
#include "sim/statistics/resampler.hpp"

namespace gene_clocks::statistics {
namespace {

using boost::math::cdf;
using boost::math::complement;
using boost::math::students_t;

struct Moments {
    double mean{};
    double standard_error{};  ///< of the mean
};

Moments moments(std::span<const double> sample) {
    const auto size = static_cast<double>(sample.size());
    // Equal values have just that mean and no deviation, whatever a sum of them rounds to.
    if (std::ranges::adjacent_find(sample, std::ranges::not_equal_to{}) == sample.end())
        return {sample.front(), 0.0};
    double sum = 0.0;
    for (const double value : sample) sum += value;
    const double mean = sum / size;
    double squares = 0.0;
    for (const double value : sample) squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / (size - 1.0) / size)};
}

/// The probability of a mean so far above `expected`, or further; 1 without scatter.
double tail_above(const Moments& sample, double expected, const students_t& distribution) {
    if (sample.standard_error == 0.0) return 1.0;
    return cdf(complement(distribution, (sample.mean - expected) / sample.standard_error));
}

double tail_below(const Moments& sample, double expected, const students_t& distribution) {
    return tail_above({-sample.mean, sample.standard_error}, -expected, distribution);
}

double two_sided(const Moments& sample, const students_t& distribution) {
    return std::min(1.0, 2.0 * std::min(tail_above(sample, 0.0, distribution),
                                        tail_below(sample, 0.0, distribution)));
}

double outside(const Moments& sample, double margin, const students_t& distribution) {
    return std::max(tail_above(sample, -margin, distribution),
                    tail_below(sample, margin, distribution));
}

void require_fit(std::span<const double> differences, double margin) {
    require_finite(differences);
    if (differences.size() < 2) throw std::invalid_argument("a paired test needs two pairs");
    if (!(margin > 0.0 && std::isfinite(margin)))
        throw std::invalid_argument("a margin is not positive");
}

students_t null_distribution(std::span<const double> differences) {
    return students_t(static_cast<double>(differences.size() - 1));
}

}  // namespace

PairedTest paired_test(std::span<const double> differences, double margin, double confidence) {
    require_fit(differences, margin);
    if (!(confidence > 0.0 && confidence < 1.0))
        throw std::invalid_argument("a confidence lies outside (0, 1)");
    const students_t distribution = null_distribution(differences);
    const Moments sample = moments(differences);
    const double reach =
        sample.standard_error * quantile(complement(distribution, 0.5 * (1.0 - confidence)));
    return {differences.size(),
            sample.mean,
            {sample.mean - reach, sample.mean + reach},
            two_sided(sample, distribution),
            outside(sample, margin, distribution)};
}

Power paired_power(std::span<const double> differences, double margin,
                   const PowerSettings& settings) {
    require_fit(differences, margin);
    if (settings.resamples == 0) throw std::invalid_argument("a power needs resamples");
    const students_t distribution = null_distribution(differences);
    std::vector<double> centred(differences.begin(), differences.end());
    const double mean = moments(differences).mean;
    for (double& value : centred) value -= mean;
    Resampler resampler(centred, centred.size());
    std::mt19937_64 random(settings.seed);
    std::size_t equivalent = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < settings.resamples; ++i) {
        Moments drawn = moments(resampler.draw(random));
        if (outside(drawn, margin, distribution) < settings.level) ++equivalent;
        drawn.mean += margin;
        if (two_sided(drawn, distribution) < settings.level) ++different;
    }
    const auto resamples = static_cast<double>(settings.resamples);
    return {static_cast<double>(equivalent) / resamples,
            static_cast<double>(different) / resamples};
}

}  // namespace gene_clocks::statistics
