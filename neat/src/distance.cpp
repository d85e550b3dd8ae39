#include "gene_clocks/neat/distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "gene_clocks/align.hpp"

namespace gene_clocks::neat {
namespace {

/// What matching genes contribute to W.
struct WeightTerm {
    float sum = 0.0f;    // of |Δw| over genes enabled in both
    float count = 0.0f;  // of genes enabled in both
};

/// Adds genes [begin, end) of both genomes, which match one to one. Stops after a block of eight
/// once the sum is above `enough`. Eight partial sums, added in a fixed order, so that the compiler
/// may use vector registers of any width and the result stays the same.
void add_matching(const Genome& first, const Genome& second, std::size_t begin, std::size_t end,
                  float enough, WeightTerm& term) {
    constexpr std::size_t lanes = 8;
    const float* weights_a = first.weights.data();
    const float* weights_b = second.weights.data();
    const float* enabled_a = first.enabled.data();
    const float* enabled_b = second.enabled.data();
    const auto total = [](const std::array<float, lanes>& x) {
        return ((x[0] + x[4]) + (x[1] + x[5])) + ((x[2] + x[6]) + (x[3] + x[7]));
    };
    for (std::size_t i = begin; i < end && !(term.sum >= enough); i += lanes) {
        std::array<float, lanes> differences{};
        std::array<float, lanes> both{};
        const std::size_t size = std::min(lanes, end - i);
        const auto compare = [&](std::size_t lane) {
            both[lane] = enabled_a[i + lane] * enabled_b[i + lane];
            differences[lane] = std::abs(weights_a[i + lane] - weights_b[i + lane]) * both[lane];
        };
        if (size == lanes) {
            for (std::size_t lane = 0; lane < lanes; ++lane) compare(lane);
        } else {
            for (std::size_t lane = 0; lane < size; ++lane) compare(lane);
        }
        term.sum += total(differences);
        term.count += total(both);
    }
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
    const float enough = is_sum && measure.c_weight > 0.0f ? limit / measure.c_weight
                                                           : std::numeric_limits<float>::infinity();
    WeightTerm weight;
    add_matching(first, second, 0, initial, enough, weight);
    if (weight.sum >= enough) return limit;

    const bool same_topology = &topology_a == &topology_b;
    const std::size_t prefix =
        same_topology ? first.connections() : common_prefix(topology_a, topology_b, initial);
    add_matching(first, second, initial, prefix, enough, weight);
    if (weight.sum >= enough) return limit;

    float disjoint = 0.0f;
    float excess = 0.0f;
    if (!same_topology) {
        const auto tail = [prefix](const std::vector<InnovationNumber>& marks) {
            return std::span(marks).subspan(prefix);
        };
        align(tail(topology_a.connection_marks), tail(topology_b.connection_marks),
              [&](GeneMatch match, std::size_t i, std::size_t j) {
                  switch (match) {
                      case GeneMatch::matching: {
                          const float both = first.enabled[prefix + i] * second.enabled[prefix + j];
                          weight.sum += both * std::abs(first.weights[prefix + i] -
                                                        second.weights[prefix + j]);
                          weight.count += both;
                          break;
                      }
                      case GeneMatch::disjoint_first:
                      case GeneMatch::disjoint_second:
                          disjoint += 1.0f;
                          break;
                      case GeneMatch::excess_first:
                      case GeneMatch::excess_second:
                          excess += 1.0f;
                          break;
                  }
              });
    }
    const float size = static_cast<float>(std::max(first.connections(), second.connections()));
    const float difference = is_sum ? weight.sum : weight.sum / std::max(weight.count, 1.0f);
    return measure.c_excess * excess / size + measure.c_disjoint * disjoint / size +
           measure.c_weight * difference;
}

}  // namespace gene_clocks::neat
