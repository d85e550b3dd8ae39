#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gene_clocks/neat/random.hpp>
#include <vector>

namespace gene_clocks::neat {
namespace {

/// SplitMix64 (Steele, Lea & Flood 2014), written a second time.
struct SplitMix64 {
    std::uint64_t state;
    std::uint64_t operator()() {
        state += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state;
        z ^= z >> 30;
        z *= 0xbf58476d1ce4e5b9u;
        z ^= z >> 27;
        z *= 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
};

/// xoshiro256++ 1.0 (Blackman & Vigna 2019), written a second time.
struct Xoshiro256PlusPlus {
    std::array<std::uint64_t, 4> s;
    static std::uint64_t rotl(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }
    std::uint64_t operator()() {
        const std::uint64_t result = rotl(s[0] + s[3], 23) + s[0];
        const std::uint64_t t = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= t;
        s[3] = rotl(s[3], 45);
        return result;
    }
};

Xoshiro256PlusPlus reference(std::uint64_t seed, std::uint64_t stream) {
    SplitMix64 seeder{seed};
    SplitMix64 mixer{seeder() ^ stream};
    Xoshiro256PlusPlus generator{};
    for (auto& word : generator.s) word = mixer();
    return generator;
}

TEST(Random, OurSecondSplitMix64GivesThePublishedNumbers) {
    SplitMix64 generator{1234567};
    for (const std::uint64_t expected :
         {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u,
          16408922859458223821u}) {
        EXPECT_EQ(generator(), expected);
    }
}

TEST(Random, OurSecondXoshiroGivesThePublishedNumbers) {
    Xoshiro256PlusPlus generator{{1, 2, 3, 4}};
    for (const std::uint64_t expected :
         {std::uint64_t{41943041}, std::uint64_t{58720359}, std::uint64_t{3588806011781223},
          std::uint64_t{3591011842654386}, 9228616714210784205u, 9973669472204895162u,
          14011001112246962877u, 12406186145184390807u, 15849039046786891736u,
          10450023813501588000u}) {
        EXPECT_EQ(generator(), expected);
    }
}

TEST(Random, IsXoshiroSeededBySplitMix64) {
    for (const std::uint64_t seed : {0u, 1u, 42u, ~0u}) {
        for (const std::uint64_t stream : {0u, 1u, 100u}) {
            auto expected = reference(seed, stream);
            RandomStream random(seed, stream);
            for (int i = 0; i < 100; ++i) ASSERT_EQ(random.bits(), expected());
        }
    }
}

TEST(Random, StreamsOfOneSeedDiffer) {
    std::vector<std::uint64_t> first_draws;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        for (std::uint64_t stream = 0; stream < 100; ++stream) {
            first_draws.push_back(RandomStream(seed, stream).bits());
        }
    }
    std::sort(first_draws.begin(), first_draws.end());
    EXPECT_EQ(std::adjacent_find(first_draws.begin(), first_draws.end()), first_draws.end());
}

TEST(Random, UniformHasTheUpper53Bits) {
    RandomStream random(1, 2);
    RandomStream twin(1, 2);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_EQ(random.uniform(), std::ldexp(static_cast<double>(twin.bits() >> 11), -53));
    }
}

TEST(Random, UniformHasMeanAndVarianceOfTheUniformDistribution) {
    RandomStream random(3, 4);
    constexpr int draws = 1'000'000;
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < draws; ++i) {
        const double u = random.uniform();
        ASSERT_GE(u, 0.0);
        ASSERT_LT(u, 1.0);
        sum += u;
        squares += u * u;
    }
    const double mean = sum / draws;
    EXPECT_NEAR(mean, 0.5, 5 * std::sqrt(1.0 / 12.0 / draws));
    EXPECT_NEAR(squares / draws - mean * mean, 1.0 / 12.0, 5e-4);
}

TEST(Random, UniformOfARangeIsScaled) {
    RandomStream random(5, 6);
    RandomStream twin(5, 6);
    for (int i = 0; i < 1000; ++i) {
        const double x = random.uniform(-3.0, 5.0);
        EXPECT_EQ(x, -3.0 + 8.0 * twin.uniform());
        EXPECT_GE(x, -3.0);
        EXPECT_LT(x, 5.0);
    }
}

