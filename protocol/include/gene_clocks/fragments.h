/* Messages in pieces, for links that carry no more than some 20 to 400 bytes at a time
 * (docs/wire-format.md, fragments). Plain C99, which every C++ from 11 on takes too.
 *
 * A sender splits a frame, sealed or not, into fragments; a receiver puts them together in memory
 * of its own, whose size it fixes, whoever sends. A message of which a fragment is lost is lost.
 *
 * No allocation, no I/O, no global state, no time.
 */
#ifndef GENE_CLOCKS_FRAGMENTS_H
#define GENE_CLOCKS_FRAGMENTS_H

#include <gene_clocks/bytes.h>
#include <gene_clocks/language.h>
#include <stddef.h>
#include <stdint.h>

GENE_CLOCKS_BEGIN

enum {
    gene_clocks_fragment_marker = 64, /* its first byte; no frame begins so */
    gene_clocks_fragments_max = 256,  /* of a message */
    gene_clocks_fragment_header_max = 1 + 5 + 3
};

/* ---- Sending -------------------------------------------------------------------------------- */

/* A message and how it is split. The message must outlive it. */
struct gene_clocks_split {
    const uint8_t* message;
    size_t size;
    size_t piece_bytes; /* of all pieces but the last, which may be shorter */
    uint32_t sender;
    uint8_t number;
    uint8_t last; /* index of the last fragment; 0 where the message goes whole, as it is */
};

/* The bytes before the piece in a fragment. */
GENE_CLOCKS_PLAIN size_t gene_clocks_fragment_header(uint32_t sender) {
    size_t size = 1 + 1 + 3;
    for (; sender >= 0x80u; sender >>= 7) ++size;
    return size;
}

/* Splits a message into fragments of at most `fragment_bytes`, as even as can be. `number` is one
 * more for each message of this sender, from any number on; 0 follows 255. Refused are sender 0
 * (robot), an empty message (truncated), one that begins like a fragment (form), and one that takes
 * more than 256 fragments (too_long). */
GENE_CLOCKS_PLAIN enum gene_clocks_wire_error gene_clocks_split_message(
    struct gene_clocks_split* split, const uint8_t* message, size_t size, uint32_t sender,
    uint8_t number, size_t fragment_bytes) {
    if (sender == 0) return gene_clocks_wire_robot;
    if (size == 0) return gene_clocks_wire_truncated;
    if (message[0] == gene_clocks_fragment_marker) return gene_clocks_wire_form;
    split->message = message;
    split->size = size;
    split->sender = sender;
    split->number = number;
    split->piece_bytes = size;
    split->last = 0;
    if (size <= fragment_bytes) return gene_clocks_wire_ok;
    const size_t header = gene_clocks_fragment_header(sender);
    if (fragment_bytes <= header) return gene_clocks_wire_too_long;
    const size_t room = fragment_bytes - header;
    const size_t count = size / room + (size % room != 0 ? 1 : 0);
    if (count > gene_clocks_fragments_max) return gene_clocks_wire_too_long;
    split->piece_bytes = size / count + (size % count != 0 ? 1 : 0);
    split->last = GENE_CLOCKS_CAST(uint8_t, (size - 1) / split->piece_bytes);
    return gene_clocks_wire_ok;
}

/* Writes fragment `index`, 0 to split->last, and returns its size. `buffer` has room for the bytes
 * that the message was split for. */
GENE_CLOCKS_PLAIN size_t gene_clocks_put_fragment(const struct gene_clocks_split* split,
                                                  uint8_t index, uint8_t* buffer) {
    const size_t begin = index * split->piece_bytes;
    const size_t left = split->size - begin;
    const size_t count = left < split->piece_bytes ? left : split->piece_bytes;
    struct gene_clocks_writer writer = {buffer, gene_clocks_fragment_header_max + count, 0};
    if (split->last > 0) {
        gene_clocks_put_byte(&writer, gene_clocks_fragment_marker);
        gene_clocks_put_varint(&writer, split->sender);
        gene_clocks_put_byte(&writer, split->number);
        gene_clocks_put_byte(&writer, split->last);
        gene_clocks_put_byte(&writer, index);
    }
    for (size_t i = 0; i < count; ++i) gene_clocks_put_byte(&writer, split->message[begin + i]);
    return writer.size;
}

