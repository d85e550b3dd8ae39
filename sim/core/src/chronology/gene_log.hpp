#pragma once

#include <cstddef>
#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <gene_clocks/sim/chronology_measures.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <span>
#include <unordered_map>
#include <vector>

namespace gene_clocks::sim {

/// Marks in columns, so that many are compared at once.
class MarkList {
public:
    void push_back(InnovationNumber mark);
    std::size_t size() const { return counters_.size(); }

    /// How many of the first `count` sort after `mark`.
    std::uint64_t count_after(InnovationNumber mark, std::size_t count) const;

private:
    std::uint64_t count_after(InnovationNumber mark, std::size_t begin, std::size_t end) const;

    std::vector<std::uint64_t> counters_;
    std::vector<std::uint32_t> robots_;   // of the marks, parallel to counters_
    std::vector<std::uint64_t> largest_;  // counter of each block of marks
};

/// All genes that a run creates, in order, each compared with those before it.
class GeneLog {
public:
    explicit GeneLog(std::size_t robots) : by_robot_(robots) {}

    /// Enters the next gene, of that structure, which `robot`, an index, creates in `cycle`.
    /// `known` says how many genes of each robot it can have heard of. Cycles do not descend.
    void add(std::uint32_t robot, InnovationNumber mark, std::uint64_t structure,
             std::int64_t cycle, std::span<const std::int32_t> known);

    std::size_t size() const { return genes_.size(); }

    /// Whether two different genes, by their places in the log, are of different cycles or of one
    /// robot, so that one is known to be the earlier.
    bool is_timed(std::size_t one, std::size_t other) const {
        return genes_[one].cycle != genes_[other].cycle || genes_[one].robot == genes_[other].robot;
    }
    const std::vector<GeneCreation>& genes() const { return genes_; }

    /// Enters its counts.
    void report(ChronologyMeasures& measures) const;

private:
    struct Hash {
        std::size_t operator()(InnovationNumber mark) const {
            return mark.counter * 0x9e37'79b9'7f4a'7c15 ^ static_cast<std::uint64_t>(mark.robot);
        }
    };
    /// The genes with one mark.
    struct Namesakes {
        std::uint64_t structure{};  // of the first
        bool differ = false;        // whether they are of different structures
    };

    void compare_times(InnovationNumber mark, RobotId robot, double cycle);
    void compare_causes(InnovationNumber mark, std::span<const std::int32_t> known);
    void look_for_namesakes(InnovationNumber mark, std::uint64_t structure);

    std::vector<GeneCreation> genes_;
    MarkList marks_;                  // parallel to genes_
    std::vector<MarkList> by_robot_;  // the marks of each robot's genes
    std::size_t cycle_start_ = 0;     // the first gene of the last one's cycle
    std::unordered_map<InnovationNumber, Namesakes, Hash> namesakes_;
    ChronologyMeasures counts_;
};

}  // namespace gene_clocks::sim
