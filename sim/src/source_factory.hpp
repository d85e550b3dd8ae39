#pragma once

#include <cstdint>
#include <memory>

#include "gene_clocks/neat/global_counter_source.hpp"
#include "gene_clocks/neat/innovation_source.hpp"
#include "gene_clocks/neat/local_time.hpp"
#include "gene_clocks/neat/random.hpp"
#include "gene_clocks/sim/settings.hpp"

namespace gene_clocks::sim {

/// Makes the innovation sources of one run's robots, with what they share.
class SourceFactory {
public:
    /// `settings` must outlive the factory. Genes 1…genesis_count are the initial ones.
    SourceFactory(const Settings& settings, std::uint64_t genesis_count, std::uint64_t seed);

    /// To be called for robots 1, 2, … in turn, since each draws its clock's faults.
    std::unique_ptr<neat::InnovationSource> make(RobotId robot);

private:
    neat::LocalTime draw_local_time(RobotId robot);

    const Settings& settings_;
    std::uint64_t genesis_count_;
    std::uint64_t seed_;
    neat::RandomStream clock_random_;
    std::shared_ptr<neat::InnovationRecord> record_;  // global counter only
};

}  // namespace gene_clocks::sim
