#include "sim/core/src/neighbour_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gene_clocks/neat/random.hpp>

namespace gene_clocks::sim {
namespace {

constexpr float width_px = 300.0f;
constexpr float height_px = 200.0f;
constexpr float reach_px = 35.0f;
constexpr float speed_px = 2.0f;

/// Robots that move at full speed in directions drawn anew each cycle, within the arena.
class NeighbourIndexTest : public testing::TestWithParam<std::size_t> {
protected:
    NeighbourIndexTest() : x_(GetParam()), y_(GetParam()) {
        for (std::size_t i = 0; i < x_.size(); ++i) {
            x_[i] = draw(0.0, width_px);
            y_[i] = draw(0.0, height_px);
        }
    }
    float draw(double from, double to) { return static_cast<float>(random_.uniform(from, to)); }
    void move() {
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const float angle = draw(0.0, 6.2831853);
            x_[i] = std::clamp(x_[i] + speed_px * std::cos(angle), 0.0f, width_px);
            y_[i] = std::clamp(y_[i] + speed_px * std::sin(angle), 0.0f, height_px);
        }
    }
    /// Counts the robots within the reach that the index does not list.
    std::size_t missing(const NeighbourIndex& index) const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const auto near = index.near(i);
            for (std::size_t j = 0; j < x_.size(); ++j) {
                if (i == j || std::hypot(x_[i] - x_[j], y_[i] - y_[j]) >= reach_px) continue;
                count += std::find(near.begin(), near.end(), j) == near.end();
            }
        }
        return count;
    }

    neat::RandomStream random_{1, 1};
    std::vector<float> x_, y_;
};

TEST_P(NeighbourIndexTest, NobodyWithinReachIsMissingBeforeOrAfterAMove) {
    NeighbourIndex index(x_.size(), width_px, height_px, reach_px, speed_px);
    for (int cycle = 0; cycle < 100; ++cycle) {
        index.update(x_, y_);
        ASSERT_EQ(missing(index), 0u) << "before the move of cycle " << cycle;
        move();
        ASSERT_EQ(missing(index), 0u) << "after the move of cycle " << cycle;
    }
}

TEST_P(NeighbourIndexTest, NobodyIsListedTwiceOrIsItsOwnNeighbour) {
    NeighbourIndex index(x_.size(), width_px, height_px, reach_px, speed_px);
    index.update(x_, y_);
    for (std::size_t i = 0; i < x_.size(); ++i) {
        std::vector<std::uint32_t> near(index.near(i).begin(), index.near(i).end());
        std::sort(near.begin(), near.end());
        EXPECT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
        EXPECT_FALSE(std::binary_search(near.begin(), near.end(), i));
    }
}

INSTANTIATE_TEST_SUITE_P(Robots, NeighbourIndexTest, testing::Values(1, 2, 3, 50, 300));

TEST(NeighbourIndex, ListsFewerThanAllWhereThereIsRoom) {
    std::vector<float> x, y;
    for (int i = 0; i < 100; ++i) {
        x.push_back(static_cast<float>(100 * (i % 10)));
        y.push_back(static_cast<float>(100 * (i / 10)));
    }
    NeighbourIndex index(x.size(), 1000.0f, 1000.0f, reach_px, speed_px);
    index.update(x, y);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_TRUE(index.near(i).empty());
}

}  // namespace
}  // namespace gene_clocks::sim
