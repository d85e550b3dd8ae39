#pragma once

#include <gene_clocks/genome_payload.h>

#include <cstdint>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/neat/settings.hpp>
#include <gene_clocks/wire.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace gene_clocks::neat {

/// A message off the wire. Its genome is valid (see `find_fault`) and has the fleet's initial
/// genes, so that `Agent::receive` may be given it.
struct ReceivedMessage {
    RobotId sender{};
    Message message;
};

/// The limits of a fleet that runs odNEAT with these settings from this initial topology.
WireLimits wire_limits(const Topology& initial, const OdneatSettings& settings);

/// The bytes of a genome's payload, whatever marked its genes: also where no codec would take it,
/// since those of other sources than gene clocks may come before what they depend on. Precondition:
/// fewer than 65 536 genes of each kind, as the format counts them.
std::size_t payload_bytes(const Genome& genome);

/// Turns messages into frames of the wire format and back (docs/wire-format.md): the door between
/// an agent and strangers. What comes out of `decode` is a valid message, whatever went in; what
/// `encode` writes decodes to the same message, and no other bytes do.
///
/// Marks must be those of gene clocks: a message with a stamp that is not above its genes, as
/// other innovation sources send it, is refused. Not thread-safe: one owner.
class MessageCodec {
public:
    /// `initial` is the topology that all robots start from; its marks are the genesis marks, from
    /// 1 on without a gap, and its size counts for limits.genesis_count. Keeps 32 bytes of memory
    /// for each gene that the limits allow, and 16 more for each connection.
    MessageCodec(std::shared_ptr<const Topology> initial, const WireLimits& limits);

    /// The frame that carries `message`; valid until the next call. Refused is what `decode` would
    /// refuse. Precondition: the arrays of the genome are parallel.
    WireResult<std::span<const std::uint8_t>> encode(RobotId sender, const Message& message);

    /// The message in a frame; refused ones leave no trace, and no memory is allocated for them.
    /// What the message takes is bounded by the limits, and by 32 bytes for each byte of the frame.
    /// A genome with no genes but the initial ones shares `initial`.
    WireResult<ReceivedMessage> decode(std::span<const std::uint8_t> frame);

private:
    std::optional<std::size_t> first_foreign_gene(std::size_t genes) const;
    std::size_t offset_of_gene(const Frame& frame, std::size_t index);
    bool has_initial_genes(const Topology& topology) const;
    std::shared_ptr<const Topology> topology_of(const kernel::gene_clocks_genome& counts) const;
    bool take_genes(const Genome& genome);

    std::shared_ptr<const Topology> initial_;
    std::vector<kernel::gene_clocks_gene> initial_genes_;  // in the order of marks
    WireLimits limits_;
    kernel::gene_clocks_wire_limits kernel_limits_;
    // Scratch: the genes that were read or written last, what checks need, neurons by their marks,
    // the frame that was written last.
    std::vector<kernel::gene_clocks_gene> genes_;
    std::vector<std::uint32_t> joined_;
    std::vector<std::uint16_t> places_;
    std::vector<std::uint8_t> buffer_;
};

}  // namespace gene_clocks::neat
