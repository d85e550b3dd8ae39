#include "sim/settings/arena_file.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

namespace gene_clocks::experiment {
namespace {

sim::ThickSegment read_wall(const Document& document, const toml::node& row,
                            const sim::Arena& arena, std::size_t index) {
    const Place place = document.place_of(row);
    const std::string key = fmt::format("walls[{}]", index);
    const toml::array* numbers = row.as_array();
    if (numbers == nullptr || numbers->size() != 5) {
        throw key_error(place, key, "expected five numbers [x1, y1, x2, y2, thickness]");
    }
    const Range x{0.0, arena.width_px};
    const Range y{0.0, arena.height_px};
    const Range thickness{0.0, std::max(arena.width_px, arena.height_px), true};
    const std::array<Range, 5> ranges{x, y, x, y, thickness};
    std::array<double, 5> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = read_real(*numbers->get(i), ranges[i], place, key);
    }
    if (values[0] == values[2] && values[1] == values[3]) {
        throw key_error(place, key, "its centre line has no length");
    }
    return {values[0], values[1], values[2], values[3], values[4]};
}

void read_frame(const Document& document, const toml::table& table, sim::Arena& arena) {
    TableReader frame(document, table, "frame");
    arena.frame_left_px = frame.required_real("left_px", {0.0, arena.width_px});
    arena.frame_right_px = frame.required_real("right_px", {0.0, arena.width_px});
    arena.frame_top_px = frame.required_real("top_px", {0.0, arena.height_px});
    arena.frame_bottom_px = frame.required_real("bottom_px", {0.0, arena.height_px});
    frame.refuse_other_keys();
    if (arena.frame_left_px + arena.frame_right_px >= arena.width_px) {
        throw frame.error("right_px", "the frame leaves no room between left and right");
    }
    if (arena.frame_top_px + arena.frame_bottom_px >= arena.height_px) {
        throw frame.error("bottom_px", "the frame leaves no room between top and bottom");
    }
}

}  // namespace

sim::Arena read_arena(const Document& document) {
    TableReader reader(document, document.table);
    sim::Arena arena;
    arena.name = reader.required_text("name");
    reader.text("description");
    arena.width_px = reader.required_real("width_px", arena_size_px);
    arena.height_px = reader.required_real("height_px", arena_size_px);
    const toml::table* frame = reader.table("frame");
    if (frame == nullptr) throw reader.error("frame", "is missing");
    read_frame(document, *frame, arena);

    const toml::array& walls = reader.array("walls");
    if (walls.size() > arena_walls_maximum) {
        throw reader.error(
            "walls", fmt::format("{} walls are more than {}", walls.size(), arena_walls_maximum));
    }
    for (const toml::node& row : walls) {
        arena.walls.push_back(read_wall(document, row, arena, arena.walls.size()));
    }
    reader.refuse_other_keys();
    return arena;
}

sim::Arena find_arena(const std::string& name) {
    return read_arena(find_document(Builtin::arena, name));
}

nlohmann::json geometry_to_json(const sim::Arena& arena) {
    nlohmann::json walls = nlohmann::json::array();
    for (const sim::ThickSegment& wall : arena.walls) {
        walls.push_back({wall.x1_px, wall.y1_px, wall.x2_px, wall.y2_px, wall.thickness_px});
    }
    return {{"size_px", {arena.width_px, arena.height_px}},
            {"frame_px",
             {{"left", arena.frame_left_px},
              {"top", arena.frame_top_px},
              {"right", arena.frame_right_px},
              {"bottom", arena.frame_bottom_px}}},
            {"walls_px", std::move(walls)}};
}

}  // namespace gene_clocks::experiment
