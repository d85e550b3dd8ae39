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
    {"TwoRobotsFourCounters", {.robots = 2, .maximum = 5}, 250'828, 2'126'992},
    {"ThreeMessagesInFlight",
     {.robots = 2, .maximum = 4, .blocks = {1, 1}, .messages = 3},
     593'123,
     6'148'401},
    {"MutationsOfTwoGenesAndReservedBlocks",
     {.robots = 2, .maximum = 5, .blocks = {2, 0}, .largest_mint = 2},
     722'514,
     7'057'342},
    {"AnythingStoredAndStampsAlone",
     {.robots = 2, .maximum = 4, .blocks = {1, 0}, .stored_beyond = 255, .overhears = true},
     312'456,
     3'421'109},
    {"ForgedStampsWithinABudget",
     {.robots = 2,
      .maximum = 8,
      .blocks = {1, 0},
      .window = 2,
      .messages = 1,
      .stored_beyond = 2,
      .budget = Scope::Budget{.minted = 2, .crashes = 1, .forged = 1, .stored = 2}},
     217'301,
     1'378'371},
    {"Gates",
     {.robots = 2, .maximum = 4, .gate = Gate::Policy{.allowance = 1, .per_cycle = 1}},
     200'046,
     1'905'868},
};

/// A few million worlds: seconds.
inline constexpr RecordedScope large_scopes[] = {
    {"ThreeRobots", {.robots = 3, .maximum = 3}, 3'123'171, 32'564'407},
    {"ForgedStampsAtGates",
     {.robots = 2,
      .maximum = 5,
      .messages = 1,
      .gate = Gate::Policy{.allowance = 1, .per_cycle = 1},
      .budget = Scope::Budget{.minted = 2, .crashes = 1, .forged = 2}},
     1'730'947,
     12'989'199},
};

/// For `./run prove --full`: minutes, and up to 4 GiB.
inline constexpr RecordedScope full_scopes[] = {
    {"AnythingStored", {.robots = 2, .maximum = 5, .stored_beyond = 255}, 2'869'096, 25'380'420},
    {"ThreeRobotsOneMessage", {.robots = 3, .maximum = 4, .messages = 1}, 8'045'337, 66'794'382},
    {"ThreeRobotsThreeMessages",
     {.robots = 3, .maximum = 3, .messages = 3, .older_writes = false},
     20'661'538,
     268'469'849},
    {"TwoRobotsSixCountersThreeMessages",
     {.robots = 2, .maximum = 7, .messages = 3, .older_writes = false},
     51'835'972,
     561'385'058},
};

}  // namespace gene_clocks::model
