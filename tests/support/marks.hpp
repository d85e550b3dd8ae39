#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/innovation_number.hpp>
#include <ostream>
#include <set>
#include <utility>
#include <vector>

namespace gene_clocks {

template <std::unsigned_integral Counter>
std::ostream& operator<<(std::ostream& out, BasicInnovationNumber<Counter> mark) {
    return out << '<' << std::uint64_t{mark.counter} << ", robot "
               << static_cast<std::uint32_t>(mark.robot) << '>';
}

template <std::unsigned_integral Counter>
std::ostream& operator<<(std::ostream& out, BasicStamp<Counter> stamp) {
    return out << "stamp " << std::uint64_t{stamp.value};
}

namespace test {

/// Counters where trouble is likely: few distinct ones, around zero and around the maximum.
template <std::unsigned_integral Counter>
rc::Gen<Counter> counters() {
    constexpr Counter last = std::numeric_limits<Counter>::max();
    return rc::gen::oneOf(rc::gen::inRange<Counter>(0, 8), rc::gen::arbitrary<Counter>(),
                          rc::gen::map(rc::gen::inRange<Counter>(0, 8), [](Counter distance) {
                              return static_cast<Counter>(last - distance);
                          }));
}

inline rc::Gen<RobotId> robots() {
    return rc::gen::map(
        rc::gen::oneOf(rc::gen::inRange<std::uint32_t>(0, 5), rc::gen::arbitrary<std::uint32_t>()),
        [](std::uint32_t id) { return RobotId{id}; });
}

/// Two genomes: each is sorted and repeats no mark, and most marks are in both.
using GenomePair = std::pair<std::vector<InnovationNumber>, std::vector<InnovationNumber>>;

inline rc::Gen<GenomePair> genome_pairs() {
    const auto pool =
        rc::gen::container<std::set<InnovationNumber>>(rc::gen::construct<InnovationNumber>(
            rc::gen::oneOf(rc::gen::inRange<std::uint64_t>(0, 30), counters<std::uint64_t>()),
            robots()));
    return rc::gen::mapcat(pool, [](const std::set<InnovationNumber>& marks) {
        const auto owners =
            rc::gen::container<std::vector<int>>(marks.size(), rc::gen::element(0, 0, 0, 1, 2));
        return rc::gen::map(owners, [marks](const std::vector<int>& owner) {
            GenomePair genomes;
            auto which = owner.begin();
            for (const auto& mark : marks) {
                if (*which != 2) genomes.first.push_back(mark);
                if (*which != 1) genomes.second.push_back(mark);
                ++which;
            }
            return genomes;
        });
    });
}

}  // namespace test
}  // namespace gene_clocks

namespace rc {

template <std::unsigned_integral Counter>
struct Arbitrary<gene_clocks::BasicInnovationNumber<Counter>> {
    static Gen<gene_clocks::BasicInnovationNumber<Counter>> arbitrary() {
        return gen::construct<gene_clocks::BasicInnovationNumber<Counter>>(
            gene_clocks::test::counters<Counter>(), gene_clocks::test::robots());
    }
};

}  // namespace rc
