#pragma once

#include <filesystem>

#include "sim/report/report_input.hpp"

namespace gene_clocks::report {

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
