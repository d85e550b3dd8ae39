#include "sim/settings/program_version.hpp"

namespace gene_clocks::experiment {

std::string program_version() {
    return GENE_CLOCKS_VERSION;
}

}  // namespace gene_clocks::experiment
