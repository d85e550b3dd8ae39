#pragma once

#include <gene_clocks/genome_payload.h>
#include <gene_clocks/wire.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

namespace gene_clocks {

/// Why bytes are refused, or why something cannot be written (docs/wire-format.md).
enum class WireError : std::uint8_t {
    /// A field ends beyond the bytes.
    truncated = kernel::gene_clocks_wire_truncated,
    /// Bytes are left over.
    trailing = kernel::gene_clocks_wire_trailing,
    /// More bytes than the limits allow.
    too_long = kernel::gene_clocks_wire_too_long,
    /// Not version 1.
    version = kernel::gene_clocks_wire_version,
    /// The same value has a shorter encoding.
    not_shortest = kernel::gene_clocks_wire_not_shortest,
    /// A number has more bits than its field.
    out_of_range = kernel::gene_clocks_wire_out_of_range,
    /// The bytes are not those that were sent.
    checksum = kernel::gene_clocks_wire_checksum,
    /// Robot 0, reserved for the initial genes, as a sender or the maker of a genome.
    robot = kernel::gene_clocks_wire_robot,
    /// A stamp that no clock above the genesis marks has.
    stamp = kernel::gene_clocks_wire_stamp,
    /// An energy that is not finite, or beyond the limit.
    energy = kernel::gene_clocks_wire_energy,
    /// More genes than the limits allow.
    too_many_genes = kernel::gene_clocks_wire_too_many_genes,
    /// Not as many genes of a kind as announced.
    gene_count = kernel::gene_clocks_wire_gene_count,
    /// A mark is not above the one before it: unsorted, or repeated.
    not_ascending = kernel::gene_clocks_wire_not_ascending,
    /// A mark is not below the stamp.
    not_below = kernel::gene_clocks_wire_not_below,
    /// A gene of robot 0 outside the genesis marks, or of another robot inside.
    genesis = kernel::gene_clocks_wire_genesis,
    /// Not inputs, one bias, outputs, and then the rest.
    kind = kernel::gene_clocks_wire_kind,
    /// A connection without its neurons, or into an input.
    ends = kernel::gene_clocks_wire_ends,
    /// Two connections join the same neurons.
    repeated_ends = kernel::gene_clocks_wire_repeated_ends,
    /// A weight that is not finite, or beyond the limit.
    weight = kernel::gene_clocks_wire_weight,
    /// Writing: the buffer is too small.
    no_room = kernel::gene_clocks_wire_no_room,
    /// Not a general genome.
    form = kernel::gene_clocks_wire_form,
    /// A general genome after another schema.
    schema = kernel::gene_clocks_wire_schema,
    /// A value that the schema does not admit.
    attribute = kernel::gene_clocks_wire_attribute,
};

/// The error's name, as `docs/wire-format.md` and the test vectors have it.
constexpr std::string_view name_of(WireError error) {
    // In the order of gene_clocks_wire_error.
    constexpr std::string_view names[] = {
        "ok",           "truncated",      "trailing",   "too_long",      "version",
        "not_shortest", "out_of_range",   "checksum",   "robot",         "stamp",
        "energy",       "too_many_genes", "gene_count", "not_ascending", "not_below",
        "genesis",      "kind",           "ends",       "repeated_ends", "weight",
        "no_room",      "form",           "schema",     "attribute"};
    const auto index = static_cast<std::size_t>(error);
    return index < std::size(names) ? names[index] : "unknown";
}

/// What is wrong, and where.
struct WireFault {
    WireError error{};
    std::size_t offset{};  ///< first byte of the field or, where fields disagree, of the gene

