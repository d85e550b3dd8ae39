#pragma once

#include <filesystem>
#include <string>

namespace gene_clocks::test {

/// All that the studies of a store hold, as CSV of runs and of samples, but for the columns of
/// times. Equal for stores with the same results.
std::string store_contents(const std::filesystem::path& folder, const std::string& store);

}  // namespace gene_clocks::test
