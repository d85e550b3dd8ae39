#pragma once

#include <gene_clocks/sim/arena.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/settings/document.hpp"

namespace gene_clocks::experiment {

/// Reads an arena: size, frame, and walls as rows [x1, y1, x2, y2, thickness], in pixels.
/// Throws InputError where a number is not finite, a wall leaves the arena or has no extent, the
/// frame leaves no room, a count is beyond reason, or a key is unknown.
sim::Arena read_arena(const Document& document);

/// The arena of that name: a built-in one, or the file if the name ends in ".toml".
sim::Arena find_arena(const std::string& name);

/// Size, frame and walls; not the name.
nlohmann::json geometry_to_json(const sim::Arena& arena);

}  // namespace gene_clocks::experiment
