#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <gene_clocks/neat/distance.hpp>
#include <gene_clocks/neat/tabu_list.hpp>
#include <utility>
#include <vector>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

/// A genome whose distance from another of these is 0.4 · |weight − weight|.
std::shared_ptr<const Genome> genome_at(float weight, std::uint32_t birth) {
    Genome genome = perceptron(1, 1, {RobotId{1}, birth});
    genome.weights[0] = weight;
    return std::make_shared<const Genome>(std::move(genome));
}

class TabuListTest : public testing::Test {
protected:
    OdneatSettings settings_;  // nearer than 1.0 is similar; 50 receptions
    TabuList tabu_{settings_};
    const std::shared_ptr<const Genome> near_ = genome_at(1.0f, 100);   // 0.4 from 0
    const std::shared_ptr<const Genome> other_ = genome_at(9.0f, 101);  // 3.6 from 0
};

TEST_F(TabuListTest, ApprovesEverythingWhileEmpty) {
    EXPECT_TRUE(tabu_.approves(*near_));
    EXPECT_EQ(tabu_.size(), 0u);
}

TEST_F(TabuListTest, RefusesWhatResemblesAnEntry) {
    tabu_.add(genome_at(0.0f, 0));
    EXPECT_FALSE(tabu_.approves(*near_));
    EXPECT_TRUE(tabu_.approves(*other_));
}

TEST_F(TabuListTest, RefusesAnEntryItself) {
    const auto genome = genome_at(0.0f, 0);
    tabu_.add(genome);
    EXPECT_FALSE(tabu_.approves(*genome));
}

TEST_F(TabuListTest, ADistanceOfTheThresholdIsNoResemblance) {
    settings_.c_weight = 0.5;
    TabuList tabu(settings_);
    tabu.add(genome_at(0.0f, 0));
    EXPECT_TRUE(tabu.approves(*genome_at(2.0f, 1)));
    EXPECT_FALSE(tabu.approves(*genome_at(std::nextafter(2.0f, 0.0f), 2)));
}

TEST_F(TabuListTest, AnEntryLeavesAtItsFiftiethReceptionOfSomethingElse) {
    tabu_.add(genome_at(0.0f, 0));
    for (int i = 0; i < 49; ++i) ASSERT_TRUE(tabu_.approves(*other_));
    EXPECT_EQ(tabu_.size(), 1u);
    EXPECT_TRUE(tabu_.approves(*other_));
    EXPECT_EQ(tabu_.size(), 0u);
    EXPECT_TRUE(tabu_.approves(*near_));
}

TEST_F(TabuListTest, TheLifetimeIsASetting) {
    settings_.tabu_receptions = 3;
    TabuList tabu(settings_);
    tabu.add(genome_at(0.0f, 0));
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(tabu.approves(*other_));
    EXPECT_EQ(tabu.size(), 1u);
    tabu.approves(*other_);
    EXPECT_EQ(tabu.size(), 0u);
}

TEST_F(TabuListTest, ASimilarReceptionRenewsAnEntry) {
    tabu_.add(genome_at(0.0f, 0));
    for (int i = 0; i < 49; ++i) tabu_.approves(*other_);
    EXPECT_FALSE(tabu_.approves(*near_));
    for (int i = 0; i < 49; ++i) tabu_.approves(*other_);
    EXPECT_EQ(tabu_.size(), 1u);
    tabu_.approves(*other_);
    EXPECT_EQ(tabu_.size(), 0u);
}

TEST_F(TabuListTest, EveryEntryIsLookedAt) {
    tabu_.add(genome_at(0.0f, 0));
    tabu_.add(genome_at(1.5f, 1));  // near_ resembles both
    tabu_.add(genome_at(-9.0f, 2));
    for (int i = 0; i < 49; ++i) tabu_.approves(*other_);
    ASSERT_EQ(tabu_.size(), 3u);
    EXPECT_FALSE(tabu_.approves(*near_));  // renews two, and is the third's last reception
    EXPECT_EQ(tabu_.size(), 2u);
    EXPECT_TRUE(tabu_.approves(*other_));
    EXPECT_EQ(tabu_.size(), 2u);
}

