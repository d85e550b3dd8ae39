#include "sim/statistics/bootstrap.hpp"

#include <random>
#include <stdexcept>
#include <vector>

#include "sim/statistics/quantiles.hpp"
#include "sim/statistics/resampler.hpp"

namespace gene_clocks::statistics {
namespace {

template <typename Draw>
Interval percentile_interval(const BootstrapSettings& settings, Draw&& draw_statistic) {
    if (settings.resamples == 0) throw std::invalid_argument("a bootstrap needs resamples");
    if (!(settings.confidence > 0.0 && settings.confidence < 1.0))
        throw std::invalid_argument("a confidence lies outside (0, 1)");
    std::mt19937_64 random(settings.seed);
    std::vector<double> statistics(settings.resamples);
    for (double& value : statistics) value = draw_statistic(random);
    const double tail = 0.5 * (1.0 - settings.confidence);
    return {quantile(statistics, tail), quantile(statistics, 1.0 - tail)};
}

}  // namespace

Interval bootstrap_interval(std::span<const double> sample, const Statistic& statistic,
                            const BootstrapSettings& settings) {
    Resampler resampler(sample, sample.size());
    return percentile_interval(
        settings, [&](std::mt19937_64& random) { return statistic(resampler.draw(random)); });
}

Interval bootstrap_interval(std::span<const double> x, std::span<const double> y,
                            const TwoSampleStatistic& statistic,
                            const BootstrapSettings& settings) {
    Resampler of_x(x, x.size());
    Resampler of_y(y, y.size());
    return percentile_interval(settings, [&](std::mt19937_64& random) {
        const std::span<const double> drawn_x = of_x.draw(random);
        return statistic(drawn_x, of_y.draw(random));
    });
}

}  // namespace gene_clocks::statistics
