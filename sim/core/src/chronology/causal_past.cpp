#include "sim/core/src/chronology/causal_past.hpp"

#include <cassert>

#include "sim/core/src/lanes.hpp"

namespace gene_clocks::sim {
namespace {

/// Takes the maximum of each entry; whether one rose.
GENE_CLOCKS_MULTIVERSION
bool merge(std::int32_t* known, const std::int32_t* heard, std::size_t count) {
    std::int32_t rose = 0;
    for (std::size_t i = 0; i < count; ++i) {
        rose |= heard[i] > known[i] ? 1 : 0;
        known[i] = heard[i] > known[i] ? heard[i] : known[i];
    }
    return rose != 0;
}

}  // namespace

CausalPast::CausalPast(std::size_t robots, std::int64_t delay_cycles)
    : robots_(robots),
      delay_cycles_(delay_cycles),
      known_(robots * robots),
      epochs_(robots),
      merged_(robots * robots),
      snapshots_(delay_cycles > 0 ? robots : 0) {
    heard_.reserve(heard_most);
}

void CausalPast::created(std::uint32_t robot) {
    catch_up();
    ++row(robot)[robot];
    ++epochs_[robot];
}

std::shared_ptr<const CausalPast::Vector> CausalPast::snapshot(std::uint32_t robot) {
    Snapshot& latest = snapshots_[robot];
    if (!latest.known || latest.epoch != epochs_[robot]) {
        latest = {epochs_[robot], std::make_shared<const Vector>(row(robot), row(robot) + robots_)};
    }
    return latest.known;
}

void CausalPast::hold(std::uint64_t message, std::int64_t cycle) {
    while (!in_flight_.empty() && in_flight_.front().cycle + delay_cycles_ < cycle) {
        in_flight_.pop_front();
        ++first_message_;
    }
    assert(message == first_message_ + in_flight_.size());
    static_cast<void>(message);
    in_flight_.push_back({last_sender_, epochs_[last_sender_], cycle, snapshot(last_sender_)});
}

void CausalPast::admit_held(std::uint32_t receiver, std::uint64_t message) {
    const Flight& flight = in_flight_[static_cast<std::size_t>(message - first_message_)];
    admit(receiver, flight.sender, flight.epoch, flight.known->data());
}

void CausalPast::catch_up() {
    for (const auto [sender, receiver] : heard_)
        admit(receiver, sender, epochs_[sender], row(sender));
    heard_.clear();
}

void CausalPast::admit(std::uint32_t receiver, std::uint32_t sender, std::uint32_t epoch,
                       const std::int32_t* known) {
    // Many messages say nothing new.
    std::uint32_t& merged = merged_[sender * robots_ + receiver];
    if (merged >= epoch) return;
    merged = epoch;
    if (merge(row(receiver), known, robots_)) ++epochs_[receiver];
}

}  // namespace gene_clocks::sim
