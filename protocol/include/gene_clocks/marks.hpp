#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <gene_clocks/innovation_number.hpp>
#include <iterator>
#include <ranges>
#include <type_traits>

namespace gene_clocks {

namespace detail {
template <class T>
inline constexpr bool is_innovation_number = false;
template <class Counter>
inline constexpr bool is_innovation_number<BasicInnovationNumber<Counter>> = true;
}  // namespace detail

/// The mark that `projection` reads off the genes of a range.
template <class Genes, class Projection>
using MarkOf = std::remove_cvref_t<
    std::invoke_result_t<Projection&, std::ranges::range_reference_t<const Genes&>>>;

/// A range of genes, each of which has an innovation number under `projection`.
template <class Genes, class Projection>
concept MarkedGenes = std::ranges::forward_range<const Genes> &&
    detail::is_innovation_number<MarkOf<Genes, Projection>>;

namespace detail {

/// Lets the kernel read marks by index off any forward range.
///
/// Invariant: the kernel's loops never go back, so without random access an iterator that follows
/// the index is enough, and reading all marks stays linear.
template <class Genes, class Projection>
requires MarkedGenes<Genes, Projection>
class Marks {
public:
    constexpr Marks(const Genes& genes, Projection& projection)
        : projection_{projection},
          iterator_{std::ranges::begin(genes)},
          size_{static_cast<std::size_t>(std::ranges::distance(genes))} {}

    [[nodiscard]] constexpr std::size_t size() const { return size_; }

    constexpr auto operator[](std::size_t index) {
        using Iterator = std::ranges::iterator_t<const Genes>;
        if constexpr (std::random_access_iterator<Iterator>) {
            return mark(iterator_[static_cast<std::iter_difference_t<Iterator>>(index)]);
        } else {
            for (; position_ < index; ++position_) ++iterator_;
            return mark(*iterator_);
        }
    }

private:
    template <class Gene>
    constexpr auto mark(Gene&& gene) {
        return std::invoke(projection_, std::forward<Gene>(gene)).kernel_mark();
    }

    Projection& projection_;
    std::ranges::iterator_t<const Genes> iterator_;
    std::size_t position_ = 0;
    std::size_t size_;
};

}  // namespace detail
}  // namespace gene_clocks
