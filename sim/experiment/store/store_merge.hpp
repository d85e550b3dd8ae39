#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace gene_clocks::experiment {

/// What a merge did.
struct MergeResult {
    std::size_t runs_added{};
    std::size_t runs_in_all{};             ///< in the store now
    std::size_t runs_of_other_versions{};  ///< of the program, in the store now
};

/// Puts the studies and runs of stores into another store, which is made where it does not exist.
/// The others are only read.
///
/// Studies of the same name must be the same: title, description, seeds, and arms with all their
/// settings. Runs with the same settings and seed must have the same trajectory hash; the first is
/// kept. Throws InputError where they are not, where a file is no store of this format or is in
/// use, and where a file is named twice; all stores are then as they were.
///
/// Everything enters the store in one transaction: what stops the program on the way leaves the
/// store as it was.
MergeResult merge_stores(const std::filesystem::path& out,
                         const std::vector<std::filesystem::path>& in);

}  // namespace gene_clocks::experiment
