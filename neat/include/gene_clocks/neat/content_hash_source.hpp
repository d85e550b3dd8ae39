#pragma once

#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/source_parts.hpp>

namespace gene_clocks::neat {

/// A gene's identity is what it changes: the hash of the connection that is split, or of the
/// neurons that are joined. Robots that make the same innovation give it the same mark without a
/// word, and the order of marks says nothing about time.
///
/// The hash is XXH3 (64 bit) of the marks that it depends on. A connection that is split again in
/// one genome counts as another innovation, as does a pair joined the other way round.
class ContentHashSource final : public InnovationSource {
public:
    /// Hashes that fall on a genesis mark 1…genesis_count are drawn again.
    explicit ContentHashSource(std::uint64_t genesis_count) : genesis_count_(genesis_count) {}
    explicit ContentHashSource(const SourceParts& parts) : ContentHashSource(parts.genesis_count) {}

    std::optional<SplitMarks> mark_split(const Genome& genome, std::size_t connection,
                                         double) override;
    std::optional<InnovationNumber> mark_connection(const Genome& genome,
                                                    const ConnectionEnds& ends, double) override;

private:
    std::uint64_t genesis_count_;
};

}  // namespace gene_clocks::neat
