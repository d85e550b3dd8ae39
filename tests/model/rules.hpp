#pragma once

#include <cstdint>
#include <gene_clocks/admission_gate.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

/// The rules of the protocol, each in a place of its own, so that one at a time can be broken. They
/// are those of the record `rules` in proofs/theories/Protocol.v, and run the shipped clock.
namespace gene_clocks::model {

using Counter = std::uint8_t;
using Clock = BasicGeneClock<Counter>;
using Gate = BasicAdmissionGate<Counter>;
using Mark = BasicInnovationNumber<Counter>;
using Stamp = BasicStamp<Counter>;
using Genes = std::span<const Mark>;

/// Gene Clocks as it is meant.
struct GeneClocks {
    static constexpr const char* name = "gene clocks";

    /// The admission window, as the deployment set it.
    static Counter window(Counter set) { return set; }
    /// A message carries the next unused counter.
    static Stamp stamp_of(const Clock& clock) { return clock.stamp(); }
    /// A receiver takes the maximum, or drops the message whole.
    static bool merge(Clock& clock, Stamp stamp, Genes genes) {
        return clock.observe(stamp, genes);
    }
    /// Without its genes a message is no more than its stamp.
    static bool merge_stamp(Clock& clock, Stamp stamp) { return clock.observe(stamp); }
    /// Behind a gate a receiver also asks what has been earned, and whose the genes are.
    static bool pass(Gate& gate, Clock& clock, Stamp stamp, Genes genes) {
        return gate.admit(clock, stamp, genes) == Admission::admitted;
    }
    /// Nothing leaves a robot before what it needs is on stable storage.
    static bool may_send(const Clock& clock, Counter stored) {
        return clock.durable_needed() <= stored;
    }
    /// After a crash the clock goes on from what was stored …
    static std::optional<Clock> resume(RobotId robot, Counter stored, Clock::Limits limits) {
        return Clock::restart(robot, stored, 0, limits);
    }
    /// … and a stored gene at or above that is dropped.
    static bool retains(Mark gene, Counter stored) { return gene.counter < stored; }
    /// Genes are sorted by counter first.
    static bool before(Mark a, Mark b) { return a < b; }
};

// ---- One rule broken at a time. None may hold. ------------------------------------------------

struct NoMerge : GeneClocks {
    static constexpr const char* name = "genes are accepted without merging the stamp";
    static bool merge(Clock&, Stamp, Genes) { return true; }
};

struct LastUsed : GeneClocks {
    static constexpr const char* name = "the last used counter is sent, and nothing is added";
    // A receiver that checks the genes would refuse all that is sent.
    static Stamp stamp_of(const Clock& clock) {
        return {static_cast<Counter>(clock.stamp().value - 1)};
    }
    static bool merge(Clock& clock, Stamp stamp, Genes) { return clock.observe(stamp); }
};

struct SendBeforeFlush : GeneClocks {
    static constexpr const char* name = "messages leave before the counter is stored";
    static bool may_send(const Clock&, Counter) { return true; }
};

struct VolatileCounter : GeneClocks {
    static constexpr const char* name = "after a crash the clock starts afresh";
    static std::optional<Clock> resume(RobotId robot, Counter, Clock::Limits limits) {
        return Clock{robot, 0, limits};
    }
};

struct RobotFirst : GeneClocks {
    static constexpr const char* name = "genes are sorted by robot first";
    static bool before(Mark a, Mark b) {
        return std::tie(a.robot, a.counter) < std::tie(b.robot, b.counter);
    }
};

struct NoWindow : GeneClocks {
    static constexpr const char* name = "there is no admission window";
    static Counter window(Counter) { return std::numeric_limits<Counter>::max(); }
};

struct SpendsNothing : GeneClocks {
    static constexpr const char* name = "receptions are not paid for out of the allowance";
    static bool pass(Gate& gate, Clock& clock, Stamp stamp, Genes genes) {
        Gate copy = gate;
        return copy.admit(clock, stamp, genes) == Admission::admitted;
    }
};

struct KeepsAllGenes : GeneClocks {
    static constexpr const char* name =
        "genes at or above the stored counter are kept over a crash";
    static bool retains(Mark, Counter) { return true; }
};

}  // namespace gene_clocks::model
