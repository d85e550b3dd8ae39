#include "sim/core/src/arena_map.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/sim/core/naive_geometry.hpp"

namespace gene_clocks::sim {
namespace {

constexpr double reach_px = 30.0;
constexpr double radius_px = 2.5;

class ArenaMapTest : public testing::Test {
protected:
    /// Calls `check(x, y)` for random places within the arena.
    template <class Check>
    void at_random_places(int places, Check check) {
        neat::RandomStream random(1, 1);
        for (int i = 0; i < places; ++i) {
            check(random.uniform(0.0, arena_.width_px), random.uniform(0.0, arena_.height_px));
        }
    }

    Arena arena_ = naive::arena();
    ArenaMap map_{arena_, reach_px, radius_px};
};

TEST(ArenaMapFrame, HoldsInArenasOfAnySize) {
    const ArenaMap map({"wide", 25'000.0, 60.0, 5.0, 5.0, 5.0, 5.0, {}}, reach_px, radius_px);
    for (const float x : {100.0f, 12'500.0f, 24'900.0f}) {
        EXPECT_TRUE(map.robot_touches_wall(x, 5.0f)) << x;
        EXPECT_FALSE(map.robot_touches_wall(x, 30.0f)) << x;
        EXPECT_TRUE(map.robot_touches_wall(x, 55.0f)) << x;
    }
}

TEST_F(ArenaMapTest, ARobotTouchesWhatItsDiamondMeets) {
    int touching = 0;
    at_random_places(4000, [&](double x, double y) {
        const bool touches = map_.robot_touches_wall(static_cast<float>(x), static_cast<float>(y));
        // Between the two the answer depends on less than a tenth of a pixel.
        if (naive::diamond_meets_wall(arena_, x, y, radius_px - 0.1)) {
            EXPECT_TRUE(touches) << x << ", " << y;
        } else if (!naive::diamond_meets_wall(arena_, x, y, radius_px + 0.1)) {
            EXPECT_FALSE(touches) << x << ", " << y;
        }
        touching += touches;
    });
    EXPECT_GT(touching, 400);
    EXPECT_LT(touching, 3600);
}

TEST_F(ArenaMapTest, ADiscTouchesWhatIsNearerThanItsRadius) {
    constexpr double disc_px = 6.0;
    int touching = 0;
    at_random_places(20'000, [&](double x, double y) {
        double gap = std::min({x - 5.0, y - 6.0, 115.0 - x, 95.0 - y});
        for (const ThickSegment& wall : arena_.walls) {
            gap = std::min(gap, naive::distance(wall, x, y));
        }
        if (std::abs(gap - disc_px) < 1e-3) return;
        const bool touches =
            map_.disc_touches_wall(static_cast<float>(x), static_cast<float>(y), disc_px);
        EXPECT_EQ(touches, gap < disc_px) << x << ", " << y;
        touching += touches;
    });
    EXPECT_GT(touching, 2000);
}

TEST_F(ArenaMapTest, EveryWallWithinReachIsVisible) {
    at_random_places(5000, [&](double x, double y) {
        const auto visible = map_.visible_walls(static_cast<float>(x), static_cast<float>(y));
        for (const ThickSegment& wall : arena_.walls) {
            if (naive::distance(wall, x, y) > reach_px) continue;
            // The map's walls are boxes in coordinates of their own; its middle identifies one.
            const double middle_x = (wall.x1_px + wall.x2_px) / 2;
            const double middle_y = (wall.y1_px + wall.y2_px) / 2;
            const bool found = std::any_of(visible.begin(), visible.end(), [&](std::uint16_t k) {
                const WallBox& box = map_.wall(k);
                const WallOrientation& axes = map_.orientation(box.orientation);
                const double along = middle_x * axes.ax + middle_y * axes.ay;
                const double across = middle_y * axes.ax - middle_x * axes.ay;
                return std::abs(along - (box.along_min + box.along_max) / 2) < 0.01 &&
                       std::abs(across - (box.across_min + box.across_max) / 2) < 0.01;
            });
            EXPECT_TRUE(found) << x << ", " << y;
        }
    });
}

TEST_F(ArenaMapTest, WallsOfOneOrientationStandTogether) {
    // So that rays are turned once for each orientation.
    at_random_places(1000, [&](double x, double y) {
        std::set<std::uint32_t> done;
        std::uint32_t last = diamond_orientation;
        for (const auto k : map_.visible_walls(static_cast<float>(x), static_cast<float>(y))) {
            const std::uint32_t orientation = map_.wall(k).orientation;
            if (orientation == last) continue;
            EXPECT_TRUE(done.insert(last).second);
            EXPECT_FALSE(done.contains(orientation));
            last = orientation;
        }
    });
}

}  // namespace
}  // namespace gene_clocks::sim
