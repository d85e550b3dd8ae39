#pragma once

#include <gene_clocks/sim/arena.hpp>
#include <gene_clocks/sim/settings.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/settings/document.hpp"
#include "sim/settings/settings_table.hpp"

namespace gene_clocks::experiment {

/// A setting's key in a TOML text, and what stands there.
struct KeyedNode {
    std::string key;                    ///< with its table, as in "radio.loss"
    Place place;                        ///< of the key
    const toml::node* value = nullptr;  ///< never null; the document's
};

/// The keys in a table of settings and in its tables, in the order of the text, known ones or not.
/// Throws InputError where the name of a table of settings stands for something else.
std::vector<KeyedNode> flatten(const Document& document, const toml::table& table);

/// Throws InputError, with a suggestion, for a key that is no setting's.
void check_setting_key(const std::string& key, const Place& place);

/// Takes over one setting; as read_settings.
void read_setting(const Document& document, const KeyedNode& node, sim::Settings& settings);

/// Takes over the settings in a TOML table whose keys are those of `settings_table()`.
/// The path of an arena's file is taken from the document's folder.
/// Throws InputError, with file, line and key: unknown keys (with a suggestion), wrong types and
/// values out of range; `settings` is then partly changed.
void read_settings(const Document& document, const toml::table& table, sim::Settings& settings);

/// Takes over one "key=value", as an option of the command line gives it. Texts and choices need no
/// quotes. Throws InputError as read_settings does; `settings` is then unchanged.
void assign(sim::Settings& settings, std::string_view assignment,
            std::string_view option = "--set");

/// Refuses settings that contradict each other, each by itself being valid. Throws InputError.
void check_together(const sim::Settings& settings, const Place& place);

/// The settings as a TOML file, in the table's order, with units as comments.
/// Reading it gives the same settings.
std::string to_toml(const sim::Settings& settings);

/// The settings as nested JSON objects, with sorted keys.
nlohmann::json to_json(const sim::Settings& settings);

/// The reverse of to_json. A key that is missing keeps its default: settings stored before the key
/// was introduced meant just that. Throws InputError for unknown keys and unfit values.
sim::Settings settings_from_json(const nlohmann::json& json, const Place& place);

/// What the result of a run depends on, its seed apart, as one text: two runs have the same text if
/// and only if nothing but the seed can make them differ. JSON with sorted keys; of the arena only
/// the geometry counts, wherever it came from; the measures do not count.
std::string canonical_text(const sim::Settings& settings, const sim::Arena& arena);

/// XXH3-128 of a text, as 32 hexadecimal digits.
std::string hash_of(std::string_view text);

/// A canonical text that was written before some settings were introduced, with the defaults of
/// those settings, and their keys; the text unchanged and no keys if none is missing. Throws
/// InputError if it has a key that is no setting, as one of a later program may.
std::pair<std::string, std::vector<std::string>> with_new_keys(const std::string& canonical,
                                                               const Place& place);

}  // namespace gene_clocks::experiment
