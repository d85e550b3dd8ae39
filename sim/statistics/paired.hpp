#pragma once

#include <cstddef>
#include <span>

#include "sim/statistics/bootstrap.hpp"
#include "sim/statistics/equivalence.hpp"

namespace gene_clocks::statistics {

/// What differences within pairs say about their mean: Student's t-test, as R's `t.test` of one
/// sample has it, and two one-sided ones (Schuirmann 1987).
struct PairedTest {
    std::size_t pairs{};
    double mean{};
    Interval interval;             ///< of the mean, Student's
    double difference_p_value{};   ///< two-sided: "the mean is 0"
    double equivalence_p_value{};  ///< "the mean is at least `margin` away from 0"
};

/// Tests differences that are independent of each other, one for each pair. Where all of them are
/// equal there is no scatter to judge their mean by: both p-values are then 1, and the interval is
/// that mean.
/// Throws std::invalid_argument where there are fewer than two, one is not finite, the margin is
/// not positive, or the confidence lies outside (0, 1).
PairedTest paired_test(std::span<const double> differences, double margin,
                       double confidence = 0.95);

/// Power by resampling (a lower bound where few pairs differ, since draws without scatter show
/// nothing): differences are drawn, with replacement, from those given, moved to a mean
/// of 0 (of `margin`, for that of finding a difference). Throws as `paired_test` does, and
/// std::invalid_argument where no resamples are asked for.
Power paired_power(std::span<const double> differences, double margin,
                   const PowerSettings& settings = {});

}  // namespace gene_clocks::statistics
