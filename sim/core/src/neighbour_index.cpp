#include "sim/core/src/neighbour_index.hpp"

#include <algorithm>

namespace gene_clocks::sim {

NeighbourIndex::NeighbourIndex(std::size_t robots, float width_px, float height_px, float reach_px,
                               float speed_px)
    : list_reach_px_(reach_px + 2.0f * speed_px * static_cast<float>(lifetime_cycles)),
      columns_(static_cast<std::uint32_t>(width_px / list_reach_px_) + 3),
      rows_(static_cast<std::uint32_t>(height_px / list_reach_px_) + 3),
      cell_of_(robots),
      cell_begin_(columns_ * rows_ + 1),
      sorted_(robots),
      sorted_x_px_(robots),
      sorted_y_px_(robots),
      begin_(robots + 1) {}

void NeighbourIndex::sort_into_cells(std::span<const float> x_px, std::span<const float> y_px) {
    const float per_px = 1.0f / list_reach_px_;
    std::fill(cell_begin_.begin(), cell_begin_.end(), 0u);
    const std::size_t robots = cell_of_.size();
    for (std::size_t i = 0; i < robots; ++i) {
        const auto column = static_cast<std::uint32_t>(x_px[i] * per_px) + 1;
        const auto row = static_cast<std::uint32_t>(y_px[i] * per_px) + 1;
        cell_of_[i] = row * columns_ + column;
        ++cell_begin_[cell_of_[i]];
    }
    std::uint32_t total = 0;
    for (auto& begin : cell_begin_) {
        total += begin;
        begin = total;  // for now the end of the cell; filling it backwards makes it the begin
    }
    for (std::size_t i = robots; i-- > 0;) {
        const std::uint32_t place = --cell_begin_[cell_of_[i]];
        sorted_[place] = static_cast<std::uint32_t>(i);
        sorted_x_px_[place] = x_px[i];
        sorted_y_px_[place] = y_px[i];
    }
}

void NeighbourIndex::rebuild(std::span<const float> x_px, std::span<const float> y_px) {
    cycles_left_ = lifetime_cycles;
    sort_into_cells(x_px, y_px);
    const float reach_square = list_reach_px_ * list_reach_px_;
    const std::size_t robots = cell_of_.size();
    std::uint32_t used = 0;
    for (std::size_t i = 0; i < robots; ++i) {
        // Room for all, so that the loop below needs no test; kept from cycle to cycle.
        if (neighbours_.size() < used + robots) neighbours_.resize(2 * (used + robots));
        begin_[i] = used;
        std::uint32_t* const list = neighbours_.data();
        for (std::uint32_t cell = cell_of_[i] - columns_ - 1; cell <= cell_of_[i] + columns_;
             cell += columns_) {
            const std::uint32_t end = cell_begin_[cell + 3];
            for (std::uint32_t k = cell_begin_[cell]; k < end; ++k) {
                const float dx = sorted_x_px_[k] - x_px[i];
                const float dy = sorted_y_px_[k] - y_px[i];
                list[used] = sorted_[k];
                used += dx * dx + dy * dy < reach_square && sorted_[k] != i ? 1u : 0u;
            }
        }
    }
    begin_[robots] = used;
}

}  // namespace gene_clocks::sim
