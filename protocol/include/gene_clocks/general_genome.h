/* Genomes of any NEAT in a frame's payload, after the schema that a fleet agrees on
 * (docs/wire-format.md, general genomes). Plain C99, which every C++ from 11 on takes too.
 *
 * A payload has the genes class by class, each class in the order of its marks (or of its ends), so
 * that all is checked gene by gene, without memory.
 *
 * No allocation, no I/O, no global state, no floating-point arithmetic.
 */
#ifndef GENE_CLOCKS_GENERAL_GENOME_H
#define GENE_CLOCKS_GENERAL_GENOME_H

#include <gene_clocks/bytes.h>
#include <gene_clocks/general_checks.h>
#include <gene_clocks/language.h>
#include <gene_clocks/schema.h>
#include <stddef.h>
#include <stdint.h>

GENE_CLOCKS_BEGIN

/* ---- Reading -------------------------------------------------------------------------------- */

struct gene_clocks_general_reader {
    struct gene_clocks_reader bytes;
    struct gene_clocks_general_checks checks;
};

/* The first byte of a general genome; no genome of version 1 begins with it. */
enum { gene_clocks_general_marker = 0 };

/* So many bytes as a number, lowest first. Precondition: they are there. */
GENE_CLOCKS_PLAIN uint64_t gene_clocks_take_number(struct gene_clocks_reader* reader,
                                                   unsigned count) {
    uint64_t number = 0;
    for (unsigned i = 0; i < count; ++i) {
        number |= GENE_CLOCKS_CAST(uint64_t, reader->bytes[reader->offset + i]) << 8 * i;
    }
    reader->offset += count;
    return number;
}

