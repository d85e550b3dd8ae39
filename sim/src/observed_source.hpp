#pragma once

#include <memory>

#include "gene_clocks/neat/innovation_source.hpp"
#include "gene_clocks/sim/run_observer.hpp"

namespace gene_clocks::sim {

/// An innovation source that also tells an observer of each gene. Runs without an observer do
/// without this layer.
class ObservedSource final : public neat::InnovationSource {
public:
    /// `observer` must outlive the source.
    ObservedSource(std::unique_ptr<neat::InnovationSource> source, RobotId robot,
                   RunObserver& observer)
        : source_(std::move(source)), robot_(robot), observer_(observer) {}

    std::optional<neat::SplitMarks> mark_split(const neat::Genome& genome, std::size_t connection,
                                               double now_cycles) override {
        const auto marks = source_->mark_split(genome, connection, now_cycles);
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
        const auto mark = source_->mark_connection(genome, ends, now_cycles);
        if (mark) observer_.gene_marked(robot_, *mark, now_cycles);
        return mark;
    }
    Stamp stamp() const override { return source_->stamp(); }
    std::optional<Stamp> stamp_to_send(std::uint32_t birth) override {
        return source_->stamp_to_send(birth);
    }
    std::uint32_t first_birth() const override { return source_->first_birth(); }
    bool observe(Stamp stamp) override { return source_->observe(stamp); }
    Admission admit(Stamp stamp, const neat::Genome& genome) override {
        return source_->admit(stamp, genome);
    }

private:
    std::unique_ptr<neat::InnovationSource> source_;
    RobotId robot_;
    RunObserver& observer_;
};

}  // namespace gene_clocks::sim