TEST_F(TabuListTest, ListsAGenomeOnceAndRenewsItWhenAddedAgain) {
    const auto genome = genome_at(0.0f, 0);
    tabu_.add(genome);
    for (int i = 0; i < 49; ++i) tabu_.approves(*other_);
    tabu_.add(genome);
    EXPECT_EQ(tabu_.size(), 1u);
    for (int i = 0; i < 49; ++i) tabu_.approves(*other_);
    EXPECT_EQ(tabu_.size(), 1u);
    tabu_.approves(*other_);
    EXPECT_EQ(tabu_.size(), 0u);
}

TEST_F(TabuListTest, ListsGenomesOfTwoRobotsApart) {
    Genome elsewhere = *other_;
    elsewhere.id = {RobotId{2}, near_->id.birth};  // the same number, of another robot
    tabu_.add(near_);
    tabu_.add(std::make_shared<const Genome>(elsewhere));
    EXPECT_EQ(tabu_.size(), 2u);
    EXPECT_FALSE(tabu_.approves(*other_));
    EXPECT_FALSE(tabu_.approves(*near_));
}

TEST_F(TabuListTest, AThresholdOfZeroMakesNothingSimilar) {
    settings_.tabu_threshold = 0.0;
    TabuList tabu(settings_);
    const auto genome = genome_at(0.0f, 0);
    tabu.add(genome);
    EXPECT_TRUE(tabu.approves(*genome));
}

TEST_F(TabuListTest, ALifetimeOfZeroListsNothing) {
    settings_.tabu_receptions = 0;
    TabuList tabu(settings_);
    const auto genome = genome_at(0.0f, 0);
    tabu.add(genome);
    EXPECT_TRUE(tabu.approves(*genome));
    EXPECT_EQ(tabu.size(), 0u);
}

/// The rule without the memory of past comparisons.
class NaiveTabuList {
public:
    explicit NaiveTabuList(const OdneatSettings& settings) : settings_(settings) {}

    void add(const std::shared_ptr<const Genome>& genome) {
        for (auto& [listed, left] : entries_) {
            if (listed->id != genome->id) continue;
            left = settings_.tabu_receptions;
            return;
        }
        entries_.emplace_back(genome, settings_.tabu_receptions);
    }
    bool approves(const Genome& received) {
        bool approved = true;
        std::vector<std::pair<std::shared_ptr<const Genome>, std::int64_t>> kept;
        for (auto& [listed, left] : entries_) {
            const bool similar = distance(*listed, received, DistanceMeasure(settings_)) <
                                 static_cast<float>(settings_.tabu_threshold);
            if (similar) approved = false;
            left = similar ? settings_.tabu_receptions : left - 1;
            if (left > 0) kept.emplace_back(listed, left);
        }
        entries_ = kept;
        return approved;
    }
    std::size_t size() const { return entries_.size(); }

private:
    OdneatSettings settings_;
    std::vector<std::pair<std::shared_ptr<const Genome>, std::int64_t>> entries_;
};

RC_GTEST_PROP(TabuListProperty, TheMemoryOfComparisonsDoesNotShow, ()) {
    OdneatSettings settings;
    settings.tabu_receptions = *rc::gen::inRange<std::int64_t>(1, 12);
    TabuList tabu(settings);
    NaiveTabuList naive(settings);
    std::vector<std::shared_ptr<const Genome>> genomes;
    for (std::uint32_t birth = 0; birth < 12; ++birth) {
        genomes.push_back(genome_at(static_cast<float>(*rc::gen::inRange(-8, 9)), birth));
    }
    const auto steps = *rc::gen::container<std::vector<std::pair<bool, int>>>(rc::gen::pair(
        rc::gen::weightedElement<bool>({{1, true}, {4, false}}), rc::gen::inRange(0, 12)));
    for (const auto& [adds, index] : steps) {
        const auto& genome = genomes[static_cast<std::size_t>(index)];
        if (adds) {
            tabu.add(genome);
            naive.add(genome);
        } else {
            RC_ASSERT(tabu.approves(*genome) == naive.approves(*genome));
        }
        RC_ASSERT(tabu.size() == naive.size());
    }
}

}  // namespace
}  // namespace gene_clocks::neat
