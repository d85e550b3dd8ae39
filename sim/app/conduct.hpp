#pragma once

#include <cstdint>
#include <filesystem>

#include "study.hpp"

namespace gene_clocks::app {

/// Makes the runs of a study that its store does not hold yet, each entering it when finished, and
/// says on standard error how it goes. Stops cleanly on Ctrl-C and SIGTERM.
/// Returns an ExitStatus: success or interrupted. Throws InputError, before anything is written.
int conduct(const experiment::Study& study, const std::filesystem::path& store,
            std::int64_t threads);

}  // namespace gene_clocks::app
