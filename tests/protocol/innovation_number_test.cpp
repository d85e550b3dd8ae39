#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <random>
#include <type_traits>
#include <vector>

#include "tests/support/marks.hpp"
#include "tests/support/property.hpp"

namespace gene_clocks {
namespace {

using SmallMark = BasicInnovationNumber<std::uint8_t>;

// Decided while compiling: the axioms of a strict total order, for every triple of 16 marks.
constexpr bool is_strict_total_order() {
    constexpr int n = 4;
    const auto at = [](int i) {
        return SmallMark{static_cast<std::uint8_t>(i / n),
                         RobotId{static_cast<std::uint32_t>(i % n)}};
    };
    for (int i = 0; i < n * n; ++i) {
        for (int j = 0; j < n * n; ++j) {
            const SmallMark a = at(i);
            const SmallMark b = at(j);
            if ((a < b) + (b < a) + (a == b) != 1) return false;
            if ((a < b) != (i < j)) return false;  // at() enumerates by counter, then by robot
            if ((a <=> b) != (i <=> j)) return false;
            for (int k = 0; k < n * n; ++k) {
                if (a < b && b < at(k) && !(a < at(k))) return false;
            }
        }
    }
    return true;
}
static_assert(is_strict_total_order());

static_assert(std::is_trivially_copyable_v<InnovationNumber>);
static_assert(std::is_aggregate_v<InnovationNumber>);
static_assert(sizeof(InnovationNumber) == 16);
static_assert(sizeof(Stamp) == sizeof(std::uint64_t), "one integer more per message");

TEST(InnovationNumber, OrdersByCounterFirstAndByRobotAmongEqualCounters) {
    const InnovationNumber early{1, RobotId{9}};
    const InnovationNumber late{2, RobotId{1}};
    EXPECT_LT(early, late);
    const InnovationNumber concurrent{2, RobotId{2}};
    EXPECT_LT(late, concurrent);
    EXPECT_NE(late, concurrent);
}

TEST(InnovationNumber, CompareAgreesWithLess) {
    const InnovationNumber a{1, RobotId{1}};
    const InnovationNumber b{1, RobotId{2}};
    EXPECT_EQ(a <=> b, std::strong_ordering::less);
    EXPECT_EQ(b <=> a, std::strong_ordering::greater);
    EXPECT_EQ(a <=> a, std::strong_ordering::equal);
    EXPECT_LE(a, a);
    EXPECT_GE(b, a);
    EXPECT_GT(b, a);
}

TEST(InnovationNumber, DefaultIsAGenesisMarkBelowEveryOther) {
    EXPECT_EQ(InnovationNumber{}.robot, genesis_robot);
    EXPECT_LT(InnovationNumber{}, (InnovationNumber{0, RobotId{1}}));
}

GENE_CLOCKS_PROPERTY(InnovationNumberProperty, IsAStrictTotalOrder,
                     (InnovationNumber a, InnovationNumber b, InnovationNumber c)) {
    RC_ASSERT((a < b) + (b < a) + (a == b) == 1);
    RC_ASSERT((!(a < b && b < c) || a < c));
    RC_ASSERT((a.counter >= b.counter || a < b));
    RC_ASSERT((a <=> b) == (a < b    ? std::strong_ordering::less
                            : a == b ? std::strong_ordering::equal
                                     : std::strong_ordering::greater));
}

// "so all robots sort genes in the exact same manner" (paper, section 3.1)
GENE_CLOCKS_PROPERTY(InnovationNumberProperty, AllRobotsSortASharedSetAlike,
                     (std::vector<InnovationNumber> ours, std::uint32_t seed)) {
    std::vector<InnovationNumber> theirs = ours;
    std::ranges::shuffle(theirs, std::mt19937{seed});
    std::ranges::sort(ours);
    std::ranges::sort(theirs);
    RC_ASSERT(ours == theirs);
}

}  // namespace
}  // namespace gene_clocks
