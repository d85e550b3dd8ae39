#pragma once

#include <cstddef>
#include <cstdint>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/sim/chronology_measures.hpp>
#include <memory>
#include <vector>

#include "sim/core/src/chronology/causal_past.hpp"
#include "sim/core/src/chronology/gene_log.hpp"
#include "sim/core/src/chronology/gene_origins.hpp"

namespace gene_clocks::sim {

/// Measures a run's chronology from what happens in it: births, messages, receptions. It looks on
/// and changes nothing. Robots are indices.
///
/// Every run has one, so messages, of which there are hundreds of thousands, cost a comparison or
/// two each; what is dear is done for new genes, accepted genomes and crossovers.
class Chronology {
public:
    /// `initial` is the topology that all robots start from.
    Chronology(std::size_t robots, std::int64_t delay_cycles,
               std::shared_ptr<const neat::Topology> initial);

    void begin_cycle(std::int64_t cycle) { cycle_ = cycle; }

    /// A robot broadcast its active genome. Messages are numbered from 0.
    void sent(std::uint32_t robot, std::uint64_t message,
              const std::shared_ptr<const neat::Genome>& active, Stamp stamp);

    /// A robot's innovation source admitted a message, whatever became of its genome.
    void admitted(std::uint32_t receiver, std::uint64_t message) {
        past_.admitted(receiver, message);
    }
    /// A genome was accepted where `active` is the active one.
    void accepted(const neat::Genome& active, const neat::Genome& received);

    /// A robot replaced its active genome by `offspring`.
    void born(std::uint32_t robot, const neat::Birth& birth, const neat::Genome& offspring);

    /// To be called for each robot at the end of the run, before `measures()`.
    void ended(const neat::Genome& active, Stamp stamp);
    ChronologyMeasures measures() const;

    /// All genes that were created, in order.
    const std::vector<GeneCreation>& creations() const { return log_.genes(); }

private:
    struct Sender {
        std::shared_ptr<const neat::Genome> genome;  // that was sent last
        std::size_t frame_bytes{};                   // without the stamp
    };
    Sender measure_frame(std::uint32_t robot, std::shared_ptr<const neat::Genome> active) const;
    void crossed(const neat::Birth& birth);

    std::int64_t cycle_ = 0;
    CausalPast past_;
    GeneOrigins origins_;
    GeneLog log_;
    std::vector<Sender> senders_;
    ChronologyMeasures measures_;  // less the log's
    std::size_t ended_robots_ = 0;
};

}  // namespace gene_clocks::sim
