// Marks as integers, and equal mutations of a generation.
#include <gtest/gtest.h>

#include <cstdint>
#include <gene_clocks/generation_marks.hpp>
#include <gene_clocks/integer_ids.hpp>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "tests/support/marks.hpp"
#include "tests/support/property.hpp"

namespace gene_clocks {
namespace {

TEST(IntegerIds, FitOrAreNone) {
    EXPECT_EQ(pack<int>({1, RobotId{5}}, 11), 1 << 11 | 5);
    EXPECT_EQ(pack<int>({(1u << 20) - 1, RobotId{2047}}, 11), INT32_MAX);
    EXPECT_EQ(pack<int>({1u << 20, RobotId{0}}, 11), std::nullopt);
    EXPECT_EQ(pack<int>({1, RobotId{2048}}, 11), std::nullopt);
    EXPECT_EQ(pack<int>({0, RobotId{0}}, 31), std::nullopt);
    EXPECT_EQ(pack<std::uint64_t>({UINT32_MAX, RobotId{UINT32_MAX}}, 32), UINT64_MAX);
    EXPECT_EQ(pack<std::uint64_t>({std::uint64_t{1} << 32, RobotId{0}}, 32), std::nullopt);
    EXPECT_EQ(pack<std::int64_t>({INT32_MAX, RobotId{UINT32_MAX}}, 32), INT64_MAX);
    EXPECT_EQ(unpack(-1, 11), std::nullopt);
    EXPECT_EQ(unpack(5, 31), std::nullopt);
    static_assert(unpack(*pack<int>({7, RobotId{3}}, 11), 11) == InnovationNumber{7, RobotId{3}});
}

GENE_CLOCKS_PROPERTY(IntegerIds, KeepMarksAndTheirOrder, ()) {
    const auto bits = *rc::gen::inRange<unsigned>(1, 33);
    const auto draw = [&] {
        const auto robot = *rc::gen::arbitrary<std::uint32_t>() >> (32 - bits);
        return InnovationNumber{*rc::gen::inRange<std::uint64_t>(0, 1u << 20), RobotId{robot}};
    };
    const InnovationNumber a = draw(), b = draw();
    const auto x = pack<std::int64_t>(a, bits), y = pack<std::int64_t>(b, bits);
    RC_ASSERT(x && y);
    RC_ASSERT(unpack(*x, bits) == a);
    RC_ASSERT((*x < *y) == (a < b));
    RC_ASSERT((*x == *y) == (a == b));
}

GENE_CLOCKS_PROPERTY(GenerationMarks, EqualMutationsOfAGenerationAreOneAndNothingElseChanges, ()) {
    using Mutation = std::pair<int, int>;
    GeneClock clock{RobotId{3}, 10}, plain{RobotId{3}, 10};
    GenerationMarks<Mutation> marks;
    std::map<Mutation, InnovationNumber> generation;
    std::set<InnovationNumber> all;
    const auto steps = *rc::gen::inRange(0, 60);
    for (int i = 0; i < steps; ++i) {
        if (*rc::gen::inRange(0, 6) == 0) {
            marks.next_generation();
            generation.clear();
            continue;
        }
        const Mutation mutation{*rc::gen::inRange(0, 4), *rc::gen::inRange(0, 4)};
        const std::uint64_t count = mutation.first == 0 ? 3 : 1;  // a split, or a connection
        const auto minted = marks.get(mutation, clock, count);
        RC_ASSERT(minted && minted->count == count);
        const auto [known, is_new] = generation.emplace(mutation, minted->first);
        RC_ASSERT(known->second == minted->first);
        RC_ASSERT(marks.size() == generation.size());
        if (!is_new) continue;
        // As without: the next marks of the clock, which no gene has.
        RC_ASSERT(plain.mint(count)->first == minted->first);
        for (std::uint64_t k = 0; k < count; ++k) RC_ASSERT(all.insert((*minted)[k]).second);
    }
    RC_ASSERT(clock.stamp() == plain.stamp());
}

TEST(GenerationMarks, AnExhaustedClockGivesNoneAndWhatWasThereStays) {
    GeneClock clock{RobotId{3}, 0, {.maximum = 3}};
    GenerationMarks<int> marks;
    const auto first = marks.get(1, clock);
    EXPECT_FALSE(marks.get(2, clock, 3));
    EXPECT_EQ(marks.get(1, clock)->first, first->first);
    EXPECT_TRUE(marks.get(2, clock));
    EXPECT_FALSE(marks.get(3, clock));
}

}  // namespace
}  // namespace gene_clocks
