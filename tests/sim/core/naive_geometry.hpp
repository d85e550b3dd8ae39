#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gene_clocks/neat/random.hpp>
#include <gene_clocks/sim/arena.hpp>

/// The simulator's geometry, written down again in the plainest way: what a point, a diamond or a
/// disc has to do with the shapes of an arena, in double precision and without any table.
namespace gene_clocks::sim::naive {

/// Frame, bars at ±45° as in the paper's arena, and two walls at odd angles.
inline Arena arena() {
    Arena arena{"test", 120.0, 100.0, 5.0, 6.0, 5.0, 5.0, {}};
    arena.walls = {{20.0, 20.0, 40.0, 40.0, 7.0},
                   {90.0, 20.0, 70.0, 40.0, 8.0},
                   {30.0, 70.0, 60.0, 75.0, 4.0},
                   {95.0, 50.0, 95.0, 85.0, 3.0}};
    return arena;
}

inline bool is_in_frame(const Arena& arena, double x, double y) {
    return x < arena.frame_left_px || x > arena.width_px - arena.frame_right_px ||
           y < arena.frame_top_px || y > arena.height_px - arena.frame_bottom_px;
}

/// Distance of a point from a wall, 0 inside.
inline double distance(const ThickSegment& wall, double x, double y) {
    const double length = std::hypot(wall.x2_px - wall.x1_px, wall.y2_px - wall.y1_px);
    const double ex = (wall.x2_px - wall.x1_px) / length;
    const double ey = (wall.y2_px - wall.y1_px) / length;
    const double along = (x - wall.x1_px) * ex + (y - wall.y1_px) * ey;
    const double across = (y - wall.y1_px) * ex - (x - wall.x1_px) * ey;
    return std::hypot(std::max({-along, 0.0, along - length}),
                      std::max(std::abs(across) - wall.thickness_px / 2, 0.0));
}

inline bool is_wall(const Arena& arena, double x, double y) {
    return is_in_frame(arena, x, y) ||
           std::any_of(arena.walls.begin(), arena.walls.end(),
                       [&](const ThickSegment& wall) { return distance(wall, x, y) <= 0.0; });
}

inline bool is_in_diamond(double x, double y, double centre_x, double centre_y, double radius) {
    return std::abs(x - centre_x) + std::abs(y - centre_y) <= radius;
}

/// Whether a diamond meets a wall, by points of its rim and inside; misses contacts shallower than
/// the distance of two points, a twentieth of a pixel.
inline bool diamond_meets_wall(const Arena& arena, double x, double y, double radius) {
    const int points = static_cast<int>(radius / 0.05);
    for (int i = -points; i <= points; ++i) {
        for (int j = -points + std::abs(i); j <= points - std::abs(i); ++j) {
            if (is_wall(arena, x + i * radius / points, y + j * radius / points)) return true;
        }
    }
    return false;
}

}  // namespace gene_clocks::sim::naive
