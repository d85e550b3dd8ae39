#pragma once

#include <memory>
#include <ranges>
#include <utility>

#include "gene_clocks/admission_gate.hpp"
#include "gene_clocks/neat/innovation_source.hpp"
#include "gene_clocks/stored_counter.hpp"

namespace gene_clocks::neat {

/// Marks genes with a gene clock on a robot that may crash, among robots that may be broken or lie.
///
/// A broadcast is held until what it needs is in `storage`; with `limits.block` that takes a write
/// once in many genes. Every message passes an admission gate, genes and all.
template <CounterStorage Storage>
class DurableGeneClockSource final : public InnovationSource {
public:
    /// Goes on from what `storage` holds: the counter of an earlier life, or that with which it was
    /// created, which is genesis_mark_count() + 1. nullptr where no clock with these limits can
    /// have stored that, as where `storage` is not open. `storage` must outlive the source.
    static std::unique_ptr<DurableGeneClockSource> restart(RobotId robot, Storage& storage,
                                                           GeneClock::Limits limits = {},
                                                           AdmissionGate::Policy admission = {}) {
        const auto clock = GeneClock::restart(robot, storage.stored(), limits);
        if (!clock) return nullptr;
        return std::unique_ptr<DurableGeneClockSource>(
            new DurableGeneClockSource(*clock, storage, admission));
    }

    std::optional<SplitMarks> mark_split(const Genome&, std::size_t, double) override {
        const auto marks = clock_.mint(3);
        if (!marks) return std::nullopt;
        return SplitMarks{(*marks)[0], (*marks)[1], (*marks)[2]};
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds&,
                                                    double) override {
        return clock_.mint();
    }
    Stamp stamp() const override { return clock_.stamp(); }

    /// Writes to storage where that is due. nullopt where it fails; storage_status() says why, and
    /// the next call tries again.
    std::optional<Stamp> stamp_to_send() override {
        status_ = storage_.store(clock_.durable_needed());
        if (!status_) return std::nullopt;
        return clock_.stamp();
    }

    /// A stamp without genes.
    bool observe(Stamp stamp) override {
        return gate_.admit(clock_, stamp, std::views::empty<InnovationNumber>) ==
               Admission::admitted;
    }
    Admission admit(Stamp stamp, const Genome& genome) override {
        const Topology& topology = *genome.topology;
        return gate_.admit(clock_, stamp, std::views::iota(std::size_t{0}, topology.size()),
                           [&](std::size_t gene) {
                               const std::size_t neurons = topology.neurons.size();
                               return gene < neurons ? topology.neurons[gene].mark
                                                     : topology.connection_marks[gene - neurons];
                           });
    }

    /// To be called once a cycle, so that the admission policy's allowance grows.
    void elapse() { gate_.elapse(); }

    const AdmissionGate& gate() const { return gate_; }
    StorageStatus storage_status() const { return status_; }

private:
    DurableGeneClockSource(const GeneClock& clock, Storage& storage,
                           AdmissionGate::Policy admission)
        : clock_(clock), gate_(admission), storage_(storage) {}

    GeneClock clock_;
    AdmissionGate gate_;
    Storage& storage_;
    StorageStatus status_;
};

}  // namespace gene_clocks::neat
