#pragma once

#include <nlohmann/json_fwd.hpp>

namespace gene_clocks::experiment {

/// JSON schema (draft 2020-12) of a study's file; see sim/settings/schema.hpp.
nlohmann::ordered_json study_schema();

}  // namespace gene_clocks::experiment
