#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gene_clocks::sim {

/// The items of the collection task: discs that rays and robots meet, picked up and replaced.
class ItemField {
public:
    /// `reach_px`: how far from an item's centre it still matters to a robot.
    ItemField(std::size_t items, float width_px, float height_px, float reach_px);

    std::size_t size() const { return x_px_.size(); }
    bool is_present(std::size_t item) const { return present_[item] != 0; }
    float x_px(std::size_t item) const { return x_px_[item]; }
    float y_px(std::size_t item) const { return y_px_[item]; }
    std::span<const float> x_px() const { return x_px_; }
    std::span<const float> y_px() const { return y_px_; }
    std::span<const std::uint8_t> is_present() const { return present_; }

    void put(std::size_t item, float x_px, float y_px);
    void take(std::size_t item, std::int64_t absence_cycles);

    std::size_t absent() const { return absent_; }

    /// To be called once a cycle. True when an absent item is due to reappear, which stays so
    /// until it is put.
    bool count_down(std::size_t item) {
        if (is_present(item)) return false;
        if (absence_cycles_[item] > 0) --absence_cycles_[item];
        return absence_cycles_[item] == 0;
    }

    /// Calls `visit(item)` for every present item that can matter at (x, y), in ascending order;
    /// a few more may be among them. The place must lie within the arena.
    template <class Visit>
    void visit_near(float x_px, float y_px, Visit visit) const {
        const std::uint64_t* words = bits_.data() + cell_at(x_px, y_px) * words_per_cell_;
        for (std::size_t w = 0; w < words_per_cell_; ++w) {
            for (std::uint64_t bits = words[w]; bits != 0; bits &= bits - 1) {
                visit(64 * w + static_cast<std::size_t>(__builtin_ctzll(bits)));
            }
        }
    }

private:
    static constexpr float cell_px = 16.0f;

    std::size_t cell_at(float x_px, float y_px) const {
        return static_cast<std::size_t>(y_px / cell_px) * columns_ +
               static_cast<std::size_t>(x_px / cell_px);
    }
    void mark(std::size_t item, bool present);

    float reach_px_;
    std::size_t columns_;
    std::size_t rows_;
    std::size_t words_per_cell_;
    std::vector<std::uint64_t> bits_;  // per cell, one bit for each item within reach of it
    std::vector<float> x_px_;
    std::vector<float> y_px_;
    std::vector<std::uint8_t> present_;
    std::vector<std::int64_t> absence_cycles_;  // of an absent item: cycles until it is due
    std::size_t absent_;
};

}  // namespace gene_clocks::sim
