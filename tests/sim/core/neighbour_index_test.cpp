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

TEST(NeighbourIndex, SeesWhoComesStraightOnAtFullSpeed) {
    // Whatever the distance and the age of the list is at which two begin to approach.
    for (int distance_px = 20; distance_px < 160; distance_px += 2) {
        for (int wait_cycles = 0; wait_cycles < 10; ++wait_cycles) {
            std::vector<float> x{20.0f, 20.0f + static_cast<float>(distance_px)};
            const std::vector<float> y{50.0f, 50.0f};
            NeighbourIndex index(2, width_px, height_px, reach_px, speed_px);
            for (int i = 0; i < wait_cycles; ++i) index.update(x, y);
            while (x[0] < x[1]) {
                index.update(x, y);
                x[0] += speed_px;
                x[1] -= speed_px;
                if (std::abs(x[1] - x[0]) >= reach_px) continue;
                ASSERT_EQ(index.near(0).size(), 1u) << distance_px << ' ' << wait_cycles;
                ASSERT_EQ(index.near(1).size(), 1u) << distance_px << ' ' << wait_cycles;
            }
        }
    }
}

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
