#pragma once

#include <cstdint>
#include <gene_clocks/gene_clock.hpp>
#include <ostream>
#include <string>

#include "protocol/trace/trace_entry.hpp"

namespace gene_clocks::trace {

/// Writes a trace as it happens. Not thread-safe: one run, one writer.
///
/// Entries must come in an order in which they could have happened one after the other.
class TraceWriter {
public:
    /// Writes the header. `out` must outlive the writer.
    TraceWriter(std::ostream& out, FleetLimits limits);

    void minted(const GeneClock::Marks& marks);
    /// Returns the message's number, by which receptions refer to it.
    /// `newest` is the largest counter of the genome that it carries.
    std::uint64_t sent(RobotId robot, Stamp stamp, std::uint64_t newest);
    /// Only for messages whose stamp was accepted; `next` is the receiver's stamp afterwards.
    void received(RobotId robot, std::uint64_t message, Stamp next);
    void stored(RobotId robot, std::uint64_t value);
    void restarted(RobotId robot, Stamp next);

    /// Writes the end, without which a trace is malformed. Throws std::runtime_error where anything
    /// could not be written.
    void finish();

private:
    template <class... Numbers>
    void write(char kind, RobotId robot, Numbers... numbers);

    std::ostream& out_;
    std::string buffer_;  ///< entries on their way to out_
    std::uint64_t entries_ = 0;
    std::uint64_t messages_ = 0;
};

}  // namespace gene_clocks::trace
