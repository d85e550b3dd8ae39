#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include "sim/statistics/mann_whitney.hpp"

namespace gene_clocks::statistics {
namespace {

/// Uniform from the first case on, where RapidCheck's ranges grow with the number of cases.
std::size_t size_below(std::size_t end) {
    return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::size_t>(1, end));
}

/// Few levels, so that ties are common.
std::vector<double> small_sample() {
    const std::size_t size = size_below(12);
    const auto levels = *rc::gen::container<std::vector<int>>(size, rc::gen::inRange(-4, 5));
    return {levels.begin(), levels.end()};
}

double u_by_counting(const std::vector<double>& x, const std::vector<double>& y) {
    double u = 0.0;
    for (const double value : x)
        for (const double other : y) u += value > other ? 1.0 : value == other ? 0.5 : 0.0;
    return u;
}

/// The p-value by its definition: every way to deal the pooled values into two samples.
double p_by_enumeration(const std::vector<double>& x, const std::vector<double>& y) {
    std::vector<double> pooled(x);
    pooled.insert(pooled.end(), y.begin(), y.end());
    const double centre = static_cast<double>(x.size() * y.size()) / 2.0;
    const double seen = std::fabs(u_by_counting(x, y) - centre);
    std::vector<int> in_x(pooled.size(), 0);
    std::fill(in_x.end() - static_cast<std::ptrdiff_t>(x.size()), in_x.end(), 1);
    int all = 0;
    int as_extreme = 0;
    do {
        std::vector<double> dealt_x;
        std::vector<double> dealt_y;
        for (std::size_t i = 0; i < pooled.size(); ++i)
            (in_x[i] != 0 ? dealt_x : dealt_y).push_back(pooled[i]);
        ++all;
        if (std::fabs(u_by_counting(dealt_x, dealt_y) - centre) >= seen) ++as_extreme;
    } while (std::next_permutation(in_x.begin(), in_x.end()));
    return static_cast<double>(as_extreme) / all;
}

TEST(MannWhitneyProperty, ExactEqualsEnumeration) {
    EXPECT_TRUE(rc::check([] {
        const std::size_t n = size_below(7);
        const std::size_t m = size_below(7);
        const auto distinct =
            *rc::gen::unique<std::vector<int>>(n + m, rc::gen::inRange(-1000, 1000));
        const std::vector<double> x(distinct.begin(),
                                    distinct.begin() + static_cast<std::ptrdiff_t>(n));
        const std::vector<double> y(distinct.begin() + static_cast<std::ptrdiff_t>(n),
                                    distinct.end());
        const MannWhitney test = mann_whitney(x, y);
        RC_ASSERT(test.distribution == NullDistribution::exact);
        RC_ASSERT(test.u == u_by_counting(x, y));
        RC_ASSERT(std::fabs(test.p_value - p_by_enumeration(x, y)) <= 1e-12);
    }));
}

TEST(MannWhitneyProperty, TheOrderOfTheSamplesOnlyMirrors) {
    EXPECT_TRUE(rc::check([] {
        const std::vector<double> x = small_sample();
        const std::vector<double> y = small_sample();
        const MannWhitney forth = mann_whitney(x, y);
        const MannWhitney back = mann_whitney(y, x);
        RC_ASSERT(forth.u == u_by_counting(x, y));
        RC_ASSERT(forth.u + back.u == static_cast<double>(x.size() * y.size()));
        RC_ASSERT(forth.p_value == back.p_value);
        RC_ASSERT(forth.p_value > 0.0);
        RC_ASSERT(forth.p_value <= 1.0);
        RC_ASSERT(std::fabs(vargha_delaney_a(x, y) + vargha_delaney_a(y, x) - 1.0) <= 1e-15);
    }));
}

TEST(MannWhitneyProperty, OnlyTheOrderOfTheValuesCounts) {
    EXPECT_TRUE(rc::check([] {
        std::vector<double> x = small_sample();
        std::vector<double> y = small_sample();
        const MannWhitney before = mann_whitney(x, y);
        const double a = vargha_delaney_a(x, y);
        const auto monotone = [](double value) { return std::exp(3.0 * value) - 7.0; };
        std::ranges::transform(x, x.begin(), monotone);
        std::ranges::transform(y, y.begin(), monotone);
        std::ranges::reverse(x);
        const MannWhitney after = mann_whitney(x, y);
        RC_ASSERT(before.u == after.u);
        RC_ASSERT(before.p_value == after.p_value);
        RC_ASSERT(a == vargha_delaney_a(x, y));
    }));
}

TEST(MannWhitney, AllValuesTheSame) {
    const std::vector<double> same(5, 2.0);
    const MannWhitney test = mann_whitney(same, same);
    EXPECT_EQ(test.p_value, 1.0);
    EXPECT_EQ(test.distribution, NullDistribution::normal);
    EXPECT_EQ(vargha_delaney_a(same, same), 0.5);
}

TEST(MannWhitney, RefusesEmptyAndNotFiniteSamples) {
    const std::vector<double> good{1, 2};
    const std::vector<double> bad{1, std::numeric_limits<double>::infinity()};
    EXPECT_THROW(mann_whitney({}, good), std::invalid_argument);
    EXPECT_THROW(mann_whitney(good, {}), std::invalid_argument);
    EXPECT_THROW(mann_whitney(bad, good), std::invalid_argument);
    EXPECT_THROW(vargha_delaney_a(good, bad), std::invalid_argument);
}

}  // namespace
}  // namespace gene_clocks::statistics
