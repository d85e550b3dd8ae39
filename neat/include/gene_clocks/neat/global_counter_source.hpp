#pragma once

#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/source_parts.hpp>
#include <map>
#include <memory>
#include <tuple>

namespace gene_clocks::neat {

/// What all robots would have to share: NEAT's one counter, and the record of all innovations so
/// far (Stanley & Miikkulainen 2002). Not thread-safe: one for each run.
class InnovationRecord {
public:
    /// Numbers begin above the genesis marks 1…genesis_count.
    explicit InnovationRecord(std::uint64_t genesis_count) : next_(genesis_count + 1) {}

    /// The marks for the `repetition`-th split of a connection within one genome.
    SplitMarks split(InnovationNumber connection, std::uint64_t repetition);
    InnovationNumber join(InnovationNumber source, InnovationNumber target);

private:
    InnovationNumber next() { return {next_++, no_robot}; }

    std::uint64_t next_;
    std::map<std::pair<InnovationNumber, std::uint64_t>, SplitMarks> splits_;
    std::map<std::pair<InnovationNumber, InnovationNumber>, InnovationNumber> joins_;
};

/// NEAT as it was meant, and as no swarm can have it: one counter for all, and equal structural
/// innovations get equal numbers, whoever makes them and whenever. NEAT forgets its record after
/// each generation; robots have none, so that here it is kept for ever.
class GlobalCounterSource final : public InnovationSource {
public:
    /// Precondition: the record is not null, and its user's genomes share its genesis marks.
    explicit GlobalCounterSource(std::shared_ptr<InnovationRecord> record)
        : record_(std::move(record)) {}
    explicit GlobalCounterSource(const SourceParts& parts) : GlobalCounterSource(parts.record) {}

    std::optional<SplitMarks> mark_split(const Genome& genome, std::size_t connection,
                                         double) override {
        const Topology& topology = *genome.topology;
        std::uint64_t repetition = 0;
        SplitMarks marks;
        do {
            marks = record_->split(topology.connection_marks[connection], repetition++);
        } while (topology.find_neuron(marks.neuron));
        return marks;
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds& ends,
                                                    double) override {
        return record_->join(ends.source, ends.target);
    }

private:
    std::shared_ptr<InnovationRecord> record_;
};

}  // namespace gene_clocks::neat
