#include "gene_clocks/neat/distance.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>

#include "gene_clocks/align.hpp"

namespace gene_clocks::neat {
namespace {

/// What matching genes contribute to W. Eight partial sums, added up in a fixed order, so that
/// vector registers of any width give the same result.
struct WeightTerm {
    static constexpr std::size_t lanes = 8;
    using Lanes = Eigen::Array<float, lanes, 1>;

    static float total(const Lanes& x) {
        const Eigen::Array4f half = x.head<4>() + x.tail<4>();
        return (half(0) + half(1)) + (half(2) + half(3));
    }
    float sum() const { return total(sums); }
    float mean() const { return total(sums) / std::max(total(counts), 1.0f); }

    Lanes sums = Lanes::Zero();    // of |Δw| over genes enabled in both
    Lanes counts = Lanes::Zero();  // of genes enabled in both
};

/// Adds genes [begin, end) of both genomes, which match one to one. Stops after a block of eight
/// once `is_enough`; returns whether it did. Terms only grow, so that stopping or not changes no
/// sum that is not enough.
template <class IsEnough>
bool add_matching(const Genome& first, const Genome& second, std::size_t begin, std::size_t end,
                  WeightTerm& term, IsEnough is_enough) {
    constexpr std::size_t lanes = WeightTerm::lanes;
    using Lanes = WeightTerm::Lanes;
    const float* weights_a = first.weights.data();
    const float* weights_b = second.weights.data();
    const float* enabled_a = first.enabled.data();
    const float* enabled_b = second.enabled.data();
    std::size_t i = begin;
    for (; i + lanes <= end; i += lanes) {
        const Lanes both = Lanes::Map(enabled_a + i) * Lanes::Map(enabled_b + i);
        term.sums += (Lanes::Map(weights_a + i) - Lanes::Map(weights_b + i)).abs() * both;
        term.counts += both;
        if (is_enough(term)) return true;
    }
    for (Eigen::Index lane = 0; i < end; ++i, ++lane) {
        const float both = enabled_a[i] * enabled_b[i];
        term.sums(lane) += std::abs(weights_a[i] - weights_b[i]) * both;
        term.counts(lane) += both;
    }
    return is_enough(term);
}

/// Length of the common beginning of two lists of marks.
std::size_t common_prefix(const Topology& first, const Topology& second, std::size_t from) {
    const auto& marks_a = first.connection_marks;
    const auto& marks_b = second.connection_marks;
    const std::size_t end = std::min(marks_a.size(), marks_b.size());
    while (from < end && marks_a[from] == marks_b[from]) ++from;
    return from;
}

}  // namespace

DistanceMeasure::DistanceMeasure(const OdneatSettings& settings)
    : c_excess(static_cast<float>(settings.c_excess)),
      c_disjoint(static_cast<float>(settings.c_disjoint)),
      c_weight(static_cast<float>(settings.c_weight)),
      weight_difference(settings.weight_difference) {}

float distance(const Genome& first, const Genome& second, const DistanceMeasure& measure,
               float limit) {
    const bool is_sum = measure.weight_difference == WeightDifference::sum;
    const Topology& topology_a = *first.topology;
    const Topology& topology_b = *second.topology;

    // Every genome begins with the initial connections, so those match without a look at marks.
    // As a sum, their weight term alone already decides most comparisons with a threshold.
    const std::size_t initial =
        std::min(topology_a.initial_connections, topology_b.initial_connections);
    const bool may_stop = is_sum && limit < std::numeric_limits<float>::infinity();
    const auto is_enough = [&](const WeightTerm& term) {
        return may_stop && measure.c_weight * term.sum() >= limit;
    };
    WeightTerm weight;
    if (add_matching(first, second, 0, initial, weight, is_enough)) return limit;

    const bool same_topology = &topology_a == &topology_b;
    const std::size_t prefix =
        same_topology ? first.connections() : common_prefix(topology_a, topology_b, initial);
    if (add_matching(first, second, initial, prefix, weight, is_enough)) return limit;

    std::size_t disjoint = 0;
    std::size_t excess = 0;
    if (!same_topology) {
        const auto tail = [prefix](const std::vector<InnovationNumber>& marks) {
            return std::span(marks).subspan(prefix);
        };
        align(tail(topology_a.connection_marks), tail(topology_b.connection_marks),
              [&](GeneMatch match, std::size_t i, std::size_t j) {
                  switch (match) {
                      case GeneMatch::matching: {
                          const float both = first.enabled[prefix + i] * second.enabled[prefix + j];
                          weight.sums(0) += both * std::abs(first.weights[prefix + i] -
                                                            second.weights[prefix + j]);
                          weight.counts(0) += both;
                          break;
                      }
                      case GeneMatch::disjoint_first:
                      case GeneMatch::disjoint_second:
                          ++disjoint;
                          break;
                      case GeneMatch::excess_first:
                      case GeneMatch::excess_second:
                          ++excess;
                          break;
                  }
              });
    }
    const float size = static_cast<float>(std::max(first.connections(), second.connections()));
    return measure.c_excess * static_cast<float>(excess) / size +
           measure.c_disjoint * static_cast<float>(disjoint) / size +
           measure.c_weight * (is_sum ? weight.sum() : weight.mean());
}

}  // namespace gene_clocks::neat
