#pragma once

#include <gene_clocks/kernel.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <gene_clocks/innovation_number.hpp>
#include <gene_clocks/marks.hpp>
#include <limits>
#include <optional>

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

/// What becomes of a received message. Everything but `admitted` is a refusal: nothing changes, and
/// the message must be dropped whole.
enum class Admission : std::uint8_t {
    admitted = kernel::gene_clocks_admitted,
    beyond_maximum = kernel::gene_clocks_beyond_maximum,      ///< exceeds Limits::maximum
    beyond_window = kernel::gene_clocks_beyond_window,        ///< leaps further than Limits::window
    beyond_allowance = kernel::gene_clocks_beyond_allowance,  ///< leaps further than earned by now
    gene_not_covered = kernel::gene_clocks_gene_not_covered,  ///< a gene not below the stamp
    /// A gene bears this robot's id, but this robot never made it: another robot has the same id,
    /// or this one's storage was set back, or the message is forged. Not to be overlooked: in the
    /// first two cases marks are no longer unique until this robot goes on under a new id.
    identity_conflict = kernel::gene_clocks_identity_conflict,
};
inline constexpr std::size_t admission_kinds = 6;

/// A robot's logical clock for genes (paper, section 3.1).
///
/// Mint a mark for every new gene; send `stamp()` with every genome; `observe()` the stamp of
/// every genome received, before any of its genes is used. That is the whole protocol.
///
/// A robot that may crash and come back writes `durable_needed()` to stable storage before
/// anything leaves it, and goes on with `restart()`.
///
/// Two clocks of one robot that both mint make the same marks, so a clock is handed on, not copied:
/// it moves, and what is left behind marks nothing and takes no stamp above its own. Where a second
/// one is meant, as in a look ahead, `clone()` says so.
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

    /// The changing part of a clock. Invariant: 1 <= next <= durable <= limits.maximum.
    struct State {
        Counter next{};     ///< the smallest counter that this robot may still use
        Counter durable{};  ///< on stable storage before anything leaves the robot
        friend constexpr bool operator==(State, State) = default;
    };

    /// A fresh clock that starts above the genesis marks 1…genesis_count. Aborts where its
    /// preconditions do not hold: robot != genesis_robot, genesis_count < limits.maximum.
    constexpr explicit BasicGeneClock(RobotId robot, Counter genesis_count = 0, Limits limits = {})
        : BasicGeneClock{limits, robot} {
        if (robot == genesis_robot ||
            !kernel::gene_clocks_start(&state_, &limits_, genesis_count)) {
            std::abort();
        }
    }

    constexpr BasicGeneClock(BasicGeneClock&& other) noexcept
        : limits_{other.limits_}, state_{other.state_}, robot_{other.robot_} {
        other.exhaust();
    }
    constexpr BasicGeneClock& operator=(BasicGeneClock&& other) noexcept {
        if (this != &other) {
            limits_ = other.limits_;
            state_ = other.state_;
            robot_ = other.robot_;
            other.exhaust();
        }
        return *this;
    }
    BasicGeneClock(const BasicGeneClock&) = delete;
    BasicGeneClock& operator=(const BasicGeneClock&) = delete;
    ~BasicGeneClock() = default;

    /// Another clock of the same robot, in the same state: to try what would be, or as the clock of
    /// a simulated robot. Only one of the two may mark genes that leave the robot.
    [[nodiscard]] constexpr BasicGeneClock clone() const {
        BasicGeneClock copy{{limits_.maximum, limits_.block, limits_.window}, robot_};
        copy.state_ = state_;
        return copy;
    }

    /// A clock that goes on exactly where another one of this robot was left, as in a snapshot;
    /// nullopt where `state` breaks its invariant. After a crash, `restart()` is the right door.
    [[nodiscard]] static constexpr std::optional<BasicGeneClock> from_state(RobotId robot,
                                                                            State state,
                                                                            Limits limits = {}) {
        BasicGeneClock clock{limits, robot};
        if (robot == genesis_robot || !kernel::gene_clocks_restore(&clock.state_, &clock.limits_,
                                                                   state.next, state.durable)) {
            return std::nullopt;
        }
        return clock;
    }

    /// A clock that goes on after a crash, from the last `durable_needed()` that reached stable
    /// storage: no mark is issued twice. Genes kept across the crash whose counter is not below
    /// `stored` must be dropped. Nullopt where no clock with these limits, above these genesis
    /// marks, can have stored it: a store that was made for fewer of them would lead below them.
    [[nodiscard]] static constexpr std::optional<BasicGeneClock> restart(RobotId robot,
                                                                         Counter stored,
                                                                         Counter genesis_count,
                                                                         Limits limits = {}) {
        BasicGeneClock clock{limits, robot};
        if (robot == genesis_robot ||
            !kernel::gene_clocks_restart(&clock.state_, &clock.limits_, genesis_count, stored)) {
            return std::nullopt;
        }
        return clock;
    }

    /// The mark of one new gene; nullopt at exhaustion, and nothing changes.
    [[nodiscard]] constexpr std::optional<Mark> mint() {
        Counter first{};
        if (!kernel::gene_clocks_mint(&state_, &limits_, Counter{1}, &first)) return std::nullopt;
        return Mark{first, robot_};
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
        return kernel::gene_clocks_observe(&state_, &limits_, stamp.value);
    }

    /// The same for a message whose genes may be forged or damaged: false also where a gene does
    /// not lie below the stamp, as every gene of an honest message does. O(genes).
    template <class Genes, class Projection = std::identity>
    requires MarkedGenes<Genes, Projection> && std::same_as<MarkOf<Genes, Projection>, Mark>
    [[nodiscard]] constexpr bool observe(StampType stamp, const Genes& genes,
                                         Projection projection = {}) {
        detail::Marks<Genes, Projection> marks{genes, projection};
        return kernel::gene_clocks_covers(stamp.value, marks, marks.size()) && observe(stamp);
    }

    /// The same, paid for out of an allowance of counters, which only shrinks here and only where
    /// the message is admitted. AdmissionGate keeps one.
    [[nodiscard]] constexpr Admission observe_within(Counter& allowance, StampType stamp) {
        return static_cast<Admission>(
            kernel::gene_clocks_admit(&state_, &limits_, &allowance, stamp.value));
    }

    /// What to send with every message. Every mark this robot knows lies below it.
    [[nodiscard]] constexpr StampType stamp() const { return {state_.next}; }

    /// The counter that must be on stable storage before anything derived from this clock may
    /// leave the robot.
    [[nodiscard]] constexpr Counter durable_needed() const { return state_.durable; }

    [[nodiscard]] constexpr State state() const { return {state_.next, state_.durable}; }
    [[nodiscard]] constexpr RobotId robot() const { return robot_; }

private:
    constexpr BasicGeneClock(Limits limits, RobotId robot)
        : limits_{limits.maximum, limits.block, limits.window}, robot_{robot} {}

    /// What is left of a clock that has moved: no counter is free below its maximum.
    constexpr void exhaust() {
        state_.durable = state_.next;
        limits_.maximum = state_.next;
    }

    kernel::gene_clocks_limits<Counter> limits_;
    kernel::gene_clocks_state<Counter> state_{};
    RobotId robot_;
};
using GeneClock = BasicGeneClock<std::uint64_t>;

}  // namespace gene_clocks
