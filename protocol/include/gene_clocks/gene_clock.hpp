#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>

#include "gene_clocks/innovation_number.hpp"
#include "gene_clocks/kernel.h"

namespace gene_clocks {

/// `count` consecutive marks of one robot, the first of which is `first`.
template <std::unsigned_integral Counter>
struct BasicMintedRange {
    BasicInnovationNumber<Counter> first;
    Counter count{};

    /// The mark at `index`; precondition: index < count.
    constexpr BasicInnovationNumber<Counter> operator[](Counter index) const {
        return {static_cast<Counter>(first.counter + index), first.robot};
    }
};

/// A robot's logical clock for genes (paper, section 3.1).
///
/// Mint a mark for every new gene; send `stamp()` with every genome; `observe()` the stamp of
/// every genome received, before any of its genes is used. That is the whole protocol.
///
/// No allocation, no exceptions, no I/O. Not thread-safe: one owner.
template <std::unsigned_integral Counter>
class BasicGeneClock {
public:
    using Mark = BasicInnovationNumber<Counter>;
    using Marks = BasicMintedRange<Counter>;
    using StampType = BasicStamp<Counter>;

    /// What a deployment fixes once; the same on every robot, except `block`.
    struct Limits {
        Counter maximum = std::numeric_limits<Counter>::max();  ///< no stamp exceeds it
        Counter block = 0;  ///< counters that one flush reserves beyond need
        Counter window = std::numeric_limits<Counter>::max();  ///< largest admitted leap
    };

    /// All that a restart needs. Invariant: next <= durable.
    struct State {
        Counter next{};     ///< the smallest counter that this robot may still use
        Counter durable{};  ///< on stable storage before anything leaves the robot
        friend constexpr bool operator==(State, State) = default;
    };

    /// A fresh clock that starts above the genesis marks 1…genesis_count.
    /// Preconditions: robot != genesis_robot, genesis_count < limits.maximum.
    constexpr explicit BasicGeneClock(RobotId robot, Counter genesis_count = 0, Limits limits = {})
        : limits_{limits.maximum, limits.block, limits.window},
          state_{static_cast<Counter>(genesis_count + 1), static_cast<Counter>(genesis_count + 1)},
          robot_{robot} {}

    /// A clock that goes on from a stored state; nullopt where the state breaks its invariant.
    static constexpr std::optional<BasicGeneClock> from_state(RobotId robot, State state,
                                                              Limits limits = {}) {
        if (robot == genesis_robot || state.next == 0 || state.next > state.durable ||
            state.durable > limits.maximum) {
            return std::nullopt;
        }
        BasicGeneClock clock{robot, 0, limits};
        clock.state_ = {state.next, state.durable};
        return clock;
    }

    /// The mark of one new gene; nullopt at exhaustion, and nothing changes.
    [[nodiscard]] constexpr std::optional<Mark> mint() {
        const auto marks = mint(1);
        if (!marks) return std::nullopt;
        return marks->first;
    }

    /// `count` consecutive marks, all or none (add-neuron needs three at once).
    [[nodiscard]] constexpr std::optional<Marks> mint(Counter count) {
        Counter first{};
        if (!kernel::gene_clocks_mint(&state_, &limits_, count, &first)) return std::nullopt;
        return Marks{{first, robot_}, count};
    }

    /// Takes the maximum with a received stamp. False where the stamp lies beyond the maximum or
    /// the admission window: then nothing changes and the message must be dropped whole.
    [[nodiscard]] constexpr bool observe(StampType stamp) {
        return kernel::gene_clocks_observe(&state_, &limits_, stamp.value) != 0;
    }

    /// What to send with every message. Every mark this robot knows lies below it.
    [[nodiscard]] constexpr StampType stamp() const { return {state_.next}; }

    /// The counter that must be on stable storage before anything derived from this clock may
    /// leave the robot.
    [[nodiscard]] constexpr Counter durable_needed() const { return state_.durable; }

    [[nodiscard]] constexpr State state() const { return {state_.next, state_.durable}; }
    [[nodiscard]] constexpr RobotId robot() const { return robot_; }

private:
    kernel::gene_clocks_limits<Counter> limits_;
    kernel::gene_clocks_state<Counter> state_;
    RobotId robot_;
};
using GeneClock = BasicGeneClock<std::uint64_t>;

}  // namespace gene_clocks
