#pragma once

#include <memory>
#include <vector>

#include "gene_clocks/neat/innovation_source.hpp"
#include "gene_clocks/sim/simulation.hpp"

namespace gene_clocks::sim {

/// An innovation source that also writes down when each gene was created. Runs that do not ask for
/// it do without this layer.
class RecordingSource final : public neat::InnovationSource {
public:
    /// `log` must outlive the source.
    RecordingSource(std::unique_ptr<neat::InnovationSource> source, RobotId robot,
                    std::vector<GeneCreation>& log)
        : source_(std::move(source)), robot_(robot), log_(log) {}

    std::optional<neat::SplitMarks> mark_split(const neat::Genome& genome, std::size_t connection,
                                               double now_cycles) override {
        const auto marks = source_->mark_split(genome, connection, now_cycles);
        if (marks) {
            for (const auto& mark : {marks->neuron, marks->incoming, marks->outgoing}) {
                log_.push_back({mark, robot_, now_cycles});
            }
        }
        return marks;
    }
    std::optional<InnovationNumber> mark_connection(const neat::Genome& genome,
                                                    const neat::ConnectionEnds& ends,
                                                    double now_cycles) override {
        const auto mark = source_->mark_connection(genome, ends, now_cycles);
        if (mark) log_.push_back({*mark, robot_, now_cycles});
        return mark;
    }
    Stamp stamp() const override { return source_->stamp(); }
    bool observe(Stamp stamp) override { return source_->observe(stamp); }

private:
    std::unique_ptr<neat::InnovationSource> source_;
    RobotId robot_;
    std::vector<GeneCreation>& log_;
};

}  // namespace gene_clocks::sim
