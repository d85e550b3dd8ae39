#include "sim/settings/schema.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/settings/arena_file.hpp"
#include "sim/settings/settings_table.hpp"

namespace gene_clocks::experiment {
namespace {

using Json = nlohmann::ordered_json;

void add_range(Json& schema, const Range& range) {
    schema[range.minimum_excluded ? "exclusiveMinimum" : "minimum"] = range.minimum;
    schema["maximum"] = range.maximum;
}

Json number_between(const Range& range) {
    Json schema = {{"type", "number"}};
    add_range(schema, range);
    return schema;
}

Json object(Json properties, Json required) {
    return {{"type", "object"},
            {"properties", std::move(properties)},
            {"required", std::move(required)},
            {"additionalProperties", false}};
}

}  // namespace

Json schema_head(const char* title) {
    return {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
}

Json setting_schema(const Setting& setting) {
    Json schema;
    const Value value = setting.default_value();
    if (!setting.choices.empty()) {
        schema["enum"] = setting.choices;
    } else if (std::holds_alternative<bool>(value)) {
        schema["type"] = "boolean";
    } else if (std::holds_alternative<std::string>(value)) {
        schema["type"] = "string";
    } else {
        schema["type"] = std::holds_alternative<double>(value) ? "number" : "integer";
        add_range(schema, setting.range);
    }
    schema["default"] = std::visit([](const auto& held) { return Json(held); }, value);
    std::string words = setting.description;
    if (!setting.unit.empty()) words += fmt::format(" Unit: {}.", setting.unit);
    if (!setting.paper.empty()) words += fmt::format(" Paper: {}.", setting.paper);
    schema["description"] = words;
    return schema;
}

Json settings_schema() {
    Json properties = Json::object();
    for (const Setting& setting : settings_table()) {
        const std::string table(setting.table());
        const std::string name(setting.name());
        if (table.empty()) {
            properties[name] = setting_schema(setting);
            continue;
        }
        Json& entry = properties[table];
        entry["type"] = "object";
        entry["additionalProperties"] = false;
        entry["properties"][name] = setting_schema(setting);
    }
    Json schema = schema_head("Settings of Gene Clocks");
    schema.update(object(std::move(properties), Json::array()));
    return schema;
}

Json arena_schema() {
    const Json side = number_between(arena_size_px);
    const Json thickness = number_between({0.0, arena_size_px.maximum});
    const Json wall = {
        {"type", "array"},
        {"items", {{"type", "number"}, {"minimum", 0.0}}},
        {"minItems", 5},
        {"maxItems", 5},
        {"description", "Centre line and thickness: [x1, y1, x2, y2, thickness], px"}};
    Json frame = object({{"left_px", thickness},
                         {"right_px", thickness},
                         {"top_px", thickness},
                         {"bottom_px", thickness}},
                        {"left_px", "right_px", "top_px", "bottom_px"});
    Json schema = schema_head("Arena of Gene Clocks");
    schema.update(
        object({{"name", {{"type", "string"}}},
                {"description", {{"type", "string"}}},
                {"width_px", side},
                {"height_px", side},
                {"frame", std::move(frame)},
                {"walls", {{"type", "array"}, {"items", wall}, {"maxItems", arena_walls_maximum}}}},
               {"name", "width_px", "height_px", "frame", "walls"}));
    return schema;
}

}  // namespace gene_clocks::experiment
