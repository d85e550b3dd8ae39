#pragma once

#include <array>
#include <cstdint>
#include <gene_clocks/neat/random.hpp>
#include <gene_clocks/sim/settings.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/core/src/arena_map.hpp"
#include "sim/core/src/item_field.hpp"
#include "sim/core/src/lanes.hpp"
#include "sim/core/src/neighbour_index.hpp"

namespace gene_clocks::sim {

inline constexpr std::size_t ray_count = 8;

/// What one robot senses in a cycle. Ray 0 points left, the others follow clockwise.
struct alignas(32) Senses {
    std::array<float, ray_count> obstacle;      ///< 0 touching … 1 nothing in range
    std::array<float, ray_count> item;          ///< the same for items; 1 without
    std::array<std::int32_t, ray_count> robot;  ///< who is hit within radio range, or −1
    float nearest_obstacle;                     ///< the smallest of `obstacle`
    bool hears_robot;                           ///< any of `robot` is not −1
    bool meets_robot;   ///< a robot is so near that the next moves can make them collide
    bool reaches_item;  ///< an item's centre is near enough to be picked up
};

/// The physical side of a run: bodies, movement, collisions, sensing.
///
/// Lengths in pixels, x to the right, y down; a robot is a diamond |dx| + |dy| ≤ radius that does
/// not turn with its heading. All robots move, one after the other; then all sense.
class World {
public:
    /// Puts items and robots at random free places; throws std::runtime_error where none is found.
    World(const Settings& settings, std::shared_ptr<const ArenaMap> map,
          neat::RandomStream& random);

    std::size_t robots() const { return x_px_.size(); }
    const Senses& senses(std::size_t robot) const { return senses_[robot]; }
    std::span<const float> x_px() const { return {x_px_.data(), robots()}; }
    std::span<const float> y_px() const { return {y_px_.data(), robots()}; }
    /// Cosine and sine of the robots' headings.
    std::span<const float> heading_x() const { return {cosine_.data(), robots()}; }
    std::span<const float> heading_y() const { return {sine_.data(), robots()}; }
    const ItemField& items() const { return items_; }

    /// Puts items whose time has come at random free places; those that find none try again.
    void replace_items(neat::RandomStream& random);

    /// Takes an item within a robot's reach, the first by index. False where there is none.
    bool pick_up(std::size_t robot);

    /// Robots turn, then try to move in `order`. `translation` and `rotation` in [−1, 1].
    /// Returns the number of collisions.
    std::uint64_t move(std::span<const float> translation, std::span<const float> rotation,
                       std::span<const std::uint32_t> order);

    /// All robots look at the world as it stands.
    void sense();

private:
    struct Place {
        float x_px, y_px;
    };

    template <class IsFree>
    std::optional<Place> find_place(neat::RandomStream& random, IsFree is_free) const;
    void place_robots(neat::RandomStream& random);
    bool put_item(std::size_t item, neat::RandomStream& random);
    bool is_free_for_robot(float x_px, float y_px, std::size_t placed) const;
    bool is_free_for_item(float x_px, float y_px) const;
    bool collides(std::size_t robot, float x_px, float y_px) const;

    const WorldSettings settings_;
    bool has_items_;
    float range_px_;        // of the rays, from the robot's edge
    float radio_range_px_;  // the same for robots that hear a broadcast
    float radius_px_;
    float meeting_px_;  // centres that are farther apart stay so in the next moves
    float item_radius_px_;
    float item_reach_px_;
    std::shared_ptr<const ArenaMap> map_;
    NeighbourIndex neighbours_;
    ItemField items_;

    // Robots, structure of arrays.
    std::vector<float> x_px_, y_px_;
    std::vector<float> cosine_, sine_;   // of the heading; unit length
    std::vector<float> translation_px_;  // of the last cycle, 0 after a collision
    std::vector<float> planned_x_px_, planned_y_px_;
    std::vector<Senses> senses_;
    std::vector<std::uint32_t> near_;  // room for sense_all

    friend void sense_all(World& world);
};

}  // namespace gene_clocks::sim
