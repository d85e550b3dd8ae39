#pragma once

#include <cstdint>
#include <filesystem>

#include "run_plan.hpp"
#include "study.hpp"

namespace gene_clocks::app {

/// Makes the runs of a study, or of one shard of it, that its store does not hold yet, each
/// entering it when finished, and says on standard error how it goes. Stops cleanly on Ctrl-C and
/// SIGTERM. Returns an ExitStatus: success or interrupted. Throws InputError, before anything is
/// written.
int conduct(const experiment::Study& study, const std::filesystem::path& store,
            std::int64_t threads, const experiment::Shard& shard = {});

}  // namespace gene_clocks::app
