#pragma once

#include <cstdint>
#include <filesystem>

#include "sim/experiment/study/run_plan.hpp"
#include "sim/experiment/study/study.hpp"

namespace gene_clocks::app {

/// Checks a study and prints its arms, its runs, which of them (or of the shard's) its store lacks,
/// and how long they may take on this machine with so many threads. Writes no file.
/// Returns ExitStatus success. Throws InputError where the study or the store is unfit.
int dry_run(const experiment::Study& study, const std::filesystem::path& store,
            std::int64_t threads, const experiment::Shard& shard);

}  // namespace gene_clocks::app
