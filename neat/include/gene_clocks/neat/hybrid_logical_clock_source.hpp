#pragma once

#include <algorithm>
#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/source_parts.hpp>

namespace gene_clocks::neat {

/// Marks genes with a hybrid logical clock (Kulkarni et al. 2014): physical time where clocks
/// agree, a logical clock where they do not, so that cause comes before effect however they drift.
///
/// A reading is local time in ticks of 2^-10 cycles, shifted by 16 bits that count what happens
/// within a tick; more than 65 536 genes in one carry into the time. Messages carry the last
/// reading. Only genes are events: sending and receiving take no reading of their own.
class HybridLogicalClockSource final : public InnovationSource {
public:
    /// Time starts above the genesis marks 1…genesis_count, for negative offsets too.
    HybridLogicalClockSource(RobotId robot, std::uint64_t genesis_count, LocalTime time)
        : time_(time), last_(genesis_count), robot_(robot) {}
    explicit HybridLogicalClockSource(const SourceParts& parts)
        : HybridLogicalClockSource(parts.robot, parts.genesis_count, parts.time) {}

    std::optional<SplitMarks> mark_split(const Genome&, std::size_t, double now_cycles) override {
        if (!advance(now_cycles, 3)) return std::nullopt;
        return SplitMarks{{last_ - 2, robot_}, {last_ - 1, robot_}, {last_, robot_}};
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds&,
                                                    double now_cycles) override {
        if (!advance(now_cycles, 1)) return std::nullopt;
        return InnovationNumber{last_, robot_};
    }
    Stamp stamp() const override { return {last_}; }
    /// False for a reading that leaves no room above it.
    bool observe(Stamp stamp) override {
        if (stamp.value >= limit) return false;
        last_ = std::max(last_, stamp.value);
        return true;
    }

private:
    static constexpr std::uint64_t limit = std::uint64_t{1} << 63;

    /// Takes `genes` readings; false where they cannot be told, and nothing changes.
    bool advance(double now_cycles, std::uint64_t genes) {
        constexpr double readings_per_cycle = 0x1p26;
        // Cycle zero of a synchronised clock, so that offsets down to minus 2^31 stay positive.
        constexpr double epoch_cycles = 0x1p31;
        const double readings = readings_per_cycle * (epoch_cycles + time_.at(now_cycles));
        if (!(readings < 0x1p62)) return false;
        // The logical bits of a reading off the physical clock are zero.
        const std::uint64_t physical =
            static_cast<std::uint64_t>(readings > 0.0 ? readings : 0.0) & ~std::uint64_t{0xffff};
        const std::uint64_t first = std::max(physical, last_ + 1);
        if (first >= limit - genes) return false;
        last_ = first + genes - 1;
        return true;
    }

    LocalTime time_;
    std::uint64_t last_;  // invariant: below limit
    RobotId robot_;
};

}  // namespace gene_clocks::neat
