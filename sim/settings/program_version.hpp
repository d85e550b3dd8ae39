#pragma once

#include <string>

namespace gene_clocks::experiment {

/// The version of this program, as in "0.1.0".
std::string program_version();

}  // namespace gene_clocks::experiment
