/* The wire format, version 1 (docs/wire-format.md): frames. In C99 and in constexpr C++20 at once,
 * like kernel.h.
 *
 * No allocation, no I/O, no global state; no assumption on byte order, alignment or the processor's
 * floating point: numbers are put together from bytes, and floats are compared as bit patterns.
 * Every length is checked before it is used. What is read may be anything at all.
 */
#ifndef GENE_CLOCKS_WIRE_H
#define GENE_CLOCKS_WIRE_H

#include <gene_clocks/bytes.h>
#include <gene_clocks/checksum.h>
#include <stddef.h>
#include <stdint.h>

/* clang-format off */
#ifdef __cplusplus
#include <bit>
#define GENE_CLOCKS_FUNCTION constexpr
#define GENE_CLOCKS_BITS_OF(number) std::bit_cast<uint32_t>(number)
#define GENE_CLOCKS_FLOAT_OF(bits) std::bit_cast<float>(bits)
namespace gene_clocks::kernel {
#else
#include <stdbool.h>
#define GENE_CLOCKS_FUNCTION static inline
union gene_clocks_float { float number; uint32_t bits; };
#define GENE_CLOCKS_BITS_OF(value) ((union gene_clocks_float){.number = (value)}.bits)
#define GENE_CLOCKS_FLOAT_OF(value) ((union gene_clocks_float){.bits = (value)}.number)
#endif
/* clang-format on */

/* ---- Limits --------------------------------------------------------------------------------- */

/* What a deployment admits. Floats bound magnitudes; they are not negative and may be infinite
 * (still, only finite numbers are admitted). */
struct gene_clocks_wire_limits {
    uint32_t frame_bytes;   /* of a whole frame */
    uint64_t genesis_count; /* genesis marks 1 ... genesis_count, the same in the whole fleet */
    uint16_t neurons;       /* neuron genes of a genome */
    uint16_t connections;   /* connection genes of a genome */
    float energy;
    float weight;
    /* Not a limit, and no matter to what is admitted: any number that strangers cannot guess, so
     * that they cannot make up a genome that takes long to check (see gene_clocks_join). */
    uint32_t salt;
};

/* ---- Floats --------------------------------------------------------------------------------- */

/* Whether the float of these bits is finite and its magnitude at most `limit`. IEEE 754 orders
 * magnitudes as it orders their bits, so that no floating point is needed. */
GENE_CLOCKS_FUNCTION bool gene_clocks_is_within(uint32_t bits, float limit) {
    const uint32_t magnitude = bits & 0x7fffffffu;
    return magnitude < 0x7f800000u && magnitude <= GENE_CLOCKS_BITS_OF(limit);
}

/* ---- Frames --------------------------------------------------------------------------------- */

enum { gene_clocks_wire_version_1 = 1, gene_clocks_checksum_bytes = 4 };

/* The most bytes of a frame that are not payload: version, sender, stamp, energy, payload length
 * and checksum. */
enum { gene_clocks_frame_overhead_bytes = 1 + 5 + 10 + 4 + 5 + gene_clocks_checksum_bytes };

/* What a robot broadcasts (paper, section 3.2). */
struct gene_clocks_frame {
    uint64_t stamp; /* the sender's next unused counter */
    uint32_t sender;
    float energy;
    const uint8_t* payload; /* lies within the frame's bytes */
    size_t payload_size;
};

/* What every frame of a fleet keeps to, whichever way it goes. */
GENE_CLOCKS_FUNCTION bool gene_clocks_is_sender(uint64_t sender) {
    return sender != 0;
}
GENE_CLOCKS_FUNCTION bool gene_clocks_is_stamp(uint64_t stamp,
                                               const struct gene_clocks_wire_limits* limits) {
    return stamp > limits->genesis_count; /* clocks start above the genesis marks */
}

/* Reads the fields before the payload; `reader` is then at the payload. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_get_frame_header(
    struct gene_clocks_reader* reader, const struct gene_clocks_wire_limits* limits,
    struct gene_clocks_frame* frame) {
    enum gene_clocks_wire_error error = gene_clocks_wire_ok;
    uint64_t sender = 0, stamp = 0, payload_size = 0;
    uint32_t energy = 0;
    if (reader->size == 0) return gene_clocks_fault_at(gene_clocks_wire_truncated, 0);
    if (reader->bytes[0] != gene_clocks_wire_version_1) {
        return gene_clocks_fault_at(gene_clocks_wire_version, 0);
    }
    reader->offset = 1;
    size_t field = reader->offset;
    error = gene_clocks_get_varint(reader, 32, &sender);
    if (!error && !gene_clocks_is_sender(sender)) error = gene_clocks_wire_robot;
    if (error) return gene_clocks_fault_at(error, field);
    field = reader->offset;
    error = gene_clocks_get_varint(reader, 64, &stamp);
    if (!error && !gene_clocks_is_stamp(stamp, limits)) error = gene_clocks_wire_stamp;
    if (error) return gene_clocks_fault_at(error, field);
    field = reader->offset;
    error = gene_clocks_get_word(reader, &energy);
    if (!error && !gene_clocks_is_within(energy, limits->energy)) error = gene_clocks_wire_energy;
    if (error) return gene_clocks_fault_at(error, field);
    field = reader->offset;
    error = gene_clocks_get_varint(reader, 32, &payload_size);
    if (error) return gene_clocks_fault_at(error, field);

    const size_t left = reader->size - reader->offset;
    if (left < gene_clocks_checksum_bytes || left - gene_clocks_checksum_bytes < payload_size) {
        return gene_clocks_fault_at(gene_clocks_wire_truncated, field);
    }
    if (left - gene_clocks_checksum_bytes > payload_size) {
        return gene_clocks_fault_at(
            gene_clocks_wire_trailing,
            reader->offset + (size_t)payload_size + gene_clocks_checksum_bytes);
    }
    frame->sender = (uint32_t)sender;
    frame->stamp = stamp;
    frame->energy = GENE_CLOCKS_FLOAT_OF(energy);
    frame->payload = reader->bytes + reader->offset;
    frame->payload_size = (size_t)payload_size;
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Reads a frame, whose payload stays where it is: `bytes` must outlive the use of it. Where the
 * frame is refused, `frame` does not change. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_decode_frame(
    const uint8_t* bytes, size_t size, const struct gene_clocks_wire_limits* limits,
    struct gene_clocks_frame* frame) {
    if (size > limits->frame_bytes) {
        return gene_clocks_fault_at(gene_clocks_wire_too_long, limits->frame_bytes);
    }
    struct gene_clocks_reader reader = {bytes, size, 0};
    struct gene_clocks_frame read = {0, 0, 0.0f, NULL, 0};
    const struct gene_clocks_fault fault = gene_clocks_get_frame_header(&reader, limits, &read);
    if (fault.error) return fault;
    const size_t end = size - gene_clocks_checksum_bytes;
    if (gene_clocks_word_at(bytes, end) != gene_clocks_crc32c(bytes, end)) {
        return gene_clocks_fault_at(gene_clocks_wire_checksum, end);
    }
    *frame = read;
    return fault;
}

/* Writes the fields before the payload. */
GENE_CLOCKS_FUNCTION void gene_clocks_put_frame_header(struct gene_clocks_writer* writer,
                                                       const struct gene_clocks_frame* frame) {
    gene_clocks_put_byte(writer, gene_clocks_wire_version_1);
    gene_clocks_put_varint(writer, frame->sender);
    gene_clocks_put_varint(writer, frame->stamp);
    gene_clocks_put_word(writer, GENE_CLOCKS_BITS_OF(frame->energy));
    gene_clocks_put_varint(writer, frame->payload_size);
}

/* The bytes that a frame takes, also one that no receiver would take. Of its payload only the size
 * counts. */
GENE_CLOCKS_FUNCTION size_t gene_clocks_frame_bytes(const struct gene_clocks_frame* frame) {
    struct gene_clocks_writer header = {NULL, 0, 0};
    gene_clocks_put_frame_header(&header, frame);
    return header.size + frame->payload_size + gene_clocks_checksum_bytes;
}

/* Writes a frame and its size. The payload may lie in the buffer already, at or behind its place.
 * Where the frame would be refused by its receivers, or does not fit, only `size` is set: to the
 * bytes needed where the error is gene_clocks_wire_no_room, else to 0. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_encode_frame(
    const struct gene_clocks_frame* frame, const struct gene_clocks_wire_limits* limits,
    uint8_t* buffer, size_t capacity, size_t* size) {
    *size = 0;
    if (!gene_clocks_is_sender(frame->sender)) {
        return gene_clocks_fault_at(gene_clocks_wire_robot, 0);
    }
    if (!gene_clocks_is_stamp(frame->stamp, limits)) {
        return gene_clocks_fault_at(gene_clocks_wire_stamp, 0);
    }
    if (!gene_clocks_is_within(GENE_CLOCKS_BITS_OF(frame->energy), limits->energy)) {
        return gene_clocks_fault_at(gene_clocks_wire_energy, 0);
    }
    /* The header first in a place of its own: nothing is written before all is known to fit. */
    uint8_t header[gene_clocks_frame_overhead_bytes] = {0};
    struct gene_clocks_writer writer = {header, sizeof header, 0};
    gene_clocks_put_frame_header(&writer, frame);
    const size_t header_size = writer.size;
    const size_t around = header_size + gene_clocks_checksum_bytes;
    if (limits->frame_bytes < around || limits->frame_bytes - around < frame->payload_size) {
        return gene_clocks_fault_at(gene_clocks_wire_too_long, limits->frame_bytes);
    }
    *size = around + frame->payload_size;
    if (*size > capacity) return gene_clocks_fault_at(gene_clocks_wire_no_room, capacity);

    for (size_t i = 0; i < frame->payload_size; ++i) buffer[header_size + i] = frame->payload[i];
    for (size_t i = 0; i < header_size; ++i) buffer[i] = header[i];
    const size_t end = *size - gene_clocks_checksum_bytes;
    writer.bytes = buffer;
    writer.capacity = capacity;
    writer.size = end;
    gene_clocks_put_word(&writer, gene_clocks_crc32c(buffer, end));
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

#ifdef __cplusplus
} /* namespace gene_clocks::kernel */
#endif

#undef GENE_CLOCKS_FUNCTION
#undef GENE_CLOCKS_BITS_OF
#undef GENE_CLOCKS_FLOAT_OF

#endif /* GENE_CLOCKS_WIRE_H */
