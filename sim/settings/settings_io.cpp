#include "sim/settings/settings_io.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "sim/settings/arena_file.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::experiment {
namespace {

/// The value of a node, checked against the setting's type, range and choices.
Value checked_value(const Setting& setting, const toml::node& node, const Place& place) {
    switch (setting.default_value().index()) {
        case 0:
            return read_flag(node, place, setting.key);
        case 1:
            return read_integer(node, setting.range, place, setting.key);
        case 2:
            return read_real(node, setting.range, place, setting.key);
        default:
            break;
    }
    std::string text = read_text(node, place, setting.key);
    if (setting.choices.empty() || std::ranges::count(setting.choices, text) > 0) return text;
    throw key_error(place, setting.key,
                    fmt::format("\"{}\" is not {}{}", text, one_of(setting.choices),
                                suggestion(text, setting.choices)));
}

const Setting& known_setting(const std::string& key, const Place& place) {
    const Setting* setting = find_setting(key);
    if (setting == nullptr) throw key_error(place, key, "unknown key" + suggest_setting(key));
    return *setting;
}

bool is_table_of_settings(std::string_view name) {
    return std::ranges::any_of(settings_table(),
                               [&](const Setting& setting) { return setting.table() == name; });
}

/// One TOML value as text, as in "0.25" or "\"gecco15\"": numbers with no more digits than it takes
/// to read the same number back.
std::string toml_text(const Value& value) {
    if (const auto* real = std::get_if<double>(&value)) {
        const std::string text = fmt::format("{}", *real);
        return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
    }
    if (const auto* text = std::get_if<std::string>(&value)) {
        std::ostringstream stream;
        const toml::value<std::string> node(*text);
        stream << toml::toml_formatter(node, toml::format_flags::none);
        return stream.str();
    }
    return to_text(value);
}

nlohmann::json::json_pointer pointer_to(const Setting& setting) {
    const nlohmann::json::json_pointer root;
    if (setting.table().empty()) return root / std::string(setting.name());
    return root / std::string(setting.table()) / std::string(setting.name());
}

void put(nlohmann::json& json, const Setting& setting, const Value& value) {
    std::visit([&](const auto& held) { json[pointer_to(setting)] = held; }, value);
}

nlohmann::json to_json_where(const sim::Settings& settings, bool (*included)(const Setting&)) {
    nlohmann::json json = nlohmann::json::object();
    for (const Setting& setting : settings_table()) {
        if (included(setting)) put(json, setting, setting.get(settings));
    }
    return json;
}

/// JSON objects of flags, numbers and texts as TOML, so that one reader with its checks serves
/// both.
toml::table to_toml_table(const nlohmann::json& json, const Place& place) {
    if (!json.is_object()) throw InputError(place.prefix() + "expected a JSON object");
    toml::table table;
    for (const auto& [key, value] : json.items()) {
        switch (value.type()) {
            case nlohmann::json::value_t::object:
                table.insert(key, to_toml_table(value, place));
                break;
            case nlohmann::json::value_t::boolean:
                table.insert(key, value.get<bool>());
                break;
            case nlohmann::json::value_t::number_unsigned:
            case nlohmann::json::value_t::number_integer:
                table.insert(key, value.get<std::int64_t>());
                break;
            case nlohmann::json::value_t::number_float:
                table.insert(key, value.get<double>());
                break;
            case nlohmann::json::value_t::string:
                table.insert(key, value.get<std::string>());
                break;
            default:
                throw key_error(place, key, "settings hold no arrays and no nulls");
        }
    }
    return table;
}

bool is_canonical(const Setting& setting) {
    return setting.shapes_run() && setting.key != "world.arena";
}

}  // namespace

std::vector<KeyedNode> flatten(const Document& document, const toml::table& table) {
    std::vector<std::pair<toml::source_position, KeyedNode>> found;
    const auto add = [&](std::string name, const toml::key& key, const toml::node& value) {
        found.emplace_back(key.source().begin,
                           KeyedNode{std::move(name), document.place_of(key), &value});
    };
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        if (!is_table_of_settings(name)) {
            add(name, key, node);
            continue;
        }
        const toml::table* inner = node.as_table();
        if (inner == nullptr) {
            throw key_error(document.place_of(node), name,
                            "is the name of a table of settings, not of a setting");
        }
        for (const auto& [inner_key, inner_node] : *inner) {
            add(name + "." + std::string(inner_key.str()), inner_key, inner_node);
        }
    }
    std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<KeyedNode> nodes;
    for (auto& [position, node] : found) nodes.push_back(std::move(node));
    return nodes;
}

void check_setting_key(const std::string& key, const Place& place) {
    known_setting(key, place);
}