    /// Precondition: `fault` is one.
    static constexpr WireFault from(kernel::gene_clocks_fault fault) {
        return {static_cast<WireError>(fault.error), fault.offset};
    }
    friend constexpr bool operator==(WireFault, WireFault) = default;
};

/// A value, or why there is none.
template <class T, class Fault = WireFault>
class [[nodiscard]] WireResult {
public:
    constexpr WireResult(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    constexpr WireResult(Fault fault) : content_(std::in_place_index<1>, fault) {}

    constexpr explicit operator bool() const { return content_.index() == 0; }
    /// Preconditions of all three: there is a value; there is none for `fault()`.
    constexpr T& operator*() { return *std::get_if<0>(&content_); }
    constexpr const T& operator*() const { return *std::get_if<0>(&content_); }
    constexpr T* operator->() { return std::get_if<0>(&content_); }
    constexpr const T* operator->() const { return std::get_if<0>(&content_); }
    constexpr Fault fault() const { return *std::get_if<1>(&content_); }

private:
    std::variant<T, Fault> content_;
};

/// What a deployment admits; everything beyond is refused before it costs memory.
struct WireLimits {
    std::uint32_t frame_bytes = 65'507;  ///< of a frame; by default what a UDP datagram holds
    std::uint64_t genesis_count = 0;     ///< genesis marks 1…genesis_count, the same in the fleet
    std::uint16_t neurons = 1024;        ///< neuron genes of a genome
    std::uint16_t connections = 1024;    ///< connection genes of a genome
    float energy = std::numeric_limits<float>::max();  ///< magnitude; not negative
    float weight = std::numeric_limits<float>::max();  ///< magnitude; not negative
    /// Changes nothing that is admitted: any number that strangers cannot guess, so that they
    /// cannot make up a genome that takes long to check (`neat::MessageCodec` draws one where this
    /// is 0).
    std::uint32_t salt = 0;

    [[nodiscard]] constexpr kernel::gene_clocks_wire_limits kernel_limits() const {
        return {frame_bytes, genesis_count, neurons, connections, energy, weight, salt};
    }
};

/// What a robot broadcasts (paper, section 3.2), around a payload of its own format.
struct Frame {
    RobotId sender{};
    Stamp stamp;
    float energy{};
    std::span<const std::uint8_t> payload;
};

/// Reads a frame, without allocation. The payload lies within `bytes` and is not looked at, except
/// that the checksum covers it. The stamp still has to pass the clock's `observe`.
constexpr WireResult<Frame> decode_frame(std::span<const std::uint8_t> bytes,
                                         const WireLimits& limits = {}) {
    const auto kernel_limits = limits.kernel_limits();
    kernel::gene_clocks_frame frame{};
    const auto fault =
        kernel::gene_clocks_decode_frame(bytes.data(), bytes.size(), &kernel_limits, &frame);
    if (fault.error) return WireFault::from(fault);
    return Frame{RobotId{frame.sender},
                 Stamp{frame.stamp},
                 frame.energy,
                 {frame.payload, frame.payload_size}};
}

/// Writes a frame to the front of `buffer` and returns its bytes, without allocation. The payload
/// may lie in the buffer already, at or behind its place: it is moved there. Refused, with the
/// buffer unchanged, is what `decode_frame` would refuse with the same limits, and what does not
/// fit (`WireError::no_room`).
constexpr WireResult<std::span<const std::uint8_t>> encode_frame(const Frame& frame,
                                                                 std::span<std::uint8_t> buffer,
                                                                 const WireLimits& limits = {}) {
    const auto kernel_limits = limits.kernel_limits();
    const kernel::gene_clocks_frame kernel_frame{
        frame.stamp.value, static_cast<std::uint32_t>(frame.sender), frame.energy,
        frame.payload.data(), frame.payload.size()};
    std::size_t size = 0;
    const auto fault = kernel::gene_clocks_encode_frame(&kernel_frame, &kernel_limits,
                                                        buffer.data(), buffer.size(), &size);
    if (fault.error) return WireFault::from(fault);
    return std::span<const std::uint8_t>(buffer.first(size));
}

/// The bytes that a frame takes, also one that no receiver would take.
constexpr std::size_t frame_bytes(RobotId sender, Stamp stamp, std::size_t payload_bytes) {
    const kernel::gene_clocks_frame frame{stamp.value, static_cast<std::uint32_t>(sender), 0.0f,
                                          nullptr, payload_bytes};
    return kernel::gene_clocks_frame_bytes(&frame);
}

/// The bytes that a number takes in a frame, as a varint: seven bits in each.
constexpr std::size_t varint_bytes(std::uint64_t value) {
    return (static_cast<std::size_t>(std::bit_width(value | 1)) + 6) / 7;
}

/// The most bytes of a frame that are not payload.
inline constexpr std::size_t frame_overhead_bytes = kernel::gene_clocks_frame_overhead_bytes;

/// The most bytes that a genome's payload can take.
constexpr std::size_t genome_payload_bytes_max(std::size_t neurons, std::size_t connections) {
    return kernel::gene_clocks_genome_header_bytes_max +
           neurons * kernel::gene_clocks_neuron_bytes_max +
           connections * kernel::gene_clocks_connection_bytes_max;
}

}  // namespace gene_clocks
