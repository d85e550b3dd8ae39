#include "sim/statistics/quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/statistics/finite_sample.hpp"

namespace gene_clocks::statistics {
namespace {

double quantile_of_sorted(std::span<const double> sorted, double probability) {
    if (!(probability >= 0.0 && probability <= 1.0))
        throw std::invalid_argument("a probability lies outside [0, 1]");
    const double position = static_cast<double>(sorted.size() - 1) * probability;
    const double below = std::floor(position);
    const auto index = static_cast<std::size_t>(below);
    const double share = position - below;
    // Equal neighbours are not interpolated: (1 − h)·v + h·v need not be v.
    if (share == 0.0 || sorted[index] == sorted[index + 1]) return sorted[index];
    return (1.0 - share) * sorted[index] + share * sorted[index + 1];
}

std::vector<double> sorted_copy(std::span<const double> sample) {
    require_finite(sample);
    std::vector<double> sorted(sample.begin(), sample.end());
    std::ranges::sort(sorted);
    return sorted;
}

}  // namespace

double quantile(std::span<const double> sample, double probability) {
    return quantile_of_sorted(sorted_copy(sample), probability);
}

double median(std::span<const double> sample) {
    return quantile(sample, 0.5);
}

BoxSummary summarize(std::span<const double> sample) {
    const std::vector<double> sorted = sorted_copy(sample);
    BoxSummary box;
    box.count = sorted.size();
    box.minimum = sorted.front();
    box.maximum = sorted.back();
    box.lower_quartile = quantile_of_sorted(sorted, 0.25);
    box.median = quantile_of_sorted(sorted, 0.5);
    box.upper_quartile = quantile_of_sorted(sorted, 0.75);
    const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
    // Both searches succeed, and a whisker never ends inside the box: an interpolated quartile may
    // lie beyond the last value within reach.
    box.lower_whisker =
        std::min(box.lower_quartile, *std::ranges::lower_bound(sorted, box.lower_quartile - reach));
    box.upper_whisker =
        std::max(box.upper_quartile,
                 *std::prev(std::ranges::upper_bound(sorted, box.upper_quartile + reach)));
    return box;
}

}  // namespace gene_clocks::statistics
