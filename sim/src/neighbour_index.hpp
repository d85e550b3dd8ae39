#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gene_clocks::sim {

/// Which robots are near which: rebuilt every cycle by sorting the robots into cells as large as
/// the reach, and comparing each with those of the nine cells around it.
class NeighbourIndex {
public:
    NeighbourIndex(std::size_t robots, float width_px, float height_px, float reach_px);

    /// Lists, for every robot, the others whose centres are nearer than the reach.
    void rebuild(std::span<const float> x_px, std::span<const float> y_px);

    /// In an order that depends on positions only.
    std::span<const std::uint32_t> near(std::size_t robot) const {
        return {neighbours_.data() + begin_[robot], neighbours_.data() + end_[robot]};
    }

private:
    void sort_into_cells(std::span<const float> x_px, std::span<const float> y_px);

    float reach_px_;
    std::uint32_t columns_;  // a border of empty cells included, so that all have neighbours
    std::uint32_t rows_;
    std::vector<std::uint32_t> cell_of_;     // by robot
    std::vector<std::uint32_t> cell_begin_;  // into the sorted arrays
    std::vector<std::uint32_t> sorted_;      // robots by cell
    std::vector<float> sorted_x_px_;
    std::vector<float> sorted_y_px_;
    std::vector<std::uint32_t> neighbours_;
    std::vector<std::uint32_t> begin_;  // by robot, into neighbours_
    std::vector<std::uint32_t> end_;
};

}  // namespace gene_clocks::sim
