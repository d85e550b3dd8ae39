#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "tests/model/rules.hpp"

namespace gene_clocks::model {

inline constexpr int most_robots = 4;
inline constexpr int most_messages = 4;

/// How much of the world is explored. Everything else is unbounded: a run may have any length.
struct Scope {
    int robots = 2;
    Counter maximum = 4;                        ///< counters run from 1 to maximum
    std::array<Counter, most_robots> blocks{};  ///< counters that each robot reserves ahead
    Counter window = 255;                       ///< largest admitted leap
    int messages = 2;                           ///< in the air at the same time
    Counter largest_mint = 1;                   ///< genes that one mutation adds, all or none
    /// How far beyond need a robot may store, as one does that numbers its genomes by the same
    /// counter.
    Counter stored_beyond = 0;
    bool older_writes = true;  ///< values below the one that is needed may be stored as well
    bool overhears = false;    ///< robots may also take a message's stamp alone
    /// Before each clock stands a gate of this policy, and time goes by.
    std::optional<Gate::Policy> gate = std::nullopt;
    /// With it, runs are bounded by these four, what they cost is added up as
    /// Claims.budget_with_storing in proofs/theories does, and no counter may exceed it.
    struct Budget {
        int minted = 0;
        int crashes = 0;
        int forged = 0;
        int stored = 0;  ///< counters beyond need, all together
    };
    std::optional<Budget> budget = std::nullopt;
    /// Also checks what the proof of the outcomes rests on, in every state.
    bool check_invariants = true;
};

/// Marks as bits: `robot · counters + counter - 1`.
using MarkSet = std::uint32_t;

struct RobotState {
    bool is_up = true;
    Counter next = 1;       ///< of its clock; 0 while it is down
    Counter durable = 1;    ///< of its clock; 0 while it is down
    Counter stored = 1;     ///< on stable storage
    MarkSet known = 0;      ///< every gene that it made or received, and did not lose in a crash
    Counter allowance = 0;  ///< of its gate
    Counter line = 0;       ///< how far receptions may have moved its clock, by time and own genes
};

struct Message {
    Counter stamp = 0;
    MarkSet genes = 0;
    friend auto operator<=>(Message, Message) = default;
};

/// Invariant: messages[0 … message_count) are sorted, the others default, so equal worlds are equal
/// values.
struct World {
    std::array<RobotState, most_robots> robots;
    std::array<Message, most_messages> messages;
    int message_count = 0;
    int minted = 0;
    int crashes = 0;
    int forged = 0;
    int stored = 0;  ///< counters beyond need
    int spent = 0;   ///< of all robots' counters
};

/// A forged message has no genes, or those of a message in flight.
inline constexpr int no_message = -1;

/// What can happen next.
struct Action {
    enum class Kind {
        mint,
        send,
        deliver,
        overhear,
        lose,
        duplicate,
        flush,
        elapse,
        crash,
        restart,
        forge
    };
    Kind kind;
    int robot = 0;      ///< where it happens; of no meaning for lose and duplicate
    int message = 0;    ///< in flight, for those that are about one; for forge whose genes it has
    Counter value = 0;  ///< number of genes to mint, counter to store, or stamp to forge
};

/// A world in 128 bits.
using Packed = unsigned __int128;

}  // namespace gene_clocks::model
