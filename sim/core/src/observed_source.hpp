#pragma once

#include <gene_clocks/sim/run_observer.hpp>
#include <memory>
#include <utility>

#include "sim/core/src/forwarding_source.hpp"

namespace gene_clocks::sim {

/// An innovation source that also tells an observer of each gene. Runs without an observer do
/// without this layer.
class ObservedSource final : public ForwardingSource {
public:
    /// `observer` must outlive the source.
    ObservedSource(std::unique_ptr<neat::InnovationSource> source, RobotId robot,
                   RunObserver& observer)
        : ForwardingSource(std::move(source)), robot_(robot), observer_(observer) {}

    std::optional<neat::SplitMarks> mark_split(const neat::Genome& genome, std::size_t connection,
                                               double now_cycles) override {
        const auto marks = ForwardingSource::mark_split(genome, connection, now_cycles);
        if (marks) {
            for (const auto& mark : {marks->neuron, marks->incoming, marks->outgoing}) {
                observer_.gene_marked(robot_, mark, now_cycles);
            }
        }
        return marks;
    }
    std::optional<InnovationNumber> mark_connection(const neat::Genome& genome,
                                                    const neat::ConnectionEnds& ends,
                                                    double now_cycles) override {
        const auto mark = ForwardingSource::mark_connection(genome, ends, now_cycles);
        if (mark) observer_.gene_marked(robot_, *mark, now_cycles);
        return mark;
    }

private:
    RobotId robot_;
    RunObserver& observer_;
};

}  // namespace gene_clocks::sim
