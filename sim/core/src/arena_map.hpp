#pragma once

#include <cstdint>
#include <gene_clocks/sim/arena.hpp>
#include <span>
#include <vector>

namespace gene_clocks::sim {

/// Walls of one orientation (angles 90° apart count as one): the axes in which they are boxes.
/// Scaled such that at 45° ax = ay = 1, which are the coordinates u = x + y and v = y − x in
/// which a robot's diamond is a square.
struct WallOrientation {
    float ax{}, ay{};
};

/// The orientation of the robots' diamonds, and of all walls at ±45°.
inline constexpr std::uint32_t diamond_orientation = 0;

/// A wall as an axis-parallel box in the coordinates of its orientation:
/// along = x·ax + y·ay and across = y·ax − x·ay.
struct WallBox {
    float along_min{}, along_max{};
    float across_min{}, across_max{};
    // The same box's extent in the coordinates of the robots' diamonds, for collisions.
    float u_min{}, u_max{};
    float v_min{}, v_max{};
    std::uint32_t orientation{};
};

/// An arena, prepared for questions about a place: which walls can be seen or touched from there.
///
/// Immutable, so that runs on several threads share one.
class ArenaMap {
public:
    /// `reach_px`: how far from a robot's centre a wall still matters;
    /// `radius_px`: half the diagonal of a robot's diamond.
    ArenaMap(const Arena& arena, double reach_px, double radius_px);

    float width_px() const { return width_px_; }
    float height_px() const { return height_px_; }

    const WallOrientation& orientation(std::uint32_t index) const { return orientations_[index]; }
    const WallBox& wall(std::uint32_t index) const { return walls_[index]; }

    /// The walls that can be seen from (x, y), by orientation; a few more may be among them.
    std::span<const std::uint16_t> visible_walls(float x_px, float y_px) const {
        const std::size_t cell = cell_at(x_px, y_px);
        return {visible_.data() + cell_begin_[cell], visible_.data() + cell_begin_[cell + 1]};
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

    // Places lie within the arena: a robot that would leave it collides with the frame.
    std::size_t cell_at(float x_px, float y_px) const {
        return static_cast<std::size_t>(static_cast<std::int32_t>(y_px / cell_px)) * columns_ +
               static_cast<std::size_t>(static_cast<std::int32_t>(x_px / cell_px));
    }
    std::size_t touch_cell_at(float x_px, float y_px) const {
        return static_cast<std::size_t>(static_cast<std::int32_t>(y_px / touch_cell_px)) *
                   touch_columns_ +
               static_cast<std::size_t>(static_cast<std::int32_t>(x_px / touch_cell_px));
    }
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
    std::vector<WallBox> walls_;             // sorted by orientation
    std::vector<std::uint16_t> visible_;     // walls, by cell
    std::vector<std::uint32_t> cell_begin_;  // into visible_; one more than there are cells
    std::vector<std::uint8_t> may_touch_;
};

}  // namespace gene_clocks::sim