/* Reads flags and enumerations off the low bits of `bits`, and the other attributes. */
GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_get_values(
    struct gene_clocks_reader* reader, const struct gene_clocks_attribute* attributes,
    uint8_t count, uint64_t bits, uint64_t* values) {
    for (uint8_t i = 0; i < count; ++i) {
        const struct gene_clocks_attribute* const attribute = &attributes[i];
        const size_t at = reader->offset;
        if (attribute->type == gene_clocks_flag || attribute->type == gene_clocks_enumeration) {
            const unsigned width = attribute->type == gene_clocks_flag
                                       ? 1u
                                       : gene_clocks_bits_for(attribute->value_count);
            values[i] = bits & ((UINT64_C(1) << width) - 1);
            bits >>= width;
        } else if (attribute->type == gene_clocks_integer) {
            uint64_t zigzag = 0;
            const enum gene_clocks_wire_error error = gene_clocks_get_varint(reader, 64, &zigzag);
            if (error) return gene_clocks_fault_at(error, at);
            values[i] = gene_clocks_value_of_integer(gene_clocks_unzigzag(zigzag));
        } else {
            const unsigned width = attribute->type == gene_clocks_float32 ? 4 : 8;
            if (reader->size - at < width) {
                return gene_clocks_fault_at(gene_clocks_wire_truncated, at);
            }
            values[i] = gene_clocks_take_number(reader, width);
        }
    }
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Reads identity and counts. */
GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_get_general_header(
    struct gene_clocks_reader* reader, const struct gene_clocks_layout* layout, uint32_t genes_max,
    struct gene_clocks_general_header* header) {
    uint64_t number = 0;
    size_t at = reader->offset;
    enum gene_clocks_wire_error error = gene_clocks_get_varint(reader, 32, &number);
    if (!error && number == 0) error = gene_clocks_wire_robot;
    if (error) return gene_clocks_fault_at(error, at);
    header->robot = GENE_CLOCKS_CAST(uint32_t, number);
    at = reader->offset;
    error = gene_clocks_get_varint(reader, 64, &header->birth);
    if (error) return gene_clocks_fault_at(error, at);
    uint32_t left = genes_max;
    for (uint8_t i = 0; i < layout->schema->class_count; ++i) {
        at = reader->offset;
        error = gene_clocks_get_varint(reader, 32, &number);
        if (!error && number > left) error = gene_clocks_wire_too_many_genes;
        if (error) return gene_clocks_fault_at(error, at);
        header->counts[i] = GENE_CLOCKS_CAST(uint32_t, number);
        left -= header->counts[i];
    }
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* The fewest bytes that attributes and genes with these counts take. */
GENE_CLOCKS_PLAIN uint64_t gene_clocks_general_bytes_min(
    const struct gene_clocks_layout* layout, const struct gene_clocks_general_header* header) {
    uint64_t bytes = layout->genome.bytes_min;
    for (uint8_t i = 0; i < layout->schema->class_count; ++i) {
        bytes += GENE_CLOCKS_CAST(uint64_t, header->counts[i]) * layout->classes[i].bytes_min;
    }
    return bytes;
}

/* Begins to read a payload: its identity and counts, which are then in reader->checks.genome and
 * are not more than the bytes can hold, and the genome's own attributes, for which `values` has
 * room. `stamp` is that of the frame. `bytes` and `layout` must outlive the reader. */
GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_open_general(
    struct gene_clocks_general_reader* reader, const uint8_t* bytes, size_t size, uint64_t stamp,
    const struct gene_clocks_layout* layout, uint32_t genes_max, uint64_t* values) {
    const struct gene_clocks_schema* const schema = layout->schema;
    struct gene_clocks_reader in = {bytes, size, 0};
    uint32_t fingerprint = 0;
    struct gene_clocks_general_header header = {0, 0, {0, 0, 0, 0, 0, 0, 0, 0}};
    gene_clocks_start_general(&reader->checks, layout, stamp, &header);
    if (size == 0) return gene_clocks_fault_at(gene_clocks_wire_truncated, 0);
    if (bytes[0] != gene_clocks_general_marker)
        return gene_clocks_fault_at(gene_clocks_wire_form, 0);
    in.offset = 1;
    enum gene_clocks_wire_error error = gene_clocks_get_word(&in, &fingerprint);
    if (!error && fingerprint != layout->fingerprint) error = gene_clocks_wire_schema;
    if (error) return gene_clocks_fault_at(error, 1);
    struct gene_clocks_fault fault =
        gene_clocks_get_general_header(&in, layout, genes_max, &header);
    if (fault.error) return fault;
    if (gene_clocks_general_bytes_min(layout, &header) > size - in.offset) {
        return gene_clocks_fault_at(gene_clocks_wire_truncated, size);
    }
    const size_t start = in.offset;
    const uint64_t bits = gene_clocks_take_number(&in, layout->genome.head_bytes);
    if (bits >> layout->genome.bits != 0) {
        return gene_clocks_fault_at(gene_clocks_wire_out_of_range, start);
    }
    fault = gene_clocks_get_values(&in, schema->attributes, schema->attribute_count, bits, values);
    if (fault.error) return fault;
    const uint8_t bad =
        gene_clocks_find_bad_value(schema->attributes, schema->attribute_count, values);
    if (bad != schema->attribute_count) {
        reader->checks.part = GENE_CLOCKS_CAST(uint8_t, gene_clocks_part_attribute + bad);
        return gene_clocks_fault_at(gene_clocks_wire_attribute, start);
    }
    reader->bytes = in;
    gene_clocks_start_general(&reader->checks, layout, stamp, &header);
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Whether genes are still to be read or written; reader->checks.gene_class is then their class. */
GENE_CLOCKS_PLAIN bool gene_clocks_are_genes_left(const struct gene_clocks_general_checks* checks) {
    return checks->gene_class < checks->layout->schema->class_count;
}

/* Reads the mark of the gene that begins at `start`, whose head without flags and enumerations is
 * `head`: whether a robot follows, then how far the counter leaps. */
GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_get_general_mark(
    struct gene_clocks_general_reader* reader, size_t start, uint64_t head, bool has_robot,
    uint8_t leap_bits, struct gene_clocks_general_gene* gene) {
    const struct gene_clocks_general_gene* const last = &reader->checks.last;
    uint64_t more = 0;
    if (head == (UINT64_C(1) << leap_bits) - 1) {
        const size_t at = reader->bytes.offset;
        const enum gene_clocks_wire_error error = gene_clocks_get_varint(&reader->bytes, 64, &more);
        if (error) return gene_clocks_fault_at(error, at);
    }
    /* Before the sum, which may have more than 64 bits. The stamp is not 0: the frame's reader saw
     * to it, and where no frame did, no counter is below it. */
    const uint64_t below = reader->checks.stamp == 0 ? 0 : reader->checks.stamp - 1;
    const uint64_t room = below < last->counter ? 0 : below - last->counter;
    if (more > room || head > room - more) {
        return gene_clocks_fault_at(gene_clocks_wire_not_below, start);
    }
    gene->counter = last->counter + head + more;
    gene->robot = last->robot;
    if (has_robot) {
        const size_t at = reader->bytes.offset;
        uint64_t robot = 0;
        enum gene_clocks_wire_error error = gene_clocks_get_varint(&reader->bytes, 32, &robot);
        if (!error && robot == last->robot) error = gene_clocks_wire_not_shortest;
        if (error) return gene_clocks_fault_at(error, at);
        gene->robot = GENE_CLOCKS_CAST(uint32_t, robot);
    }
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_get_end(struct gene_clocks_reader* reader,
                                                               enum gene_clocks_ends_kind kind,
                                                               struct gene_clocks_gene_end* end) {
    uint64_t number = 0;
    size_t at = reader->offset;
    if (kind == gene_clocks_no_ends) return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
    if (kind == gene_clocks_ends_by_mark) {
        const enum gene_clocks_wire_error error = gene_clocks_get_varint(reader, 64, &end->counter);
        if (error) return gene_clocks_fault_at(error, at);
        at = reader->offset;
    }
    const enum gene_clocks_wire_error error = gene_clocks_get_varint(reader, 32, &number);
    if (error) return gene_clocks_fault_at(error, at);
    *(kind == gene_clocks_ends_by_mark ? &end->robot : &end->index) =
        GENE_CLOCKS_CAST(uint32_t, number);
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Reads the next gene, of class reader->checks.gene_class, and checks that it may come there;
 * `values` has room for the attributes of its class. Precondition: genes are left, and none was
 * refused. */
GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_next_general_gene(
    struct gene_clocks_general_reader* reader, struct gene_clocks_general_gene* gene,
    uint64_t* values) {
    const struct gene_clocks_layout* const layout = reader->checks.layout;
    const struct gene_clocks_class_layout* const form = &layout->classes[reader->checks.gene_class];
    const struct gene_clocks_gene_class* const gene_class =
        &layout->schema->classes[reader->checks.gene_class];
    struct gene_clocks_general_gene read = {0, 0, {0, 0, 0}, {0, 0, 0}};
    const size_t start = reader->bytes.offset;
    reader->checks.part = gene_clocks_part_mark;
    if (reader->bytes.size - start < form->head_bytes) {
        return gene_clocks_fault_at(gene_clocks_wire_truncated, start);
    }
    uint64_t bits = gene_clocks_take_number(&reader->bytes, form->head_bytes);
    struct gene_clocks_fault fault = gene_clocks_fault_at(gene_clocks_wire_ok, 0);
    if (gene_class->is_marked) {
        const bool has_robot = (bits & 1u) != 0;
        bits >>= 1;
        fault = gene_clocks_get_general_mark(reader, start, bits >> form->bits, has_robot,
                                             form->leap_bits, &read);
    } else if (bits >> form->bits != 0) {
        fault = gene_clocks_fault_at(gene_clocks_wire_out_of_range, start);
    }
    if (fault.error) return fault;
    reader->checks.part = gene_clocks_part_source;
    fault = gene_clocks_get_end(&reader->bytes, gene_class->ends, &read.source);
    if (fault.error) return fault;
    reader->checks.part = gene_clocks_part_target;
    fault = gene_clocks_get_end(&reader->bytes, gene_class->ends, &read.target);
    if (fault.error) return fault;
    reader->checks.part = gene_clocks_part_attribute;
    fault = gene_clocks_get_values(&reader->bytes, gene_class->attributes,
                                   gene_class->attribute_count, bits, values);
    if (fault.error) return fault;
    const enum gene_clocks_wire_error error =
        gene_clocks_add_general_gene(&reader->checks, &read, values);
    if (error) return gene_clocks_fault_at(error, start);
    *gene = read;
    return fault;
}

/* Ends the reading, after all genes. */
GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_close_general(
    const struct gene_clocks_general_reader* reader) {
    if (gene_clocks_are_genes_left(&reader->checks)) {
        return gene_clocks_fault_at(gene_clocks_wire_gene_count, reader->bytes.offset);
    }
    if (reader->bytes.offset != reader->bytes.size) {
        return gene_clocks_fault_at(gene_clocks_wire_trailing, reader->bytes.offset);
    }
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* ---- Writing -------------------------------------------------------------------------------- */

struct gene_clocks_general_writer {
    struct gene_clocks_writer bytes;
    struct gene_clocks_general_checks checks;
};

/* So many bytes of a number, lowest first. */
GENE_CLOCKS_PLAIN void gene_clocks_put_number(struct gene_clocks_writer* writer, uint64_t number,
                                              unsigned count) {
    for (; count > 0; --count, number >>= 8) {
        gene_clocks_put_byte(writer, GENE_CLOCKS_CAST(uint8_t, number & 0xffu));
    }
}

/* Flags and enumerations, the first one lowest. */
GENE_CLOCKS_PLAIN uint64_t gene_clocks_bits_of_values(
    const struct gene_clocks_attribute* attributes, uint8_t count, const uint64_t* values) {
    uint64_t bits = 0;
    unsigned at = 0;
    for (uint8_t i = 0; i < count; ++i) {
        if (attributes[i].type == gene_clocks_flag) {
            bits |= values[i] << at;
            at += 1;
        } else if (attributes[i].type == gene_clocks_enumeration) {
            bits |= values[i] << at;
            at += gene_clocks_bits_for(attributes[i].value_count);
        }
    }
    return bits;
}

GENE_CLOCKS_PLAIN void gene_clocks_put_values(struct gene_clocks_writer* writer,
                                              const struct gene_clocks_attribute* attributes,
                                              uint8_t count, const uint64_t* values) {
    for (uint8_t i = 0; i < count; ++i) {
        if (attributes[i].type == gene_clocks_integer) {
            gene_clocks_put_varint(writer,
                                   gene_clocks_zigzag(gene_clocks_integer_of_value(values[i])));
        } else if (attributes[i].type == gene_clocks_float32) {
            gene_clocks_put_number(writer, values[i], 4);
        } else if (attributes[i].type == gene_clocks_float64) {
            gene_clocks_put_number(writer, values[i], 8);
        }
    }
}

/* Begins to write a genome with this identity, these counts and these values of its own attributes,
 * to travel with `stamp`. With a capacity of 0, where `buffer` may be null, the size is found. */
GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_begin_general(
    struct gene_clocks_general_writer* writer, uint8_t* buffer, size_t capacity,
    const struct gene_clocks_general_header* genome, const uint64_t* values, uint64_t stamp,
    const struct gene_clocks_layout* layout, uint32_t genes_max) {
    const struct gene_clocks_schema* const schema = layout->schema;
    const struct gene_clocks_writer bytes = {buffer, capacity, 0};
    const struct gene_clocks_general_header empty = {0, 0, {0, 0, 0, 0, 0, 0, 0, 0}};
    gene_clocks_start_general(&writer->checks, layout, stamp, &empty);
    if (genome->robot == 0) return gene_clocks_fault_at(gene_clocks_wire_robot, 0);
    uint32_t left = genes_max;
    for (uint8_t i = 0; i < schema->class_count; ++i) {
        if (genome->counts[i] > left) {
            return gene_clocks_fault_at(gene_clocks_wire_too_many_genes, 0);
        }
        left -= genome->counts[i];
    }
    const uint8_t bad =
        gene_clocks_find_bad_value(schema->attributes, schema->attribute_count, values);
    if (bad != schema->attribute_count) {
        writer->checks.part = GENE_CLOCKS_CAST(uint8_t, gene_clocks_part_attribute + bad);
        return gene_clocks_fault_at(gene_clocks_wire_attribute, 0);
    }
    writer->bytes = bytes;
    gene_clocks_put_byte(&writer->bytes, gene_clocks_general_marker);
    gene_clocks_put_word(&writer->bytes, layout->fingerprint);
    gene_clocks_put_varint(&writer->bytes, genome->robot);
    gene_clocks_put_varint(&writer->bytes, genome->birth);
    for (uint8_t i = 0; i < schema->class_count; ++i) {
        gene_clocks_put_varint(&writer->bytes, genome->counts[i]);
    }
    gene_clocks_put_number(
        &writer->bytes,
        gene_clocks_bits_of_values(schema->attributes, schema->attribute_count, values),
        layout->genome.head_bytes);
    gene_clocks_put_values(&writer->bytes, schema->attributes, schema->attribute_count, values);
    gene_clocks_start_general(&writer->checks, layout, stamp, genome);
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

GENE_CLOCKS_PLAIN void gene_clocks_put_end(struct gene_clocks_writer* writer,
                                           enum gene_clocks_ends_kind kind,
                                           struct gene_clocks_gene_end end) {
    if (kind == gene_clocks_ends_by_index) gene_clocks_put_varint(writer, end.index);
    if (kind == gene_clocks_ends_by_mark) {
        gene_clocks_put_varint(writer, end.counter);
        gene_clocks_put_varint(writer, end.robot);
    }
}

/* Writes the next gene, of class writer->checks.gene_class. Where it may not come there, nothing
 * changes but writer->checks.part. */
GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_put_general_gene(
    struct gene_clocks_general_writer* writer, const struct gene_clocks_general_gene* gene,
    const uint64_t* values) {
    const uint8_t index = writer->checks.gene_class;
    const struct gene_clocks_general_gene last = writer->checks.last;
    const enum gene_clocks_wire_error error =
        gene_clocks_add_general_gene(&writer->checks, gene, values);
    if (error) return gene_clocks_fault_at(error, writer->bytes.size);

    const struct gene_clocks_class_layout* const form = &writer->checks.layout->classes[index];
    const struct gene_clocks_gene_class* const gene_class =
        &writer->checks.layout->schema->classes[index];
    struct gene_clocks_writer* const bytes = &writer->bytes;
    uint64_t head =
        gene_clocks_bits_of_values(gene_class->attributes, gene_class->attribute_count, values);
    if (gene_class->is_marked) {
        const uint64_t far = (UINT64_C(1) << form->leap_bits) - 1;
        const uint64_t leap = gene->counter - last.counter;
        const bool has_robot = gene->robot != last.robot;
        head = (head | (leap < far ? leap : far) << form->bits) << 1 | (has_robot ? 1u : 0u);
        gene_clocks_put_number(bytes, head, form->head_bytes);
        if (leap >= far) gene_clocks_put_varint(bytes, leap - far);
        if (has_robot) gene_clocks_put_varint(bytes, gene->robot);
    } else {
        gene_clocks_put_number(bytes, head, form->head_bytes);
    }
    gene_clocks_put_end(bytes, gene_class->ends, gene->source);
    gene_clocks_put_end(bytes, gene_class->ends, gene->target);
    gene_clocks_put_values(bytes, gene_class->attributes, gene_class->attribute_count, values);
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Ends the writing; the payload is the first writer->bytes.size bytes of the buffer. */
GENE_CLOCKS_PLAIN struct gene_clocks_fault gene_clocks_end_general(
    const struct gene_clocks_general_writer* writer) {
    enum gene_clocks_wire_error error = gene_clocks_wire_ok;
    if (gene_clocks_are_genes_left(&writer->checks)) error = gene_clocks_wire_gene_count;
    if (!error && writer->bytes.size > writer->bytes.capacity) error = gene_clocks_wire_no_room;
    return gene_clocks_fault_at(error, error ? writer->bytes.size : 0);
}

GENE_CLOCKS_END

#endif /* GENE_CLOCKS_GENERAL_GENOME_H */
