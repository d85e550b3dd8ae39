#pragma once

#include <cstdint>
#include <ostream>

#include "tests/model/swarm.hpp"

namespace gene_clocks::model {

/// A scope in which every promise holds, and how many worlds there are. A number that changes means
/// that the protocol, the model or the explorer has changed: find out which before recording it.
struct RecordedScope {
    const char* name;
    Scope scope;
    std::uint64_t states;
    std::uint64_t transitions;

    friend std::ostream& operator<<(std::ostream& out, const RecordedScope& recorded) {
        return out << recorded.name;
    }
};

inline constexpr RecordedScope small_scopes[] = {
    {"TwoRobotsFourCounters", {.robots = 2, .maximum = 5}, 250'828, 2'046'584},
    {"ThreeMessagesInFlight",
     {.robots = 2, .maximum = 4, .block = 1, .messages = 3},
     276'283,
     2'744'803},
    {"MutationsOfTwoGenesAndReservedBlocks",
     {.robots = 2, .maximum = 5, .block = 2, .largest_mint = 2},
     503'603,
     4'544'962},
    {"ForgedStampsWithinABudget",
     {.robots = 2,
      .maximum = 8,
      .block = 1,
      .window = 2,
      .budget = Scope::Budget{.minted = 3, .crashes = 1, .forged = 1}},
     369'069,
     2'948'244},
};

/// A few million worlds: seconds.
inline constexpr RecordedScope large_scopes[] = {
    {"ThreeRobots", {.robots = 3, .maximum = 3}, 3'123'171, 32'351'353},
};

/// For `./run prove --full`: minutes, and up to 4 GiB.
inline constexpr RecordedScope full_scopes[] = {
    {"ThreeRobotsOneMessage", {.robots = 3, .maximum = 4, .messages = 1}, 8'043'609, 64'405'833},
    {"ThreeRobotsThreeMessages",
     {.robots = 3, .maximum = 3, .messages = 3},
     20'661'538,
     268'469'849},
    {"TwoRobotsSixCountersThreeMessages",
     {.robots = 2, .maximum = 7, .messages = 3},
     51'835'972,
     561'385'058},
};

}  // namespace gene_clocks::model
