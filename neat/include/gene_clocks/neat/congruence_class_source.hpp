#pragma once

#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/source_parts.hpp>
#include <limits>

namespace gene_clocks::neat {

/// Robot i of n marks its genes i, i + n, i + 2n, … (Karns & Desell's EXAMM does so): unique
/// without a message, but the number of robots must be known, and nothing is said about who came
/// first.
class CongruenceClassSource final : public InnovationSource {
public:
    /// Preconditions: 1 <= robot <= robots; genesis_count + robots fits 64 bits.
    CongruenceClassSource(RobotId robot, std::uint64_t robots, std::uint64_t genesis_count)
        : next_(genesis_count + static_cast<std::uint64_t>(robot)),
          robots_(robots),
          robot_(robot) {}
    explicit CongruenceClassSource(const SourceParts& parts)
        : CongruenceClassSource(parts.robot, parts.robots, parts.genesis_count) {}

    std::optional<SplitMarks> mark_split(const Genome&, std::size_t, double) override {
        if ((largest - next_) / robots_ < 3) return std::nullopt;
        const InnovationNumber neuron = next();
        const InnovationNumber incoming = next();
        return SplitMarks{neuron, incoming, next()};
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds&,
                                                    double) override {
        if (largest - next_ < robots_) return std::nullopt;
        return next();
    }

private:
    static constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();

    InnovationNumber next() {
        const InnovationNumber mark{next_, robot_};
        next_ += robots_;
        return mark;
    }

    std::uint64_t next_;  // invariant: congruent to the robot's index modulo robots_, over genesis
    std::uint64_t robots_;
    RobotId robot_;
};

}  // namespace gene_clocks::neat