TEST(Random, BelowIsUniform) {
    RandomStream random(7, 8);
    constexpr std::uint32_t bound = 7;
    constexpr int draws = 700'000;
    std::array<int, bound> counts{};
    for (int i = 0; i < draws; ++i) {
        const std::uint32_t drawn = random.below(bound);
        ASSERT_LT(drawn, bound);
        ++counts[drawn];
    }
    double chi_squared = 0.0;
    for (const int count : counts) {
        const double expected = draws / double{bound};
        chi_squared += (count - expected) * (count - expected) / expected;
    }
    EXPECT_LT(chi_squared, 22.46);  // 6 degrees of freedom, p = 0.001
}

TEST(Random, BelowKeepsToTheEdgesOfItsRange) {
    RandomStream random(9, 10);
    RandomStream twin(9, 10);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_EQ(random.below(1), 0u);
        twin.bits();
        // The largest bound must not overflow: it takes the upper half of the bits, scaled.
        const std::uint64_t upper = twin.bits() >> 32;
        EXPECT_EQ(random.below(0xffff'ffffu), (upper * 0xffff'ffffu) >> 32);
    }
}

TEST(Random, ChanceHasItsProbability) {
    RandomStream random(11, 12);
    constexpr int draws = 1'000'000;
    int hits = 0;
    for (int i = 0; i < draws; ++i) {
        ASSERT_FALSE(random.chance(0.0));
        ASSERT_TRUE(random.chance(1.0));
        hits += random.chance(0.3) ? 1 : 0;
    }
    EXPECT_NEAR(hits / double{draws}, 0.3, 5 * std::sqrt(0.3 * 0.7 / draws));
}

TEST(Random, NormalHasTheMomentsOfTheNormalDistribution) {
    RandomStream random(13, 14);
    constexpr int draws = 1'000'000;
    std::array<double, 5> moments{};
    for (int i = 0; i < draws; ++i) {
        const double x = random.normal();
        double power = 1.0;
        for (double& moment : moments) {
            moment += power;
            power *= x;
        }
    }
    EXPECT_NEAR(moments[1] / draws, 0.0, 5e-3);
    EXPECT_NEAR(moments[2] / draws, 1.0, 8e-3);
    EXPECT_NEAR(moments[3] / draws, 0.0, 2e-2);
    EXPECT_NEAR(moments[4] / draws, 3.0, 5e-2);
}

TEST(Random, NormalHasTheDistributionFunctionOfTheNormalDistribution) {
    RandomStream random(15, 16);
    std::vector<double> sample(200'000);
    for (double& x : sample) x = random.normal();
    std::sort(sample.begin(), sample.end());
    const double size = static_cast<double>(sample.size());
    double largest_gap = 0.0;
    for (std::size_t i = 0; i < sample.size(); ++i) {
        const double below = 0.5 * std::erfc(-sample[i] / std::sqrt(2.0));
        largest_gap = std::max({largest_gap, std::abs(below - static_cast<double>(i) / size),
                                std::abs(below - static_cast<double>(i + 1) / size)});
    }
    EXPECT_LT(largest_gap, 1.95 / std::sqrt(size));  // Kolmogorov-Smirnov, p = 0.001
}

TEST(Random, NormalIsThePolarMethodUpToRounding) {
    RandomStream random(17, 18);
    RandomStream twin(17, 18);
    for (int i = 0; i < 100'000; ++i) {
        double x = 0.0;
        double square = 0.0;
        do {
            x = twin.uniform(-1.0, 1.0);
            const double y = twin.uniform(-1.0, 1.0);
            square = x * x + y * y;
        } while (square >= 1.0 || square == 0.0);
        const double expected = x * std::sqrt(-2.0 * std::log(square) / square);
        ASSERT_NEAR(random.normal(), expected, 1e-14 * std::abs(expected));
    }
}

TEST(Random, NormalIsTheSameBitForBitOnEveryMachine) {
    RandomStream random(19, 20);
    // Recorded once; any change changes every trajectory.
    for (const double expected : {-0x1.fc8a53c082044p+0, 0x1.594c6b9a7708ap+0,
                                  -0x1.f4c387c6da65ap-1, -0x1.9f436bb85a677p-3}) {
        EXPECT_EQ(random.normal(), expected);
    }
}

}  // namespace
}  // namespace gene_clocks::neat
