#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <gene_clocks/neat/activation.hpp>
#include <limits>

namespace gene_clocks::neat {
namespace {

constexpr double error_bound = 1e-6;

/// Every how many-th float of an octave is looked at: all of those from 2^-12 to 87, where the
/// functions bend. Instrumented code is too slow for that.
constexpr std::uint32_t stride(int exponent) {
#ifdef GENE_CLOCKS_SANITIZED
    constexpr std::uint32_t finest = 1021;
#else
    constexpr std::uint32_t finest = 1;
#endif
    return exponent < -12 ? 61 * finest : finest;
}

double exact_logistic(double x) {
    return 1.0 / (1.0 + std::exp(-x));
}

/// The floats of one binary exponent and either sign. The exponents from -24 to 6 make up the range
/// from 2^-24, below which exp(x) rounds to 1, to 87, where the bounds end.
class ActivationOverOctave : public testing::TestWithParam<int> {};

TEST_P(ActivationOverOctave, KeepsItsErrorBounds) {
    const auto first = std::bit_cast<std::uint32_t>(std::ldexp(1.0f, GetParam()));
    const auto last = std::bit_cast<std::uint32_t>(
        std::min(std::nextafter(std::ldexp(2.0f, GetParam()), 0.0f), 87.0f));
    double worst_exponential = 0.0;
    double worst_logistic = 0.0;
    for (std::uint32_t bits = first; bits <= last; bits += stride(GetParam())) {
        const float x = std::bit_cast<float>(bits);
        const double exact = std::exp(double{x});
        worst_exponential =
            std::max({worst_exponential, std::abs(double{exponential(x)} / exact - 1.0),
                      std::abs(double{exponential(-x)} * exact - 1.0)});
        const double share = exact / (1.0 + exact);
        worst_logistic = std::max({worst_logistic, std::abs(double{logistic(x, 1.0f)} - share),
                                   std::abs(double{logistic(-x, 1.0f)} - (1.0 - share))});
    }
    EXPECT_LT(worst_exponential, error_bound);
    EXPECT_LT(worst_logistic, error_bound);
}

INSTANTIATE_TEST_SUITE_P(Floats, ActivationOverOctave, testing::Range(-24, 7));

TEST(Activation, IsOneAndOneHalfNearZero) {
    for (const float x : {0.0f, -0.0f, 1e-30f, -1e-30f, std::numeric_limits<float>::denorm_min()}) {
        EXPECT_EQ(exponential(x), 1.0f);
        EXPECT_EQ(logistic(x, 4.924273f), 0.5f);
    }
}

TEST(Activation, ClampsArgumentsBeyond87) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float x : {87.5f, 100.0f, 1e30f, infinity}) {
        EXPECT_EQ(exponential(x), exponential(87.0f));
        EXPECT_EQ(exponential(-x), exponential(-87.0f));
        EXPECT_NEAR(logistic(x, 1.0f), 1.0, error_bound);
        EXPECT_NEAR(logistic(-x, 1.0f), 0.0, error_bound);
    }
}

TEST(Activation, LogisticTakesItsSlope) {
    for (const float slope : {0.5f, 1.0f, 4.924273f, 10.0f}) {
        for (float x = -20.0f; x <= 20.0f; x += 0.001f) {
            ASSERT_NEAR(logistic(x, slope), exact_logistic(double{slope} * x), error_bound);
        }
    }
}

}  // namespace
}  // namespace gene_clocks::neat
