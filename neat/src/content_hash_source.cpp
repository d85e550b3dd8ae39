#include <gene_clocks/neat/content_hash_source.hpp>

// The hash is compiled in, so that users of this library need not link another.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>

namespace gene_clocks::neat {
namespace {

enum class Kind : std::uint64_t { neuron = 1, connection = 2 };

/// The mark of an innovation that depends on two marks. `repetition` tells apart what would be the
/// same within one genome.
InnovationNumber hash_mark(Kind kind, InnovationNumber a, InnovationNumber b,
                           std::uint64_t repetition, std::uint64_t genesis_count) {
    const auto robot = [](InnovationNumber mark) { return static_cast<std::uint64_t>(mark.robot); };
    std::array<std::uint64_t, 7> content{
        static_cast<std::uint64_t>(kind), a.counter, robot(a), b.counter, robot(b), repetition, 0};
    for (;; ++content.back()) {
        const std::uint64_t hash = XXH3_64bits(content.data(), sizeof content);
        if (hash > genesis_count) return {hash, no_robot};
    }
}

}  // namespace

std::optional<SplitMarks> ContentHashSource::mark_split(const Genome& genome,
                                                        std::size_t connection, double) {
    const Topology& topology = *genome.topology;
    const InnovationNumber split = topology.connection_marks[connection];
    const ConnectionEnds& ends = topology.connection_ends[connection];
    InnovationNumber neuron;
    std::uint64_t repetition = 0;
    do {
        neuron = hash_mark(Kind::neuron, split, {}, repetition++, genesis_count_);
    } while (topology.find_neuron(neuron));
    return SplitMarks{neuron, hash_mark(Kind::connection, ends.source, neuron, 0, genesis_count_),
                      hash_mark(Kind::connection, neuron, ends.target, 0, genesis_count_)};
}

std::optional<InnovationNumber> ContentHashSource::mark_connection(const Genome&,
                                                                   const ConnectionEnds& ends,
                                                                   double) {
    return hash_mark(Kind::connection, ends.source, ends.target, 0, genesis_count_);
}

}  // namespace gene_clocks::neat
