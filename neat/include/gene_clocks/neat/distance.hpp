#pragma once

#include <limits>

#include "gene_clocks/neat/genome.hpp"
#include "gene_clocks/neat/settings.hpp"

namespace gene_clocks::neat {

/// The coefficients of Equation 1, ready for use.
struct DistanceMeasure {
    explicit DistanceMeasure(const OdneatSettings& settings);

    float c_excess;
    float c_disjoint;
    float c_weight;
    WeightDifference weight_difference;
};

/// Genotypic distance c1·E/N + c2·D/N + c3·W (paper, Equation 1).
///
/// Over connection genes; N counts those of the larger genome, disabled ones included; W is the
/// sum or the mean of |Δw| over matching genes that are enabled in both.
///
/// May stop early: a result at or above `limit` only says that the distance is at or above it.
float distance(const Genome& first, const Genome& second, const DistanceMeasure& measure,
               float limit = std::numeric_limits<float>::infinity());

}  // namespace gene_clocks::neat
