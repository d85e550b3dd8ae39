#pragma once

#include <charconv>
#include <concepts>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace gene_clocks::test {

/// The words of a line, which one space parts, as the oracle splits it: "a  b" has an empty one.
inline std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        const auto space = line.find(' ');
        words.push_back(line.substr(0, space));
        if (space == std::string_view::npos) return words;
        line.remove_prefix(space + 1);
    }
}

/// A decimal number that fits; throws std::invalid_argument at anything else. A stream would take
/// the largest value for one that is too large, where the oracle refuses.
template <std::unsigned_integral Number>
Number number(std::string_view word) {
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool padded = word.size() > 1 && word.front() == '0';
    if (error != std::errc{} || end != word.data() + word.size() || padded) {
        throw std::invalid_argument("not a number in range: '" + std::string(word) + "'");
    }
    return value;
}

}  // namespace gene_clocks::test
