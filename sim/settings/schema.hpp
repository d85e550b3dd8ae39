#pragma once

#include <nlohmann/json_fwd.hpp>

#include "sim/settings/settings_table.hpp"

namespace gene_clocks::experiment {

/// JSON schemas (draft 2020-12) of the files that a user writes, for editors that complete and
/// check TOML. What a schema cannot say (names that must be different, lists of equal length) is
/// still refused by the reader.

/// Of a file for `--settings`; the same object stands in studies and profiles.
nlohmann::ordered_json settings_schema();

/// Of an arena.
nlohmann::ordered_json arena_schema();

/// The value of one setting, without its key: type, range, choices, default, description.
nlohmann::ordered_json setting_schema(const Setting& setting);

/// The head that every schema begins with.
nlohmann::ordered_json schema_head(const char* title);

}  // namespace gene_clocks::experiment
