#pragma once

#include <gene_clocks/neat/innovation_source.hpp>
#include <memory>
#include <utility>

namespace gene_clocks::sim {

/// A layer around an innovation source that passes everything on. What derives from it overrides
/// what it changes, and never has to follow when the interface grows.
class ForwardingSource : public neat::InnovationSource {
public:
    explicit ForwardingSource(std::unique_ptr<neat::InnovationSource> source)
        : source_(std::move(source)) {}

    std::optional<neat::SplitMarks> mark_split(const neat::Genome& genome, std::size_t connection,
                                               double now_cycles) override {
        return source_->mark_split(genome, connection, now_cycles);
    }
    std::optional<InnovationNumber> mark_connection(const neat::Genome& genome,
                                                    const neat::ConnectionEnds& ends,
                                                    double now_cycles) override {
        return source_->mark_connection(genome, ends, now_cycles);
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
};

}  // namespace gene_clocks::sim
