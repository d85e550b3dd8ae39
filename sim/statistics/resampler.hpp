#pragma once

#include <boost/random/uniform_int_distribution.hpp>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "sim/statistics/finite_sample.hpp"

namespace gene_clocks::statistics {

/// Draws samples of one size, with replacement.
class Resampler {
public:
    /// `sample` must outlive the resampler. Throws as `require_finite` does.
    Resampler(std::span<const double> sample, std::size_t size) : sample_(sample), drawn_(size) {
        require_finite(sample);
    }

    /// Valid until the next draw.
    std::span<const double> draw(std::mt19937_64& random) {
        const boost::random::uniform_int_distribution<std::size_t> index(0, sample_.size() - 1);
        for (double& value : drawn_) value = sample_[index(random)];
        return drawn_;
    }

private:
    std::span<const double> sample_;
    std::vector<double> drawn_;
};

}  // namespace gene_clocks::statistics
