#pragma once

#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/source_parts.hpp>

namespace gene_clocks::neat {

/// Marks genes with local timestamps, as odNEAT does (paper, section 2).
///
/// Simulated time, in ticks of 2^-20 cycles, read anew for each gene; two genes of one robot
/// never share a tick. Equal ticks of two robots are told apart by the robot's id. Local times of
/// 2^43 cycles and more cannot be told: then nothing is marked.
class TimestampSource final : public InnovationSource {
public:
    /// Time starts above the genesis marks 1…genesis_count, for negative offsets too.
    TimestampSource(RobotId robot, std::uint64_t genesis_count, LocalTime time)
        : time_(time), last_tick_(genesis_count), robot_(robot) {}
    explicit TimestampSource(const SourceParts& parts)
        : TimestampSource(parts.robot, parts.genesis_count, parts.time) {}

    std::optional<SplitMarks> mark_split(const Genome&, std::size_t, double now_cycles) override {
        const auto neuron = read(now_cycles);
        const auto incoming = read(now_cycles);
        const auto outgoing = read(now_cycles);
        if (!neuron || !incoming || !outgoing) return std::nullopt;
        return SplitMarks{*neuron, *incoming, *outgoing};
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds&,
                                                    double now_cycles) override {
        return read(now_cycles);
    }

private:
    std::optional<InnovationNumber> read(double now_cycles) {
        constexpr double ticks_per_cycle = 1 << 20;
        // Cycle zero of a synchronised clock reads as this, so that offsets down to minus 2^31
        // cycles stay positive.
        constexpr double epoch_cycles = 0x1p31;
        const double ticks = ticks_per_cycle * (epoch_cycles + time_.at(now_cycles));
        if (!(ticks < 0x1p63)) return std::nullopt;
        const auto tick = static_cast<std::uint64_t>(ticks > 0.0 ? ticks : 0.0);
        last_tick_ = tick > last_tick_ ? tick : last_tick_ + 1;
        return InnovationNumber{last_tick_, robot_};
    }

    LocalTime time_;
    std::uint64_t last_tick_;
    RobotId robot_;
};

}  // namespace gene_clocks::neat
