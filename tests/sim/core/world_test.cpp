#include "sim/core/src/world.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <stdexcept>

#include "tests/sim/core/naive_geometry.hpp"

namespace gene_clocks::sim {
namespace {

constexpr double radius_px = 2.5;
constexpr double range_px = 30.0;
constexpr double item_radius_px = 6.0;

class WorldTest : public testing::Test {
protected:
    WorldTest() { set_robots(12); }

    void set_robots(std::int64_t robots) {
        settings_.world.robots = robots;
        order_.resize(static_cast<std::size_t>(robots));
        std::iota(order_.begin(), order_.end(), 0u);
    }
    void collect(std::int64_t items) {
        settings_.task = Task::collection;
        settings_.world.items = items;
    }
    World make_world() {
        return World(settings_, std::make_shared<ArenaMap>(arena_, range_px + radius_px, radius_px),
                     random_);
    }
    std::uint64_t move(World& world, float translation, float rotation) {
        const std::vector<float> translations(world.robots(), translation);
        const std::vector<float> rotations(world.robots(), rotation);
        return world.move(translations, rotations, order_);
    }
    /// One cycle of random commands.
    std::uint64_t wander(World& world) {
        std::vector<float> translations, rotations;
        for (std::size_t i = 0; i < world.robots(); ++i) {
            translations.push_back(static_cast<float>(random_.uniform(-1.0, 1.0)));
            rotations.push_back(static_cast<float>(random_.uniform(-1.0, 1.0)));
        }
        const std::uint64_t collisions = world.move(translations, rotations, order_);
        world.sense();
        return collisions;
    }

