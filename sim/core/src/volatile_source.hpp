#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "sim/core/src/forwarding_source.hpp"

namespace gene_clocks::sim {

/// An innovation source whose counter a reboot sets back, so that it may mark a gene as it once
/// marked another. The robot sees, and passes over, marks that the genome at hand has already; that
/// others hold them it cannot see.
class VolatileSource final : public ForwardingSource {
public:
    explicit VolatileSource(std::unique_ptr<neat::InnovationSource> source)
        : ForwardingSource(std::move(source)) {}

    std::optional<neat::SplitMarks> mark_split(const neat::Genome& genome, std::size_t connection,
                                               double now_cycles) override {
        for (;;) {
            const auto marks = ForwardingSource::mark_split(genome, connection, now_cycles);
            if (!marks || !(has(genome, marks->neuron) || has(genome, marks->incoming) ||
                            has(genome, marks->outgoing))) {
                return marks;
            }
        }
    }
    std::optional<InnovationNumber> mark_connection(const neat::Genome& genome,
                                                    const neat::ConnectionEnds& ends,
                                                    double now_cycles) override {
        for (;;) {
            const auto mark = ForwardingSource::mark_connection(genome, ends, now_cycles);
            if (!mark || !has(genome, *mark)) return mark;
        }
    }

private:
    static bool has(const neat::Genome& genome, InnovationNumber mark) {
        const auto& connections = genome.topology->connection_marks;
        return genome.topology->find_neuron(mark) ||
               std::binary_search(connections.begin(), connections.end(), mark);
    }
};

}  // namespace gene_clocks::sim
