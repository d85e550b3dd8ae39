#pragma once

#include <cstdint>
#include <filesystem>
#include <gene_clocks/sim/settings.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/experiment/study/contrast_table.hpp"

namespace gene_clocks::report {

/// A finished run.
struct Run {
    std::uint64_t seed{};
    sim::RunResult result;
    std::string program_version;  ///< of the program that executed the run
};

/// The finished runs of an arm: they differ in nothing but their seed.
struct ArmRuns {
    std::string name;
    std::string profile;
    std::string settings_hash;  ///< of settings and arena; runs of one hash and seed are one run
    sim::Settings settings;
    std::vector<Run> runs;  ///< no seed twice
};

/// What a report or a contrast is about.
struct Input {
    std::string study;  ///< its name; the first one's of several
    std::string title;
    std::string command;          ///< that computes the same again
    std::string program_version;  ///< of the program that writes the report
    std::vector<ArmRuns> arms;
    /// What the studies say their arms are compared with; none where they say nothing.
    std::optional<experiment::ContrastTable> contrast = {};
    /// Two of the studies that say different things, of which `contrast` is the first's.
    std::optional<std::pair<std::string, std::string>> contrary_studies = {};
};

/// The runs of a store: of all its studies, or of the named ones. Arms of several studies are one
/// arm where settings, arena and profile are the same: it has the name that the first of these
/// studies gives it, and the runs of all of them. `command` stays empty.
/// Throws InputError where the file is unfit or holds no study of that name.
Input read_input(const std::filesystem::path& store, const std::vector<std::string>& studies);

}  // namespace gene_clocks::report
