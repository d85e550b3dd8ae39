#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gene_clocks/sim/arena.hpp"

namespace gene_clocks::sim {

/// A wall as an axis-parallel box in the coordinates of its orientation:
/// along = x·ax + y·ay and across = y·ax − x·ay.
struct WallBox {
    float along_min{}, along_max{};
    float across_min{}, across_max{};
    // The same box's extent in the coordinates of the robots' diamonds, for collisions.
    float u_min{}, u_max{};
    float v_min{}, v_max{};
};

/// Walls of one orientation (angles 90° apart count as one): the axes in which they are boxes.
/// Scaled such that at 45° ax = ay = 1, which are the coordinates u = x + y and v = y − x in
/// which a robot's diamond is a square.
struct WallOrientation {
    float ax{}, ay{};
};

/// An arena, prepared for questions about a place: which walls can be seen or touched from there.
///
/// Immutable, so that runs on several threads share one.
class ArenaMap {
public:
    /// Walls of one orientation that can be seen from a cell: boxes [begin, end).
    struct Segment {
        std::uint32_t orientation;
        std::uint32_t begin;
        std::uint32_t end;
    };

    /// `reach_px`: how far from a robot's centre a wall still matters;
    /// `radius_px`: half the diagonal of a robot's diamond.
    ArenaMap(const Arena& arena, double reach_px, double radius_px);

    float width_px() const { return width_px_; }
    float height_px() const { return height_px_; }

    const WallOrientation& orientation(std::uint32_t index) const { return orientations_[index]; }
    const WallBox& box(std::uint32_t index) const { return boxes_[index]; }

    /// The walls that can be seen from (x, y), grouped by orientation; a few more may be there.
    std::span<const Segment> visible_walls(float x_px, float y_px) const {
        const std::size_t cell = cell_at(x_px, y_px);
        return {segments_.data() + cell_begin_[cell], segments_.data() + cell_begin_[cell + 1]};
    }

    /// Whether a robot's diamond at (x, y) meets a wall or leaves the arena.
    bool robot_touches_wall(float x_px, float y_px) const {
        return may_touch_[touch_cell_at(x_px, y_px)] && diamond_meets_wall(x_px, y_px);
    }

    /// Whether a disc at (x, y) meets a wall or leaves the arena. Not for every cycle.
    bool disc_touches_wall(float x_px, float y_px, float radius_px) const;

private:
    static constexpr float cell_px = 8.0f;
    static constexpr float touch_cell_px = 4.0f;

    std::size_t cell_at(float x_px, float y_px) const;
    std::size_t touch_cell_at(float x_px, float y_px) const;
    bool diamond_meets_wall(float x_px, float y_px) const;
    void add_wall(const ThickSegment& wall);
    void list_visible_walls(float reach_px);
    void mark_touchable_cells();

    float width_px_;
    float height_px_;
    float radius_px_;
    std::size_t columns_;
    std::size_t rows_;
    std::size_t touch_columns_;
    std::size_t touch_rows_;
    std::vector<WallOrientation> orientations_;
    struct Wall {
        std::uint32_t orientation;
        WallBox box;
    };
    std::vector<Wall> walls_;     // sorted by orientation
    std::vector<WallBox> boxes_;  // those of each cell lie together
    std::vector<Segment> segments_;
    std::vector<std::uint32_t> cell_begin_;  // into segments_; one more than there are cells
    std::vector<std::uint8_t> may_touch_;
};

}  // namespace gene_clocks::sim
