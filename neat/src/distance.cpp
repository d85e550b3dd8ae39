#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <gene_clocks/neat/distance.hpp>
#include <span>
#include <utility>

#include "neat/src/chronological_distance.hpp"

namespace gene_clocks::neat {
namespace {

/// What matching genes contribute to W. Eight partial sums, added up in a fixed order, so that
/// vector registers of any width give the same result.
struct WeightTerm {
    using Lanes = Eigen::Array<float, 8, 1>;

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
    const float* weights_a = first.weights.data();
    const float* weights_b = second.weights.data();
    const float* enabled_a = first.enabled.data();
    const float* enabled_b = second.enabled.data();
    const auto add = [&](auto sums, auto counts, std::size_t i) {
        using Block = Eigen::Array<float, decltype(sums)::SizeAtCompileTime, 1>;
        const Block both = Block::Map(enabled_a + i) * Block::Map(enabled_b + i);
        sums += (Block::Map(weights_a + i) - Block::Map(weights_b + i)).abs() * both;
        counts += both;
    };
    std::size_t i = begin;
    for (; i + 8 <= end; i += 8) {
        add(term.sums.head<8>(), term.counts.head<8>(), i);
        if (is_enough(term)) return true;
    }
    if (i + 4 <= end) {
        add(term.sums.head<4>(), term.counts.head<4>(), i);
        i += 4;
    }
    for (; i < end; ++i) add(term.sums.head<1>(), term.counts.head<1>(), i);
    return is_enough(term);
}

/// Length of the common beginning of two lists of marks; at least `from`.
std::size_t common_prefix(const Topology& first, const Topology& second, std::size_t from) {
    const InnovationNumber* a = first.connection_marks.data();
    const InnovationNumber* b = second.connection_marks.data();
    const std::size_t end = std::min(first.connection_marks.size(), second.connection_marks.size());
    // Whole blocks first, without a branch for each mark.
    constexpr std::size_t block = 8;
    for (; from + block <= end; from += block) {
        bool differs = false;
        for (std::size_t i = from; i < from + block; ++i) differs |= a[i] != b[i];
        if (differs) break;
    }
    while (from < end && a[from] == b[from]) ++from;
    return from;
}

/// How many genes do not match.
struct Unmatched {
    std::size_t disjoint = 0;
    std::size_t excess = 0;
};

/// Merges two lists of marks up to the end of one of them; calls `on_match(a, b)` for equal ones.
/// Returns where it stopped. This is align(), but it visits matching genes only and skips a run of
/// others by counters alone: a processor cannot foretell which side comes next, so that fewer
/// branches are less time. tests/oracle compares what is counted with the proved alignment.
template <class OnMatch>
std::pair<const InnovationNumber*, const InnovationNumber*> merge(const InnovationNumber* a,
                                                                  const InnovationNumber* end_a,
                                                                  const InnovationNumber* b,
                                                                  const InnovationNumber* end_b,
                                                                  OnMatch on_match) {
    if (a == end_a || b == end_b) return {a, b};
    for (;;) {
        while (a->counter < b->counter) {
            if (++a == end_a) return {a, b};
        }
        while (b->counter < a->counter) {
            if (++b == end_b) return {a, b};
        }
        if (*a < *b) {
            if (++a == end_a) return {a, b};
        } else if (*b < *a) {
            if (++b == end_b) return {a, b};
        } else {
            on_match(a++, b++);
            if (a == end_a || b == end_b) return {a, b};
        }
    }
}

/// Counts the unmatched genes from index `begin` on, and adds the matching ones to `term`. Apart
/// from distance(), so that the merge has the registers to itself.
[[gnu::noinline]] Unmatched count_unmatched(const Genome& first, const Genome& second,
                                            std::size_t begin, WeightTerm& term) {
    const std::span marks_a(first.topology->connection_marks);
    const std::span marks_b(second.topology->connection_marks);
    const InnovationNumber* const end_a = marks_a.data() + marks_a.size();
    const InnovationNumber* const end_b = marks_b.data() + marks_b.size();
    std::size_t matches = begin;
    const auto add = [&](const InnovationNumber* a, const InnovationNumber* b) {
        const auto i = static_cast<std::size_t>(a - marks_a.data());
        const auto j = static_cast<std::size_t>(b - marks_b.data());
        const float both = first.enabled[i] * second.enabled[j];
        term.sums(0) += both * std::abs(first.weights[i] - second.weights[j]);
        term.counts(0) += both;
        ++matches;
    };
    const auto [a, b] = merge(marks_a.data() + begin, end_a, marks_b.data() + begin, end_b, add);
    // One list has ended; what is left of the other is excess.
    const auto excess = static_cast<std::size_t>((end_a - a) + (end_b - b));
    return {marks_a.size() + marks_b.size() - 2 * matches - excess, excess};
}

}  // namespace

float distance(const Genome& first, const Genome& second, const DistanceMeasure& measure,
               float limit) {
    if (measure.mismatch != Mismatch::excess_disjoint) {
        return chronological_distance(first, second, measure);
    }
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
    const std::size_t whole_blocks = initial / 8 * 8;
    if (add_matching(first, second, 0, whole_blocks, weight, is_enough)) return limit;

    const bool same_topology = &topology_a == &topology_b;
    const std::size_t prefix =
        same_topology ? first.connections() : common_prefix(topology_a, topology_b, initial);
    if (add_matching(first, second, whole_blocks, prefix, weight, is_enough)) return limit;

    const auto [disjoint, excess] =
        same_topology ? Unmatched{} : count_unmatched(first, second, prefix, weight);
    const float size = static_cast<float>(std::max(first.connections(), second.connections()));
    return measure.c_excess * static_cast<float>(excess) / size +
           measure.c_disjoint * static_cast<float>(disjoint) / size +
           measure.c_weight * (is_sum ? weight.sum() : weight.mean());
}

}  // namespace gene_clocks::neat
