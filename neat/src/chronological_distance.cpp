#include "neat/src/chronological_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gene_clocks/align.hpp>
#include <utility>

namespace gene_clocks::neat {
namespace {

/// The age of a genome's gene in units of 1/k: the youngest has 1, the one before it 3, …
std::size_t age(const Genome& genome, std::size_t gene) {
    return 2 * (genome.connections() - gene) - 1;
}

/// What the alignment of two genomes comes to.
struct Comparison {
    float weights = 0.0f;  // Σ |Δw| over matching genes enabled in both
    float weight_count = 0.0f;
    // Of unmatched genes, by genome, so that neither comes first in a sum.
    std::size_t ages_first = 0;
    std::size_t ages_second = 0;
    std::size_t below_common = 0;  // unmatched genes before the last matching one …
    std::size_t above_common = 0;  // … and behind it
};

Comparison compare(const Genome& first, const Genome& second) {
    Comparison result;
    align(first.topology->connection_marks, second.topology->connection_marks,
          [&](GeneMatch match, std::size_t i, std::size_t j) {
              switch (match) {
                  case GeneMatch::matching: {
                      const float both = first.enabled[i] * second.enabled[j];
                      result.weights += both * std::abs(first.weights[i] - second.weights[j]);
                      result.weight_count += both;
                      result.below_common += std::exchange(result.above_common, 0);
                      return;
                  }
                  case GeneMatch::disjoint_first:
                  case GeneMatch::excess_first:
                      result.ages_first += age(first, i);
                      break;
                  case GeneMatch::disjoint_second:
                  case GeneMatch::excess_second:
                      result.ages_second += age(second, j);
                      break;
              }
              ++result.above_common;
          });
    return result;
}

/// Ages in units of 1, given those in units of 1/k.
float in_shares(std::size_t ages, const Genome& genome) {
    if (ages == 0) return 0.0f;  // k may be 0
    const std::size_t k = genome.connections() - genome.topology->initial_connections;
    return static_cast<float>(ages) / static_cast<float>(k);
}

}  // namespace

float chronological_distance(const Genome& first, const Genome& second,
                             const DistanceMeasure& measure) {
    const Comparison result = compare(first, second);
    const bool is_sum = measure.weight_difference == WeightDifference::sum;
    const float weights =
        is_sum ? result.weights : result.weights / std::max(result.weight_count, 1.0f);
    const float mismatch =
        measure.mismatch == Mismatch::age
            ? (measure.c_excess + measure.c_disjoint) / 2.0f *
                  (in_shares(result.ages_first, first) + in_shares(result.ages_second, second))
            : measure.c_excess * static_cast<float>(result.above_common) +
                  measure.c_disjoint * static_cast<float>(result.below_common);
    const auto size = static_cast<float>(std::max(first.connections(), second.connections()));
    return mismatch / size + measure.c_weight * weights;
}

}  // namespace gene_clocks::neat
