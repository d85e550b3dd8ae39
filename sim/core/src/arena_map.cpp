#include "sim/core/src/arena_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gene_clocks::sim {
namespace {

/// The frame's walls reach this far out, so that nothing sees or slips past them.
double outside_px(const Arena& arena) {
    return std::max({1e4, 2 * arena.width_px, 2 * arena.height_px});
}

// One cell more than the extent needs, for places on its very edge.
std::size_t cell_count(float extent_px, float cell_px) {
    return static_cast<std::size_t>(extent_px / cell_px) + 1;
}

struct Point {
    float along, across;
};

Point rotate(const WallOrientation& axes, float x, float y) {
    return {x * axes.ax + y * axes.ay, y * axes.ax - x * axes.ay};
}

float scale_of(const WallOrientation& axes) {
    return std::hypot(axes.ax, axes.ay);
}

/// Distance from a place to a box, 0 inside.
float distance_px(const WallOrientation& axes, const WallBox& box, float x, float y) {
    const Point p = rotate(axes, x, y);
    const float along = std::max({box.along_min - p.along, 0.0f, p.along - box.along_max});
    const float across = std::max({box.across_min - p.across, 0.0f, p.across - box.across_max});
    return std::hypot(along, across) / scale_of(axes);
}

}  // namespace

ArenaMap::ArenaMap(const Arena& arena, double reach_px, double radius_px)
    : width_px_(static_cast<float>(arena.width_px)),
      height_px_(static_cast<float>(arena.height_px)),
      radius_px_(static_cast<float>(radius_px)),
      columns_(cell_count(width_px_, cell_px)),
      rows_(cell_count(height_px_, cell_px)),
      touch_columns_(cell_count(width_px_, touch_cell_px)),
      touch_rows_(cell_count(height_px_, touch_cell_px)),
      orientations_(1, WallOrientation{1.0f, 1.0f}) {
    for (const ThickSegment& wall : arena.walls) add_wall(wall);
    // The frame, as four walls that reach from its inner edge far outside.
    const double outside = outside_px(arena);
    const double left = arena.frame_left_px - outside / 2;
    const double right = arena.width_px - arena.frame_right_px + outside / 2;
    const double top = arena.frame_top_px - outside / 2;
    const double bottom = arena.height_px - arena.frame_bottom_px + outside / 2;
    add_wall({left, -outside, left, outside, outside});
    add_wall({right, -outside, right, outside, outside});
    add_wall({-outside, top, outside, top, outside});
    add_wall({-outside, bottom, outside, bottom, outside});
    list_visible_walls(static_cast<float>(reach_px));
    mark_touchable_cells();
}

void ArenaMap::add_wall(const ThickSegment& wall) {
    const double dx = wall.x2_px - wall.x1_px;
    const double dy = wall.y2_px - wall.y1_px;
    const double length = std::hypot(dx, dy);
    // Turned by quarter turns into 0 ≤ angle < 90°; the box is then either along or across.
    double cosine = length > 0.0 ? dx / length : 1.0;
    double sine = length > 0.0 ? dy / length : 0.0;
    bool quarter_turned = false;
    while (!(cosine > 1e-9 && sine > -1e-9)) {
        const double turned = -sine;
        sine = cosine;
        cosine = turned;
        quarter_turned = !quarter_turned;
    }
    const double scale = std::max(cosine, sine);
    const WallOrientation axes{static_cast<float>(cosine / scale),
                               static_cast<float>(sine / scale)};
    std::uint32_t orientation = 0;
    while (orientation < orientations_.size() &&
           std::hypot(orientations_[orientation].ax - axes.ax,
                      orientations_[orientation].ay - axes.ay) > 1e-6f) {
        ++orientation;
    }
    if (orientation == orientations_.size()) orientations_.push_back(axes);

    const double to_axes = std::hypot(static_cast<double>(axes.ax), static_cast<double>(axes.ay));
    const Point centre = rotate(axes, static_cast<float>((wall.x1_px + wall.x2_px) / 2),
                                static_cast<float>((wall.y1_px + wall.y2_px) / 2));
    auto half_along = static_cast<float>(length / 2 * to_axes);
    auto half_across = static_cast<float>(wall.thickness_px / 2 * to_axes);
    if (quarter_turned) std::swap(half_along, half_across);
    WallBox box;
    box.orientation = orientation;
    box.along_min = centre.along - half_along;
    box.along_max = centre.along + half_along;
    box.across_min = centre.across - half_across;
    box.across_max = centre.across + half_across;

    // Corners back in (x, y), then in the diamonds' coordinates.
    const float square = axes.ax * axes.ax + axes.ay * axes.ay;
    box.u_min = box.v_min = std::numeric_limits<float>::infinity();
    box.u_max = box.v_max = -std::numeric_limits<float>::infinity();
    for (const float along : {box.along_min, box.along_max}) {
        for (const float across : {box.across_min, box.across_max}) {
            const float x = (along * axes.ax - across * axes.ay) / square;
            const float y = (along * axes.ay + across * axes.ax) / square;
            box.u_min = std::min(box.u_min, x + y);
            box.u_max = std::max(box.u_max, x + y);
            box.v_min = std::min(box.v_min, y - x);
            box.v_max = std::max(box.v_max, y - x);
        }
    }
    const auto place = std::upper_bound(
        walls_.begin(), walls_.end(), orientation,
        [](std::uint32_t wanted, const WallBox& other) { return wanted < other.orientation; });
    walls_.insert(place, box);
}

