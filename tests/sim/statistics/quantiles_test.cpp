#include "sim/statistics/quantiles.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

namespace gene_clocks::statistics {
namespace {

TEST(Quantiles, BoxOfASampleWithOutliers) {
    const BoxSummary box = summarize(std::vector<double>{9, 1, 2, 3, 4, 5, 6, 7, 8, 15, -30});
    EXPECT_EQ(box.count, 11U);
    EXPECT_EQ(box.minimum, -30);
    EXPECT_EQ(box.lower_quartile, 2.5);
    EXPECT_EQ(box.median, 5);
    EXPECT_EQ(box.upper_quartile, 7.5);
    EXPECT_EQ(box.maximum, 15);
    EXPECT_EQ(box.lower_whisker, 1);  // the fences are −5 and 15
    EXPECT_EQ(box.upper_whisker, 15);
}

TEST(Quantiles, AWhiskerNeverEndsInsideTheBox) {
    const BoxSummary box = summarize(std::vector<double>{-100, 10, 10.1, 10.2});
    EXPECT_EQ(box.lower_quartile, -17.5);
    EXPECT_EQ(box.lower_whisker, -17.5);
}

TEST(Quantiles, ASingleValueIsItsOwnBox) {
    const BoxSummary box = summarize(std::vector<double>{4.5});
    EXPECT_EQ(box.lower_whisker, 4.5);
    EXPECT_EQ(box.median, 4.5);
    EXPECT_EQ(box.upper_whisker, 4.5);
}

TEST(Quantiles, RefuseWhatHasNone) {
    EXPECT_THROW(median(std::vector<double>{}), std::invalid_argument);
    EXPECT_THROW(median(std::vector<double>{1, std::numeric_limits<double>::quiet_NaN()}),
                 std::invalid_argument);
    EXPECT_THROW(summarize(std::vector<double>{1, std::numeric_limits<double>::infinity()}),
                 std::invalid_argument);
    EXPECT_THROW(quantile(std::vector<double>{1, 2}, -0.1), std::invalid_argument);
    EXPECT_THROW(quantile(std::vector<double>{1, 2}, 1.1), std::invalid_argument);
}

}  // namespace
}  // namespace gene_clocks::statistics
