#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <forward_list>
#include <gene_clocks/align.hpp>
#include <list>
#include <map>
#include <ostream>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "tests/support/marks.hpp"
#include "tests/support/property.hpp"

namespace gene_clocks {

std::ostream& operator<<(std::ostream& out, GeneMatch match) {
    constexpr std::array names{"matching", "disjoint_first", "disjoint_second", "excess_first",
                               "excess_second"};
    return out << names.at(static_cast<std::size_t>(match));
}

namespace {

struct Visit {
    GeneMatch match;
    std::size_t first;
    std::size_t second;
    friend bool operator==(const Visit&, const Visit&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Visit& visit) {
        return out << visit.match << '(' << visit.first << ", " << visit.second << ')';
    }
};

template <class First, class Second, class... Projection>
std::vector<Visit> alignment_of(const First& first, const Second& second,
                                Projection... projection) {
    std::vector<Visit> visits;
    align(
        first, second,
        [&](GeneMatch match, std::size_t i, std::size_t j) {
            visits.push_back({match, i, j});
        },
        projection...);
    return visits;
}

// The definition, without a merge: sets of marks and their maxima.
std::map<InnovationNumber, GeneMatch> naive(const std::vector<InnovationNumber>& first,
                                            const std::vector<InnovationNumber>& second) {
    const std::set<InnovationNumber> a(first.begin(), first.end());
    const std::set<InnovationNumber> b(second.begin(), second.end());
    const auto alone = [](const std::set<InnovationNumber>& others, InnovationNumber mark,
                          GeneMatch disjoint, GeneMatch excess) {
        return others.empty() || *others.rbegin() < mark ? excess : disjoint;
    };
    std::map<InnovationNumber, GeneMatch> matches;
    for (const auto mark : a) {
        matches[mark] = b.contains(mark)
                            ? GeneMatch::matching
                            : alone(b, mark, GeneMatch::disjoint_first, GeneMatch::excess_first);
    }
    for (const auto mark : b) {
        if (a.contains(mark)) continue;
        matches[mark] = alone(a, mark, GeneMatch::disjoint_second, GeneMatch::excess_second);
    }
    return matches;
}

constexpr InnovationNumber mark(std::uint64_t counter, std::uint32_t robot = 1) {
    return {counter, RobotId{robot}};
}

// Decided while compiling, so it runs in constant expressions.
constexpr int constant_matches() {
    constexpr std::array first{mark(1), mark(2), mark(5)};
    constexpr std::array second{mark(2), mark(3)};
    int code = 0;
    align(first, second, [&](GeneMatch match, std::size_t, std::size_t) {
        code = code * 10 + static_cast<int>(match);
    });
    return code;
}
static_assert(constant_matches() == 1023);

TEST(Align, ClassifiesEveryKindInMarkOrder) {
    const std::vector first{mark(1), mark(2), mark(4), mark(6), mark(7)};
    const std::vector second{mark(1), mark(3), mark(4)};
    EXPECT_EQ(alignment_of(first, second), (std::vector<Visit>{{GeneMatch::matching, 0, 0},
                                                               {GeneMatch::disjoint_first, 1, 1},
                                                               {GeneMatch::disjoint_second, 2, 1},
                                                               {GeneMatch::matching, 2, 2},
                                                               {GeneMatch::excess_first, 3, 3},
                                                               {GeneMatch::excess_first, 4, 3}}));
}

TEST(Align, ExcessBelongsToTheLargerLastMarkNotToTheLongerGenome) {
    const std::vector longer{mark(1), mark(2), mark(3)};
    const std::vector shorter{mark(9)};
    EXPECT_EQ(alignment_of(longer, shorter).back(), (Visit{GeneMatch::excess_second, 3, 0}));
}

TEST(Align, EqualCountersOfTwoRobotsDoNotMatch) {
    EXPECT_EQ(
        alignment_of(std::vector{mark(1, 1)}, std::vector{mark(1, 2)}),
        (std::vector<Visit>{{GeneMatch::disjoint_first, 0, 0}, {GeneMatch::excess_second, 1, 0}}));
}

TEST(Align, AllGenesOfAGenomeAreExcessBesideAnEmptyOne) {
    const std::vector<InnovationNumber> none;
    EXPECT_TRUE(alignment_of(none, none).empty());
    EXPECT_EQ(alignment_of(std::vector{mark(1)}, none),
              (std::vector<Visit>{{GeneMatch::excess_first, 0, 0}}));
    EXPECT_EQ(alignment_of(none, std::vector{mark(1)}),
              (std::vector<Visit>{{GeneMatch::excess_second, 0, 0}}));
}

TEST(Align, ReadsMarksThroughAProjection) {
    struct Gene {
        double weight;
        InnovationNumber mark;
    };
    const std::vector<Gene> first{{0.5, mark(1)}, {0.25, mark(2)}};
    const std::vector<Gene> second{{0.75, mark(2)}};
    EXPECT_EQ(alignment_of(first, second, &Gene::mark),
              (std::vector<Visit>{{GeneMatch::disjoint_first, 0, 0}, {GeneMatch::matching, 1, 0}}));
}

GENE_CLOCKS_PROPERTY(AlignProperty, AgreesWithSets, ()) {
    const auto [first, second] = *test::genome_pairs();
    std::map<InnovationNumber, GeneMatch> seen;
    for (const auto& [match, i, j] : alignment_of(first, second)) {
        const bool is_second =
            match == GeneMatch::disjoint_second || match == GeneMatch::excess_second;
        const auto place = is_second ? second.at(j) : first.at(i);
        if (match == GeneMatch::matching) RC_ASSERT(second.at(j) == place);
        RC_ASSERT((seen.empty() || seen.rbegin()->first < place));  // once each, in mark order
        seen[place] = match;
    }
    const auto expected = naive(first, second);
    RC_ASSERT(seen == expected);
    RC_CLASSIFY(expected.size() > 10, "more than ten genes");
}

GENE_CLOCKS_PROPERTY(AlignProperty, IsSymmetric, ()) {
    const auto [first, second] = *test::genome_pairs();
    auto mirrored = alignment_of(second, first);
    for (auto& visit : mirrored) {
        std::swap(visit.first, visit.second);
        constexpr std::array mirror{GeneMatch::matching, GeneMatch::disjoint_second,
                                    GeneMatch::disjoint_first, GeneMatch::excess_second,
                                    GeneMatch::excess_first};
        visit.match = mirror.at(static_cast<std::size_t>(visit.match));
    }
    RC_ASSERT(mirrored == alignment_of(first, second));
}

// The kernel reads by index; ranges that can only be walked must give the same.
GENE_CLOCKS_PROPERTY(AlignProperty, DoesNotDependOnTheKindOfRange, ()) {
    const auto [first, second] = *test::genome_pairs();
    const auto expected = alignment_of(first, second);
    const std::forward_list forward(first.begin(), first.end());
    const std::list bidirectional(second.begin(), second.end());
    RC_ASSERT(alignment_of(forward, bidirectional) == expected);
    RC_ASSERT(alignment_of(std::span(first), bidirectional) == expected);
    RC_ASSERT(alignment_of(forward, std::span(second)) == expected);
}

}  // namespace
}  // namespace gene_clocks
