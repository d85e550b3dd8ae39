#pragma once

#include <string>
#include <vector>

namespace gene_clocks::sim {

/// A wall with flat ends, given by its centre line. Lengths in pixels, x right, y down.
struct ThickSegment {
    double x1_px{}, y1_px{}, x2_px{}, y2_px{};
    double thickness_px{};
};

/// A rectangular arena; nothing lies outside it. The frame is part of the arena.
struct Arena {
    std::string name;
    double width_px{}, height_px{};
    double frame_left_px{}, frame_top_px{}, frame_right_px{}, frame_bottom_px{};  ///< thickness
    std::vector<ThickSegment> walls;
};

/// The same arena with all lengths times `factor`, which is positive.
Arena scaled(Arena arena, double factor);

}  // namespace gene_clocks::sim
