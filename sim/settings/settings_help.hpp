#pragma once

#include <string>
#include <vector>

namespace gene_clocks::experiment {

/// Every setting whose key, or whose table, is among `wanted` (all if it is empty): key, default,
/// unit, range or choices, description and the paper's section, for a terminal.
/// Throws InputError, with a suggestion, for a word that is neither key nor table.
std::string settings_listing(const std::vector<std::string>& wanted);

/// docs/settings.md.
std::string settings_markdown();

}  // namespace gene_clocks::experiment