/* ---- Receiving ------------------------------------------------------------------------------ */

enum gene_clocks_assembly_state {
    gene_clocks_assembly_unused,
    gene_clocks_assembly_begun,
    gene_clocks_assembly_whole /* kept, so that fragments that are repeated are known */
};

/* A message of one sender, as far as it is there.
 *
 * Invariants where begun: of the pieces 0 ... last, those whose bit is set in `arrived` have
 * arrived, and `missing` have not; piece_bytes is 0 until one before the last has arrived, and
 * last_bytes until the last one has. Pieces lie in their place, but the last one lies at the end of
 * the memory until the message is whole. last * piece_bytes + last_bytes fits into the memory. */
struct gene_clocks_assembly {
    size_t piece_bytes;
    size_t last_bytes;
    uint32_t sender;
    uint32_t touched; /* on the assembler's count of fragments */
    uint16_t missing;
    uint8_t state; /* enum gene_clocks_assembly_state */
    uint8_t number;
    uint8_t last;
    uint8_t arrived[gene_clocks_fragments_max / 8];
};

/* Puts messages together: one at a time for each sender, `count` at a time in all. The caller gives
 * `count` assemblies, zeroed, and count * message_bytes of memory. */
struct gene_clocks_assembler {
    struct gene_clocks_assembly* assemblies;
    uint8_t* memory;
    size_t message_bytes; /* the longest message */
    size_t count;
    uint32_t fragments; /* so many were looked at */
};

/* What became of a fragment. */
enum gene_clocks_fragment_outcome {
    gene_clocks_fragment_kept,      /* the message is not whole yet */
    gene_clocks_fragment_completes, /* the message is whole, and was not before */
    gene_clocks_fragment_repeated,  /* it is there already */
    gene_clocks_fragment_late,      /* the sender has gone on to another message */
    gene_clocks_fragment_malformed, /* it is no fragment that anyone splits off */
    gene_clocks_fragment_too_long   /* the message is longer than the memory for it */
};

/* A fragment that was read; the piece lies within its bytes. */
struct gene_clocks_fragment {
    const uint8_t* piece;
    size_t piece_bytes;
    uint32_t sender;
    uint8_t number;
    uint8_t last;
    uint8_t index;
};

/* Reads a fragment; false where it is none. */
GENE_CLOCKS_PLAIN bool gene_clocks_read_fragment(const uint8_t* bytes, size_t size,
                                                 struct gene_clocks_fragment* fragment) {
    struct gene_clocks_reader reader = {bytes, size, 1};
    uint64_t sender = 0;
    if (size == 0 || bytes[0] != gene_clocks_fragment_marker) return false;
    if (gene_clocks_get_varint(&reader, 32, &sender) || sender == 0) return false;
    if (size - reader.offset < 4) return false; /* and a piece of at least one byte */
    fragment->sender = GENE_CLOCKS_CAST(uint32_t, sender);
    fragment->number = bytes[reader.offset];
    fragment->last = bytes[reader.offset + 1];
    fragment->index = bytes[reader.offset + 2];
    fragment->piece = bytes + reader.offset + 3;
    fragment->piece_bytes = size - reader.offset - 3;
    return fragment->last > 0 && fragment->index <= fragment->last;
}

GENE_CLOCKS_PLAIN bool gene_clocks_has_arrived(const struct gene_clocks_assembly* assembly,
                                               uint8_t index) {
    return (assembly->arrived[index / 8] >> index % 8 & 1) != 0;
}

