#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/sim/core/naive_geometry.hpp"
#include "tests/sim/core/watched_run.hpp"

// Where robots and items may be put: as near to walls and to each other as their bodies allow, and
// no nearer.

namespace gene_clocks::sim {
namespace {

constexpr double robot_px = 2.5;
constexpr double item_px = 6.0;

double gap_to_walls(const Arena& arena, double x, double y) {
    double gap = std::min({x - arena.frame_left_px, y - arena.frame_top_px,
                           arena.width_px - arena.frame_right_px - x,
                           arena.height_px - arena.frame_bottom_px - y});
    for (const ThickSegment& wall : arena.walls) gap = std::min(gap, naive::distance(wall, x, y));
    return gap;
}

/// Whether a point of a diamond's rim is in a wall; no wall is so thin that it slips between two.
bool rim_meets_wall(const Arena& arena, const watched::Robot& robot, double radius_px) {
    constexpr int points = 8;  // on each of the four edges
    for (int i = 0; i < 4 * points; ++i) {
        const double share = static_cast<double>(i % points) / points;
        const double x = ((i / points) % 2 == 0 ? 1.0 - share : -share) * radius_px;
        const double y = ((i / points) % 2 == 0 ? share : 1.0 - share) * radius_px;
        const double side = i / points < 2 ? 1.0 : -1.0;
        if (naive::is_wall(arena, robot.x_px + side * x, robot.y_px + side * y)) return true;
    }
    return false;
}

double distance(const watched::Item& a, const auto& b) {
    return std::hypot(a.x_px - b.x_px, a.y_px - b.y_px);
}

/// The smallest of many distances, which must not be below `limit_px` but comes near to it.
struct Closest {
    double limit_px;
    double smallest_px = std::numeric_limits<double>::infinity();
    void add(double distance_px) { smallest_px = std::min(smallest_px, distance_px); }
    void expect_met(const char* what) const {
        EXPECT_GE(smallest_px, limit_px - 1e-3) << what;
        EXPECT_LT(smallest_px, limit_px + 1.0) << what << ": farther than it must be";
    }
};

class Placement : public testing::Test {
protected:
    Placement() {
        settings_.task = Task::collection;
        settings_.world.robots = 14;
        settings_.world.items = 5;
        settings_.run.cycles = 1;
        settings_.run.sample_period_cycles = 1;
    }
    Settings settings_;
    Arena arena_ = naive::arena();
};

TEST_F(Placement, LeavesRoomForEveryBodyAtTheStart) {
    Closest item_to_wall{item_px}, item_to_item{2 * item_px}, item_to_robot{item_px + robot_px};
    Closest robot_to_robot{2 * robot_px};
    double left = 1e9, right = 0.0, top = 1e9, bottom = 0.0;
    std::array<int, 4> quadrants{};
    int robots = 0, at_walls = 0;
    for (std::uint64_t seed = 1; seed <= 250; ++seed) {
        const watched::Run run(settings_, arena_, seed);
        const watched::Moment& start = run.moments[0];
        for (std::size_t i = 0; i < start.items.size(); ++i) {
            const watched::Item& item = start.items[i];
            ASSERT_TRUE(item.is_present);
            item_to_wall.add(gap_to_walls(arena_, item.x_px, item.y_px));
            for (std::size_t j = 0; j < i; ++j) item_to_item.add(distance(item, start.items[j]));
            for (const auto& robot : start.robots) item_to_robot.add(distance(item, robot));
        }
        for (std::size_t i = 0; i < start.robots.size(); ++i) {
            const watched::Robot& robot = start.robots[i];
            ASSERT_FALSE(rim_meets_wall(arena_, robot, robot_px - 0.1));
            at_walls += rim_meets_wall(arena_, robot, robot_px + 0.5);
            for (std::size_t j = 0; j < i; ++j) {
                robot_to_robot.add(std::abs(robot.x_px - start.robots[j].x_px) +
                                   std::abs(robot.y_px - start.robots[j].y_px));
            }
            left = std::min(left, robot.x_px), right = std::max(right, robot.x_px);
            top = std::min(top, robot.y_px), bottom = std::max(bottom, robot.y_px);
            EXPECT_NEAR(std::hypot(robot.heading_x, robot.heading_y), 1.0, 1e-6);
            ++quadrants[(robot.heading_x > 0.0 ? 1u : 0u) + (robot.heading_y > 0.0 ? 2u : 0u)];
            ++robots;
        }
    }
    item_to_wall.expect_met("items and walls");
    item_to_item.expect_met("items");
    item_to_robot.expect_met("items and robots");
    robot_to_robot.expect_met("robots");
    EXPECT_GT(at_walls, 50);
    // Everywhere between the frame's edges, and in every direction.
    EXPECT_LT(left, 5.0 + robot_px + 1.0);
    EXPECT_LT(top, 6.0 + robot_px + 1.0);
    EXPECT_GT(right, 115.0 - robot_px - 1.0);
    EXPECT_GT(bottom, 95.0 - robot_px - 1.0);
    for (const int quadrant : quadrants) {
        EXPECT_NEAR(quadrant / double(robots), 0.25, 5 * std::sqrt(0.1875 / robots));
    }
}

TEST_F(Placement, LeavesRoomForEveryBodyWhenAnItemReappears) {
    settings_.run.cycles = 20'000;
    settings_.run.sample_period_cycles = 10'000;
    settings_.world.item_reach_px = 25.0;  // so that they come and go
    const watched::Run run(settings_, arena_);
    Closest item_to_wall{item_px}, item_to_item{2 * item_px}, item_to_robot{item_px + robot_px};
    int reappeared = 0;
    for (std::size_t t = 1; t < run.moments.size(); ++t) {
        const watched::Moment& moment = run.moments[t];
        for (std::size_t i = 0; i < moment.items.size(); ++i) {
            if (run.moments[t - 1].items[i].is_present || !moment.items[i].is_present) continue;
            ++reappeared;
            const watched::Item& item = moment.items[i];
            item_to_wall.add(gap_to_walls(arena_, item.x_px, item.y_px));
            for (const auto& robot : moment.robots) item_to_robot.add(distance(item, robot));
            for (std::size_t j = 0; j < moment.items.size(); ++j) {
                if (j == i || !moment.items[j].is_present) continue;
                item_to_item.add(distance(item, moment.items[j]));
            }
        }
    }
    EXPECT_GT(reappeared, 2000);
    item_to_wall.expect_met("items and walls");
    item_to_item.expect_met("items");
    item_to_robot.expect_met("items and robots");
}

}  // namespace
}  // namespace gene_clocks::sim
