// Differential: align() against the definition of matching, disjoint and excess on sets.

#include <algorithm>
#include <gene_clocks/align.hpp>
#include <gene_clocks/innovation_number.hpp>
#include <set>
#include <vector>

#include "fuzz/byte_reader.hpp"
#include "fuzz/require.hpp"

namespace {

using gene_clocks::GeneMatch;
using gene_clocks::InnovationNumber;
using gene_clocks::RobotId;

struct Visit {
    GeneMatch match;
    InnovationNumber mark;
    friend bool operator==(const Visit&, const Visit&) = default;
};

/// The definition: excess lies beyond the other genome's last mark, disjoint does not.
std::vector<Visit> align_by_definition(const std::set<InnovationNumber>& first,
                                       const std::set<InnovationNumber>& second) {
    std::set<InnovationNumber> all = first;
    all.insert(second.begin(), second.end());
    std::vector<Visit> visits;
    for (const InnovationNumber mark : all) {
        const bool in_first = first.contains(mark);
        if (in_first && second.contains(mark)) {
            visits.push_back({GeneMatch::matching, mark});
            continue;
        }
        const auto& other = in_first ? second : first;
        const bool beyond = other.empty() || *other.rbegin() < mark;
        const auto match = in_first
                               ? (beyond ? GeneMatch::excess_first : GeneMatch::disjoint_first)
                               : (beyond ? GeneMatch::excess_second : GeneMatch::disjoint_second);
        visits.push_back({match, mark});
    }
    return visits;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gene_clocks::fuzz::ByteReader bytes({data, size});
    std::set<InnovationNumber> sets[2];
    while (!bytes.empty()) {
        const std::uint8_t choice = bytes.byte();
        // Few counters and robots, so that marks meet; now and then one from the whole range.
        const std::uint64_t counter = choice & 0x80 ? bytes.word() : bytes.below(24);
        const RobotId robot{choice & 0x40 ? static_cast<std::uint32_t>(bytes.word())
                                          : static_cast<std::uint32_t>(bytes.below(4))};
        if (choice & 1) sets[0].insert({counter, robot});
        if (choice & 2) sets[1].insert({counter, robot});
    }
    const std::vector<InnovationNumber> first(sets[0].begin(), sets[0].end());
    const std::vector<InnovationNumber> second(sets[1].begin(), sets[1].end());
    std::vector<Visit> visits;
    gene_clocks::align(first, second, [&](GeneMatch match, std::size_t i, std::size_t j) {
        const bool in_first =
            match != GeneMatch::disjoint_second && match != GeneMatch::excess_second;
        GENE_CLOCKS_REQUIRE(in_first ? i < first.size() : j < second.size());
        if (match == GeneMatch::matching) GENE_CLOCKS_REQUIRE(first[i] == second[j]);
        visits.push_back({match, in_first ? first[i] : second[j]});
    });
    GENE_CLOCKS_REQUIRE(visits == align_by_definition(sets[0], sets[1]));
    return 0;
}
