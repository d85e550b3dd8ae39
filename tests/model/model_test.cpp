// Every interleaving of mint, send, deliver, lose, duplicate, store, crash and restart, in small
// swarms of the shipped clock and gate with 8-bit counters.
#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <vector>

#include "tests/model/explorer.hpp"
#include "tests/model/scopes.hpp"

namespace gene_clocks::model {
namespace {

class HoldsInScope : public testing::TestWithParam<RecordedScope> {};

TEST_P(HoldsInScope, EveryPromiseInEveryWorld) {
    const Result result = explore<GeneClocks>(GetParam().scope);
    EXPECT_EQ(result.violation, "") << testing::PrintToString(result.trace);
    EXPECT_EQ(result.states, GetParam().states);
    EXPECT_EQ(result.transitions, GetParam().transitions);
}

const auto name_of = [](const auto& info) { return std::string{info.param.name}; };
INSTANTIATE_TEST_SUITE_P(Small, HoldsInScope, testing::ValuesIn(small_scopes), name_of);
#ifndef GENE_CLOCKS_SANITIZED  // there the small ones have to do
INSTANTIATE_TEST_SUITE_P(Large, HoldsInScope, testing::ValuesIn(large_scopes), name_of);
#endif

// A broken rule is refuted by a shortest run into a broken promise. Only outcomes are looked at,
// not the invariants below them, so that the run shows the harm.
template <class Rules>
void expect_refuted(Scope scope, const std::string& violation,
                    const std::vector<std::string>& trace) {
    scope.check_invariants = false;
    ASSERT_EQ(explore<GeneClocks>(scope).violation, "") << "the scope is no fair one";
    const Result result = explore<Rules>(scope);
    EXPECT_EQ(result.violation, violation);
    EXPECT_EQ(result.trace, trace);
    std::cout << "If " << Rules::name << ", then " << result.violation << ":\n";
    for (const auto& step : result.trace) std::cout << "    " << step << '\n';
}

constexpr Scope two_robots{.robots = 2, .maximum = 4};

TEST(Refutes, AcceptingGenesWithoutMergingTheStamp) {
    expect_refuted<NoMerge>(
        two_robots, "a gene does not sort after a gene that its robot knew",
        {"robot 2 mints <1, robot 2>", "robot 2 stores counter 2",
         "robot 2 sends stamp 2 with {<1, robot 2>}",
         "robot 1 receives stamp 2 with {<1, robot 2>}", "robot 1 mints <1, robot 1>"});
}

TEST(Refutes, SendingTheLastUsedCounter) {
    expect_refuted<LastUsed>(
        two_robots, "a gene does not sort after a gene that its robot knew",
        {"robot 2 mints <1, robot 2>", "robot 2 stores counter 2",
         "robot 2 sends stamp 1 with {<1, robot 2>}",
         "robot 1 receives stamp 1 with {<1, robot 2>}", "robot 1 mints <1, robot 1>"});
}

TEST(Refutes, SendingBeforeTheFlush) {
    expect_refuted<SendBeforeFlush>(
        two_robots, "two genes have the same mark",
        {"robot 1 mints <1, robot 1>", "robot 1 sends stamp 2 with {<1, robot 1>}",
         "robot 1 crashes", "robot 1 restarts from counter 1", "robot 1 mints <1, robot 1>"});
}

TEST(Refutes, AVolatileCounter) {
    expect_refuted<VolatileCounter>(
        two_robots, "two genes have the same mark",
        {"robot 1 mints <1, robot 1>", "robot 1 stores counter 2", "robot 1 crashes",
         "robot 1 restarts from counter 2", "robot 1 mints <1, robot 1>"});
}

TEST(Refutes, SortingByRobotFirst) {
    expect_refuted<RobotFirst>(
        two_robots, "a gene does not sort after a gene that its robot knew",
        {"robot 2 mints <1, robot 2>", "robot 2 stores counter 2",
         "robot 2 sends stamp 2 with {<1, robot 2>}",
         "robot 1 receives stamp 2 with {<1, robot 2>}", "robot 1 mints <2, robot 1>"});
}

TEST(Refutes, AMissingWindow) {
    expect_refuted<NoWindow>({.robots = 2,
                              .maximum = 4,
                              .window = 1,
                              .budget = Scope::Budget{.minted = 2, .crashes = 1, .forged = 1}},
                             "a counter exceeds its budget",
                             {"robot 1 receives a forged stamp 3 with {}"});
}

TEST(Refutes, AGateThatSpendsNothing) {
    expect_refuted<SpendsNothing>(
        {.robots = 1,
         .maximum = 5,
         .gate = Gate::Policy{.allowance = 1},
         .budget = Scope::Budget{.forged = 2}},
        "receptions move a clock further than has been earned",
        {"robot 1 receives a forged stamp 2 with {}", "robot 1 receives a forged stamp 3 with {}"});
}

TEST(Refutes, KeepingGenesThatTheStoredCounterDoesNotCover) {
    expect_refuted<KeepsAllGenes>(
        two_robots, "two genes have the same mark",
        {"robot 1 mints <1, robot 1>", "robot 1 crashes", "robot 1 restarts from counter 1",
         "robot 1 mints <1, robot 1>"});
}

TEST(Swarm, RefusesAScopeThatDoesNotFit) {
    EXPECT_THROW(explore<GeneClocks>({.robots = 4, .maximum = 20}), std::invalid_argument);
    EXPECT_THROW(explore<GeneClocks>({.window = 100, .budget = Scope::Budget{.forged = 1}}),
                 std::invalid_argument);
}

// The states of the smallest world, counted by hand: one robot, one counter, nothing in flight.
// Up: nothing minted; minted, not stored; minted, stored. Down: after the first and the third (the
// second comes back as the first).
TEST(Swarm, CountsTheSmallestScopeAsByHand) {
    const Result result = explore<GeneClocks>({.robots = 1, .maximum = 2, .messages = 0});
    EXPECT_EQ(result.states, 5u);
    // mint, crash | mint refused, flush, crash | mint refused, crash | restart | restart
    EXPECT_EQ(result.transitions, 9u);
}

}  // namespace
}  // namespace gene_clocks::model
