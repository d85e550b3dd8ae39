#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gene_clocks::app {

/// Writes the report on studies of one store into a folder, and says where it is. All of the
/// store's studies if none is named. `command` is what the page says computes the same again.
/// Throws InputError, before anything is written, where there is nothing to report on.
void report_on(const std::filesystem::path& store, const std::vector<std::string>& studies,
               const std::string& command, const std::filesystem::path& folder);

/// Where a store's report goes if the user names no folder: beside the store, "results/gecco15" for
/// "results/gecco15.sqlite".
std::filesystem::path report_folder(std::filesystem::path store);

}  // namespace gene_clocks::app
