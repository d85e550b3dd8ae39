#include "sim/statistics/equivalence.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "sim/statistics/finite_sample.hpp"
#include "sim/statistics/mann_whitney.hpp"
#include "sim/statistics/quantiles.hpp"
#include "sim/statistics/resampler.hpp"

namespace gene_clocks::statistics {
namespace {

std::vector<double> moved(std::span<const double> sample, double by) {
    std::vector<double> values(sample.begin(), sample.end());
    for (double& value : values) value += by;
    return values;
}

/// All differences, ascending.
std::vector<double> differences(std::span<const double> x, std::span<const double> y) {
    std::vector<double> values;
    values.reserve(x.size() * y.size());
    for (const double of_x : x) {
        for (const double of_y : y) values.push_back(of_x - of_y);
    }
    std::ranges::sort(values);
    return values;
}

}  // namespace

Shift shift_of_location(std::span<const double> x, std::span<const double> y, double confidence) {
    require_finite(x);
    require_finite(y);
    if (!(confidence > 0.0 && confidence < 1.0))
        throw std::invalid_argument("a confidence lies outside (0, 1)");
    const std::vector<double> all = differences(x, y);
    // As many differences are cut off at each end as leave their statistic in its tail.
    const std::size_t cut = tail_statistic(x.size(), y.size(), 0.5 * (1.0 - confidence));
    const std::size_t lower = std::min(std::max<std::size_t>(cut, 1) - 1, all.size() - 1);
    return {median(all), {all[lower], all[all.size() - 1 - lower]}};
}

double equivalence_p_value(std::span<const double> x, std::span<const double> y, double margin) {
    if (!(margin > 0.0 && std::isfinite(margin)))
        throw std::invalid_argument("a margin is not positive");
    const double not_far_below = mann_whitney(moved(x, margin), y, Alternative::greater).p_value;
    const double not_far_above = mann_whitney(moved(x, -margin), y, Alternative::less).p_value;
    return std::max(not_far_below, not_far_above);
}

Power power(std::span<const double> x, std::span<const double> y, double margin,
            const PowerSettings& settings) {
    if (settings.resamples == 0) throw std::invalid_argument("a power needs resamples");
    std::vector<double> pooled = moved(x, -median(x));
    for (const double value : moved(y, -median(y))) pooled.push_back(value);
    Resampler of_x(pooled, x.size());
    Resampler of_y(pooled, y.size());
    std::mt19937_64 random(settings.seed);
    std::size_t equivalent = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < settings.resamples; ++i) {
        const std::span<const double> drawn_x = of_x.draw(random);
        const std::span<const double> drawn_y = of_y.draw(random);
        if (equivalence_p_value(drawn_x, drawn_y, margin) < settings.level) ++equivalent;
        if (mann_whitney(moved(drawn_x, margin), drawn_y).p_value < settings.level) ++different;
    }
    const auto share = [&](std::size_t count) {
        return static_cast<double>(count) / static_cast<double>(settings.resamples);
    };
    return {share(equivalent), share(different)};
}

std::vector<double> holm(std::span<const double> p_values) {
    std::vector<std::size_t> order(p_values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return p_values[i]; });
    std::vector<double> corrected(p_values.size());
    double largest = 0.0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const double p_value = p_values[order[rank]];
        if (!(p_value >= 0.0 && p_value <= 1.0))
            throw std::invalid_argument("a p-value lies outside [0, 1]");
        largest = std::max(largest, static_cast<double>(order.size() - rank) * p_value);
        corrected[order[rank]] = std::min(1.0, largest);
    }
    return corrected;
}

}  // namespace gene_clocks::statistics
