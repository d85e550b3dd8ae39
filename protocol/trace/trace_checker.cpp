#include "protocol/trace/trace_checker.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <variant>

namespace gene_clocks::trace {

std::string_view name(Violation violation) {
    static constexpr std::array<std::string_view, 10> names{
        "not-next-counter", "beyond-maximum",  "wrong-stamp",  "sent-before-stored",
        "gene-above-stamp", "no-such-message", "not-admitted", "wrong-maximum",
        "stored-backwards", "wrong-restart"};
    return names[static_cast<std::size_t>(violation)];
}

std::string_view meaning(Violation violation) {
    static constexpr std::array<std::string_view, 10> meanings{
        "a gene took a counter that is not its robot's next",
        "counters beyond the maximum were taken",
        "the stamp is not the sender's next counter",
        "a message left while the counter was ahead of storage",
        "a message holds a gene that is not below its stamp",
        "a message was received that had not been sent",
        "a stamp beyond the maximum or the admission window was accepted",
        "after reception the clock is not the larger of its own and the stamp",
        "storage went back, or beyond the maximum",
        "after a crash the clock did not go on from what was stored"};
    return meanings[static_cast<std::size_t>(violation)];
}

// A trace does not show how far ahead a robot reserves. With a block of 0 the clock asks for just
// what safety needs: that the next counter be stored before a message leaves.
TraceChecker::TraceChecker(FleetLimits limits)
    : limits_{.maximum = limits.maximum, .block = 0, .window = limits.window},
      genesis_count_{limits.genesis_count} {}

std::optional<Violation> TraceChecker::check(const Entry& entry) {
    return std::visit([this](const auto& kind) { return check(seat_of(kind.robot), kind); }, entry);
}

std::optional<Violation> TraceChecker::check(Seat& seat, const Mints& entry) {
    if (entry.first != seat.clock.stamp().value) return Violation::not_next_counter;
    if (!seat.clock.mint(entry.count)) return Violation::beyond_maximum;
    return std::nullopt;
}

std::optional<Violation> TraceChecker::check(Seat& seat, const Sends& entry) {
    if (entry.stamp != seat.clock.stamp()) return Violation::wrong_stamp;
    if (seat.clock.durable_needed() > seat.stored) return Violation::sent_before_stored;
    if (entry.newest >= entry.stamp.value) return Violation::gene_above_stamp;
    stamps_.push_back(entry.stamp);
    return std::nullopt;
}

std::optional<Violation> TraceChecker::check(Seat& seat, const Receives& entry) {
    if (entry.message >= stamps_.size()) return Violation::no_such_message;
    GeneClock after = seat.clock.clone();
    if (!after.observe(stamps_[entry.message])) return Violation::not_admitted;
    if (entry.next != after.stamp()) return Violation::wrong_maximum;
    seat.clock = std::move(after);
    return std::nullopt;
}

std::optional<Violation> TraceChecker::check(Seat& seat, const Stores& entry) {
    if (entry.value < seat.stored || entry.value > limits_.maximum) {
        return Violation::stored_backwards;
    }
    seat.stored = entry.value;
    return std::nullopt;
}

std::optional<Violation> TraceChecker::check(Seat& seat, const Restarts& entry) {
    if (entry.next.value != seat.stored) return Violation::wrong_restart;
    // What was stored lies between the first counter and the maximum, so there is a clock.
    seat.clock = GeneClock::restart(entry.robot, seat.stored, genesis_count_, limits_).value();
    return std::nullopt;
}

TraceChecker::Standing TraceChecker::standing(RobotId robot) {
    const Seat& seat = seat_of(robot);
    return {seat.clock.stamp(), seat.stored};
}

TraceChecker::Seat& TraceChecker::seat_of(RobotId robot) {
    const auto place = seats_.find(robot);
    if (place != seats_.end()) return place->second;
    GeneClock clock{robot, genesis_count_, limits_};
    const std::uint64_t stored = clock.durable_needed();
    return seats_.emplace(robot, Seat{std::move(clock), stored}).first->second;
}

}  // namespace gene_clocks::trace
