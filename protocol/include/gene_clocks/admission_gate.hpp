#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/marks.hpp>
#include <limits>
#include <optional>

namespace gene_clocks {

/// How many messages had each outcome.
class AdmissionCounts {
public:
    [[nodiscard]] constexpr std::uint64_t operator[](Admission admission) const {
        return counts_[static_cast<std::size_t>(admission)];
    }
    [[nodiscard]] constexpr std::uint64_t refused() const {
        std::uint64_t sum = 0;
        for (std::size_t i = 1; i < admission_kinds; ++i) sum += counts_[i];
        return sum;
    }
    constexpr void add(Admission admission) { ++counts_[static_cast<std::size_t>(admission)]; }

private:
    std::array<std::uint64_t, admission_kinds> counts_{};
};

/// Stands before a clock where messages may be forged or damaged, or their senders be broken.
///
/// Forged stamps cannot make marks repeat or fall out of order, but they use counters up.
/// Limits::window bounds what each message uses up; this gate bounds what all of them do together,
/// by time: receptions may advance the clock by `allowance` counters at once, and by `per_cycle`
/// more with each cycle that goes by, heard or unheard. However many strangers send whatever they
/// like, the clock advances by no more than that and its own genes (Claims.allowance_bounds_clock).
/// And a stamp below that line is never refused for want of allowance, whatever was heard before
/// (Claims.allowance_admits_below; the limits' maximum and window still count): the allowance grows
/// in silence, so a fleet that mints no faster is heard again after any partition, and a clock that
/// fell behind is not shut out for good.
///
/// The default policy refuses nothing that the clock's limits admit. One owner; no allocation.
template <std::unsigned_integral Counter>
class BasicAdmissionGate {
public:
    using Clock = BasicGeneClock<Counter>;
    using Mark = BasicInnovationNumber<Counter>;

    struct Policy {
        Counter allowance = std::numeric_limits<Counter>::max();  ///< to begin with, in counters
        Counter per_cycle = 0;  ///< what the whole fleet may mint in a cycle, in counters
    };

    constexpr explicit BasicAdmissionGate(Policy policy = {})
        : allowance_{policy.allowance}, per_cycle_{policy.per_cycle} {}

    /// A cycle of the receiver's own time has gone by.
    constexpr void elapse() {
        kernel::gene_clocks_earn(&allowance_, per_cycle_, std::numeric_limits<Counter>::max());
    }

    /// Hands a message to `clock`, or refuses it and says why; then neither gate nor clock has
    /// changed, except for the counts. O(genes).
    template <class Genes, class Projection = std::identity>
    requires MarkedGenes<Genes, Projection> && std::same_as<MarkOf<Genes, Projection>, Mark>
    [[nodiscard]] constexpr Admission admit(Clock& clock, BasicStamp<Counter> stamp,
                                            const Genes& genes, Projection projection = {}) {
        const Admission admission = decide(clock, stamp, genes, projection);
        counts_.add(admission);
        return admission;
    }

    /// Counters that receptions may still add to the clock.
    [[nodiscard]] constexpr Counter allowance() const { return allowance_; }
    [[nodiscard]] constexpr const AdmissionCounts& counts() const { return counts_; }
    /// The mark that the first identity conflict was about, if there was one.
    [[nodiscard]] constexpr std::optional<Mark> conflicting_mark() const {
        return conflicting_mark_;
    }

private:
    template <class Genes, class Projection>
    constexpr Admission decide(Clock& clock, BasicStamp<Counter> stamp, const Genes& genes,
                               Projection& projection) {
        // What is not even a message in its own terms is no evidence of anything.
        detail::Marks<Genes, Projection> covered{genes, projection};
        if (!kernel::gene_clocks_covers(stamp.value, covered, covered.size())) {
            return Admission::gene_not_covered;
        }
        // Before the clock moves: afterwards the mark would look like one of the past.
        detail::Marks<Genes, Projection> marks{genes, projection};
        const std::size_t unmade = kernel::gene_clocks_find_unmade(
            clock.stamp().value, static_cast<std::uint32_t>(clock.robot()), marks, marks.size());
        if (unmade < marks.size()) {
            if (!conflicting_mark_) {
                conflicting_mark_ = Mark{marks[unmade].counter, clock.robot()};
            }
            return Admission::identity_conflict;
        }
        return clock.observe_within(allowance_, stamp);
    }

    Counter allowance_;
    Counter per_cycle_;
    AdmissionCounts counts_;
    std::optional<Mark> conflicting_mark_;
};
using AdmissionGate = BasicAdmissionGate<std::uint64_t>;

}  // namespace gene_clocks
