#pragma once

#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <gene_clocks/neat/local_time.hpp>
#include <gene_clocks/neat/random.hpp>
#include <memory>

namespace gene_clocks::neat {

class InnovationRecord;

/// What innovation sources of a simulated swarm are made of. Each has a constructor that takes from
/// here what it needs, so that all are made alike.
struct SourceParts {
    RobotId robot{};                           ///< 1 to `robots`
    std::uint64_t robots{};                    ///< in the swarm
    std::uint64_t genesis_count{};             ///< genesis marks are 1…genesis_count
    LocalTime time;                            ///< the robot's physical clock
    RandomStream random;                       ///< this robot's own
    std::shared_ptr<InnovationRecord> record;  ///< the swarm's; not null
};

}  // namespace gene_clocks::neat