    Settings settings_;
    Arena arena_ = naive::arena();
    neat::RandomStream random_{1, 1};
    std::vector<std::uint32_t> order_;
};

/// What a ray meets, found by walking along it in small steps.
struct Met {
    double distance_px = range_px + radius_px;  // from the robot's centre
    std::int32_t robot = -1;
    bool is_item = false;
};

constexpr double step_px = 0.01;

Met walk(const Arena& arena, const World& world, std::size_t robot, std::size_t ray) {
    // Ray 0 points left of the heading, the others follow clockwise; y points down.
    const double heading = std::atan2(world.heading_y()[robot], world.heading_x()[robot]);
    const double angle = heading + (static_cast<double>(ray) - 2.0) * std::acos(-1.0) / 4.0;
    for (double along = 0.0; along < range_px + radius_px; along += step_px) {
        const double x = world.x_px()[robot] + along * std::cos(angle);
        const double y = world.y_px()[robot] + along * std::sin(angle);
        for (std::size_t other = 0; other < world.robots(); ++other) {
            if (other != robot &&
                naive::is_in_diamond(x, y, world.x_px()[other], world.y_px()[other], radius_px)) {
                return {along, static_cast<std::int32_t>(other), false};
            }
        }
        const ItemField& items = world.items();
        for (std::size_t item = 0; item < items.size(); ++item) {
            if (items.is_present(item) &&
                std::hypot(items.x_px(item) - x, items.y_px(item) - y) <= item_radius_px) {
                return {along, -1, true};
            }
        }
        if (naive::is_wall(arena, x, y)) return {along, -1, false};
    }
    return {};
}

/// Rays that graze a corner may be told either way.
struct Tally {
    int rays = 0, disagree = 0, robots = 0, items = 0, walls = 0;
};

void compare_with_walking(const Arena& arena, const World& world, Tally& tally) {
    for (std::size_t i = 0; i < world.robots(); ++i) {
        const Senses& senses = world.senses(i);
        float nearest = 1.0f;
        for (std::size_t ray = 0; ray < ray_count; ++ray) {
            const Met met = walk(arena, world, i, ray);
            const double reading = std::clamp((met.distance_px - radius_px) / range_px, 0.0, 1.0);
            const double obstacle = met.is_item ? 1.0 : reading;
            const double item = met.is_item ? reading : 1.0;
            ++tally.rays;
            tally.robots += met.robot >= 0;
            tally.items += met.is_item;
            tally.walls += met.robot < 0 && !met.is_item && reading < 1.0;
            const bool agree = std::abs(senses.obstacle[ray] - obstacle) < 1e-3 &&
                               std::abs(senses.item[ray] - item) < 1e-3 &&
                               senses.robot[ray] == met.robot;
            tally.disagree += !agree;
            nearest = std::min(nearest, senses.obstacle[ray]);
        }
        EXPECT_EQ(senses.nearest_obstacle, nearest);
        EXPECT_EQ(senses.hears_robot, std::any_of(senses.robot.begin(), senses.robot.end(),
                                                  [](std::int32_t robot) { return robot >= 0; }));
    }
}

TEST_F(WorldTest, RaysMeetWhatIsThere) {
    collect(4);
    set_robots(20);
    World world = make_world();
    Tally tally;
    for (int cycle = 0; cycle < 25; ++cycle) {
        compare_with_walking(arena_, world, tally);
        for (int i = 0; i < 5; ++i) wander(world);
    }
    EXPECT_GT(tally.robots, 200);
    EXPECT_GT(tally.items, 100);
    EXPECT_GT(tally.walls, 1000);
    EXPECT_LE(tally.disagree, tally.rays / 400) << "of " << tally.rays;
}

/// How far along a ray a diamond is met, in double precision; infinity where it is not.
double diamond_along(double dx, double dy, double x, double y, double radius) {
    // Its four edges, as lines u = ±radius and v = ±radius with u = x + y and v = y − x.
    double nearest = std::numeric_limits<double>::infinity();
    for (const double side : {-radius, radius}) {
        const double at_u = (x + y + side) / (dx + dy);
        const double at_v = (y - x + side) / (dy - dx);
        if (at_u > 0.0 && std::abs(at_u * (dy - dx) - (y - x)) <= radius) {
            nearest = std::min(nearest, at_u);
        }
        if (at_v > 0.0 && std::abs(at_v * (dx + dy) - (x + y)) <= radius) {
            nearest = std::min(nearest, at_v);
        }
    }
    return nearest;
}

TEST_F(WorldTest, RobotsSeeEachOtherInEveryCycleHoweverFastTheyMeet) {
    // A wide arena, so that lists of neighbours do not hold everybody; all go straight on at full
    // speed and turn only where they collide.
    arena_ = {"wide", 420.0, 420.0, 5.0, 5.0, 5.0, 5.0, {}};
    set_robots(70);
    World world = make_world();
    std::vector<float> rotations(world.robots());
    const std::vector<float> translations(world.robots(), 1.0f);
    int seen = 0, met = 0;
    for (int cycle = 0; cycle < 400; ++cycle) {
        for (std::size_t i = 0; i < world.robots(); ++i) {
            const Senses& senses = world.senses(i);
            bool meets = false;
            bool is_close_call = false;
            for (std::size_t j = 0; j < world.robots(); ++j) {
                if (j == i) continue;
                const double x = world.x_px()[j] - world.x_px()[i];
                const double y = world.y_px()[j] - world.y_px()[i];
                const double apart_px = std::hypot(x, y);
                is_close_call |= std::abs(apart_px - 2 * (radius_px + 2.0)) < 1e-3;
                meets |= apart_px < 2 * (radius_px + 2.0);
            }
            EXPECT_TRUE(senses.meets_robot == meets || is_close_call) << cycle << ' ' << i;
            met += meets;
            for (std::size_t ray = 0; ray < ray_count; ++ray) {
                const double angle = std::atan2(world.heading_y()[i], world.heading_x()[i]) +
                                     (static_cast<double>(ray) - 2.0) * std::acos(-1.0) / 4.0;
                const double dx = std::cos(angle);
                const double dy = std::sin(angle);
                // Who is met without any doubt: also if it were a little smaller, and all others
                // and the frame a little nearer.
                double nearest = range_px + radius_px - 0.05;
                std::int32_t who = -1;
                bool is_certain = true;
                for (std::size_t j = 0; j < world.robots(); ++j) {
                    if (j == i) continue;
                    const double x = world.x_px()[j] - world.x_px()[i];
                    const double y = world.y_px()[j] - world.y_px()[i];
                    const double at = diamond_along(dx, dy, x, y, radius_px - 0.02);
                    const double at_least = diamond_along(dx, dy, x, y, radius_px + 0.02);
                    is_certain &= std::isinf(at) == std::isinf(at_least);
                    if (at < nearest) nearest = at, who = static_cast<std::int32_t>(j);
                }
                const double hit_x = world.x_px()[i] + nearest * dx;
                const double hit_y = world.y_px()[i] + nearest * dy;
                if (!is_certain || who < 0 || naive::is_in_frame(arena_, hit_x, hit_y)) continue;
                ASSERT_EQ(senses.robot[ray], who) << cycle << ' ' << i << ' ' << ray;
                ++seen;
            }
        }
        const auto x_before = std::vector<float>(world.x_px().begin(), world.x_px().end());
        world.move(translations, rotations, order_);
        for (std::size_t i = 0; i < world.robots(); ++i) {
            rotations[i] = world.x_px()[i] == x_before[i] ? 0.7f : 0.0f;
        }
        world.sense();
    }
    EXPECT_GT(seen, 2000);
    EXPECT_GT(met, 300);
}

TEST_F(WorldTest, ARobotIsHeardWithinTheRangeOfTheRadioOnly) {
    settings_.radio.range_px = 10.0;
    set_robots(25);
    World world = make_world();
    int heard = 0, seen = 0;
    for (int cycle = 0; cycle < 50; ++cycle) {
        for (std::size_t i = 0; i < world.robots(); ++i) {
            for (std::size_t ray = 0; ray < ray_count; ++ray) {
                if (world.senses(i).robot[ray] < 0) continue;
                ++heard;
                EXPECT_LE(world.senses(i).obstacle[ray], 10.0f / 30.0f + 1e-6f);
            }
            seen += world.senses(i).nearest_obstacle < 1.0f;
        }
        wander(world);
    }
    EXPECT_GT(heard, 20);
    EXPECT_GT(seen, heard);
}

TEST_F(WorldTest, BodiesNeverOverlap) {
    collect(4);
    set_robots(20);
    World world = make_world();
    std::uint64_t collisions = 0;
    for (int cycle = 0; cycle < 300; ++cycle) {
        collisions += wander(world);
        for (std::size_t i = 0; i < world.robots(); ++i) {
            const double x = world.x_px()[i];
            const double y = world.y_px()[i];
            ASSERT_FALSE(naive::diamond_meets_wall(arena_, x, y, radius_px - 0.1));
            for (std::size_t j = 0; j < i; ++j) {
                ASSERT_GE(std::abs(world.x_px()[j] - x) + std::abs(world.y_px()[j] - y),
                          2 * radius_px - 1e-4);
            }
            for (std::size_t item = 0; item < world.items().size(); ++item) {
                // A diamond's nearest point is at least so far from a disc's centre.
                ASSERT_GE(std::hypot(world.items().x_px(item) - x, world.items().y_px(item) - y),
                          item_radius_px + radius_px / std::sqrt(2.0) - 1e-3);
            }
        }
    }
    EXPECT_GT(collisions, 100u);
}

TEST_F(WorldTest, RobotsTurnFirstAndThenGoAlongTheirNewHeading) {
    set_robots(1);
    World world = make_world();
    const double heading = std::atan2(world.heading_y()[0], world.heading_x()[0]);
    const float x = world.x_px()[0];
    const float y = world.y_px()[0];
    ASSERT_EQ(move(world, 0.5f, 1.0f), 0u);
    const double turned = heading + std::acos(-1.0) / 6.0;  // 30° clockwise
    EXPECT_NEAR(world.x_px()[0] - x, std::cos(turned), 1e-4);
    EXPECT_NEAR(world.y_px()[0] - y, std::sin(turned), 1e-4);
}

TEST_F(WorldTest, HeadingsTurnByTheShareOfTheLargestRotationThatIsAsked) {
    settings_.world.rotation_deg = 60.0;
    World world = make_world();
    for (int share = -10; share <= 10; ++share) {
        const std::vector<float> x(world.heading_x().begin(), world.heading_x().end());
        const std::vector<float> y(world.heading_y().begin(), world.heading_y().end());
        move(world, 0.0f, static_cast<float>(share) / 10.0f);
        for (std::size_t i = 0; i < world.robots(); ++i) {
            const double angle = std::atan2(y[i], x[i]) + share / 10.0 * std::acos(-1.0) / 3.0;
            EXPECT_NEAR(world.heading_x()[i], std::cos(angle), 1e-5) << share;
            EXPECT_NEAR(world.heading_y()[i], std::sin(angle), 1e-5) << share;
        }
    }
}

TEST_F(WorldTest, HeadingsKeepUnitLength) {
    settings_.world.rotation_deg = 60.0;  // where the polynomials err the most
    World world = make_world();
    for (int cycle = 0; cycle < 10'000; ++cycle) move(world, 0.0f, 1.0f);
    for (std::size_t i = 0; i < world.robots(); ++i) {
        EXPECT_NEAR(std::hypot(world.heading_x()[i], world.heading_y()[i]), 1.0, 1e-5);
    }
}

TEST_F(WorldTest, TranslationChangesByTheAccelerationAtMostAndEndsInACollision) {
    settings_.world.acceleration_px = 0.5;
    set_robots(1);
    World world = make_world();
    double last_px = 0.0;
    bool has_collided = false;
    for (int cycle = 0; cycle < 200; ++cycle) {
        const float x = world.x_px()[0];
        const float y = world.y_px()[0];
        const bool collided = move(world, 1.0f, 0.0f) > 0;
        const double step_px = std::hypot(world.x_px()[0] - x, world.y_px()[0] - y);
        EXPECT_NEAR(step_px, collided ? 0.0 : std::min(last_px + 0.5, 2.0), 1e-3);
        last_px = step_px;
        has_collided |= collided;
    }
    EXPECT_TRUE(has_collided);
}

TEST_F(WorldTest, TranslationFallsByTheAccelerationAtMostAndIsNoneAfterACollision) {
    settings_.world.acceleration_px = 0.5;
    set_robots(1);
    arena_ = {"small", 50.0, 50.0, 5.0, 5.0, 5.0, 5.0, {}};
    World world = make_world();
    double last_px = 0.0;
    int forward = 0, backward = 0, collisions = 0, starts = 0;
    for (int cycle = 0; cycle < 3000; ++cycle) {
        const float wanted = cycle / 7 % 2 == 0 ? 1.0f : -1.0f;
        const float x = world.x_px()[0];
        const float y = world.y_px()[0];
        const auto rotation = static_cast<float>(random_.uniform(-1.0, 1.0));
        if (move(world, wanted, rotation) > 0) {
            last_px = 0.0;
            ++collisions;
            continue;
        }
        starts += last_px == 0.0;
        const double step_px = (world.x_px()[0] - x) * world.heading_x()[0] +
                               (world.y_px()[0] - y) * world.heading_y()[0];
        ASSERT_NEAR(step_px, std::clamp(2.0 * wanted, last_px - 0.5, last_px + 0.5), 1e-3);
        last_px = step_px;
        ++(step_px > 0.0 ? forward : backward);
    }
    EXPECT_GT(forward, 100);
    EXPECT_GT(backward, 100);
    EXPECT_GT(collisions, 40);
    EXPECT_GT(starts, 20);
}

TEST_F(WorldTest, RobotsMoveOneAfterTheOtherInTheOrderGiven) {
    // A crowd, in which who comes first takes the place that another wanted.
    arena_ = {"crowd", 70.0, 70.0, 5.0, 5.0, 5.0, 5.0, {}};
    set_robots(40);
    World world = make_world();
    const std::vector<float> translations(world.robots(), 1.0f);
    int blocked = 0, decided_by_order = 0;
    for (int cycle = 0; cycle < 400; ++cycle) {
        std::vector<float> rotations;
        for (std::size_t i = 0; i < world.robots(); ++i) {
            rotations.push_back(static_cast<float>(random_.uniform(-1.0, 1.0)));
            std::swap(order_[i], order_[random_.below(static_cast<std::uint32_t>(i + 1))]);
        }
        std::vector<double> x(world.x_px().begin(), world.x_px().end());
        std::vector<double> y(world.y_px().begin(), world.y_px().end());
        const auto x_before = x;
        const auto y_before = y;
        world.move(translations, rotations, order_);
        for (const std::uint32_t i : order_) {
            const double to_x = x[i] + 2.0 * world.heading_x()[i];
            const double to_y = y[i] + 2.0 * world.heading_y()[i];
            const auto closest = [&](const auto& xs, const auto& ys) {
                double smallest = 1e9;
                for (std::size_t j = 0; j < xs.size(); ++j) {
                    if (j == i) continue;
                    smallest = std::min(smallest, std::abs(xs[j] - to_x) + std::abs(ys[j] - to_y));
                }
                return smallest;
            };
            const double robot_px = closest(x, y);
            const double frame_px = std::min({to_x, to_y, 70.0 - to_x, 70.0 - to_y}) - 5.0;
            const bool is_close_call =
                std::abs(robot_px - 2 * radius_px) < 1e-3 || std::abs(frame_px - radius_px) < 1e-3;
            const bool stays = world.x_px()[i] == x_before[i] && world.y_px()[i] == y_before[i];
            const bool expected = robot_px < 2 * radius_px || frame_px < radius_px;
            ASSERT_TRUE(stays == expected || is_close_call) << cycle << ' ' << i;
            blocked += expected;
            decided_by_order +=
                (closest(x_before, y_before) < 2 * radius_px) != (robot_px < 2 * radius_px);
            x[i] = world.x_px()[i];
            y[i] = world.y_px()[i];
        }
        world.sense();
    }
    EXPECT_GT(blocked, 500);
    EXPECT_GT(decided_by_order, 80);
}

TEST_F(WorldTest, ItemsArePickedUpWithinReachAndReappearElsewhere) {
    collect(6);
    World world = make_world();
    int picked_up = 0;
    for (int cycle = 0; cycle < 600; ++cycle) {
        world.replace_items(random_);
        for (std::size_t i = 0; i < world.robots(); ++i) {
            bool in_reach = false;
            for (std::size_t item = 0; item < world.items().size(); ++item) {
                in_reach |= world.items().is_present(item) &&
                            std::hypot(world.items().x_px(item) - world.x_px()[i],
                                       world.items().y_px(item) - world.y_px()[i]) < 10.0;
            }
            const std::size_t absent = world.items().absent();
            // One at most; and none that appeared after the robot looked.
            const bool got_one = world.pick_up(i);
            EXPECT_EQ(world.items().absent(), absent + (got_one ? 1 : 0));
            EXPECT_TRUE(in_reach || !got_one);
            if (world.senses(i).reaches_item && in_reach) {
                EXPECT_TRUE(got_one);
            }
            picked_up += got_one;
        }
        wander(world);
    }
    EXPECT_GT(picked_up, 10);
    for (int cycle = 0; cycle < 3; ++cycle) world.replace_items(random_);
    EXPECT_EQ(world.items().absent(), 0u);
}

TEST_F(WorldTest, WallsPassForItemsAsOftenAsTheSlipSays) {
    collect(1);
    settings_.world.item_slip = 0.5;
    set_robots(20);
    World world = make_world();
    int walls = 0, slips = 0;
    for (int cycle = 0; cycle < 200; ++cycle) {
        for (std::size_t i = 0; i < world.robots(); ++i) {
            for (std::size_t ray = 0; ray < ray_count; ++ray) {
                if (world.senses(i).robot[ray] >= 0) continue;
                walls += world.senses(i).obstacle[ray] < 1.0f;
                slips += world.senses(i).item[ray] < 1.0f;
            }
        }
        wander(world);
    }
    EXPECT_NEAR(static_cast<double>(slips) / (walls + slips), 0.5, 0.1);
}

TEST_F(WorldTest, RobotsAndItemsDoNotPassForItemsByTheSlip) {
    collect(1);
    settings_.world.item_slip = 1.0;  // all walls do
    set_robots(20);
    World world = make_world();
    int robots = 0, walls = 0;
    for (int cycle = 0; cycle < 200; ++cycle) {
        for (std::size_t i = 0; i < world.robots(); ++i) {
            const Senses& senses = world.senses(i);
            for (std::size_t ray = 0; ray < ray_count; ++ray) {
                if (senses.robot[ray] >= 0) {
                    EXPECT_EQ(senses.item[ray], 1.0f);
                    ++robots;
                } else {
                    EXPECT_EQ(senses.obstacle[ray], 1.0f);
                    walls += senses.item[ray] < 1.0f;
                }
            }
        }
        wander(world);
    }
    EXPECT_GT(robots, 500);
    EXPECT_GT(walls, 5000);
}

TEST_F(WorldTest, NobodyIsHeardThroughAnItem) {
    collect(5);
    set_robots(20);
    World world = make_world();
    int hidden = 0;
    for (int cycle = 0; cycle < 400; ++cycle) {
        for (std::size_t i = 0; i < world.robots(); ++i) {
            const Senses& senses = world.senses(i);
            for (std::size_t ray = 0; ray < ray_count; ++ray) {
                if (senses.item[ray] == 1.0f) continue;
                EXPECT_EQ(senses.robot[ray], -1);
                const double angle = std::atan2(world.heading_y()[i], world.heading_x()[i]) +
                                     (static_cast<double>(ray) - 2.0) * std::acos(-1.0) / 4.0;
                for (std::size_t j = 0; j < world.robots(); ++j) {
                    const double x = world.x_px()[j] - world.x_px()[i];
                    const double y = world.y_px()[j] - world.y_px()[i];
                    hidden += j != i && diamond_along(std::cos(angle), std::sin(angle), x, y,
                                                      radius_px) < range_px;
                }
            }
        }
        wander(world);
    }
    EXPECT_GT(hidden, 80) << "hardly anybody was behind an item";
}

TEST_F(WorldTest, AnArenaWithoutRoomIsAnError) {
    set_robots(10'000);
    EXPECT_THROW(make_world(), std::runtime_error);
    set_robots(1);
    collect(200);
    EXPECT_THROW(make_world(), std::runtime_error);
}

}  // namespace
}  // namespace gene_clocks::sim
