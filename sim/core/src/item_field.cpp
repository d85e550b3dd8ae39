#include "sim/core/src/item_field.hpp"

#include <algorithm>

namespace gene_clocks::sim {

ItemField::ItemField(std::size_t items, float width_px, float height_px, float reach_px)
    : reach_px_(reach_px),
      columns_(static_cast<std::size_t>(width_px / cell_px) + 1),
      rows_(static_cast<std::size_t>(height_px / cell_px) + 1),
      words_per_cell_((items + 63) / 64),
      bits_(columns_ * rows_ * words_per_cell_, 0),
      x_px_(items, 0.0f),
      y_px_(items, 0.0f),
      present_(items, 0),
      absence_cycles_(items, 0),
      absent_(items) {}

void ItemField::put(std::size_t item, float x_px, float y_px) {
    x_px_[item] = x_px;
    y_px_[item] = y_px;
    present_[item] = 1;
    --absent_;
    mark(item, true);
}

void ItemField::take(std::size_t item, std::int64_t absence_cycles) {
    mark(item, false);
    present_[item] = 0;
    ++absent_;
    absence_cycles_[item] = absence_cycles;
}

void ItemField::mark(std::size_t item, bool present) {
    const auto cell_of = [](float place_px, std::size_t count) {
        const float cell = std::max(place_px, 0.0f) / cell_px;
        return std::min(static_cast<std::size_t>(cell), count - 1);
    };
    const float x = x_px_[item];
    const float y = y_px_[item];
    const std::uint64_t bit = std::uint64_t{1} << (item % 64);
    for (std::size_t row = cell_of(y - reach_px_, rows_); row <= cell_of(y + reach_px_, rows_);
         ++row) {
        for (std::size_t column = cell_of(x - reach_px_, columns_);
             column <= cell_of(x + reach_px_, columns_); ++column) {
            const float left = static_cast<float>(column) * cell_px;
            const float top = static_cast<float>(row) * cell_px;
            const float dx = std::max({left - x, 0.0f, x - left - cell_px});
            const float dy = std::max({top - y, 0.0f, y - top - cell_px});
            if (dx * dx + dy * dy > reach_px_ * reach_px_) continue;
            std::uint64_t& word = bits_[(row * columns_ + column) * words_per_cell_ + item / 64];
            word = present ? word | bit : word & ~bit;
        }
    }
}

}  // namespace gene_clocks::sim
