// kernel.h is one text that two languages read. A C compiler's reading and a C++ compiler's must
// agree, function by function.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <gene_clocks/align.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <optional>
#include <vector>

#include "tests/protocol/kernel_in_c.h"
#include "tests/support/marks.hpp"
#include "tests/support/property.hpp"

namespace gene_clocks {
namespace {

c_mark in_c(InnovationNumber mark) {
    return {mark.counter, static_cast<std::uint32_t>(mark.robot)};
}

std::vector<c_mark> in_c(const std::vector<InnovationNumber>& genome) {
    std::vector<c_mark> marks;
    for (const auto mark : genome) marks.push_back(in_c(mark));
    return marks;
}

GENE_CLOCKS_PROPERTY(KernelProperty, CAndCppOrderAlike, (InnovationNumber a, InnovationNumber b)) {
    RC_ASSERT((a < b) == (c_less(in_c(a), in_c(b)) != 0));
}

GENE_CLOCKS_PROPERTY(KernelProperty, CAndCppClocksStartAlike, ()) {
    const auto maximum = *rc::gen::suchThat(test::counters<std::uint64_t>(),
                                            [](std::uint64_t value) { return value > 0; });
    const auto genesis_count = *test::counters<std::uint64_t>();
    c_clock clock{maximum, 0, 0, 0, 0};
    RC_ASSERT((c_start(&clock, genesis_count) != 0) == (genesis_count < maximum));
    if (genesis_count < maximum) {
        const GeneClock cpp{RobotId{1}, genesis_count, {.maximum = maximum}};
        RC_ASSERT(cpp.state() == (GeneClock::State{clock.next, clock.durable}));
    } else {
        RC_ASSERT(clock.next == 0u && clock.durable == 0u);
    }
}

GENE_CLOCKS_PROPERTY(KernelProperty, CAndCppClocksRestartAlike, ()) {
    const auto counter = test::counters<std::uint64_t>();
    const auto maximum = *counter;
    const auto genesis_count = *counter;
    const auto stored = *counter;
    c_clock clock{maximum, 0, 0, 0, 0};
    const auto cpp = GeneClock::restart(RobotId{1}, stored, genesis_count, {.maximum = maximum});
    RC_ASSERT(cpp.has_value() == (genesis_count < stored && stored <= maximum));
    RC_ASSERT((c_restart(&clock, genesis_count, stored) != 0) == cpp.has_value());
    const auto state = cpp ? cpp->state() : GeneClock::State{0, 0};
    RC_ASSERT(state == (GeneClock::State{clock.next, clock.durable}));
}

GENE_CLOCKS_PROPERTY(KernelProperty, CAndCppClocksGoOnAlike, ()) {
    const auto counter = test::counters<std::uint64_t>();
    c_clock c{*counter, *counter, *counter, 0, 0};
    const auto next = *counter;
    const auto durable = *counter;
    auto cpp = GeneClock::from_state(RobotId{1}, {next, durable}, {c.maximum, c.block, c.window});
    RC_ASSERT((c_restore(&c, next, durable) != 0) == cpp.has_value());
    RC_PRE(cpp.has_value());

    for (int i = 0; i < 4; ++i) {
        const auto count = *counter;
        constexpr std::uint64_t untouched = 0;  // no counter is 0
        std::uint64_t first = untouched;
        const bool minted = c_mint(&c, count, &first) != 0;
        const auto marks = cpp->mint(count);
        RC_ASSERT(minted == marks.has_value());
        RC_ASSERT(first == (minted ? marks->first.counter : untouched));

        const auto stamp = *counter;
        RC_ASSERT((c_observe(&c, stamp) != 0) == cpp->observe(Stamp{stamp}));
        RC_ASSERT(cpp->state() == (GeneClock::State{c.next, c.durable}));
    }
}

GENE_CLOCKS_PROPERTY(KernelProperty, CAndCppAdmitGenomesAlike,
                     (const std::vector<InnovationNumber>& genome)) {
    const auto stamp = *test::counters<std::uint64_t>();
    GeneClock clock{RobotId{1}};
    const auto marks = in_c(genome);
    RC_ASSERT((c_covers(stamp, marks.data(), marks.size()) != 0) ==
              clock.observe(Stamp{stamp}, genome));
}

GENE_CLOCKS_PROPERTY(KernelProperty, CAndCppGuardAlike,
                     (const std::vector<InnovationNumber>& genome)) {
    const auto counter = test::counters<std::uint64_t>();
    const auto next = *counter;
    c_clock c{*counter, *counter, *counter, 0, 0};
    auto cpp = GeneClock::from_state(RobotId{2}, {next, next}, {c.maximum, c.block, c.window});
    RC_PRE(cpp && c_restore(&c, next, next) != 0);

    const auto marks = in_c(genome);
    const auto robot = static_cast<std::uint32_t>(genome.empty() ? RobotId{2} : genome[0].robot);
    const auto unmade = c_find_unmade(next, robot, marks.data(), marks.size());
    const auto is_unmade = [&](InnovationNumber mark) {
        return mark.robot == RobotId{robot} && mark.counter >= next;
    };
    const auto found = std::ranges::find_if(genome, is_unmade);
    RC_ASSERT(unmade == static_cast<std::size_t>(found - genome.begin()));

    std::uint64_t in_c = 0;
    std::uint64_t in_cpp = 0;
    for (int i = 0; i < 4; ++i) {
        const auto earned = *counter;
        c_earn(&in_c, earned, c.maximum);
        kernel::gene_clocks_earn(&in_cpp, earned, c.maximum);
        const auto stamp = *counter;
        RC_ASSERT(c_admit(&c, &in_c, stamp) ==
                  static_cast<int>(cpp->observe_within(in_cpp, Stamp{stamp})));
        RC_ASSERT(in_c == in_cpp);
        RC_ASSERT(cpp->state() == (GeneClock::State{c.next, c.durable}));
    }
}

GENE_CLOCKS_PROPERTY(KernelProperty, CAndCppAlignAlike, ()) {
    const auto [first, second] = *test::genome_pairs();
    const auto first_in_c = in_c(first);
    const auto second_in_c = in_c(second);
    std::vector<c_visit> visits(first.size() + second.size());
    visits.resize(
        c_align(first_in_c.data(), first.size(), second_in_c.data(), second.size(), visits.data()));
    auto visit = visits.begin();
    align(first, second, [&](GeneMatch match, std::size_t i, std::size_t j) {
        RC_ASSERT(visit != visits.end());
        RC_ASSERT(visit->match == static_cast<int>(match));
        RC_ASSERT(visit->first == i);
        RC_ASSERT(visit->second == j);
        ++visit;
    });
    RC_ASSERT(visit == visits.end());
}

}  // namespace
}  // namespace gene_clocks
