#include "sim/core/src/chronology/chronology.hpp"

#include <algorithm>
#include <gene_clocks/wire.hpp>
#include <utility>

namespace gene_clocks::sim {

Chronology::Chronology(std::size_t robots, std::int64_t delay_cycles,
                       std::shared_ptr<const neat::Topology> initial)
    : past_(robots, delay_cycles), origins_(std::move(initial)), log_(robots), senders_(robots) {}

Chronology::Sender Chronology::measure_frame(std::uint32_t robot,
                                             std::shared_ptr<const neat::Genome> active) const {
    const std::size_t payload = origins_.of(*active->topology).bytes +
                                varint_bytes(static_cast<std::uint64_t>(active->id.robot)) +
                                varint_bytes(active->id.birth);
    // Robots are numbered from 1 on the wire. A stamp of 0 takes its bytes, too.
    const std::size_t frame = frame_bytes(RobotId{robot + 1}, Stamp{0}, payload) - varint_bytes(0);
    return {std::move(active), frame};
}

void Chronology::sent(std::uint32_t robot, std::uint64_t message,
                      const std::shared_ptr<const neat::Genome>& active, Stamp stamp) {
    past_.sent(robot, message, cycle_);
    Sender& sender = senders_[robot];
    if (sender.genome != active) sender = measure_frame(robot, active);
    const std::size_t stamp_bytes = stamp.value == 0 ? 0 : varint_bytes(stamp.value);
    measures_.stamp_bytes += stamp_bytes;
    measures_.bytes_sent += sender.frame_bytes + stamp_bytes;
}

void Chronology::accepted(const neat::Genome& active, const neat::Genome& received) {
    const Homology homology = origins_.align(*active.topology, *received.topology);
    ++measures_.alignments;
    measures_.matching += homology.matching;
    measures_.disjoint += homology.disjoint;
    measures_.excess += homology.excess;
    measures_.missed_homologies += homology.missed;
    measures_.false_homologies += homology.mistaken;
}

void Chronology::crossed(const neat::Birth& birth) {
    const Homology homology =
        origins_.align(*birth.first_parent->topology, *birth.second_parent->topology);
    ++measures_.crossovers;
    if (homology.missed > 0) ++measures_.crossovers_missed;
    if (homology.mistaken > 0) ++measures_.crossovers_false;
    if (origins_.repeats_structure(*birth.inherited)) ++measures_.crossovers_repeated;
}

void Chronology::born(std::uint32_t robot, const neat::Birth& birth,
                      const neat::Genome& offspring) {
    origins_.inherit(birth.inherited, *birth.first_parent->topology,
                     birth.mated ? birth.second_parent->topology.get() : nullptr);
    if (birth.mated) crossed(birth);
    if (offspring.topology == birth.inherited) return;
    origins_.innovate(offspring.topology, *birth.inherited);
    for (const Innovation& gene : origins_.innovations()) {
        log_.add(robot, gene.mark, gene.structure, cycle_, past_.known(robot));
        past_.created(robot);
    }
}

void Chronology::ended(const neat::Genome& active, Stamp stamp) {
    // The initial genes come before all others, by their marks as in time.
    const auto& genes = origins_.of(*active.topology).connections;
    const std::size_t initial = origins_.initial_genes();
    for (std::size_t i = active.topology->initial_connections; i < genes.size(); ++i) {
        for (std::size_t j = i + 1; j < genes.size(); ++j) {
            if (!log_.is_timed(genes[i] - initial, genes[j] - initial)) continue;
            ++measures_.genome_pairs;
            if (genes[j] < genes[i]) ++measures_.genome_inverted;
        }
    }
    const bool is_first = ended_robots_ == 0;
    measures_.stamp_smallest =
        is_first ? stamp.value : std::min(measures_.stamp_smallest, stamp.value);
    measures_.stamp_largest = std::max(measures_.stamp_largest, stamp.value);
    ++ended_robots_;
    measures_.stamp_mean += (static_cast<double>(stamp.value) - measures_.stamp_mean) /
                            static_cast<double>(ended_robots_);
}

ChronologyMeasures Chronology::measures() const {
    ChronologyMeasures measures = measures_;
    log_.report(measures);
    return measures;
}

}  // namespace gene_clocks::sim
