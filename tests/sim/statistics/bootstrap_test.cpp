#include "sim/statistics/bootstrap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cstdint>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "sim/statistics/mann_whitney.hpp"
#include "sim/statistics/quantiles.hpp"

namespace gene_clocks::statistics {
namespace {

double mean(std::span<const double> sample) {
    return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
}

/// The bootstrap distribution of the median of n distinct values, n odd, is known: the median of a
/// resample is at most the k-th value where more than half of n draws are, each with chance k/n.
double exact_quantile_of_median(const std::vector<double>& sorted, double probability) {
    const auto n = static_cast<double>(sorted.size());
    for (std::size_t k = 1; k < sorted.size(); ++k) {
        const boost::math::binomial draws(n, static_cast<double>(k) / n);
        const double at_most = boost::math::cdf(complement(draws, (n - 1.0) / 2.0));
        if (at_most >= probability) return sorted[k - 1];
    }
    return sorted.back();
}

TEST(Bootstrap, IntervalOfAMedianEqualsItsKnownDistribution) {
    const std::vector<double> sorted{-3, -1, 0.5, 1, 2, 2.5, 4, 7, 11, 12, 20, 31, 32, 40, 55};
    for (const double confidence : {0.5, 0.9, 0.95, 0.99}) {
        const Interval interval = bootstrap_interval(
            sorted, median, {.resamples = 100'000, .confidence = confidence, .seed = 7});
        EXPECT_EQ(interval.lower, exact_quantile_of_median(sorted, (1 - confidence) / 2));
        EXPECT_EQ(interval.upper, exact_quantile_of_median(sorted, (1 + confidence) / 2));
    }
}

TEST(Bootstrap, TheSeedDecidesAlone) {
    const std::vector<double> sample{1, 4, 9, 16, 25, 36};
    const Interval first = bootstrap_interval(sample, mean, {.resamples = 500, .seed = 1});
    const Interval again = bootstrap_interval(sample, mean, {.resamples = 500, .seed = 1});
    const Interval other = bootstrap_interval(sample, mean, {.resamples = 500, .seed = 2});
    EXPECT_EQ(first.lower, again.lower);
    EXPECT_EQ(first.upper, again.upper);
    EXPECT_NE(first.lower, other.lower);
}

TEST(Bootstrap, ResamplesAreTheSameOnEveryMachine) {
    // The C++ standard fixes the generator's outputs; an output picks the value in whose bucket it
    // falls, the range of the generator being cut into as many buckets of equal width.
    const std::vector<double> sample{1, 4, 9, 16, 25, 36};
    std::mt19937_64 random(42);
    constexpr std::uint64_t bucket_width = std::mt19937_64::max() / 6;
    const Interval interval = bootstrap_interval(sample,
                                                 [&](std::span<const double> drawn) {
                                                     for (const double value : drawn) {
                                                         std::uint64_t bucket =
                                                             random() / bucket_width;
                                                         while (bucket > 5)
                                                             bucket = random() / bucket_width;
                                                         EXPECT_EQ(value, sample[bucket]);
                                                     }
                                                     return mean(drawn);
                                                 },
                                                 {.resamples = 200, .seed = 42});
    EXPECT_LT(interval.lower, interval.upper);
}

TEST(Bootstrap, TwoSamplesAreDrawnEachByItself) {
    const std::vector<double> low{1, 2, 3};
    const std::vector<double> high{10, 20, 30, 40, 50, 60, 70};
    const auto difference = [](std::span<const double> x, std::span<const double> y) {
        EXPECT_EQ(x.size(), 3U);
        EXPECT_EQ(y.size(), 7U);
        EXPECT_LE(*std::max_element(x.begin(), x.end()), 3.0);
        EXPECT_GE(*std::min_element(y.begin(), y.end()), 10.0);
        return mean(y) - mean(x);
    };
    const Interval interval = bootstrap_interval(low, high, difference, {.resamples = 2000});
    EXPECT_LT(interval.lower, 38.0);
    EXPECT_GT(interval.upper, 38.0);
    const Interval effect = bootstrap_interval(low, high, vargha_delaney_a, {.resamples = 100});
    EXPECT_EQ(effect.lower, 0.0);
    EXPECT_EQ(effect.upper, 0.0);
}

TEST(Bootstrap, RefusesSettingsWithoutMeaning) {
    const std::vector<double> sample{1, 2};
    EXPECT_THROW(bootstrap_interval({}, mean), std::invalid_argument);
    EXPECT_THROW(bootstrap_interval(sample, mean, {.resamples = 0}), std::invalid_argument);
    for (const double confidence : {0.0, 1.0, -1.0})
        EXPECT_THROW(bootstrap_interval(sample, mean, {.confidence = confidence}),
                     std::invalid_argument);
}

}  // namespace
}  // namespace gene_clocks::statistics
