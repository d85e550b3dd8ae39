#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <ranges>

namespace gene_clocks {

/// How a gene stands in the alignment of two genomes (paper, section 3.2).
enum class GeneMatch : std::uint8_t {
    matching,         ///< the mark is in both genomes
    disjoint_first,   ///< only in the first, below the second's last mark
    disjoint_second,  ///< only in the second, below the first's last mark
    excess_first,     ///< only in the first, beyond the second's last mark
    excess_second,    ///< only in the second, beyond the first's last mark
};

/// Aligns two genomes by their marks in one linear pass, without allocation.
///
/// `first` and `second` are sorted by mark, without repetition, after `projection`.
/// `visit(match, i, j)` is called once for every gene, in mark order, with the gene's index: both
/// indices are valid for `matching`, else only the one on the gene's own side. Excess lies on one
/// side only: with the genome whose *last mark* is larger, which need not be the longer one.
///
template <std::ranges::forward_range First, std::ranges::forward_range Second, class Visit,
          class Projection = std::identity>
constexpr void align(const First& first, const Second& second, Visit visit,
                     Projection projection = {}) {
    auto a = std::ranges::begin(first);
    auto b = std::ranges::begin(second);
    const auto a_end = std::ranges::end(first);
    const auto b_end = std::ranges::end(second);
    std::size_t i = 0;
    std::size_t j = 0;
    while (a != a_end && b != b_end) {
        const auto& mark_a = std::invoke(projection, *a);
        const auto& mark_b = std::invoke(projection, *b);
        if (mark_a == mark_b) {
            visit(GeneMatch::matching, i++, j++);
            ++a;
            ++b;
        } else if (mark_a < mark_b) {
            visit(GeneMatch::disjoint_first, i++, j);
            ++a;
        } else {
            visit(GeneMatch::disjoint_second, i, j++);
            ++b;
        }
    }
    for (; a != a_end; ++a) visit(GeneMatch::excess_first, i++, j);
    for (; b != b_end; ++b) visit(GeneMatch::excess_second, i, j++);
}

}  // namespace gene_clocks
