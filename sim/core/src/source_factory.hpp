#pragma once

#include <cstdint>
#include <gene_clocks/neat/global_counter_source.hpp>
#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/local_time.hpp>
#include <gene_clocks/neat/random.hpp>
#include <gene_clocks/sim/settings.hpp>
#include <memory>
#include <vector>

namespace gene_clocks::sim {

/// Makes the innovation sources of one run's robots, with what they share.
class SourceFactory {
public:
    /// `settings` must outlive the factory. Genes 1…genesis_count are the initial ones.
    SourceFactory(const Settings& settings, std::uint64_t genesis_count, std::uint64_t seed);

    /// The source of a robot, 1 to `world.robots`, in its initial state. What a robot has lost in
    /// `life` reboots it has not: counters start over; its physical clock keeps its faults, as a
    /// clock with a battery does; and identifiers are drawn anew, since no robot draws twice the
    /// same.
    std::unique_ptr<neat::InnovationSource> make(RobotId robot, std::uint64_t life = 0) const;

private:
    std::vector<neat::LocalTime> draw_local_times() const;

    const Settings& settings_;
    std::uint64_t genesis_count_;
    std::uint64_t seed_;
    std::vector<neat::LocalTime> local_times_;  // by robot, from 1
    std::shared_ptr<neat::InnovationRecord> record_;
};

}  // namespace gene_clocks::sim
