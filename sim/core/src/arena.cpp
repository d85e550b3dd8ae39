#include <gene_clocks/sim/arena.hpp>

namespace gene_clocks::sim {

Arena scaled(Arena arena, double factor) {
    for (double* length_px : {&arena.width_px, &arena.height_px, &arena.frame_left_px,
                              &arena.frame_top_px, &arena.frame_right_px, &arena.frame_bottom_px}) {
        *length_px *= factor;
    }
    for (ThickSegment& wall : arena.walls) {
        for (double* length_px :
             {&wall.x1_px, &wall.y1_px, &wall.x2_px, &wall.y2_px, &wall.thickness_px}) {
            *length_px *= factor;
        }
    }
    return arena;
}

}  // namespace gene_clocks::sim
