#pragma once

#include <array>
#include <cstdint>
#include <gene_clocks/neat/distance_measure.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <memory>
#include <vector>

namespace gene_clocks::neat {

/// Recent poor genomes: those that ran out of energy or were dropped from a full population
/// (paper, section 3.2). Received genomes that resemble one of them are refused.
class TabuList {
public:
    explicit TabuList(const OdneatSettings& settings)
        : measure_(settings),
          threshold_(static_cast<float>(settings.tabu_threshold)),
          lifetime_receptions_(settings.tabu_receptions) {}

    /// Lists a genome, or renews it where it is listed already.
    void add(std::shared_ptr<const Genome> genome);

    /// Whether no entry resembles a received genome. Every entry is looked at: one that does is
    /// renewed, every other grows older by one reception, and leaves at the end of its lifetime.
    bool approves(const Genome& received);

    std::size_t size() const { return entries_.size(); }

private:
    // A robot hears the same few neighbours many times in a row: an entry remembers its last
    // comparison with a genome of each of four residues of the maker's id.
    struct Comparison {
        GenomeId with;
        bool similar;
    };
    struct Entry {
        std::shared_ptr<const Genome> genome;
        std::int64_t receptions_left;
        std::array<Comparison, 4> compared;
    };

    bool is_similar(Entry& entry, const Genome& received) const;

    DistanceMeasure measure_;
    float threshold_;
    std::int64_t lifetime_receptions_;
    std::vector<Entry> entries_;  // invariant: no genome is listed twice; receptions_left > 0
};

}  // namespace gene_clocks::neat
