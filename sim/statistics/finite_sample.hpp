#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace gene_clocks::statistics {

/// Throws std::invalid_argument where the sample is empty or holds a value that is not finite.
inline void require_finite(std::span<const double> sample) {
    if (sample.empty()) throw std::invalid_argument("a sample is empty");
    if (!std::ranges::all_of(sample, [](double value) { return std::isfinite(value); }))
        throw std::invalid_argument("a sample holds a value that is not finite");
}

}  // namespace gene_clocks::statistics
