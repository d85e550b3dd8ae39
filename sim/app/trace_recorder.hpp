#pragma once

#include <cstdint>
#include <gene_clocks/sim/run_observer.hpp>
#include <limits>
#include <unordered_map>

#include "protocol/trace/trace_writer.hpp"

namespace gene_clocks::trace {

/// Writes the trace of a simulated run whose robots mark genes with gene clocks.
///
/// Simulated robots do not crash, and their storage is immediate: what a message needs stored is
/// stored just before it leaves.
class TraceRecorder final : public sim::RunObserver {
public:
    /// `genesis_count`: see sim::genesis_count. `out` must outlive the recorder.
    TraceRecorder(std::ostream& out, std::uint64_t genesis_count)
        : writer_{out,
                  {.maximum = std::numeric_limits<std::uint64_t>::max(),
                   .window = std::numeric_limits<std::uint64_t>::max(),
                   .genesis_count = genesis_count}},
          first_{genesis_count + 1} {}

    void gene_marked(RobotId, InnovationNumber mark, double) override { writer_.minted({mark, 1}); }

    void message_sent(RobotId robot, Stamp stamp, InnovationNumber newest) override {
        std::uint64_t& stored = stored_.try_emplace(robot, first_).first->second;
        if (stored < stamp.value) {
            stored = stamp.value;
            writer_.stored(robot, stored);
        }
        writer_.sent(robot, stamp, newest.counter);
    }

    void message_admitted(RobotId robot, std::uint64_t message, Stamp stamp) override {
        writer_.received(robot, message, stamp);
    }

    /// Ends the trace; see TraceWriter::finish.
    void finish() { writer_.finish(); }

private:
    TraceWriter writer_;
    std::uint64_t first_;  ///< counter of every clock
    std::unordered_map<RobotId, std::uint64_t> stored_;
};

}  // namespace gene_clocks::trace
