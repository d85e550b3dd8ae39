#pragma once

#include <gene_clocks/neat/settings.hpp>

namespace gene_clocks::neat {

/// The coefficients of a distance, ready for use.
struct DistanceMeasure {
    explicit DistanceMeasure(const OdneatSettings& settings)
        : c_excess(static_cast<float>(settings.c_excess)),
          c_disjoint(static_cast<float>(settings.c_disjoint)),
          c_weight(static_cast<float>(settings.c_weight)),
          weight_difference(settings.weight_difference),
          mismatch(settings.mismatch) {}

    float c_excess;
    float c_disjoint;
    float c_weight;
    WeightDifference weight_difference;
    Mismatch mismatch;
};

}  // namespace gene_clocks::neat
