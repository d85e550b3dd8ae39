#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gene_clocks::experiment {

/// The index of the word in `known` that `word` may be a misspelling of: the nearest by edit
/// distance, if at most a third of it differs.
std::optional<std::size_t> nearest(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean KNOWN?", or nothing where no known word is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

/// "a, b or c"
std::string one_of(const std::vector<std::string>& words);

/// "a, b and c"
std::string list_of(const std::vector<std::string>& words);

}  // namespace gene_clocks::experiment
