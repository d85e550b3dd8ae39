#pragma once

#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/source_parts.hpp>

namespace gene_clocks::neat {

/// A new neuron draws its identifier from 1…1000, and a connection is known by the neurons that it
/// joins, as in IM-(mu+1) (Schwarzer et al. 2012). Robots may draw the same identifier for
/// different neurons; selection has to cope. Within one genome the draw is repeated until it is
/// new.
class RandomIdentifierSource final : public InnovationSource {
public:
    /// Identifiers begin above the genesis marks 1…genesis_count.
    RandomIdentifierSource(std::uint64_t genesis_count, RandomStream random)
        : genesis_count_(genesis_count), random_(random) {}
    explicit RandomIdentifierSource(const SourceParts& parts)
        : RandomIdentifierSource(parts.genesis_count, parts.random) {}

    /// nullopt where all identifiers are in the genome.
    std::optional<SplitMarks> mark_split(const Genome& genome, std::size_t connection,
                                         double) override {
        const Topology& topology = *genome.topology;
        if (topology.neurons.size() >= identifiers) return std::nullopt;
        InnovationNumber neuron;
        do {
            neuron = {genesis_count_ + 1 + random_.below(identifiers), no_robot};
        } while (topology.find_neuron(neuron));
        const ConnectionEnds& ends = topology.connection_ends[connection];
        return SplitMarks{neuron, mark_of(ends.source, neuron), mark_of(neuron, ends.target)};
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds& ends,
                                                    double) override {
        return mark_of(ends.source, ends.target);
    }

private:
    static constexpr std::uint32_t identifiers = 1000;

    /// Its own for every pair of neurons: their counters as the digits of one number.
    InnovationNumber mark_of(InnovationNumber source, InnovationNumber target) const {
        const std::uint64_t base = genesis_count_ + identifiers + 1;
        return {base + source.counter * base + target.counter, no_robot};
    }

    std::uint64_t genesis_count_;
    RandomStream random_;
};

}  // namespace gene_clocks::neat
