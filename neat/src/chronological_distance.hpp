#pragma once

#include <gene_clocks/neat/distance.hpp>

namespace gene_clocks::neat {

/// The distances of Mismatch::age and Mismatch::since_common; see `distance`. Apart from that of
/// Equation 1, whose speed decides that of a run, and written plainly.
float chronological_distance(const Genome& first, const Genome& second,
                             const DistanceMeasure& measure);

}  // namespace gene_clocks::neat
