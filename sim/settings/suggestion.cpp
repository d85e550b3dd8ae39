#include "sim/settings/suggestion.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gene_clocks::experiment {
namespace {

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b` (optimal
/// string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1);  // two rows above `next`
    std::vector<std::size_t> row(b.size() + 1);     // the row above `next`
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::vector<std::size_t> next(b.size() + 1, i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            next[j] = std::min({substituted, row[j] + 1, next[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                next[j] = std::min(next[j], before[j - 2] + 1);
            }
        }
        before = std::exchange(row, std::move(next));
    }
    return row.back();
}

std::string join(const std::vector<std::string>& words, const char* last_separator) {
    std::string text;
    for (std::size_t index = 0; index < words.size(); ++index) {
        if (index > 0) text += index + 1 == words.size() ? last_separator : ", ";
        text += words[index];
    }
    return text;
}

}  // namespace

std::optional<std::size_t> nearest(std::string_view word, const std::vector<std::string>& known) {
    std::optional<std::size_t> best;
    std::size_t best_distance = 0;
    for (std::size_t index = 0; index < known.size(); ++index) {
        const std::size_t tolerance = std::max<std::size_t>(1, known[index].size() / 3);
        // A difference in length is a lower bound, and hostile words may be very long.
        if (word.size() > known[index].size() + tolerance) continue;
        const std::size_t distance = edit_distance(word, known[index]);
        if (distance <= tolerance && (!best || distance < best_distance)) {
            best = index;
            best_distance = distance;
        }
    }
    return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
    const auto index = nearest(word, known);
    return index ? "; did you mean " + known[*index] + "?" : std::string{};
}

std::string one_of(const std::vector<std::string>& words) {
    return join(words, " or ");
}

std::string list_of(const std::vector<std::string>& words) {
    return join(words, " and ");
}

}  // namespace gene_clocks::experiment
