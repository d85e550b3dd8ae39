// What bench/lying_peers.cpp measures, in short: what robots achieve that lie about genomes.
#include "tests/support/lying_fleet.hpp"

#include <gtest/gtest.h>

namespace gene_clocks::test {
namespace {

constexpr int cycles = 1'200;
constexpr neat::PeerLimits few_places{.members_per_maker = 1, .members_of_others = 2};

LyingResult run(const LyingSettings& settings) {
    return LyingFleet{settings}.run();
}

TEST(LyingFleet, LearnsWhereNobodyLies) {
    EXPECT_GT(run({.cycles = cycles}).right_answers, 0.6);
}

// Where nobody can speak as another, what is said of others' genomes counts for nothing, and the
// fleet fares exactly as if the liars said nothing that has an effect.
TEST(LyingFleet, IsNotMovedByWhatOnlyAMakerCanSay) {
    for (const int liars : {1, 10, 30}) {
        for (const Lie lie :
             {Lie::takes_ids, Lie::slanders_own, Lie::slanders_others, Lie::impossible}) {
            const auto result = run({.liars = liars, .lie = lie, .cycles = cycles});
            EXPECT_GT(result.lies, 1'000u);
            EXPECT_EQ(result.taken, 0u) << liars << " tell lie " << int(lie);
            EXPECT_EQ(result.lied_members, 0.0);
            EXPECT_GT(result.right_answers, 0.55) << liars << " tell lie " << int(lie);
        }
    }
}

// Nor, whoever speaks: a robot hears nothing about its own, and no energy that cannot be.
TEST(LyingFleet, IsNotMovedAboutItsOwnGenomesOnceAnyoneSpeaksAsAnyone) {
    for (const Lie lie : {Lie::slanders_own, Lie::impossible}) {
        const auto result =
            run({.liars = 30, .lie = lie, .senders_are_known = false, .cycles = cycles});
        EXPECT_EQ(result.taken, 0u) << int(lie);
    }
}

// The control: this is what robots' keys are for.
TEST(LyingFleet, LosesWhereLiarsSpeakAsOthers) {
    const auto result =
        run({.liars = 10, .lie = Lie::takes_ids, .senders_are_known = false, .cycles = cycles});
    EXPECT_GT(result.taken, 1'000u);
    EXPECT_GT(result.lied_members, 0.5);
    EXPECT_LT(result.right_answers, 0.5);
}

// A high energy claimed for one's own genomes cannot be disproved. Its places are numbered.
TEST(LyingFleet, GivesBoastersNoMorePlacesThanItSays) {
    for (const int liars : {1, 10, 30}) {
        const auto trusting = run({.liars = liars, .lie = Lie::boasts, .cycles = cycles});
        EXPECT_GT(trusting.lied_members, 0.8);
        const auto wary =
            run({.liars = liars, .lie = Lie::boasts, .peers = few_places, .cycles = cycles});
        EXPECT_LE(wary.lied_members, 0.5)
            << "2 of up to 7 places, once a robot has some of its own";
        EXPECT_GT(wary.right_answers, trusting.right_answers);
    }
    const auto one = run({.liars = 1, .lie = Lie::boasts, .peers = few_places, .cycles = cycles});
    EXPECT_GT(one.right_answers, 0.6);
}

}  // namespace
}  // namespace gene_clocks::test
