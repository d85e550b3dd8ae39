#pragma once

#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/source_parts.hpp>

namespace gene_clocks::neat {

/// Marks genes with a gene clock (paper, section 3.1).
///
/// Its counter lives in memory only, and it trusts whom it hears: for simulations. A robot uses
/// DurableGeneClockSource.
class GeneClockSource : public InnovationSource {
public:
    /// Preconditions: those of GeneClock.
    GeneClockSource(RobotId robot, std::uint64_t genesis_count, GeneClock::Limits limits = {})
        : clock_(robot, genesis_count, limits) {}
    explicit GeneClockSource(const SourceParts& parts)
        : GeneClockSource(parts.robot, parts.genesis_count) {}

    std::optional<SplitMarks> mark_split(const Genome&, std::size_t, double) override {
        return mint_split(clock_);
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds&,
                                                    double) override {
        return clock_.mint();
    }
    Stamp stamp() const override { return clock_.stamp(); }
    bool observe(Stamp stamp) override { return clock_.observe(stamp); }

private:
    GeneClock clock_;
};

}  // namespace gene_clocks::neat
