#pragma once

#include <cstddef>
#include <cstdint>

namespace gene_clocks::sim {

/// What a run shows of its marking (docs/markings.md, "Measures of chronology"). Counts, unless a
/// field says otherwise; shares are ratios of two of them.
///
/// "Genes" are innovations: neuron and connection genes that mutations created, not the initial
/// ones. Two genes have the same structure, or are the same innovation, where NEAT's global counter
/// would give them one number (Stanley & Miikkulainen 2002): neurons that split the same connection
/// as often, connections that join the same neurons. "Alignments" are over connection genes, as in
/// the paper (section 3.2).
struct ChronologyMeasures {
    std::uint64_t genes{};

    // Pairs of genes, the earlier one first.
    std::uint64_t pairs{};           ///< all of them
    std::uint64_t caused_pairs{};    ///< the earlier one happened before the later (Lamport 1978)
    std::uint64_t timed_pairs{};     ///< of different cycles, or of one robot
    std::uint64_t cause_inverted{};  ///< caused pairs that the marks sort the other way
    std::uint64_t time_inverted{};   ///< timed pairs that the marks sort the other way

    // Genes with a mark that an earlier gene has.
    std::uint64_t same_collisions{};       ///< all genes of that mark are the same innovation
    std::uint64_t different_collisions{};  ///< some earlier one is another innovation

    // Over the connection genes of each active genome at the end, the initial ones left out.
    std::uint64_t genome_pairs{};     ///< timed pairs within a genome
    std::uint64_t genome_inverted{};  ///< of these, those that the marks sort the other way

    // Over alignments of each genome that is accepted with the receiver's active one.
    std::uint64_t alignments{};
    std::uint64_t matching{};
    std::uint64_t disjoint{};
    std::uint64_t excess{};
    std::uint64_t missed_homologies{};  ///< unmatched genes of the same structure on both sides
    std::uint64_t false_homologies{};   ///< matching genes of different structure

    // Over births with two different parents.
    std::uint64_t crossovers{};
    std::uint64_t crossovers_missed{};    ///< with missed homology between the parents
    std::uint64_t crossovers_false{};     ///< with false homology between the parents
    std::uint64_t crossovers_repeated{};  ///< whose child has some structure twice

    // Counters that the robots would send at the end; 0 where the source sends nothing.
    std::uint64_t stamp_smallest{};
    double stamp_mean{};
    std::uint64_t stamp_largest{};

    // All broadcasts as frames of the wire format, version 1 (docs/wire-format.md), heard or not.
    std::uint64_t bytes_sent{};   ///< bytes; without the stamp where the source sends none
    std::uint64_t stamp_bytes{};  ///< bytes of the stamps among them: what the clock costs
};

/// Calls `visit(name, value)` for each field, in order; `measures` may be const. Every list of what
/// chronology measures comes from here.
template <class Measures, class Visit>
constexpr void for_each_measure(Measures&& measures, Visit visit) {
    visit("genes", measures.genes);
    visit("pairs", measures.pairs);
    visit("caused_pairs", measures.caused_pairs);
    visit("timed_pairs", measures.timed_pairs);
    visit("cause_inverted", measures.cause_inverted);
    visit("time_inverted", measures.time_inverted);
    visit("same_collisions", measures.same_collisions);
    visit("different_collisions", measures.different_collisions);
    visit("genome_pairs", measures.genome_pairs);
    visit("genome_inverted", measures.genome_inverted);
    visit("alignments", measures.alignments);
    visit("matching", measures.matching);
    visit("disjoint", measures.disjoint);
    visit("excess", measures.excess);
    visit("missed_homologies", measures.missed_homologies);
    visit("false_homologies", measures.false_homologies);
    visit("crossovers", measures.crossovers);
    visit("crossovers_missed", measures.crossovers_missed);
    visit("crossovers_false", measures.crossovers_false);
    visit("crossovers_repeated", measures.crossovers_repeated);
    visit("stamp_smallest", measures.stamp_smallest);
    visit("stamp_mean", measures.stamp_mean);
    visit("stamp_largest", measures.stamp_largest);
    visit("bytes_sent", measures.bytes_sent);
    visit("stamp_bytes", measures.stamp_bytes);
}

/// How many measures for_each_measure visits: all fields, each of which takes eight bytes.
inline constexpr std::size_t chronology_measures = [] {
    std::size_t count = 0;
    for_each_measure(ChronologyMeasures{}, [&](const char*, const auto&) { ++count; });
    return count;
}();
static_assert(sizeof(ChronologyMeasures) == chronology_measures * 8,
              "for_each_measure leaves a field out");

}  // namespace gene_clocks::sim
