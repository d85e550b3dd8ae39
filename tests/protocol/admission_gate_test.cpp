#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <forward_list>
#include <gene_clocks/admission_gate.hpp>
#include <limits>
#include <vector>

namespace gene_clocks {
namespace {

constexpr RobotId robot{7};
using Genes = std::vector<InnovationNumber>;
using Small = std::uint8_t;
using SmallClock = BasicGeneClock<Small>;

// Against plain arithmetic on integers that cannot overflow, for every 8-bit input.
TEST(Allowance, EarnsAsDefined) {
    for (int ceiling = 0; ceiling < 256; ++ceiling) {
        for (int before = 0; before <= ceiling; ++before) {
            for (int counters = 0; counters < 256; ++counters) {
                auto allowance = Small(before);
                kernel::gene_clocks_earn(&allowance, Small(counters), Small(ceiling));
                ASSERT_EQ(allowance, std::min(before + counters, ceiling));
            }
        }
    }
}

// Every 8-bit clock, allowance and stamp, with a few limits and reserves.
TEST(Allowance, AdmitsAsDefined) {
    for (const int maximum : {1, 100, 255}) {
        for (const int window : {0, 1, 50, 255}) {
            const SmallClock::Limits limits{Small(maximum), 3, Small(window)};
            for (int next = 1; next <= maximum; ++next) {
                const int durable = std::min(next + next % 3, maximum);
                for (int before = 0; before < 256; ++before) {
                    for (int stamp = 0; stamp < 256; ++stamp) {
                        auto clock =
                            *SmallClock::from_state(robot, {Small(next), Small(durable)}, limits);
                        auto allowance = Small(before);
                        const auto admission = clock.observe_within(allowance, {Small(stamp)});
                        const auto expected = stamp > maximum         ? Admission::beyond_maximum
                                              : stamp > next + window ? Admission::beyond_window
                                              : stamp > next + before ? Admission::beyond_allowance
                                                                      : Admission::admitted;
                        ASSERT_EQ(admission, expected);
                        const bool moves = admission == Admission::admitted && stamp > next;
                        const int after = moves ? stamp : next;
                        const int reserved =
                            after <= durable ? durable : std::min(after + 3, maximum);
                        ASSERT_EQ(clock.state(),
                                  (SmallClock::State{Small(after), Small(reserved)}));
                        ASSERT_EQ(allowance, before - (after - next));
                    }
                }
            }
        }
    }
}

TEST(AdmissionGate, AdmitsByDefaultWhatTheClockAdmits) {
    GeneClock clock{robot};
    AdmissionGate gate;
    EXPECT_EQ(gate.admit(clock, Stamp{1'000'000}, Genes{}), Admission::admitted);
    EXPECT_EQ(clock.stamp(), Stamp{1'000'000});
    gate.elapse();
    EXPECT_EQ(gate.counts()[Admission::admitted], 1u);
    EXPECT_EQ(gate.counts().refused(), 0u);
}

TEST(AdmissionGate, CountsWhatItRefusesByReason) {
    GeneClock clock{robot, 0, {.maximum = 1000, .window = 100}};
    AdmissionGate gate{{.allowance = 50}};
    EXPECT_EQ(gate.admit(clock, Stamp{1001}, Genes{}), Admission::beyond_maximum);
    EXPECT_EQ(gate.admit(clock, Stamp{102}, Genes{}), Admission::beyond_window);
    EXPECT_EQ(gate.admit(clock, Stamp{52}, Genes{}), Admission::beyond_allowance);
    EXPECT_EQ(gate.admit(clock, Stamp{5}, Genes{{5, RobotId{2}}}), Admission::gene_not_covered);
    EXPECT_EQ(gate.admit(clock, Stamp{5}, Genes{{1, robot}}), Admission::identity_conflict);
    EXPECT_EQ(clock.stamp(), Stamp{1}) << "refusals change nothing";
    EXPECT_EQ(gate.allowance(), 50u);
    EXPECT_EQ(gate.admit(clock, Stamp{51}, Genes{}), Admission::admitted);
    for (const auto refusal :
         {Admission::beyond_maximum, Admission::beyond_window, Admission::beyond_allowance,
          Admission::gene_not_covered, Admission::identity_conflict, Admission::admitted}) {
        EXPECT_EQ(gate.counts()[refusal], 1u);
    }
    EXPECT_EQ(gate.counts().refused(), 5u);
}

TEST(AdmissionGate, EarnsInSilenceAndSpendsOnLeaps) {
    GeneClock clock{robot};
    AdmissionGate gate{{.allowance = 10, .per_cycle = 3}};
    EXPECT_EQ(gate.admit(clock, Stamp{11}, Genes{}), Admission::admitted);
    EXPECT_EQ(gate.allowance(), 0u);
    EXPECT_EQ(gate.admit(clock, Stamp{11}, Genes{}), Admission::admitted) << "no leap, no cost";
    EXPECT_EQ(gate.admit(clock, Stamp{12}, Genes{}), Admission::beyond_allowance);
    for (int cycle = 0; cycle < 100; ++cycle) gate.elapse();
    EXPECT_EQ(gate.admit(clock, Stamp{312}, Genes{}), Admission::beyond_allowance);
    EXPECT_EQ(gate.admit(clock, Stamp{311}, Genes{}), Admission::admitted);
}

TEST(AdmissionGate, EarnsNoMoreThanThereIs) {
    constexpr auto most = std::numeric_limits<std::uint64_t>::max();
    AdmissionGate gate{{.allowance = 10, .per_cycle = most - 5}};
    gate.elapse();
    EXPECT_EQ(gate.allowance(), most);
    gate.elapse();
    EXPECT_EQ(gate.allowance(), most);
}

// ---- A mark of one's own that one never made
// -------------------------------------------------------

TEST(AdmissionGate, KnowsItsOwnMarks) {
    GeneClock clock{robot, 22};
    AdmissionGate gate;
    const auto mine = clock.mint().value();
    // They come back in the genomes of others, for ever.
    EXPECT_EQ(gate.admit(clock, Stamp{40}, Genes{{22, genesis_robot}, mine, {30, RobotId{9}}}),
              Admission::admitted);
    EXPECT_EQ(gate.conflicting_mark(), std::nullopt);
}

TEST(AdmissionGate, NoticesACloneOfItsRobot) {
    GeneClock clock{robot, 22};
    GeneClock clone{robot, 22};
    AdmissionGate gate;
    const auto theirs = clone.mint(2).value();
    const auto before = clock.state();
    EXPECT_EQ(gate.admit(clock, clone.stamp(), Genes{theirs[0], theirs[1]}),
              Admission::identity_conflict);
    EXPECT_EQ(gate.conflicting_mark(), theirs[0]);
    EXPECT_EQ(clock.state(), before);
}

TEST(AdmissionGate, NoticesStorageThatWasSetBack) {
    GeneClock clock{robot, 22};
    const auto old_image = clock.durable_needed();
    const auto lost = clock.mint(5).value();
    const Genes genome_of_another{{22, genesis_robot}, lost[4], {28, RobotId{9}}};

    auto restored = GeneClock::restart(robot, old_image, 22).value();
    AdmissionGate gate;
    EXPECT_EQ(gate.admit(restored, Stamp{29}, genome_of_another), Admission::identity_conflict);
    EXPECT_EQ(gate.conflicting_mark(), lost[4]);
    EXPECT_EQ(gate.admit(restored, Stamp{29}, Genes{lost[3]}), Admission::identity_conflict);
    EXPECT_EQ(gate.conflicting_mark(), lost[4]) << "the first is kept";
}

// With any forward range and projection, as observe().
TEST(AdmissionGate, ReadsMarksOffAnyGenes) {
    struct Gene {
        InnovationNumber mark;
    };
    GeneClock clock{robot};
    AdmissionGate gate;
    const std::forward_list<Gene> genes{{{1, RobotId{2}}}, {{4, robot}}};
    EXPECT_EQ(gate.admit(clock, Stamp{5}, genes, &Gene::mark), Admission::identity_conflict);
    EXPECT_EQ(gate.conflicting_mark(), (InnovationNumber{4, robot}));
}

}  // namespace
}  // namespace gene_clocks
