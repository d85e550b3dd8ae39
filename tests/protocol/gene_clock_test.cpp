#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <gene_clocks/gene_clock.hpp>
#include <limits>
#include <ostream>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "tests/support/marks.hpp"
#include "tests/support/property.hpp"

namespace gene_clocks {
namespace {

using SmallClock = BasicGeneClock<std::uint8_t>;
using Small = std::uint8_t;
constexpr RobotId robot{7};
constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();

// Decided while compiling, for every state and limits below a bound, against plain arithmetic on
// integers too wide to overflow.
constexpr bool mints_as_defined() {
    constexpr int bound = 6;
    for (int maximum = 1; maximum < bound; ++maximum) {
        for (int block = 0; block < bound; ++block) {
            for (int durable = 1; durable <= maximum; ++durable) {
                for (int next = 1; next <= durable; ++next) {
                    for (int count = 0; count < bound; ++count) {
                        auto clock = SmallClock::from_state(robot, {Small(next), Small(durable)},
                                                            {Small(maximum), Small(block), 0});
                        const auto marks = clock->mint(Small(count));
                        const bool fits = next + count <= maximum;
                        if (marks.has_value() != fits) return false;
                        const int after = fits ? next + count : next;
                        const int reserved =
                            after <= durable ? durable : std::min(after + block, maximum);
                        if (clock->state() != SmallClock::State{Small(after), Small(reserved)}) {
                            return false;
                        }
                        if (fits && (marks->first != SmallClock::Mark{Small(next), robot} ||
                                     marks->count != count)) {
                            return false;
                        }
                    }
                }
            }
        }
    }
    return true;
}
static_assert(mints_as_defined());

constexpr bool observes_as_defined() {
    constexpr int bound = 6;
    for (int maximum = 1; maximum < bound; ++maximum) {
        for (int window = 0; window < bound; ++window) {
            for (int durable = 1; durable <= maximum; ++durable) {
                for (int next = 1; next <= durable; ++next) {
                    for (int stamp = 0; stamp < bound + 2; ++stamp) {
                        auto clock = SmallClock::from_state(robot, {Small(next), Small(durable)},
                                                            {Small(maximum), 1, Small(window)});
                        const bool admitted = stamp <= maximum && stamp <= next + window;
                        if (clock->observe({Small(stamp)}) != admitted) return false;
                        const int after = admitted ? std::max(next, stamp) : next;
                        const int reserved =
                            after <= durable ? durable : std::min(after + 1, maximum);
                        if (clock->state() != SmallClock::State{Small(after), Small(reserved)}) {
                            return false;
                        }
                    }
                }
            }
        }
    }
    return true;
}
static_assert(observes_as_defined());

TEST(GeneClock, StartsAboveTheGenesisMarks) {
    GeneClock clock{robot, 22};
    EXPECT_EQ(clock.stamp(), Stamp{23});
    EXPECT_EQ(clock.mint(), (InnovationNumber{23, robot}));
    EXPECT_EQ(clock.robot(), robot);
}

// "Each robot increments its counter c_r by one each time a mutation adds a new gene"
// (paper, section 3.1)
TEST(GeneClock, MintsConsecutiveCounters) {
    GeneClock clock{robot};
    EXPECT_EQ(clock.mint(), (InnovationNumber{1, robot}));
    const auto three = clock.mint(3);
    ASSERT_TRUE(three);
    EXPECT_EQ(three->count, 3u);
    EXPECT_EQ((*three)[0], (InnovationNumber{2, robot}));
    EXPECT_EQ((*three)[2], (InnovationNumber{4, robot}));
    EXPECT_EQ(clock.stamp(), Stamp{5});
}

// "upon reception, robots update their respective c_r's with the maximum of the received value and
// their own" (paper, section 3.1)
TEST(GeneClock, ObservesTheMaximumWithoutAddingOne) {
    GeneClock clock{robot, 9};
    EXPECT_TRUE(clock.observe(Stamp{40}));
    EXPECT_EQ(clock.stamp(), Stamp{40});
    EXPECT_TRUE(clock.observe(Stamp{12}));
    EXPECT_EQ(clock.stamp(), Stamp{40});
    EXPECT_EQ(clock.mint(), (InnovationNumber{40, robot}));
}

TEST(GeneClock, GivesAllMarksOrNoneAtExhaustion) {
    auto clock = GeneClock::from_state(robot, {last - 2, last - 2});
    ASSERT_TRUE(clock);
    EXPECT_FALSE(clock->mint(3));
    EXPECT_EQ(clock->stamp(), Stamp{last - 2});
    EXPECT_TRUE(clock->mint(2));
    EXPECT_EQ(clock->stamp(), Stamp{last});
    EXPECT_FALSE(clock->mint());
    EXPECT_FALSE(clock->mint(last));
    EXPECT_EQ(clock->stamp(), Stamp{last}) << "never wraps";
    EXPECT_TRUE(clock->observe(Stamp{last})) << "an exhausted clock still listens";
}

TEST(GeneClock, RefusesStampsBeyondTheMaximumOrTheWindow) {
    GeneClock clock{robot, 0, {.maximum = 100, .window = 10}};
    EXPECT_FALSE(clock.observe(Stamp{12}));
    EXPECT_EQ(clock.stamp(), Stamp{1}) << "a refused stamp changes nothing";
    EXPECT_TRUE(clock.observe(Stamp{11}));

    GeneClock open{robot, 0, {.maximum = 100}};
    EXPECT_FALSE(open.observe(Stamp{101}));
    EXPECT_TRUE(open.observe(Stamp{100}));
}

TEST(GeneClock, RefusesAMessageWithAGeneThatItsStampDoesNotCover) {
    GeneClock clock{robot};
    const std::vector<InnovationNumber> genes{{3, RobotId{1}}, {8, RobotId{2}}};
    EXPECT_FALSE(clock.observe(Stamp{8}, genes)) << "8 was used, so 8 cannot be the next unused";
    EXPECT_EQ(clock.stamp(), Stamp{1});
    EXPECT_TRUE(clock.observe(Stamp{9}, genes));
    EXPECT_EQ(clock.stamp(), Stamp{9});

    const std::vector<InnovationNumber> unsorted{{9, RobotId{1}}, {2, RobotId{2}}};
    EXPECT_FALSE(clock.observe(Stamp{9}, unsorted)) << "forged genes need not be sorted";
    EXPECT_TRUE(clock.observe(Stamp{0}, std::vector<InnovationNumber>{}));
}

TEST(GeneClock, ReservesABlockAheadForMintsAndForMerges) {
    GeneClock clock{robot, 0, {.block = 10}};
    EXPECT_EQ(clock.durable_needed(), 1u) << "a fresh clock restarts where it started";
    ASSERT_TRUE(clock.mint());
    EXPECT_EQ(clock.durable_needed(), 12u);
    ASSERT_TRUE(clock.mint(10));
    EXPECT_EQ(clock.durable_needed(), 12u) << "12 marks cost one flush";
    ASSERT_TRUE(clock.observe(Stamp{30}));
    EXPECT_EQ(clock.durable_needed(), 40u);
}

TEST(GeneClock, ReservesNothingBeyondTheMaximum) {
    GeneClock clock{robot, 0, {.maximum = 5, .block = 10}};
    ASSERT_TRUE(clock.mint());
    EXPECT_EQ(clock.durable_needed(), 5u);
}

TEST(GeneClock, RestartsFromWhatWasStored) {
    const auto clock = GeneClock::restart(robot, 12, 0);
    ASSERT_TRUE(clock);
    EXPECT_EQ(clock->state(), (GeneClock::State{12, 12}));
    EXPECT_FALSE(GeneClock::restart(robot, 0, 0));
    EXPECT_FALSE(GeneClock::restart(robot, 101, 0, {.maximum = 100}));
    EXPECT_FALSE(GeneClock::restart(genesis_robot, 12, 0));
}

// A store that was made for one genesis mark, in a fleet that has twenty-two.
TEST(GeneClock, DoesNotRestartAmongTheGenesisMarks) {
    EXPECT_TRUE(GeneClock::restart(robot, 2, 1));
    EXPECT_FALSE(GeneClock::restart(robot, 2, 22));
    EXPECT_FALSE(GeneClock::restart(robot, 22, 22));
    const auto clock = GeneClock::restart(robot, 23, 22);
    ASSERT_TRUE(clock);
    EXPECT_EQ(clock->stamp(), Stamp{23});
    EXPECT_FALSE(GeneClock::restart(robot, 101, 22, {.maximum = 100}));
}

// A copy that nobody meant would make every mark of the original again.
static_assert(!std::is_copy_constructible_v<GeneClock> && !std::is_copy_assignable_v<GeneClock>);
static_assert(std::is_nothrow_move_constructible_v<GeneClock> &&
              std::is_nothrow_move_assignable_v<GeneClock>);

void expect_spent(GeneClock& clock, std::uint64_t next) {
    EXPECT_EQ(clock.mint(), std::nullopt);
    EXPECT_EQ(clock.stamp().value, next);
    EXPECT_EQ(clock.durable_needed(), next);
    EXPECT_FALSE(clock.observe(Stamp{next + 1}));
    EXPECT_EQ(clock.stamp().value, next);
}

TEST(GeneClock, IsHandedOnWholeAndLeavesNothingToMark) {
    const GeneClock::Limits limits{.maximum = 50, .block = 10, .window = 20};
    GeneClock first{robot, 4, limits};
    ASSERT_TRUE(first.mint());
    GeneClock second{std::move(first)};
    expect_spent(first, 6);  // NOLINT(bugprone-use-after-move): what is left is what is tested
    EXPECT_EQ(second.state(), (GeneClock::State{6, 16}));

    GeneClock third{RobotId{8}};
    third = std::move(second);
    expect_spent(second, 6);  // NOLINT(bugprone-use-after-move)
    EXPECT_EQ(third.robot(), robot);
    EXPECT_FALSE(third.observe(Stamp{27})) << "the window came along";
    EXPECT_TRUE(third.observe(Stamp{26}));
    EXPECT_EQ(third.durable_needed(), 36u) << "the block came along";
    EXPECT_FALSE(third.observe(Stamp{51})) << "the maximum came along";

    auto& itself = third;
    third = std::move(itself);
    EXPECT_EQ(third.mint(), (InnovationNumber{26, robot}));
}

TEST(GeneClock, HasACloneThatGoesItsOwnWay) {
    GeneClock clock{robot, 4, {.maximum = 50, .block = 10, .window = 20}};
    auto ahead = clock.clone();
    EXPECT_EQ(ahead.state(), clock.state());
    EXPECT_EQ(ahead.mint(), clock.mint());
    EXPECT_FALSE(ahead.observe(Stamp{27}));
    EXPECT_TRUE(ahead.observe(Stamp{26}));
    EXPECT_EQ(ahead.durable_needed(), 36u);
    EXPECT_EQ(clock.stamp().value, 6u);
    EXPECT_EQ(clock.mint(), (InnovationNumber{6, robot}));
}

TEST(GeneClock, RefusesBrokenStates) {
    EXPECT_TRUE(GeneClock::from_state(robot, {1, 1}));
    EXPECT_FALSE(GeneClock::from_state(robot, {0, 5})) << "counter 0 is nobody's";
    EXPECT_FALSE(GeneClock::from_state(robot, {6, 5})) << "what is used must be durable";
    EXPECT_FALSE(GeneClock::from_state(robot, {1, 11}, {.maximum = 10}));
    EXPECT_FALSE(GeneClock::from_state(genesis_robot, {1, 1}));
}

TEST(GeneClockDeathTest, AbortsOnBrokenPreconditions) {
    EXPECT_DEATH(GeneClock{genesis_robot}, "");
    EXPECT_DEATH((GeneClock{robot, 10, {.maximum = 10}}), "");
    EXPECT_DEATH((GeneClock{robot, last}), "") << "1 + genesis_count would wrap";
}

// ---- Properties: any state, any limits, near both ends of the counter ------------------------

struct AnyClock {
    GeneClock::Limits limits;
    GeneClock clock;

