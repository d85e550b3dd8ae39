// Eight rays from every robot against walls, robots and items: more than half of a run's time.

#include <algorithm>

#include "sim/core/src/world.hpp"

namespace gene_clocks::sim {
namespace {

constexpr float half_root = 0.70710678f;
// Ray directions of a robot that heads along x: ray 0 to the left (up, since y points down),
// then clockwise in steps of 45°; ray 2 is straight ahead.
constexpr FloatLanes ray_cosine = {0, half_root, 1, half_root, 0, -half_root, -1, -half_root};
constexpr FloatLanes ray_sine = {-1, -half_root, 0, half_root, 1, half_root, 0, -half_root};

/// The eight rays of one robot, and the nearest thing that each has met so far.
struct RayFan {
    FloatLanes dx, dy;   // unit directions
    FloatLanes nearest;  // distance from the robot's centre

    /// Directions in turned coordinates, as reciprocals, ready for boxes.
    struct Turned {
        FloatLanes per_along, per_across;
    };
    GENE_CLOCKS_INLINE Turned turn(float ax, float ay) const {
        return {1.0f / (ax * dx + ay * dy), 1.0f / (ax * dy - ay * dx)};
    }

    /// Where the rays meet an axis-parallel box, given relative to the robot. Returns the rays for
    /// which it is nearer than all before it. A ray within a box meets it at 0.
    GENE_CLOCKS_INLINE IntLanes meet_box(const Turned& ray, float along_min, float along_max,
                                         float across_min, float across_max) {
        const FloatLanes a = along_min * ray.per_along;
        const FloatLanes b = along_max * ray.per_along;
        const FloatLanes c = across_min * ray.per_across;
        const FloatLanes d = across_max * ray.per_across;
        const FloatLanes enter =
            lanes_max(lanes_max(lanes_min(a, b), lanes_min(c, d)), FloatLanes{});
        const FloatLanes leave = lanes_min(lanes_min(lanes_max(a, b), lanes_max(c, d)), nearest);
        const IntLanes hit = enter < leave;
        nearest = hit ? enter : nearest;
        return hit;
    }

    /// The same for a disc.
    GENE_CLOCKS_INLINE IntLanes meet_disc(float x, float y, float radius_square) {
        const FloatLanes along = x * dx + y * dy;
        const FloatLanes square = along * along + (radius_square - (x * x + y * y));
        const FloatLanes enter =
            lanes_max(along - lanes_sqrt(lanes_max(square, FloatLanes{})), FloatLanes{});
        const IntLanes hit = (square >= 0.0f) & (along > 0.0f) & (enter < nearest);
        nearest = hit ? enter : nearest;
        return hit;
    }
};

/// A number in [0, 1) for a pixel, the same in every cycle.
float pixel_hash(std::int32_t x, std::int32_t y) {
    std::uint64_t mixed = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u +
                          static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    return static_cast<float>((mixed ^ (mixed >> 31)) >> 40) * 0x1.0p-24f;
}

/// Wall hits that pass for items: in the reference system some pixels at the rim of a wall do.
GENE_CLOCKS_INLINE IntLanes slipped(const RayFan& fan, IntLanes wall_hit, float x, float y,
                                    float share) {
    IntLanes slip{};
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if (wall_hit[lane] == 0) continue;
        const auto hit_x = static_cast<std::int32_t>(x + fan.dx[lane] * fan.nearest[lane]);
        const auto hit_y = static_cast<std::int32_t>(y + fan.dy[lane] * fan.nearest[lane]);
        if (pixel_hash(hit_x, hit_y) < share) slip[lane] = -1;
    }
    return slip;
}

}  // namespace

