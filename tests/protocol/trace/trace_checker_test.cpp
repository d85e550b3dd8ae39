#include "protocol/trace/trace_checker.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace gene_clocks::trace {
namespace {

constexpr RobotId robot_3{3};
constexpr RobotId robot_7{7};
constexpr FleetLimits small{.maximum = 20, .window = 8, .genesis_count = 1};

/// The first entry that breaks a rule, and the rule; the number of entries where none does.
struct Found {
    std::size_t position{};
    std::optional<Violation> violation;
    friend bool operator==(const Found&, const Found&) = default;
};

Found check(const std::vector<Entry>& entries, FleetLimits limits = small) {
    TraceChecker checker(limits);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (const auto violation = checker.check(entries[i])) return {i, violation};
    }
    return {entries.size(), std::nullopt};
}

/// Robot 7 makes three genes, stores its counter with some to spare, and sends.
std::vector<Entry> after_one_send(const Entry& last) {
    return {Mints{robot_7, 2, 3}, Stores{robot_7, 8}, Sends{robot_7, {5}, 4}, last};
}

// The same table as proofs/theories/proofs/Counterexamples.v, each_fault_is_found.
TEST(TraceChecker, FindsEachFault) {
    const auto fault = [](const Entry& last, Violation violation) {
        EXPECT_EQ(check(after_one_send(last)), (Found{3, violation})) << name(violation);
    };
    fault(Mints{robot_7, 4, 1}, Violation::not_next_counter);
    fault(Mints{robot_7, 6, 1}, Violation::not_next_counter);
    fault(Mints{robot_7, 5, 16}, Violation::beyond_maximum);
    fault(Sends{robot_7, {4}, 3}, Violation::wrong_stamp);
    fault(Sends{robot_7, {5}, 5}, Violation::gene_above_stamp);
    fault(Receives{robot_3, 1, {5}}, Violation::no_such_message);
    fault(Receives{robot_3, 0, {6}}, Violation::wrong_maximum);
    fault(Receives{robot_3, 0, {2}}, Violation::wrong_maximum);
    fault(Stores{robot_7, 7}, Violation::stored_backwards);
    fault(Stores{robot_7, 21}, Violation::stored_backwards);
    fault(Restarts{robot_7, {5}}, Violation::wrong_restart);
    fault(Restarts{robot_3, {8}}, Violation::wrong_restart);
    EXPECT_EQ(check(after_one_send(Mints{robot_7, 5, 15})), (Found{4, std::nullopt}));
}

TEST(TraceChecker, FindsAMessageThatLeftBeforeItsCounterWasStored) {
    EXPECT_EQ(check({Mints{robot_7, 2, 3}, Sends{robot_7, {5}, 4}}),
              (Found{1, Violation::sent_before_stored}));
}

TEST(TraceChecker, FindsALeapBeyondTheWindow) {
    EXPECT_EQ(check({Mints{robot_7, 2, 10}, Stores{robot_7, 12}, Sends{robot_7, {12}, 11},
                     Receives{robot_3, 0, {12}}}),
              (Found{3, Violation::not_admitted}));
}

// The same run as proofs/theories/proofs/Witnesses.v, recorded: the mark <8, robot 7> is made
// twice, but the first time was lost in a crash before anything had left the robot.
TEST(TraceChecker, AcceptsARunWithCrashes) {
    constexpr RobotId robot_9{9};
    const std::vector<Entry> recorded{
        Mints{robot_7, 2, 3},      Stores{robot_7, 8},        Sends{robot_7, {5}, 4},
        Mints{robot_9, 2, 2},      Restarts{robot_9, {2}},    Mints{robot_9, 2, 1},
        Receives{robot_3, 0, {5}}, Receives{robot_3, 0, {5}}, Mints{robot_3, 5, 1},
        Restarts{robot_3, {2}},    Receives{robot_3, 0, {5}}, Mints{robot_3, 5, 3},
        Stores{robot_3, 8},        Mints{robot_9, 3, 1},      Sends{robot_3, {8}, 5},
        Receives{robot_7, 1, {8}}, Mints{robot_7, 8, 1},      Restarts{robot_7, {8}},
        Mints{robot_7, 8, 1}};
    EXPECT_EQ(check(recorded), (Found{recorded.size(), std::nullopt}));
}

TEST(TraceChecker, UsesUpTheLastCounterAndNoMore) {
    constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
    const FleetLimits largest{.maximum = last, .window = last, .genesis_count = last - 2};
    EXPECT_EQ(check({Mints{robot_7, last - 1, 1}}, largest), (Found{1, std::nullopt}));
    EXPECT_EQ(check({Mints{robot_7, last - 1, 2}}, largest), (Found{0, Violation::beyond_maximum}));
}

}  // namespace
}  // namespace gene_clocks::trace
