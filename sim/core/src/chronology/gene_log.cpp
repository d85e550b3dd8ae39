#include "sim/core/src/chronology/gene_log.hpp"

#include <algorithm>

#include "sim/core/src/lanes.hpp"

namespace gene_clocks::sim {
namespace {

constexpr std::size_t block = 32;

struct Comparison {
    std::uint64_t greater{};
    std::uint64_t equal{};
};

GENE_CLOCKS_MULTIVERSION
Comparison compare(const std::uint64_t* counters, std::size_t count, std::uint64_t with) {
    std::uint64_t greater = 0;
    std::uint64_t equal = 0;
    for (std::size_t i = 0; i < count; ++i) {
        greater += counters[i] > with ? 1u : 0u;
        equal += counters[i] == with ? 1u : 0u;
    }
    return {greater, equal};
}

}  // namespace

void MarkList::push_back(InnovationNumber mark) {
    if (counters_.size() % block == 0) largest_.push_back(0);
    largest_.back() = std::max(largest_.back(), mark.counter);
    counters_.push_back(mark.counter);
    robots_.push_back(static_cast<std::uint32_t>(mark.robot));
}

std::uint64_t MarkList::count_after(InnovationNumber mark, std::size_t count) const {
    // With clocks, most blocks have only marks that are smaller.
    std::uint64_t after = 0;
    for (std::size_t start = 0; start < count; start += block) {
        if (largest_[start / block] < mark.counter) continue;
        after += count_after(mark, start, std::min(start + block, count));
    }
    return after;
}

std::uint64_t MarkList::count_after(InnovationNumber mark, std::size_t begin,
                                    std::size_t end) const {
    const auto [greater, equal] = compare(counters_.data() + begin, end - begin, mark.counter);
    if (equal == 0) return greater;
    std::uint64_t after = greater;
    for (std::size_t i = begin; i < end; ++i) {
        if (counters_[i] == mark.counter &&
            mark < InnovationNumber{counters_[i], RobotId{robots_[i]}})
            ++after;
    }
    return after;
}

void GeneLog::add(std::uint32_t robot, InnovationNumber mark, std::uint64_t structure,
                  std::int64_t cycle, std::span<const std::int32_t> known) {
    const RobotId id{robot + 1};
    const auto time = static_cast<double>(cycle);
    compare_times(mark, id, time);
    compare_causes(mark, known);
    look_for_namesakes(mark, structure);
    ++counts_.genes;
    genes_.push_back({mark, id, time});
    marks_.push_back(mark);
    by_robot_[robot].push_back(mark);
}

void GeneLog::compare_times(InnovationNumber mark, RobotId robot, double cycle) {
    if (!genes_.empty() && genes_.back().cycle != cycle) cycle_start_ = genes_.size();
    counts_.pairs += genes_.size();
    counts_.timed_pairs += cycle_start_;
    counts_.time_inverted += marks_.count_after(mark, cycle_start_);
    for (std::size_t i = cycle_start_; i < genes_.size(); ++i) {
        if (genes_[i].robot != robot) continue;
        ++counts_.timed_pairs;
        if (mark < genes_[i].mark) ++counts_.time_inverted;
    }
}

void GeneLog::compare_causes(InnovationNumber mark, std::span<const std::int32_t> known) {
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (known[i] == 0) continue;
        const auto count = static_cast<std::size_t>(known[i]);
        counts_.caused_pairs += count;
        counts_.cause_inverted += by_robot_[i].count_after(mark, count);
    }
}

void GeneLog::look_for_namesakes(InnovationNumber mark, std::uint64_t structure) {
    const auto [found, is_first] = namesakes_.try_emplace(mark, Namesakes{structure, false});
    if (is_first) return;
    Namesakes& earlier = found->second;
    earlier.differ |= earlier.structure != structure;
    ++(earlier.differ ? counts_.different_collisions : counts_.same_collisions);
}

void GeneLog::report(ChronologyMeasures& measures) const {
    measures.genes = counts_.genes;
    measures.pairs = counts_.pairs;
    measures.caused_pairs = counts_.caused_pairs;
    measures.timed_pairs = counts_.timed_pairs;
    measures.cause_inverted = counts_.cause_inverted;
    measures.time_inverted = counts_.time_inverted;
    measures.same_collisions = counts_.same_collisions;
    measures.different_collisions = counts_.different_collisions;
}

}  // namespace gene_clocks::sim