    AnyClock(GeneClock::Limits its_limits, GeneClock its_clock)
        : limits{its_limits}, clock{std::move(its_clock)} {}
    AnyClock(const AnyClock& other) : limits{other.limits}, clock{other.clock.clone()} {}

    friend std::ostream& operator<<(std::ostream& out, const AnyClock& any) {
        return out << "next " << any.clock.stamp().value << ", durable "
                   << any.clock.durable_needed() << ", maximum " << any.limits.maximum << ", block "
                   << any.limits.block << ", window " << any.limits.window;
    }
};

rc::Gen<AnyClock> clocks() {
    const auto counter = test::counters<std::uint64_t>();
    return rc::gen::map(rc::gen::tuple(counter, counter, counter, counter, counter), [](auto
                                                                                            drawn) {
        auto& [next, durable, maximum, block, window] = drawn;
        std::array ordered{std::max(next, std::uint64_t{1}), std::max(durable, std::uint64_t{1}),
                           std::max(maximum, std::uint64_t{1})};
        std::ranges::sort(ordered);
        const GeneClock::Limits limits{ordered[2], block, window};
        return AnyClock{limits, *GeneClock::from_state(robot, {ordered[0], ordered[1]}, limits)};
    });
}

void assert_invariant(const AnyClock& any) {
    const auto [next, durable] = any.clock.state();
    RC_ASSERT(1 <= next && next <= durable && durable <= any.limits.maximum);
}

GENE_CLOCKS_PROPERTY(GeneClockProperty, MintsAllOrNothingAndNeverWraps, ()) {
    auto any = *clocks();
    const auto count = *test::counters<std::uint64_t>();
    const auto before = any.clock.state();
    const bool fits = count <= any.limits.maximum - before.next;
    const auto marks = any.clock.mint(count);
    RC_ASSERT(marks.has_value() == fits);
    if (fits) {
        RC_ASSERT(marks->first == (InnovationNumber{before.next, robot}));
        RC_ASSERT(marks->count == count);
        RC_ASSERT(any.clock.stamp().value == before.next + count);
    } else {
        RC_ASSERT(any.clock.state() == before);
    }
    RC_ASSERT(any.clock.stamp().value >= before.next);
    assert_invariant(any);
    RC_CLASSIFY(fits);
}

GENE_CLOCKS_PROPERTY(GeneClockProperty, ObserveIsMonotoneAndChangesNothingWhereItRefuses, ()) {
    auto any = *clocks();
    const Stamp stamp{*test::counters<std::uint64_t>()};
    const auto before = any.clock.state();
    const bool admitted = any.clock.observe(stamp);
    const bool is_leap = stamp.value > before.next;
    RC_ASSERT(admitted == (stamp.value <= any.limits.maximum &&
                           !(is_leap && stamp.value - before.next > any.limits.window)));
    if (admitted) {
        RC_ASSERT(any.clock.stamp().value == std::max(before.next, stamp.value));
    } else {
        RC_ASSERT(any.clock.state() == before);
    }
    assert_invariant(any);
    RC_CLASSIFY(admitted && is_leap, "leap admitted");
    RC_CLASSIFY(!admitted, "refused");
}

GENE_CLOCKS_PROPERTY(GeneClockProperty, WhatIsMintedLiesAboveAllThatWasObserved, ()) {
    auto any = *clocks();
    const auto genes =
        *rc::gen::container<std::vector<InnovationNumber>>(rc::gen::arbitrary<InnovationNumber>());
    const Stamp stamp{*test::counters<std::uint64_t>()};
    const auto before = any.clock.state();
    const bool is_credible =
        std::ranges::all_of(genes, [&](auto gene) { return gene.counter < stamp.value; });
    auto alone = any.clock.clone();
    const bool admitted = any.clock.observe(stamp, genes);
    RC_ASSERT(admitted == (is_credible && alone.observe(stamp)));
    if (!admitted) RC_ASSERT(any.clock.state() == before);
    if (const auto mark = any.clock.mint(); admitted && mark) {
        for (const auto gene : genes) RC_ASSERT(gene < *mark);
    }
    RC_CLASSIFY(admitted && !genes.empty(), "genes admitted");
}

GENE_CLOCKS_PROPERTY(GeneClockProperty, ARestartNeverIssuesAMarkAgain, ()) {
    auto any = *clocks();
    const auto marks = any.clock.mint(*rc::gen::inRange<std::uint64_t>(0, 4));
    auto flushed = GeneClock::restart(robot, any.clock.durable_needed(), 0, any.limits);
    RC_ASSERT(flushed.has_value());
    RC_ASSERT(flushed->stamp() >= any.clock.stamp());
    if (const auto again = flushed->mint(); again && marks && marks->count > 0) {
        RC_ASSERT((*marks)[marks->count - 1] < *again);
    }
}

GENE_CLOCKS_PROPERTY(GeneClockProperty, AStateTakenUpGoesOnAsTheClockItCameFrom, ()) {
    auto any = *clocks();
    auto twin = GeneClock::from_state(robot, any.clock.state(), any.limits);
    RC_ASSERT(twin.has_value());
    const auto count = *test::counters<std::uint64_t>();
    const Stamp stamp{*test::counters<std::uint64_t>()};
    RC_ASSERT(any.clock.mint(count).has_value() == twin->mint(count).has_value());
    RC_ASSERT(any.clock.observe(stamp) == twin->observe(stamp));
    RC_ASSERT(any.clock.state() == twin->state());
}

}  // namespace
}  // namespace gene_clocks
