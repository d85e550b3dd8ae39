#pragma once

#include <nlohmann/json_fwd.hpp>

#include "sim/report/report_input.hpp"

namespace gene_clocks::report {

/// Every number of the report. `format` in it changes with its layout. Numbers are in the units of
/// sim::Sample and sim::Measures; a number that does not exist is null.
/// Throws experiment::InputError as `compare` does.
nlohmann::ordered_json report_data(const Input& input);

}  // namespace gene_clocks::report
