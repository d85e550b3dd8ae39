/* Bytes of messages: numbers from them and into them, and what can be wrong with them
 * (docs/wire-format.md). Plain C99, which every C++ from 11 on takes too, inside or outside of
 * extern "C".
 *
 * No allocation, no I/O, no global state; no assumption on byte order or alignment. Every length is
 * checked before it is used. What is read may be anything at all.
 */
#ifndef GENE_CLOCKS_BYTES_H
#define GENE_CLOCKS_BYTES_H

#include <gene_clocks/language.h>
#include <stddef.h>
#include <stdint.h>

GENE_CLOCKS_BEGIN

/* ---- What can be wrong ---------------------------------------------------------------------- */

/* Why bytes are refused, or why something cannot be written. */
enum gene_clocks_wire_error {
    gene_clocks_wire_ok,
    gene_clocks_wire_truncated,      /* a field ends beyond the bytes */
    gene_clocks_wire_trailing,       /* bytes are left over */
    gene_clocks_wire_too_long,       /* more bytes than the limits allow */
    gene_clocks_wire_version,        /* not version 1 */
    gene_clocks_wire_not_shortest,   /* the same value has a shorter encoding */
    gene_clocks_wire_out_of_range,   /* a number has more bits than its field */
    gene_clocks_wire_checksum,       /* the bytes are not those that were sent */
    gene_clocks_wire_robot,          /* robot 0 is reserved for the initial genes */
    gene_clocks_wire_stamp,          /* no clock of this fleet has such a stamp */
    gene_clocks_wire_energy,         /* not finite, or beyond the limit */
    gene_clocks_wire_too_many_genes, /* more than the limits allow */
    gene_clocks_wire_gene_count,     /* not as many genes of a kind as announced */
    gene_clocks_wire_not_ascending,  /* a mark is not above the one before it */
    gene_clocks_wire_not_below,      /* a mark is not below the stamp */
    gene_clocks_wire_genesis, /* an initial gene outside the genesis marks, or another inside */
    gene_clocks_wire_kind,    /* inputs, one bias, outputs, then the rest */
    gene_clocks_wire_ends,    /* a connection without its neurons, or into an input */
    gene_clocks_wire_repeated_ends, /* two connections join the same neurons */
    gene_clocks_wire_weight,        /* not finite, or beyond the limit */
    gene_clocks_wire_no_room,       /* writing: the buffer is too small */
    gene_clocks_wire_form,          /* not a payload of this form */
    gene_clocks_wire_schema,        /* genes after another schema than the receiver's */
    gene_clocks_wire_attribute      /* a value that the schema does not admit */
};

/* What is wrong, and where: the first byte of the field or, where several fields do not go
 * together, of the gene. */
struct gene_clocks_fault {
    enum gene_clocks_wire_error error;
    size_t offset;
};

GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_fault_at(enum gene_clocks_wire_error error,
                                                                size_t offset) {
    struct gene_clocks_fault fault = {error, offset};
    return fault;
}

/* ---- Bytes ---------------------------------------------------------------------------------- */

/* Bytes to read. Invariant: offset <= size. Where reading fails, the offset stays. */
struct gene_clocks_reader {
    const uint8_t* bytes;
    size_t size;
    size_t offset;
};

/* Where to write. What does not fit is counted and not written, so that a writer without room
 * tells how much is needed. */
struct gene_clocks_writer {
    uint8_t* bytes;
    size_t capacity;
    size_t size; /* what was written, or would have been; an error if above capacity */
};

GENE_CLOCKS_PLAIN void gene_clocks_put_byte(struct gene_clocks_writer* writer, uint8_t byte) {
    if (writer->size < writer->capacity) writer->bytes[writer->size] = byte;
    ++writer->size;
}

