#pragma once

#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <variant>

/// Traces: what a run of the protocol leaves behind, as docs/trace-format.md describes it and
/// proofs/theories/Trace.v defines it.
namespace gene_clocks::trace {

/// What the whole fleet shares. Invariant of a well-formed trace: genesis_count < maximum.
struct FleetLimits {
    std::uint64_t maximum{};
    std::uint64_t window{};
    std::uint64_t genesis_count{};
};

/// Made `count` genes, with the counters from `first`.
struct Mints {
    RobotId robot{};
    std::uint64_t first{};
    std::uint64_t count{};
};

/// Sent a message with a genome whose largest counter is `newest`.
struct Sends {
    RobotId robot{};
    Stamp stamp;
    std::uint64_t newest{};
};

/// Accepted the trace's `message`-th message, counted from 0; its clock then stands at `next`.
struct Receives {
    RobotId robot{};
    std::uint64_t message{};
    Stamp next;
};

/// `value` reached its stable storage.
struct Stores {
    RobotId robot{};
    std::uint64_t value{};
};

/// Restarted after a crash; its clock goes on from `next`.
struct Restarts {
    RobotId robot{};
    Stamp next;
};

using Entry = std::variant<Mints, Sends, Receives, Stores, Restarts>;

}  // namespace gene_clocks::trace
