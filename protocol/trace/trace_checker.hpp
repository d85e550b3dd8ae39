#pragma once

#include <cstdint>
#include <gene_clocks/gene_clock.hpp>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "protocol/trace/trace_entry.hpp"

namespace gene_clocks::trace {

/// The rule that an entry breaks.
enum class Violation : std::uint8_t {
    not_next_counter,    ///< a gene took a counter that is not its robot's next
    beyond_maximum,      ///< counters beyond the maximum were taken
    wrong_stamp,         ///< the stamp is not the sender's next counter
    sent_before_stored,  ///< a message left while the counter was ahead of storage
    gene_above_stamp,    ///< a message holds a gene that is not below its stamp
    no_such_message,     ///< a message was received that had not been sent
    not_admitted,        ///< a stamp beyond the maximum or the admission window was accepted
    wrong_maximum,       ///< after reception the clock is not the larger of its own and the stamp
    stored_backwards,    ///< storage went back, or beyond the maximum
    wrong_restart,       ///< after a crash the clock did not go on from what was stored
};

/// The rule's name in verdicts, such as "wrong-stamp".
std::string_view name(Violation violation);
/// The rule in words: what went wrong.
std::string_view meaning(Violation violation);

/// Replays entries through the shipped clock, one for each robot.
///
/// If no entry of a whole trace breaks a rule, then no two surviving genes share a mark and every
/// gene has a larger counter than those that happened before it: the same checker in Coq is proved
/// (proofs/theories/Claims.v, "Traces of real runs"), and the two are compared entry by entry.
class TraceChecker {
public:
    /// Precondition: limits.genesis_count < limits.maximum.
    explicit TraceChecker(FleetLimits limits);

    /// The rule that `entry` breaks after those before it, and then changes nothing; nullopt where
    /// it breaks none. Precondition: the robot is not 0.
    std::optional<Violation> check(const Entry& entry);

    /// Where a robot stands after the entries so far.
    struct Standing {
        Stamp next;              ///< its next counter
        std::uint64_t stored{};  ///< on stable storage, as the trace says
    };
    Standing standing(RobotId robot);
    std::uint64_t messages() const { return stamps_.size(); }  ///< sent so far

private:
    struct Seat {
        GeneClock clock;
        std::uint64_t stored{};  ///< on stable storage, as the trace says
    };

    std::optional<Violation> check(Seat& seat, const Mints& entry);
    std::optional<Violation> check(Seat& seat, const Sends& entry);
    std::optional<Violation> check(Seat& seat, const Receives& entry);
    std::optional<Violation> check(Seat& seat, const Stores& entry);
    std::optional<Violation> check(Seat& seat, const Restarts& entry);
    Seat& seat_of(RobotId robot);

    GeneClock::Limits limits_;
    std::uint64_t genesis_count_;
    std::unordered_map<RobotId, Seat> seats_;
    std::vector<Stamp> stamps_;  ///< of every message, by number
};

}  // namespace gene_clocks::trace
