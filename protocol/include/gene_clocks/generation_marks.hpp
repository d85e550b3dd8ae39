#pragma once

#include <cstddef>
#include <cstdint>
#include <gene_clocks/gene_clock.hpp>
#include <map>
#include <optional>

namespace gene_clocks {

/// Gives equal structural mutations of one process and one generation the same marks, as most NEATs
/// do with a list of the generation's innovations.
///
/// It changes nothing else: the first mutation of its kind takes marks from the clock as it would
/// without, the others take none; marks of different mutations, generations or processes differ.
/// What other processes do at the same time keeps its own marks.
///
/// `Key` says which mutations are equal, such as a kind and the ends of a connection; it is ordered
/// by `<`. Remembers one entry for each mutation of the generation.
template <class Key>
class GenerationMarks {
public:
    /// The `count` consecutive marks of this mutation; nullopt where the clock is exhausted, and
    /// nothing changes. Precondition: equal mutations ask for equal counts.
    [[nodiscard]] std::optional<BasicMintedRange<std::uint64_t>> get(const Key& mutation,
                                                                     GeneClock& clock,
                                                                     std::uint64_t count = 1) {
        if (const auto found = marks_.find(mutation); found != marks_.end()) return found->second;
        const auto minted = clock.mint(count);
        if (minted) marks_.emplace(mutation, *minted);
        return minted;
    }

    /// From here on equal mutations are new ones.
    void next_generation() { marks_.clear(); }

    /// Different mutations of this generation.
    [[nodiscard]] std::size_t size() const { return marks_.size(); }

private:
    std::map<Key, BasicMintedRange<std::uint64_t>> marks_;
};

}  // namespace gene_clocks