GENE_CLOCKS_MULTIVERSION
void sense_all(World& world) {
    const float radius = world.radius_px_;
    const float per_range = 1.0f / world.range_px_;
    const float radio_reach = world.radio_range_px_ + radius;
    const float item_square = world.item_radius_px_ * world.item_radius_px_;
    const float item_reach_square = world.item_reach_px_ * world.item_reach_px_;
    const auto slip_share = static_cast<float>(world.settings_.item_slip);
    const float near_square = (world.range_px_ + 2 * radius) * (world.range_px_ + 2 * radius);
    const float meeting_square = world.meeting_px_ * world.meeting_px_;
    std::uint32_t* const near_list = world.near_.data();
    const ArenaMap& map = *world.map_;
    for (std::size_t i = 0; i < world.robots(); ++i) {
        const float x = world.x_px_[i];
        const float y = world.y_px_[i];
        const float cosine = world.cosine_[i];
        const float sine = world.sine_[i];
        RayFan fan{cosine * ray_cosine - sine * ray_sine, sine * ray_cosine + cosine * ray_sine,
                   lanes(world.range_px_ + radius)};

        const RayFan::Turned diamond_rays = fan.turn(1.0f, 1.0f);
        IntLanes wall_hit{};
        std::uint32_t orientation = diamond_orientation;
        RayFan::Turned rays = diamond_rays;
        float along = x + y;
        float across = y - x;
        for (const std::uint16_t k : map.visible_walls(x, y)) {
            const WallBox& wall = map.wall(k);
            if (wall.orientation != orientation) {
                orientation = wall.orientation;
                const WallOrientation& axes = map.orientation(orientation);
                rays = fan.turn(axes.ax, axes.ay);
                along = x * axes.ax + y * axes.ay;
                across = y * axes.ax - x * axes.ay;
            }
            wall_hit |= fan.meet_box(rays, wall.along_min - along, wall.along_max - along,
                                     wall.across_min - across, wall.across_max - across);
        }

        // First those that are near enough, without a branch that nobody can predict.
        std::size_t near = 0;
        bool meets_robot = false;
        for (const std::uint32_t j : world.neighbours_.near(i)) {
            const float dx = world.x_px_[j] - x;
            const float dy = world.y_px_[j] - y;
            const float distance_square = dx * dx + dy * dy;
            near_list[near] = j;
            near += distance_square < near_square ? 1u : 0u;
            meets_robot |= distance_square < meeting_square;
        }
        IntLanes who = IntLanes{} - 1;
        for (std::size_t k = 0; k < near; ++k) {
            const std::uint32_t j = near_list[k];
            const float dx = world.x_px_[j] - x;
            const float dy = world.y_px_[j] - y;
            const float u = dx + dy;
            const float v = dy - dx;
            const IntLanes hit =
                fan.meet_box(diamond_rays, u - radius, u + radius, v - radius, v + radius);
            who = hit ? IntLanes{} + static_cast<std::int32_t>(j) : who;
        }
        wall_hit &= who < 0;

        Senses& senses = world.senses_[i];
        senses.meets_robot = meets_robot;
        senses.reaches_item = false;
        IntLanes item_hit{};
        if (world.has_items_) {
            bool reaches_item = false;
            world.items_.visit_near(x, y, [&](std::size_t item) {
                const float dx = world.items_.x_px(item) - x;
                const float dy = world.items_.y_px(item) - y;
                reaches_item |= dx * dx + dy * dy < item_reach_square;
                item_hit |= fan.meet_disc(dx, dy, item_square);
            });
            senses.reaches_item = reaches_item;
            who = item_hit ? IntLanes{} - 1 : who;
            wall_hit &= ~item_hit;
            if (slip_share > 0.0f && any(wall_hit))
                item_hit |= slipped(fan, wall_hit, x, y, slip_share);
        }

        who = fan.nearest <= radio_reach ? who : IntLanes{} - 1;
        const FloatLanes reading =
            lanes_min(lanes_max((fan.nearest - radius) * per_range, FloatLanes{}), lanes(1.0f));
        const FloatLanes obstacle = item_hit ? lanes(1.0f) : reading;
        const FloatLanes item = item_hit ? reading : lanes(1.0f);
        store(obstacle, senses.obstacle);
        store(item, senses.item);
        store(who, senses.robot);
        senses.nearest_obstacle = smallest(obstacle);
        senses.hears_robot = near > 0 && any(who >= 0);
    }
}

void World::sense() {
    sense_all(*this);
}

}  // namespace gene_clocks::sim
