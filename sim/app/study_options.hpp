#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/experiment/study/run_plan.hpp"
#include "sim/experiment/study/study.hpp"

namespace gene_clocks::app {

/// The options that every command that makes a study's runs has: --quick --seeds --set --threads.
struct StudyCommandOptions {
    bool quick = false;
    std::int64_t seeds = 0;  ///< 0: the study's own
    std::vector<std::string> assignments;
    std::int64_t threads = 0;  ///< 0: one for each of the processor's

    /// Adds the options to a command; `this` must live as long as it.
    void add_to(CLI::App& command);

    [[nodiscard]] experiment::StudyOptions study_options() const;
};

/// The folder for results where the user names none.
inline constexpr const char* results_folder = "results";

/// The store that the user named, else one named after the study, and the shard if it is one of
/// several, in the results folder.
std::filesystem::path store_file(const std::string& named, const experiment::Study& study,
                                 const experiment::Shard& shard = {});

}  // namespace gene_clocks::app
