// What bench/hostile_peers.cpp measures, in short: how far strangers get honest clocks to advance.
#include "tests/support/hostile_fleet.hpp"

#include <gtest/gtest.h>

namespace gene_clocks::test {
namespace {

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
constexpr int cycles = 2'000;
constexpr AdmissionGate::Policy paced{.allowance = 100, .per_cycle = 1};
constexpr FleetSettings besieged{.hostile = 10, .attack = Attack::greedy, .cycles = cycles};

TEST(HostileFleet, ExhaustsClocksThatAdmitEverything) {
    const auto result = HostileFleet{besieged}.run();
    EXPECT_EQ(result.smallest_clock, most);
    EXPECT_GT(result.genes_not_made, result.genes);
}

TEST(HostileFleet, TakesAWindowWithEachMessageThatAWindowAdmits) {
    FleetSettings settings = besieged;
    settings.window = 1'000;
    const auto result = HostileFleet{settings}.run();
    EXPECT_GT(result.largest_clock, 100'000u);
    EXPECT_LE(result.largest_clock, 1 + result.genes + 1'000 * result.hostile_heard)
        << "counter_budget";
    EXPECT_EQ(result.genes_not_made, 0u);
}

TEST(HostileFleet, TakesNoMoreThanTimeHasEarned) {
    for (const int hostile : {1, 10, 50, 99}) {
        for (const auto attack : {Attack::arbitrary, Attack::greedy}) {
            FleetSettings settings = besieged;
            settings.hostile = hostile;
            settings.attack = attack;
            settings.admission = paced;
            const auto result = HostileFleet{settings}.run();
            EXPECT_LE(result.largest_clock,
                      1 + result.genes + paced.allowance + paced.per_cycle * cycles)
                << "allowance_bounds_clock";
            EXPECT_EQ(result.genes_not_made, 0u);
        }
    }
}

TEST(HostileFleet, RefusesNoHonestRobotInPeace) {
    for (const int partition_cycles : {0, cycles / 2}) {
        FleetSettings settings{.cycles = cycles, .partition_cycles = partition_cycles};
        settings.admission = paced;
        const auto result = HostileFleet{settings}.run();
        EXPECT_EQ(result.honest_refused, 0u);
        EXPECT_GT(result.honest_heard, 1'000u);
        EXPECT_GT(result.largest_clock, 500u) << "more than the allowance to begin with";
    }
}

// A fixed window that is wide enough in daily life shuts a part of the fleet out for ever once it
// has been away for long; an allowance does not.
TEST(HostileFleet, AWindowShutsOutForEverWhereAnAllowanceDoesNot) {
    FleetSettings settings{.cycles = 4 * cycles, .partition_cycles = 2 * cycles};
    settings.window = 100;
    const auto shut_out = HostileFleet{settings}.run();
    EXPECT_GT(shut_out.largest_clock - shut_out.smallest_clock, 500u);
    EXPECT_GT(shut_out.honest_refused, 1'000u);

    settings.window = most;
    settings.admission = paced;
    const auto reunited = HostileFleet{settings}.run();
    EXPECT_LT(reunited.largest_clock - reunited.smallest_clock, 50u);
    EXPECT_EQ(reunited.honest_refused, 0u);
}

}  // namespace
}  // namespace gene_clocks::test