void read_setting(const Document& document, const KeyedNode& node, sim::Settings& settings) {
    const Setting& setting = known_setting(node.key, node.place);
    Value value = checked_value(setting, *node.value, document.place_of(*node.value));
    if (setting.key == "world.arena") {
        auto& name = std::get<std::string>(value);
        if (is_file_name(name)) name = (document.directory / name).lexically_normal().string();
    }
    setting.set(settings, value);
}

void read_settings(const Document& document, const toml::table& table, sim::Settings& settings) {
    for (const KeyedNode& node : flatten(document, table)) read_setting(document, node, settings);
}

void assign(sim::Settings& settings, std::string_view assignment, std::string_view option) {
    const Place place{option.empty() ? std::string(assignment)
                                     : fmt::format("{} {}", option, assignment)};
    const auto equals = assignment.find('=');
    if (equals == std::string_view::npos || equals == 0) {
        throw InputError(place.prefix() + "expected key=value, as in odneat.p_mate=0.5");
    }
    const std::string key(assignment.substr(0, equals));
    std::string text(assignment.substr(equals + 1));
    const Setting& setting = known_setting(key, place);
    if (std::holds_alternative<std::string>(setting.default_value()) && !text.starts_with('"')) {
        setting.set(settings, checked_value(setting, toml::value<std::string>(text), place));
        return;
    }
    toml::table table;
    try {
        table = toml::parse("value = " + text);
    } catch (const toml::parse_error&) {
        throw key_error(place, key, fmt::format("\"{}\" is not a value", text));
    }
    if (table.size() != 1)
        throw key_error(place, key, fmt::format("\"{}\" is not one value", text));
    setting.set(settings, checked_value(setting, *table.get("value"), place));
}

void check_together(const sim::Settings& settings, const Place& place) {
    const auto refuse = [&](const char* key, const std::string& message) {
        throw key_error(place, key, message);
    };
    if (settings.radio.range_px > settings.world.sensor_range_px) {
        refuse("radio.range_px",
               fmt::format("{} exceeds world.sensor_range_px = {}: a robot is heard by those that "
                           "its rays see",
                           settings.radio.range_px, settings.world.sensor_range_px));
    }
    if (settings.odneat.energy_initial > settings.odneat.energy_maximum) {
        refuse("odneat.energy_initial",
               fmt::format("{} exceeds odneat.energy_maximum = {}", settings.odneat.energy_initial,
                           settings.odneat.energy_maximum));
    }
    if (settings.run.sample_period_cycles > settings.run.cycles) {
        refuse("run.sample_period_cycles",
               fmt::format("{} exceeds run.cycles = {}: the run would have no samples",
                           settings.run.sample_period_cycles, settings.run.cycles));
    }
}

std::string to_toml(const sim::Settings& settings) {
    std::string text;
    std::string_view open_table;
    for (const Setting& setting : settings_table()) {
        if (setting.table() != open_table) {
            open_table = setting.table();
            text += fmt::format("\n[{}]\n", open_table);
        }
        text += fmt::format("{} = {}", setting.name(), toml_text(setting.get(settings)));
        if (!setting.choices.empty()) text += "  # " + one_of(setting.choices);
        if (!setting.unit.empty()) text += "  # " + setting.unit;
        text += '\n';
    }
    return text;
}

nlohmann::json to_json(const sim::Settings& settings) {
    return to_json_where(settings, [](const Setting&) { return true; });
}

sim::Settings settings_from_json(const nlohmann::json& json, const Place& place) {
    sim::Settings settings;
    read_settings({place.source, {}, {}, {}}, to_toml_table(json, place), settings);
    return settings;
}

std::string canonical_text(const sim::Settings& settings, const sim::Arena& arena) {
    const nlohmann::json json = {{"settings", to_json_where(settings, is_canonical)},
                                 {"arena", geometry_to_json(arena)}};
    return json.dump();
}

std::string hash_of(std::string_view text) {
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::pair<std::string, std::vector<std::string>> with_new_keys(const std::string& canonical,
                                                               const Place& place) {
    nlohmann::json json = nlohmann::json::parse(canonical, nullptr, false);
    if (!json.is_object() || !json.contains("settings")) {
        throw InputError(place.prefix() + "is damaged: unreadable settings");
    }
    const nlohmann::json stored = json["settings"];
    settings_from_json(stored, place);  // refuses keys that are no settings
    std::vector<std::string> added;
    for (const Setting& setting : settings_table()) {
        if (!is_canonical(setting) || stored.contains(pointer_to(setting))) continue;
        put(json["settings"], setting, setting.default_value());
        added.push_back(setting.key);
    }
    return {json.dump(), std::move(added)};
}

}  // namespace gene_clocks::experiment
