#pragma once

#include <filesystem>
#include <string>

namespace gene_clocks::report {

/// A Python that can draw the report: the one that the environment variable GENE_CLOCKS_PYTHON
/// names, else the first of `python3` and `/usr/bin/python3` that has matplotlib and Jinja2.
/// Throws experiment::InputError, saying what to install, where there is none.
std::string find_python();

/// Draws figures and page from `data`, the text of report.json, and puts them and it into the
/// folder, which is made where it does not exist. Throws experiment::InputError where the folder
/// cannot be written, and std::runtime_error where the program fails otherwise; its own messages go
/// to standard error. The folder is then as it was.
void draw_page(const std::string& python, const std::string& data,
               const std::filesystem::path& folder);

}  // namespace gene_clocks::report
