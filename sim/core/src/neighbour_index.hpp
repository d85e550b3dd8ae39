#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gene_clocks::sim {

/// Which robots may be near which: Verlet's lists, as molecular dynamics keeps them.
///
/// A list holds all robots within the reach and a margin. No robot is faster than `speed_px` a
/// cycle, so that a list stays complete for several cycles and is rebuilt only then, by sorting
/// the robots into cells and comparing each with those of the nine cells around it.
class NeighbourIndex {
public:
    NeighbourIndex(std::size_t robots, float width_px, float height_px, float reach_px,
                   float speed_px);

    /// To be called once a cycle, before the robots move. Positions lie within the arena.
    void update(std::span<const float> x_px, std::span<const float> y_px) {
        if (cycles_left_ == 0) rebuild(x_px, y_px);
        --cycles_left_;
    }

    /// All other robots that can be within the reach of this one, before and after the coming
    /// moves, and some that are not; in an order that depends on positions only.
    std::span<const std::uint32_t> near(std::size_t robot) const {
        return {neighbours_.data() + begin_[robot], neighbours_.data() + begin_[robot + 1]};
    }

private:
    static constexpr std::int64_t lifetime_cycles = 8;

    void rebuild(std::span<const float> x_px, std::span<const float> y_px);
    void sort_into_cells(std::span<const float> x_px, std::span<const float> y_px);

    float list_reach_px_;  // two robots approach each other by 2 · speed a cycle
    std::int64_t cycles_left_ = 0;
    std::uint32_t columns_;  // a border of empty cells included, so that all have neighbours
    std::uint32_t rows_;
    std::vector<std::uint32_t> cell_of_;     // by robot
    std::vector<std::uint32_t> cell_begin_;  // into the sorted arrays
    std::vector<std::uint32_t> sorted_;      // robots by cell
    std::vector<float> sorted_x_px_;
    std::vector<float> sorted_y_px_;
    std::vector<std::uint32_t> neighbours_;
    std::vector<std::uint32_t> begin_;  // by robot, into neighbours_; one more than there are
};

}  // namespace gene_clocks::sim
