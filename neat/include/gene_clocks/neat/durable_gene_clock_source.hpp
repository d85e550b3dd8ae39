#pragma once

#include <algorithm>
#include <cstdint>
#include <gene_clocks/admission_gate.hpp>
#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/stored_counter.hpp>
#include <memory>
#include <ranges>
#include <utility>

namespace gene_clocks::neat {

/// Marks genes with a gene clock on a robot that may crash, among robots that may be broken or lie.
///
/// A broadcast is held until what it needs is in `storage`; with `limits.block` that takes a write
/// once in many genes. Every message passes an admission gate, genes and all.
///
/// The robot's genomes are numbered by the same stored counter, from where it stood at the start,
/// so that no number is sent in two lives (modulo 2³², since a GenomeId has no more). That may move
/// the clock at a restart, by at most one counter for each genome that was sent and two blocks; the
/// other robots' admission policies have to leave room for it.
template <CounterStorage Storage>
class DurableGeneClockSource final : public InnovationSource {
public:
    /// Goes on from what `storage` holds: the counter of an earlier life, or that with which it was
    /// created, which is genesis_count + 1. nullptr where no clock with these limits, above so many
    /// genesis marks (genesis_mark_count()), can have stored that, as where `storage` is not open
    /// or was created for fewer of them. `storage` must outlive the source.
    static std::unique_ptr<DurableGeneClockSource> restart(RobotId robot, Storage& storage,
                                                           std::uint64_t genesis_count,
                                                           GeneClock::Limits limits = {},
                                                           AdmissionGate::Policy admission = {}) {
        auto clock = GeneClock::restart(robot, storage.stored(), genesis_count, limits);
        if (!clock) return nullptr;
        return std::unique_ptr<DurableGeneClockSource>(
            new DurableGeneClockSource(*std::move(clock), storage, limits, admission));
    }

    std::optional<SplitMarks> mark_split(const Genome&, std::size_t, double) override {
        return mint_split(clock_);
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds&,
                                                    double) override {
        return clock_.mint();
    }
    Stamp stamp() const override { return clock_.stamp(); }

    /// Writes to storage where that is due. nullopt where it fails; storage_status() says why, and
    /// the next call tries again.
    std::optional<Stamp> stamp_to_send(std::uint32_t birth) override {
        status_ = reserve_birth(birth) ? storage_.store(std::max(clock_.durable_needed(), births_))
                                       : StorageStatus{StorageError::bad_counter};
        if (!status_) return std::nullopt;
        return clock_.stamp();
    }
    std::uint32_t first_birth() const override { return static_cast<std::uint32_t>(first_birth_); }

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
    DurableGeneClockSource(GeneClock clock, Storage& storage, GeneClock::Limits limits,
                           AdmissionGate::Policy admission)
        : clock_(std::move(clock)), gate_(admission), storage_(storage), limits_(limits) {}

    /// Moves `births_` beyond a birth, a block at a time; false beyond the largest counter.
    bool reserve_birth(std::uint32_t birth) {
        const std::uint64_t count = std::uint64_t{birth - first_birth()} + 1;  // of this life
        if (count > limits_.maximum - first_birth_) return false;
        const std::uint64_t next = first_birth_ + count;
        if (next > births_) births_ = next + std::min(limits_.block, limits_.maximum - next);
        return true;
    }

    GeneClock clock_;
    AdmissionGate gate_;
    Storage& storage_;
    GeneClock::Limits limits_;
    const std::uint64_t first_birth_ = storage_.stored();
    std::uint64_t births_ = first_birth_;  // to be stored; above all births that were to be sent
    StorageStatus status_;
};

}  // namespace gene_clocks::neat