/* Begins a message anew. */
GENE_CLOCKS_PLAIN void gene_clocks_begin_assembly(struct gene_clocks_assembly* assembly,
                                                  const struct gene_clocks_fragment* fragment) {
    assembly->piece_bytes = 0;
    assembly->last_bytes = 0;
    assembly->sender = fragment->sender;
    assembly->missing = GENE_CLOCKS_CAST(uint16_t, fragment->last + 1);
    assembly->state = gene_clocks_assembly_begun;
    assembly->number = fragment->number;
    assembly->last = fragment->last;
    for (size_t i = 0; i < sizeof assembly->arrived; ++i) assembly->arrived[i] = 0;
}

/* The sender's assembly, or the one that can be spared most: an unused one, then the whole one that
 * was touched longest ago, then any. Precondition: count > 0. */
GENE_CLOCKS_PLAIN struct gene_clocks_assembly* gene_clocks_find_assembly(
    const struct gene_clocks_assembler* assembler, uint32_t sender) {
    struct gene_clocks_assembly* spared = assembler->assemblies;
    for (size_t i = 0; i < assembler->count; ++i) {
        struct gene_clocks_assembly* const one = &assembler->assemblies[i];
        if (one->state != gene_clocks_assembly_unused && one->sender == sender) return one;
        const bool is_begun = one->state == gene_clocks_assembly_begun;
        const bool is_spared_begun = spared->state == gene_clocks_assembly_begun;
        const uint32_t age = assembler->fragments - one->touched;
        const uint32_t spared_age = assembler->fragments - spared->touched;
        if (spared->state == gene_clocks_assembly_unused) continue;
        if (one->state == gene_clocks_assembly_unused || is_begun < is_spared_begun ||
            (is_begun == is_spared_begun && age > spared_age)) {
            spared = one;
        }
    }
    return spared;
}

/* Where a piece lies, or is to lie. */
GENE_CLOCKS_PLAIN uint8_t* gene_clocks_place_of_piece(const struct gene_clocks_assembler* assembler,
                                                      const struct gene_clocks_assembly* assembly,
                                                      uint8_t index) {
    uint8_t* const memory =
        assembler->memory +
        GENE_CLOCKS_CAST(size_t, assembly - assembler->assemblies) * assembler->message_bytes;
    if (index == assembly->last && assembly->state != gene_clocks_assembly_whole) {
        return memory + (assembler->message_bytes - assembly->last_bytes);
    }
    return memory + index * assembly->piece_bytes;
}

/* Whether a fragment may be of the message that was begun: of the same length and pieces and, where
 * it has arrived already, the same. Else the sender began anew with the number, or something was
 * damaged. */
GENE_CLOCKS_PLAIN bool gene_clocks_is_of_assembly(const struct gene_clocks_assembler* assembler,
                                                  const struct gene_clocks_assembly* assembly,
                                                  const struct gene_clocks_fragment* fragment) {
    const bool is_last = fragment->index == fragment->last;
    if (fragment->last != assembly->last) return false;
    const size_t known = is_last ? assembly->last_bytes : assembly->piece_bytes;
    if (known != 0 && fragment->piece_bytes != known) return false;
    if (is_last && assembly->piece_bytes != 0 && fragment->piece_bytes > assembly->piece_bytes) {
        return false;
    }
    if (!is_last && fragment->piece_bytes < assembly->last_bytes) return false;
    if (!gene_clocks_has_arrived(assembly, fragment->index)) return true;
    const uint8_t* const piece = gene_clocks_place_of_piece(assembler, assembly, fragment->index);
    for (size_t i = 0; i < fragment->piece_bytes; ++i) {
        if (piece[i] != fragment->piece[i]) return false;
    }
    return true;
}

