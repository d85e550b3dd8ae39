#pragma once

#include "gene_clocks/gene_clock.hpp"
#include "gene_clocks/neat/innovation_source.hpp"

namespace gene_clocks::neat {

/// A gene clock without the maximum on reception, for comparison: what the merge is for shows where
/// it is left out. Marks are still unique, but no longer ordered as cause and effect.
class UnmergedGeneClockSource final : public InnovationSource {
public:
    /// Preconditions: those of GeneClock.
    UnmergedGeneClockSource(RobotId robot, std::uint64_t genesis_count)
        : clock_(robot, genesis_count) {}

    std::optional<SplitMarks> mark_split(const Genome&, std::size_t, double) override {
        const auto marks = clock_.mint(3);
        if (!marks) return std::nullopt;
        return SplitMarks{(*marks)[0], (*marks)[1], (*marks)[2]};
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds&,
                                                    double) override {
        return clock_.mint();
    }
    Stamp stamp() const override { return {}; }
    bool observe(Stamp) override { return true; }

private:
    GeneClock clock_;
};

}  // namespace gene_clocks::neat
