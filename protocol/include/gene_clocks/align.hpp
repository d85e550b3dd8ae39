#pragma once

#include <gene_clocks/kernel.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gene_clocks/marks.hpp>

namespace gene_clocks {

/// How a gene stands in the alignment of two genomes (paper, section 3.2).
enum class GeneMatch : std::uint8_t {
    /// The mark is in both genomes.
    matching = kernel::gene_clocks_matching,
    /// Only in the first, below the second's last mark.
    disjoint_first = kernel::gene_clocks_disjoint_first,
    /// Only in the second, below the first's last mark.
    disjoint_second = kernel::gene_clocks_disjoint_second,
    /// Only in the first, beyond the second's last mark.
    excess_first = kernel::gene_clocks_excess_first,
    /// Only in the second, beyond the first's last mark.
    excess_second = kernel::gene_clocks_excess_second,
};

/// Aligns two genomes by their marks in one linear pass, without allocation.
///
/// `first` and `second` are sorted by mark, without repetition, after `projection`.
/// `visit(match, i, j)` is called once for every gene, in mark order, with the gene's index: both
/// indices are valid for `matching`, else only the one on the gene's own side. Excess lies on one
/// side only: with the genome whose *last mark* is larger, which need not be the longer one.
template <class First, class Second, class Visit, class Projection = std::identity>
requires MarkedGenes<First, Projection> && MarkedGenes<Second, Projection> &&
    std::same_as<MarkOf<First, Projection>, MarkOf<Second, Projection>> &&
    std::invocable<Visit&, GeneMatch, std::size_t, std::size_t>
constexpr void align(const First& first, const Second& second, Visit visit,
                     Projection projection = {}) {
    detail::Marks<First, Projection> a{first, projection};
    detail::Marks<Second, Projection> b{second, projection};
    auto report = [&visit](kernel::gene_clocks_match match, std::size_t i, std::size_t j) {
        visit(static_cast<GeneMatch>(match), i, j);
    };
    kernel::gene_clocks_align(a, a.size(), b, b.size(), report);
}

}  // namespace gene_clocks