/* Whether the message, as far as it is known with this fragment, fits into the memory. */
GENE_CLOCKS_PLAIN bool gene_clocks_fits_assembly(const struct gene_clocks_assembler* assembler,
                                                 const struct gene_clocks_assembly* assembly,
                                                 const struct gene_clocks_fragment* fragment) {
    const bool is_last = fragment->index == fragment->last;
    const size_t pieces = is_last ? assembly->piece_bytes : fragment->piece_bytes;
    size_t last = is_last ? fragment->piece_bytes : assembly->last_bytes;
    if (last == 0) last = 1;
    if (last > assembler->message_bytes) return false;
    return pieces <= (assembler->message_bytes - last) / fragment->last;
}

/* Takes what came off a link: a fragment, or a message that came whole. Where the outcome is
 * gene_clocks_fragment_completes, the message is told; it lies in the memory (or in `bytes`, where
 * it came whole) until the next call. Nothing is said of what is in it: its checksum tells whether
 * it was put together right. */
GENE_CLOCKS_PLAIN enum gene_clocks_fragment_outcome gene_clocks_take_fragment(
    struct gene_clocks_assembler* assembler, const uint8_t* bytes, size_t size,
    const uint8_t** message, size_t* message_size) {
    struct gene_clocks_fragment fragment = {GENE_CLOCKS_NULL, 0, 0, 0, 0, 0};
    if (size > 0 && bytes[0] != gene_clocks_fragment_marker) {
        if (size > assembler->message_bytes) return gene_clocks_fragment_too_long;
        *message = bytes;
        *message_size = size;
        return gene_clocks_fragment_completes;
    }
    if (!gene_clocks_read_fragment(bytes, size, &fragment)) return gene_clocks_fragment_malformed;
    ++assembler->fragments;
    struct gene_clocks_assembly* const assembly =
        gene_clocks_find_assembly(assembler, fragment.sender);
    const bool is_known =
        assembly->state != gene_clocks_assembly_unused && assembly->sender == fragment.sender;
    const uint8_t behind = GENE_CLOCKS_CAST(uint8_t, assembly->number - fragment.number);
    /* A few behind is late. More than that is a sender that counts anew. */
    if (is_known && behind >= 1 && behind <= 8) return gene_clocks_fragment_late;
    if (!is_known || behind != 0 || !gene_clocks_is_of_assembly(assembler, assembly, &fragment)) {
        gene_clocks_begin_assembly(assembly, &fragment);
    }
    assembly->touched = assembler->fragments;
    if (gene_clocks_has_arrived(assembly, fragment.index)) return gene_clocks_fragment_repeated;
    if (!gene_clocks_fits_assembly(assembler, assembly, &fragment)) {
        assembly->state = gene_clocks_assembly_unused;
        return gene_clocks_fragment_too_long;
    }
    *(fragment.index == fragment.last ? &assembly->last_bytes : &assembly->piece_bytes) =
        fragment.piece_bytes;
    uint8_t* const piece = gene_clocks_place_of_piece(assembler, assembly, fragment.index);
    for (size_t i = 0; i < fragment.piece_bytes; ++i) piece[i] = fragment.piece[i];
    assembly->arrived[fragment.index / 8] =
        GENE_CLOCKS_CAST(uint8_t, assembly->arrived[fragment.index / 8] | 1u << fragment.index % 8);
    if (--assembly->missing > 0) return gene_clocks_fragment_kept;

    const uint8_t* const last = gene_clocks_place_of_piece(assembler, assembly, fragment.last);
    assembly->state = gene_clocks_assembly_whole;
    uint8_t* const place = gene_clocks_place_of_piece(assembler, assembly, fragment.last);
    for (size_t i = 0; i < assembly->last_bytes; ++i) place[i] = last[i]; /* from front to back */
    *message = gene_clocks_place_of_piece(assembler, assembly, 0);
    *message_size = fragment.last * assembly->piece_bytes + assembly->last_bytes;
    return gene_clocks_fragment_completes;
}

GENE_CLOCKS_END

#endif /* GENE_CLOCKS_FRAGMENTS_H */