void ArenaMap::list_visible_walls(float reach_px) {
    const float half_diagonal = cell_px * std::numbers::sqrt2_v<float> / 2;
    cell_begin_.reserve(columns_ * rows_ + 1);
    for (std::size_t row = 0; row < rows_; ++row) {
        for (std::size_t column = 0; column < columns_; ++column) {
            const float x = (static_cast<float>(column) + 0.5f) * cell_px;
            const float y = (static_cast<float>(row) + 0.5f) * cell_px;
            cell_begin_.push_back(static_cast<std::uint32_t>(visible_.size()));
            for (std::size_t i = 0; i < walls_.size(); ++i) {
                const float distance =
                    distance_px(orientations_[walls_[i].orientation], walls_[i], x, y);
                if (distance > reach_px + half_diagonal) continue;
                visible_.push_back(static_cast<std::uint16_t>(i));
            }
        }
    }
    cell_begin_.push_back(static_cast<std::uint32_t>(visible_.size()));
}

void ArenaMap::mark_touchable_cells() {
    const float half_diagonal = touch_cell_px * std::numbers::sqrt2_v<float> / 2;
    may_touch_.assign(touch_columns_ * touch_rows_, 0);
    for (std::size_t row = 0; row < touch_rows_; ++row) {
        for (std::size_t column = 0; column < touch_columns_; ++column) {
            const float x = (static_cast<float>(column) + 0.5f) * touch_cell_px;
            const float y = (static_cast<float>(row) + 0.5f) * touch_cell_px;
            const bool near = std::any_of(walls_.begin(), walls_.end(), [&](const WallBox& wall) {
                return distance_px(orientations_[wall.orientation], wall, x, y) <=
                       radius_px_ + half_diagonal;
            });
            may_touch_[row * touch_columns_ + column] = near ? 1 : 0;
        }
    }
}

/// Separating axes of a box and a diamond: those of the box, then those of the diamond.
bool ArenaMap::diamond_meets_wall(float x_px, float y_px) const {
    const float u = x_px + y_px;
    const float v = y_px - x_px;
    for (const std::uint16_t i : visible_walls(x_px, y_px)) {
        const WallBox& box = walls_[i];
        const WallOrientation& axes = orientations_[box.orientation];
        const Point p = rotate(axes, x_px, y_px);
        const float half = radius_px_ * std::max(std::abs(axes.ax), std::abs(axes.ay));
        if (p.along + half > box.along_min && p.along - half < box.along_max &&
            p.across + half > box.across_min && p.across - half < box.across_max &&
            u + radius_px_ > box.u_min && u - radius_px_ < box.u_max &&
            v + radius_px_ > box.v_min && v - radius_px_ < box.v_max) {
            return true;
        }
    }
    return false;
}

bool ArenaMap::disc_touches_wall(float x_px, float y_px, float radius_px) const {
    return std::any_of(walls_.begin(), walls_.end(), [&](const WallBox& wall) {
        return distance_px(orientations_[wall.orientation], wall, x_px, y_px) < radius_px;
    });
}

}  // namespace gene_clocks::sim
