#include "sim/statistics/equivalence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "sim/statistics/mann_whitney.hpp"

namespace gene_clocks::statistics {
namespace {

/// Sums of uniform draws: near enough to normal, and the same everywhere.
std::vector<double> sample(std::size_t size, double mean, double deviation, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<double> values(size);
    for (double& value : values) {
        double sum = -6.0;
        for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() >> 11) * 0x1p-53;
        value = mean + deviation * sum;
    }
    return values;
}

TEST(Equivalence, OfSamplesOfOneDistributionIsShownWhereTheMarginIsWide) {
    const auto x = sample(128, 160.0, 19.0, 1);
    const auto y = sample(128, 160.0, 19.0, 2);
    EXPECT_LT(equivalence_p_value(x, y, 19.0), 1e-6);
    EXPECT_GT(equivalence_p_value(x, y, 0.5), 0.05);
}

TEST(Equivalence, IsRefusedWhereEitherSideIsAMarginAway) {
    const auto x = sample(128, 160.0, 19.0, 1);
    EXPECT_GT(equivalence_p_value(x, sample(128, 180.0, 19.0, 2), 8.0), 0.99);
    EXPECT_GT(equivalence_p_value(x, sample(128, 140.0, 19.0, 2), 8.0), 0.99);
}

TEST(Equivalence, IsSymmetric) {
    const auto x = sample(40, 160.0, 19.0, 1);
    const auto y = sample(33, 163.0, 19.0, 2);
    EXPECT_NEAR(equivalence_p_value(x, y, 8.0), equivalence_p_value(y, x, 8.0), 1e-12);
}

// Two tests of 5 % each and the interval of 90 % are the same statement.
TEST(Equivalence, AgreesWithTheIntervalOfTheShift) {
    std::size_t inside = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const auto x = sample(30, 160.0, 19.0, 2 * seed);
        const auto y = sample(30, 160.0, 19.0, 2 * seed + 1);
        const Interval interval = shift_of_location(x, y, 0.9).interval;
        const bool is_inside = interval.lower > -10.0 && interval.upper < 10.0;
        inside += is_inside ? 1 : 0;
        EXPECT_EQ(equivalence_p_value(x, y, 10.0) <= 0.05, is_inside) << "seed " << seed;
    }
    EXPECT_GT(inside, 15U);
    EXPECT_LT(inside, 45U);
}

TEST(Equivalence, RefusesWhatHasNoAnswer) {
    const std::vector<double> x{1.0, 2.0};
    const std::vector<double> none;
    EXPECT_THROW((void)equivalence_p_value(x, x, 0.0), std::invalid_argument);
    EXPECT_THROW((void)equivalence_p_value(x, x, std::numeric_limits<double>::quiet_NaN()),
                 std::invalid_argument);
    EXPECT_THROW((void)equivalence_p_value(none, x, 1.0), std::invalid_argument);
    EXPECT_THROW((void)shift_of_location(x, none), std::invalid_argument);
    EXPECT_THROW((void)shift_of_location(x, x, 1.0), std::invalid_argument);
    EXPECT_THROW((void)holm(std::vector<double>{0.5, 1.5}), std::invalid_argument);
    EXPECT_THROW((void)power(x, x, 1.0, {.resamples = 0}), std::invalid_argument);
}

TEST(Shift, OfAMovedSampleIsTheMove) {
    const auto x = sample(25, 10.0, 3.0, 7);
    auto y = x;
    for (double& value : y) value -= 2.5;
    const Shift shift = shift_of_location(x, y);
    EXPECT_NEAR(shift.estimate, 2.5, 1e-9);
    EXPECT_LT(shift.interval.lower, 2.5);
    EXPECT_GT(shift.interval.upper, 2.5);
}

TEST(Shift, OfTheSmallestSamplesIsAllDifferences) {
    const std::vector<double> x{5.0};
    const std::vector<double> y{1.0, 2.0};
    const Shift shift = shift_of_location(x, y);
    EXPECT_EQ(shift.estimate, 3.5);
    EXPECT_EQ(shift.interval.lower, 3.0);
    EXPECT_EQ(shift.interval.upper, 4.0);
}

// Against theory: a two-sided test of level 5 % sees samples of standard deviation 1, 100 each, a
// shift of 0.4 apart with a power of 0.80 (normal), at the efficiency 3/π of ranks about 0.78.
TEST(Power, IsThatOfTheory) {
    const auto x = sample(100, 0.0, 1.0, 3);
    const auto y = sample(100, 5.0, 1.0, 4);  // where they lie does not matter
    const Power shown = power(x, y, 0.4);
    EXPECT_NEAR(shown.difference, 0.78, 0.06);
    // Two one-sided tests: 2 Φ(0.4/√(2/100)·√(3/π) − 1.645) − 1 = 0.74.
    EXPECT_NEAR(shown.equivalence, 0.74, 0.08);
}

TEST(Power, GrowsWithTheMargin) {
    const auto x = sample(64, 0.0, 1.0, 3);
    const auto y = sample(64, 0.0, 1.0, 4);
    const Power narrow = power(x, y, 0.2);
    const Power wide = power(x, y, 1.0);
    EXPECT_LT(narrow.equivalence, 0.1);
    EXPECT_GT(wide.equivalence, 0.99);
    EXPECT_LT(narrow.difference, 0.35);
    EXPECT_GT(wide.difference, 0.99);
}

}  // namespace
}  // namespace gene_clocks::statistics