/* Reads an unsigned LEB128 number of at most `bits` bits (16, 32 or 64) in its shortest form. */
GENE_CLOCKS_PLAIN enum gene_clocks_wire_error gene_clocks_get_varint(
    struct gene_clocks_reader* reader, unsigned bits, uint64_t* value) {
    size_t at = reader->offset;
    if (at < reader->size && reader->bytes[at] < 0x80u) { /* as most numbers are */
        *value = reader->bytes[at];
        reader->offset = at + 1;
        return gene_clocks_wire_ok;
    }
    uint64_t result = 0;
    for (unsigned shift = 0;; shift += 7) {
        if (at == reader->size) return gene_clocks_wire_truncated;
        const uint8_t byte = reader->bytes[at++];
        /* The last byte that fits has fewer than eight bits left, and none to go on. */
        if (bits - shift < 8 && byte >> (bits - shift) != 0) return gene_clocks_wire_out_of_range;
        result |= GENE_CLOCKS_CAST(uint64_t, byte & 0x7fu) << shift;
        if (byte < 0x80u) {
            if (byte == 0 && shift != 0) return gene_clocks_wire_not_shortest;
            break;
        }
    }
    reader->offset = at;
    *value = result;
    return gene_clocks_wire_ok;
}

GENE_CLOCKS_PLAIN void gene_clocks_put_varint(struct gene_clocks_writer* writer, uint64_t value) {
    for (; value >= 0x80u; value >>= 7) {
        gene_clocks_put_byte(writer, GENE_CLOCKS_CAST(uint8_t, 0x80u | (value & 0x7fu)));
    }
    gene_clocks_put_byte(writer, GENE_CLOCKS_CAST(uint8_t, value));
}

/* Four bytes, little-endian. Precondition: offset + 4 <= size. */
GENE_CLOCKS_PLAIN uint32_t gene_clocks_word_at(const uint8_t* bytes, size_t offset) {
    return GENE_CLOCKS_CAST(uint32_t, bytes[offset]) |
           GENE_CLOCKS_CAST(uint32_t, bytes[offset + 1]) << 8 |
           GENE_CLOCKS_CAST(uint32_t, bytes[offset + 2]) << 16 |
           GENE_CLOCKS_CAST(uint32_t, bytes[offset + 3]) << 24;
}

GENE_CLOCKS_PLAIN enum gene_clocks_wire_error gene_clocks_get_word(
    struct gene_clocks_reader* reader, uint32_t* value) {
    if (reader->size - reader->offset < 4) return gene_clocks_wire_truncated;
    *value = gene_clocks_word_at(reader->bytes, reader->offset);
    reader->offset += 4;
    return gene_clocks_wire_ok;
}

GENE_CLOCKS_PLAIN void gene_clocks_put_word(struct gene_clocks_writer* writer, uint32_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) {
        gene_clocks_put_byte(writer, GENE_CLOCKS_CAST(uint8_t, value >> shift & 0xffu));
    }
}

GENE_CLOCKS_END

#if defined(__cplusplus)
extern "C++" {
namespace gene_clocks {
namespace kernel {
using ::gene_clocks_fault;
using ::gene_clocks_fault_at;
using ::gene_clocks_get_varint;
using ::gene_clocks_get_word;
using ::gene_clocks_put_byte;
using ::gene_clocks_put_varint;
using ::gene_clocks_put_word;
using ::gene_clocks_reader;
using ::gene_clocks_wire_attribute;
using ::gene_clocks_wire_checksum;
using ::gene_clocks_wire_ends;
using ::gene_clocks_wire_energy;
using ::gene_clocks_wire_error;
using ::gene_clocks_wire_form;
using ::gene_clocks_wire_gene_count;
using ::gene_clocks_wire_genesis;
using ::gene_clocks_wire_kind;
using ::gene_clocks_wire_no_room;
using ::gene_clocks_wire_not_ascending;
using ::gene_clocks_wire_not_below;
using ::gene_clocks_wire_not_shortest;
using ::gene_clocks_wire_ok;
using ::gene_clocks_wire_out_of_range;
using ::gene_clocks_wire_repeated_ends;
using ::gene_clocks_wire_robot;
using ::gene_clocks_wire_schema;
using ::gene_clocks_wire_stamp;
using ::gene_clocks_wire_too_long;
using ::gene_clocks_wire_too_many_genes;
using ::gene_clocks_wire_trailing;
using ::gene_clocks_wire_truncated;
using ::gene_clocks_wire_version;
using ::gene_clocks_wire_weight;
using ::gene_clocks_word_at;
using ::gene_clocks_writer;
} /* namespace kernel */
} /* namespace gene_clocks */
}
#endif

#endif /* GENE_CLOCKS_BYTES_H */
