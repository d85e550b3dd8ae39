#include "sim/statistics/paired.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace gene_clocks::statistics {
namespace {

const std::vector<double> around_zero{-3.0, -1.5, -1.0, 0.0, 0.0, 0.5, 1.0, 1.5, 2.5};

// R's t.test refuses them: "data are essentially constant".
TEST(Paired, WithoutScatterNothingIsShown) {
    for (const double difference : {0.0, 0.1, -5.0}) {  // seven times 0.1 is not 0.7
        const PairedTest found = paired_test(std::vector<double>(7, difference), 1.0);
        EXPECT_EQ(found.mean, difference);
        EXPECT_EQ(found.interval.lower, difference);
        EXPECT_EQ(found.interval.upper, difference);
        EXPECT_EQ(found.difference_p_value, 1.0);
        EXPECT_EQ(found.equivalence_p_value, 1.0);
    }
    EXPECT_EQ(paired_power(std::vector<double>(7, 0.0), 1.0).equivalence, 0.0);
    EXPECT_EQ(paired_power(std::vector<double>(7, 0.0), 1.0).difference, 0.0);
    // Of two pairs, half of all draws have no scatter, and the others are as far from sure.
    EXPECT_LT(paired_power(std::vector<double>{-4.5, 4.5}, 5.0).equivalence, 0.1);
}

TEST(Paired, EquivalenceIsAskedForOnBothSides) {
    for (const double beyond : {1.25, -1.25}) {
        std::vector<double> moved = around_zero;
        for (double& value : moved) value = 0.01 * value + beyond;
        EXPECT_GT(paired_test(moved, 1.0).equivalence_p_value, 0.99);
        EXPECT_LT(paired_test(moved, 1.5).equivalence_p_value, 0.01);
    }
}

TEST(Paired, IsSymmetric) {
    std::vector<double> negative = around_zero;
    for (double& value : negative) value = 0.25 - value;
    std::vector<double> positive = around_zero;
    for (double& value : positive) value -= 0.25;
    const PairedTest one = paired_test(positive, 0.75);
    const PairedTest other = paired_test(negative, 0.75);
    EXPECT_DOUBLE_EQ(one.mean, -other.mean);
    EXPECT_DOUBLE_EQ(one.interval.lower, -other.interval.upper);
    EXPECT_DOUBLE_EQ(one.difference_p_value, other.difference_p_value);
    EXPECT_DOUBLE_EQ(one.equivalence_p_value, other.equivalence_p_value);
}

// Two tests of 5 % each and the interval of 90 % are the same statement.
TEST(Paired, EquivalenceAgreesWithTheInterval) {
    const Interval interval = paired_test(around_zero, 1.0, 0.9).interval;
    const double reach = std::max(-interval.lower, interval.upper);
    EXPECT_LT(paired_test(around_zero, reach * 1.001).equivalence_p_value, 0.05);
    EXPECT_GT(paired_test(around_zero, reach * 0.999).equivalence_p_value, 0.05);
}

TEST(Paired, RefusesWhatHasNoAnswer) {
    const std::vector<double> nan{0.0, std::numeric_limits<double>::quiet_NaN()};
    EXPECT_THROW((void)paired_test(std::vector<double>{1.0}, 1.0), std::invalid_argument);
    EXPECT_THROW((void)paired_test({}, 1.0), std::invalid_argument);
    EXPECT_THROW((void)paired_test(nan, 1.0), std::invalid_argument);
    EXPECT_THROW((void)paired_test(around_zero, 0.0), std::invalid_argument);
    EXPECT_THROW((void)paired_test(around_zero, 1.0, 1.0), std::invalid_argument);
    EXPECT_THROW((void)paired_power(around_zero, 1.0, {.resamples = 0}), std::invalid_argument);
    EXPECT_THROW((void)paired_power(std::vector<double>{1.0}, 1.0), std::invalid_argument);
}

/// 256 values of deviation 1.
std::vector<double> scattered(double mean) {
    std::vector<double> values;
    for (int i = 0; i < 128; ++i) {
        const double quantile = std::sqrt(3.0) * (2.0 * (i + 0.5) / 128.0 - 1.0);  // uniform
        values.push_back(mean + quantile);
        values.push_back(mean - quantile);
    }
    return values;
}

// Against theory, with a standard error of 1/16: a two-sided test of 5 % sees a mean of 0.175 with
// Φ(0.175·16 − 1.96) = 0.80; two one-sided ones show a mean of 0 to be nearer than that with
// 2 Φ(0.175·16 − 1.645) − 1 = 0.75.
TEST(Paired, PowerIsThatOfTheory) {
    for (const double mean : {0.0, 5.0}) {  // where they lie does not matter
        const Power shown = paired_power(scattered(mean), 0.175);
        EXPECT_NEAR(shown.difference, 0.80, 0.04);
        EXPECT_NEAR(shown.equivalence, 0.75, 0.04);
    }
}

}  // namespace
}  // namespace gene_clocks::statistics
