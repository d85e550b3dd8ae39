#pragma once

#include <cstdint>
#include <istream>
#include <string>

#include "protocol/trace/trace_checker.hpp"

namespace gene_clocks::trace {

/// What became of a trace.
struct Verdict {
    enum class Outcome : std::uint8_t { accepted = 0, violated = 1, malformed = 2 };

    Outcome outcome{};
    std::uint64_t entries{};  ///< of an accepted trace
    std::uint64_t line{};     ///< the first that breaks a rule or is malformed, from 1
    Violation violation{};    ///< where outcome is violated
    std::string entry;        ///< the line itself, where outcome is violated
    std::string reason;       ///< what is wrong with the line, in words; empty where accepted

    /// The one line of output that docs/trace-format.md prescribes, without its end.
    std::string text() const;
    /// The exit status that goes with it.
    int exit_status() const { return static_cast<int>(outcome); }
};

/// Reads a whole trace, line by line, as far as its first fault.
/// Throws std::runtime_error where the stream fails otherwise than by ending.
Verdict check_trace(std::istream& in);

}  // namespace gene_clocks::trace
