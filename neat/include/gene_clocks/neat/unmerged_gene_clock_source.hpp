#pragma once

#include <gene_clocks/neat/gene_clock_source.hpp>

namespace gene_clocks::neat {

/// A gene clock without the maximum on reception, for comparison: what the merge is for shows where
/// it is left out. Marks are still unique, but no longer ordered as cause and effect.
class UnmergedGeneClockSource final : public GeneClockSource {
public:
    using GeneClockSource::GeneClockSource;

    Stamp stamp() const override { return {}; }
    bool observe(Stamp) override { return true; }
};

}  // namespace gene_clocks::neat
