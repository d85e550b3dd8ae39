#pragma once

#include <gene_clocks/sim/arena.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/settings/document.hpp"

namespace gene_clocks::experiment {

/// What both sides of an arena may measure, and how many walls it may have.
inline constexpr Range arena_size_px{1.0, 1e5};
inline constexpr std::size_t arena_walls_maximum = 10'000;

/// Reads an arena: size, frame, and walls as rows [x1, y1, x2, y2, thickness], in pixels.
/// Throws InputError where a number is not finite, a wall leaves the arena or has no extent, the
/// frame leaves no room, a count is beyond reason, or a key is unknown.
sim::Arena read_arena(const Document& document);

/// The arena of that name: a built-in one, or the file if the name ends in ".toml".
sim::Arena find_arena(const std::string& name);

/// Size, frame and walls; not the name.
nlohmann::json geometry_to_json(const sim::Arena& arena);

}  // namespace gene_clocks::experiment
