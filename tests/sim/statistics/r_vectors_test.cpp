// The test vectors come from R: make_vectors.R beside this file writes them.
#include "tests/sim/statistics/r_vectors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/statistics/equivalence.hpp"
#include "sim/statistics/mann_whitney.hpp"
#include "sim/statistics/paired.hpp"
#include "sim/statistics/quantiles.hpp"

namespace gene_clocks::statistics {
namespace {

TEST(RVectors, MannWhitneyEqualsWilcoxTest) {
    const auto rows = read_rows("mann_whitney.csv", 7);
    ASSERT_GE(rows.size(), 21U);
    for (const auto& row : rows) {
        const MannWhitney test = mann_whitney(numbers(row[1]), numbers(row[2]));
        EXPECT_EQ(test.u, std::stod(row[3])) << row[0];
        expect_close(test.p_value, std::stod(row[4]), row[0]);
        EXPECT_EQ(test.distribution == NullDistribution::exact, row[6] == "1") << row[0];
    }
}

TEST(RVectors, EffectSizeEqualsTheShareOfPairs) {
    const auto rows = read_rows("mann_whitney.csv", 7);
    ASSERT_FALSE(rows.empty());
    for (const auto& row : rows)
        expect_close(vargha_delaney_a(numbers(row[1]), numbers(row[2])), std::stod(row[5]), row[0]);
}

TEST(RVectors, QuantilesEqualType7) {
    const auto rows = read_rows("quantiles.csv", 4);
    ASSERT_GE(rows.size(), 70U);
    for (const auto& row : rows)
        expect_close(quantile(numbers(row[1]), std::stod(row[2])), std::stod(row[3]), row[0]);
}

TEST(RVectors, OneSidedTestsEqualWilcoxTest) {
    const auto rows = read_rows("equivalence.csv", 10);
    ASSERT_GE(rows.size(), 21U);
    for (const auto& row : rows) {
        const double margin = std::stod(row[3]);
        std::vector<double> up = numbers(row[1]);
        std::vector<double> down = up;
        for (double& value : up) value += margin;
        for (double& value : down) value -= margin;
        const std::vector<double> y = numbers(row[2]);
        const double greater = mann_whitney(up, y, Alternative::greater).p_value;
        const double less = mann_whitney(down, y, Alternative::less).p_value;
        expect_close(greater, std::stod(row[4]), row[0] + ", greater");
        expect_close(less, std::stod(row[5]), row[0] + ", less");
        EXPECT_EQ(equivalence_p_value(numbers(row[1]), y, margin), std::max(greater, less))
            << row[0];
    }
}

TEST(RVectors, ShiftsEqualWilcoxTest) {
    for (const auto& row : read_rows("equivalence.csv", 10)) {
        const Shift shift = shift_of_location(numbers(row[1]), numbers(row[2]), 0.9);
        expect_close(shift.estimate, std::stod(row[6]), row[0]);
        const double lower = std::stod(row[7]);
        const double upper = std::stod(row[8]);
        if (row[9] == "1") {
            expect_close(shift.interval.lower, lower, row[0]);
            expect_close(shift.interval.upper, upper, row[0]);
        } else {
            // R seeks the ends by iteration, and corrects the variance for ties at each step.
            const double tolerance = 0.02 * (upper - lower) + 1e-3;
            EXPECT_NEAR(shift.interval.lower, lower, tolerance) << row[0];
            EXPECT_NEAR(shift.interval.upper, upper, tolerance) << row[0];
        }
    }
}

TEST(RVectors, PairedTestsEqualTTest) {
    const auto rows = read_rows("paired.csv", 9);
    ASSERT_GE(rows.size(), 8U);
    for (const auto& row : rows) {
        const PairedTest test = paired_test(numbers(row[1]), std::stod(row[2]), 0.9);
        // R sums in higher precision, and 1e-12 of a mean near 0 is less than that shows.
        const double tolerance = 1e-12 * (std::stod(row[5]) - std::stod(row[4]));
        EXPECT_NEAR(test.mean, std::stod(row[3]), tolerance) << row[0];
        EXPECT_NEAR(test.interval.lower, std::stod(row[4]), tolerance) << row[0];
        EXPECT_NEAR(test.interval.upper, std::stod(row[5]), tolerance) << row[0];
        const auto expect_p_value = [&](double value, double expected) {
            EXPECT_NEAR(value, expected, 1e-10 * expected) << row[0];
        };
        expect_p_value(test.difference_p_value, std::stod(row[6]));
        expect_p_value(test.equivalence_p_value, std::max(std::stod(row[7]), std::stod(row[8])));
    }
}

TEST(RVectors, HolmEqualsPAdjust) {
    const auto rows = read_rows("holm.csv", 3);
    ASSERT_GE(rows.size(), 7U);
    for (const auto& row : rows) {
        const std::vector<double> corrected = holm(numbers(row[1]));
        const std::vector<double> expected = numbers(row[2]);
        ASSERT_EQ(corrected.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            expect_close(corrected[i], expected[i], row[0]);
    }
}

}  // namespace
}  // namespace gene_clocks::statistics
