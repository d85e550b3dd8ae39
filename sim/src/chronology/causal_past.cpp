#include "causal_past.hpp"

#include <cassert>

#include "../lanes.hpp"

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
      snapshots_(delay_cycles > 0 ? robots : 0) {}

void CausalPast::created(std::uint32_t robot) {
    ++known_[robot * robots_ + robot];
    ++epochs_[robot];
}

std::shared_ptr<const CausalPast::Vector> CausalPast::snapshot(std::uint32_t robot) {
    Snapshot& latest = snapshots_[robot];
    if (!latest.known || latest.epoch != epochs_[robot]) {
        const auto row = known(robot);
        latest = {epochs_[robot], std::make_shared<const Vector>(row.begin(), row.end())};
    }
    return latest.known;
}

void CausalPast::sent(std::uint32_t robot, std::uint64_t message, std::int64_t cycle) {
    if (delay_cycles_ == 0) {
        last_ = {robot, epochs_[robot]};
        return;
    }
    while (!in_flight_.empty() && in_flight_.front().cycle + delay_cycles_ < cycle) {
        in_flight_.pop_front();
        ++first_message_;
    }
    assert(message == first_message_ + in_flight_.size());
    static_cast<void>(message);
    in_flight_.push_back({{robot, epochs_[robot]}, cycle, snapshot(robot)});
}

void CausalPast::admitted(std::uint32_t receiver, std::uint64_t message) {
    if (delay_cycles_ == 0) {
        admit(receiver, last_, known(last_.sender).data());
        return;
    }
    const Flight& flight = in_flight_[static_cast<std::size_t>(message - first_message_)];
    admit(receiver, flight.sending, flight.known->data());
}

void CausalPast::admit(std::uint32_t receiver, Sending sending, const std::int32_t* heard) {
    // Many messages say nothing new.
    std::uint32_t& merged = merged_[receiver * robots_ + sending.sender];
    if (merged >= sending.epoch) return;
    merged = sending.epoch;
    if (merge(known_.data() + receiver * robots_, heard, robots_)) ++epochs_[receiver];
}

}  // namespace gene_clocks::sim
