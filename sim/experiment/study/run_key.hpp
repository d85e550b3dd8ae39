#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace gene_clocks::experiment {

/// Identifies a run: hash of its settings, and its seed.
using RunKey = std::pair<std::string, std::uint64_t>;

}  // namespace gene_clocks::experiment
