#pragma once

#include <cstdint>
#include <gene_clocks/innovation_number.hpp>

namespace gene_clocks::sim {

struct SwarmView;

/// Told of everything that marking sees in a run, in the order in which it happens; to write a
/// trace, say. A run without an observer pays nothing for it.
class RunObserver {
public:
    virtual ~RunObserver() = default;

    /// A robot marked a new gene at time `now_cycles`.
    virtual void gene_marked(RobotId robot, InnovationNumber mark, double now_cycles) = 0;

    /// A robot broadcast its active genome, whose last mark is `newest`. Messages are numbered from
    /// 0, in the order in which they are sent, whether or not anybody receives them.
    virtual void message_sent(RobotId robot, Stamp stamp, InnovationNumber newest) = 0;

    /// A robot's innovation source admitted a message; `stamp` is what the robot would send next.
    virtual void message_admitted(RobotId robot, std::uint64_t message, Stamp stamp) = 0;

    /// The swarm before every cycle, once items have reappeared, and after the last one.
    virtual void between_cycles(const SwarmView&) {}
};

}  // namespace gene_clocks::sim
