#pragma once

#include <cstdint>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/random.hpp>
#include <gene_clocks/sim/settings.hpp>
#include <vector>

namespace gene_clocks::sim {

/// What lies between sending and reception: loss and delay.
class Radio {
public:
    explicit Radio(const RadioSettings& settings)
        : loss_(settings.loss),
          delay_cycles_(static_cast<std::size_t>(settings.delay_cycles)),
          in_flight_(delay_cycles_ + 1) {}

    /// Hands the message of that number over to one receiver, now or after the delay, or never.
    template <class Receive>
    void send(const neat::Message& message, std::uint64_t number, std::uint32_t receiver,
              neat::RandomStream& random, Receive receive) {
        if (loss_ > 0.0 && random.chance(loss_)) return;
        if (delay_cycles_ == 0) {
            receive(receiver, message, number);
        } else {
            in_flight_[(slot_ + delay_cycles_) % in_flight_.size()].push_back(
                {receiver, number, message});
        }
    }

    /// Begins a cycle: messages whose delay is over arrive, in the order in which they were sent.
    template <class Receive>
    void deliver_delayed(Receive receive) {
        slot_ = (slot_ + 1) % in_flight_.size();
        for (const Flight& flight : in_flight_[slot_])
            receive(flight.receiver, flight.message, flight.number);
        in_flight_[slot_].clear();
    }

private:
    struct Flight {
        std::uint32_t receiver;
        std::uint64_t number;
        neat::Message message;
    };

    double loss_;
    std::size_t delay_cycles_;
    std::size_t slot_ = 0;
    std::vector<std::vector<Flight>> in_flight_;  // by cycle of arrival, modulo its size
};

}  // namespace gene_clocks::sim
