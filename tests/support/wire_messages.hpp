#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/wire.hpp>
#include <ostream>
#include <span>
#include <vector>

// Whole messages of the wire format as plain values, by the C header's functions: what tests and
// fuzzers decode to and encode from.

namespace gene_clocks {

// Found by argument-dependent lookup: GoogleTest prints these in messages.
inline void PrintTo(WireError error, std::ostream* out) {
    *out << name_of(error);
}
inline void PrintTo(WireFault fault, std::ostream* out) {
    *out << name_of(fault.error) << " at " << fault.offset;
}

}  // namespace gene_clocks

namespace gene_clocks::test {

struct WireMessage {
    RobotId sender{};
    Stamp stamp;
    float energy{};
    kernel::gene_clocks_genome genome{};  ///< identity and counts
    std::vector<kernel::gene_clocks_gene> genes;
};

/// The message in a frame. Faults in the payload are reported at their offset in the frame.
inline WireResult<WireMessage> decode_message(std::span<const std::uint8_t> bytes,
                                              const WireLimits& limits) {
    const auto frame = decode_frame(bytes, limits);
    if (!frame) return frame.fault();
    const auto kernel_limits = limits.kernel_limits();
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(limits.connections));
    WireMessage message{frame->sender, frame->stamp, frame->energy, {}, {}};
    message.genes.resize(std::size_t{limits.neurons} + limits.connections);
    auto fault = kernel::gene_clocks_decode_genome(
        frame->payload.data(), frame->payload.size(), frame->stamp.value, &kernel_limits,
        &message.genome, message.genes.data(), joined.data());
    if (fault.error) {
        fault.offset += static_cast<std::size_t>(frame->payload.data() - bytes.data());
        return WireFault::from(fault);
    }
    message.genes.resize(std::size_t{message.genome.neurons} + message.genome.connections);
    return message;
}

/// The frame of a message: its genes as they are, its counts as `genome` has them.
inline WireResult<std::vector<std::uint8_t>> encode_message(const WireMessage& message,
                                                            const WireLimits& limits) {
    const auto kernel_limits = limits.kernel_limits();
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(limits.connections));
    std::vector<std::uint8_t> payload(
        genome_payload_bytes_max(message.genes.size(), message.genes.size()));
    kernel::gene_clocks_genome_writer writer{};
    auto fault =
        kernel::gene_clocks_begin_genome(&writer, payload.data(), payload.size(), message.genome,
                                         message.stamp.value, &kernel_limits, joined.data());
    for (const auto& gene : message.genes) {
        if (!fault.error) fault = kernel::gene_clocks_put_gene(&writer, &gene);
    }
    if (!fault.error) fault = kernel::gene_clocks_end_genome(&writer);
    if (fault.error) return WireFault::from(fault);
    payload.resize(writer.bytes.size);
    std::vector<std::uint8_t> frame(payload.size() + frame_overhead_bytes);
    const auto written =
        encode_frame({message.sender, message.stamp, message.energy, payload}, frame, limits);
    if (!written) return written.fault();
    frame.resize(written->size());
    return frame;
}

inline bool same_gene(const kernel::gene_clocks_gene& a, const kernel::gene_clocks_gene& b) {
    return kernel::gene_clocks_equal(a.mark, b.mark) && a.kind == b.kind &&
           a.is_enabled == b.is_enabled && a.is_recurrent == b.is_recurrent &&
           a.ends.source == b.ends.source && a.ends.target == b.ends.target &&
           std::bit_cast<std::uint32_t>(a.weight) == std::bit_cast<std::uint32_t>(b.weight);
}

/// Equal to the bit.
inline bool same_message(const WireMessage& a, const WireMessage& b) {
    if (a.sender != b.sender || a.stamp != b.stamp || a.genome.robot != b.genome.robot ||
        std::bit_cast<std::uint32_t>(a.energy) != std::bit_cast<std::uint32_t>(b.energy) ||
        a.genome.birth != b.genome.birth || a.genome.neurons != b.genome.neurons ||
        a.genome.connections != b.genome.connections || a.genes.size() != b.genes.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.genes.size(); ++i) {
        if (!same_gene(a.genes[i], b.genes[i])) return false;
    }
    return true;
}

/// Replaces the last four bytes by the checksum of the others, so that damage before them is
/// found by other checks.
inline void mend_checksum(std::vector<std::uint8_t>& frame) {
    if (frame.size() < 4) return;
    const std::size_t end = frame.size() - 4;
    const std::uint32_t sum = kernel::gene_clocks_crc32c(frame.data(), end);
    for (std::size_t i = 0; i < 4; ++i) {
        frame[end + i] = static_cast<std::uint8_t>(sum >> 8 * i & 0xffu);
    }
}

}  // namespace gene_clocks::test
