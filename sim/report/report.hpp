#pragma once

#include <cstdint>
#include <filesystem>
#include <gene_clocks/sim/settings.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <string>
#include <vector>

namespace gene_clocks::report {

/// A finished run.
struct Run {
    std::uint64_t seed{};
    sim::RunResult result;
    std::string program_version;  ///< of the program that made the run
};

/// Runs that differ in nothing but their seed.
struct Arm {
    std::string name;
    std::string profile;
    sim::Settings settings;
    std::vector<Run> runs;
};

/// What a report is written about.
struct Input {
    std::string study;  ///< its name
    std::string title;
    std::string command;          ///< that computes the same again
    std::string program_version;  ///< of the program that writes the report
    std::vector<Arm> arms;
};

/// Writes a report into a folder, which is made where it does not exist: `report.json` (every
/// number, computed here), `figures/` (SVG and PNG) and `index.html` (the page, which needs no
/// network). Replaces a report that is there.
///
/// Figures and page are drawn by Python: the one that the environment variable GENE_CLOCKS_PYTHON
/// names, else the first of `python3` and `/usr/bin/python3` that has matplotlib and Jinja2.
///
/// Throws experiment::InputError, before anything is written, where there are no runs, an arm's
/// runs do not fit together, no such Python is found, or the folder cannot be written.
void write_report(const Input& input, const std::filesystem::path& folder);

}  // namespace gene_clocks::report
