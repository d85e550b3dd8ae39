/* General genomes: what a gene is, and whether it may come next (docs/wire-format.md). Reader and
 * writer, in general_genome.h, share these checks, so that what can be written is exactly what can
 * be read. Plain C99, which every C++ from 11 on takes too.
 *
 * Values of attributes are 64 bits whatever their type (see gene_clocks_value_of_float32 and its
 * neighbours), so that a processor without floating point, or with another `double`, passes them
 * on unharmed.
 */
#ifndef GENE_CLOCKS_GENERAL_CHECKS_H
#define GENE_CLOCKS_GENERAL_CHECKS_H

#include <gene_clocks/bytes.h>
#include <gene_clocks/language.h>
#include <gene_clocks/schema.h>
#include <stddef.h>
#include <stdint.h>

GENE_CLOCKS_BEGIN

/* ---- Genes ---------------------------------------------------------------------------------- */

/* One end of a gene: `index` counts the genes of all classes before its own; counter and robot are
 * a mark. The schema says which of the two it is; the other is 0. */
struct gene_clocks_gene_end {
    uint64_t counter;
    uint32_t robot;
    uint32_t index;
};

/* A gene without its attributes, which stand beside it: one value for each of its class, in the
 * order of the schema. */
struct gene_clocks_general_gene {
    uint64_t counter; /* 0 in classes without marks */
    uint32_t robot;
    struct gene_clocks_gene_end source;
    struct gene_clocks_gene_end target;
};

/* Identity of a genome (the robot that made it, and a number that this robot gives to no other),
 * and how many genes of each class follow. */
struct gene_clocks_general_header {
    uint32_t robot;
    uint64_t birth;
    uint32_t counts[gene_clocks_classes_max];
};

/* The bits of floats; integers are their two's complement, flags and enumerations the number. */
GENE_CLOCKS_PLAIN uint64_t gene_clocks_value_of_integer(int64_t integer) {
    return GENE_CLOCKS_CAST(uint64_t, integer);
}
GENE_CLOCKS_PLAIN int64_t gene_clocks_integer_of_value(uint64_t value) {
    return GENE_CLOCKS_CAST(int64_t, value);
}
GENE_CLOCKS_COPIES void gene_clocks_copy_bytes(void* to, const void* from, size_t size) {
    unsigned char* const target = GENE_CLOCKS_CAST(unsigned char*, to);
    const unsigned char* const source = GENE_CLOCKS_CAST(const unsigned char*, from);
    for (size_t i = 0; i < size; ++i) target[i] = source[i];
}
GENE_CLOCKS_COPIES uint64_t gene_clocks_value_of_float32(float number) {
    uint32_t bits = 0;
    gene_clocks_copy_bytes(&bits, &number, sizeof bits);
    return bits;
}
GENE_CLOCKS_COPIES float gene_clocks_float32_of_value(uint64_t value) {
    const uint32_t bits = GENE_CLOCKS_CAST(uint32_t, value & UINT32_C(0xffffffff));
    float number = 0.0f;
    gene_clocks_copy_bytes(&number, &bits, sizeof number);
    return number;
}
#if !defined(__SIZEOF_DOUBLE__) || __SIZEOF_DOUBLE__ == 8
GENE_CLOCKS_COPIES uint64_t gene_clocks_value_of_float64(double number) {
    uint64_t bits = 0;
    gene_clocks_copy_bytes(&bits, &number, sizeof bits);
    return bits;
}
GENE_CLOCKS_COPIES double gene_clocks_float64_of_value(uint64_t value) {
    double number = 0.0;
    gene_clocks_copy_bytes(&number, &value, sizeof number);
    return number;
}
#endif

/* ---- The checks ----------------------------------------------------------------------------- */

/* Which part of a gene a fault is about. */
enum gene_clocks_gene_part {
    gene_clocks_part_mark,
    gene_clocks_part_source,
    gene_clocks_part_target,
    gene_clocks_part_attribute /* + its index */
};

/* A genome so far: what decides whether a gene may come next, and where a fault was found.
 *
 * Invariants: gene < genome.counts[gene_class], or gene_class == class_count; `before` is the sum
 * of counts[0 ... gene_class - 1]; last is the gene before in this class, zeros for its first. */
struct gene_clocks_general_checks {
    const struct gene_clocks_layout* layout;
    uint64_t stamp;
    struct gene_clocks_general_header genome;
    uint8_t gene_class; /* of the next gene; class_count where all are there */
    uint8_t part;       /* after a fault: enum gene_clocks_gene_part */
    uint32_t gene;      /* the next gene, counted in its class from 0 */
    uint32_t before;
    struct gene_clocks_general_gene last;
};

/* Goes on to the first class that has genes left. */
GENE_CLOCKS_PLAIN void gene_clocks_skip_classes(struct gene_clocks_general_checks* checks) {
    const struct gene_clocks_general_gene none = {0, 0, {0, 0, 0}, {0, 0, 0}};
    while (checks->gene_class < checks->layout->schema->class_count &&
           checks->gene == checks->genome.counts[checks->gene_class]) {
        checks->before += checks->gene;
        checks->gene = 0;
        checks->last = none;
        ++checks->gene_class;
    }
}

/* Begins to check a genome whose counts sum up to less than 2^32. */
GENE_CLOCKS_PLAIN void gene_clocks_start_general(struct gene_clocks_general_checks* checks,
                                                 const struct gene_clocks_layout* layout,
                                                 uint64_t stamp,
                                                 const struct gene_clocks_general_header* genome) {
    const struct gene_clocks_general_gene none = {0, 0, {0, 0, 0}, {0, 0, 0}};
    checks->layout = layout;
    checks->stamp = stamp;
    checks->genome = *genome;
    checks->gene_class = 0;
    checks->part = gene_clocks_part_mark;
    checks->gene = 0;
    checks->before = 0;
    checks->last = none;
    gene_clocks_skip_classes(checks);
}

GENE_CLOCKS_PLAIN bool gene_clocks_is_value(const struct gene_clocks_attribute* attribute,
                                            uint64_t value) {
    switch (attribute->type) {
        case gene_clocks_flag:
            return value <= 1;
        case gene_clocks_enumeration:
            return value < attribute->value_count;
        case gene_clocks_integer: {
            const int64_t integer = gene_clocks_integer_of_value(value);
            return attribute->minimum <= integer && integer <= attribute->maximum;
        }
        case gene_clocks_float32: /* IEEE 754 orders magnitudes as it orders their bits. */
            return value <= UINT32_C(0xffffffff) &&
                   (value & UINT32_C(0x7fffffff)) <= attribute->limit;
        case gene_clocks_float64:
            return (value & UINT64_C(0x7fffffffffffffff)) <= attribute->limit;
    }
    return false;
}

/* The first value that the schema does not admit, or `count`. */
GENE_CLOCKS_PLAIN uint8_t gene_clocks_find_bad_value(const struct gene_clocks_attribute* attributes,
                                                     uint8_t count, const uint64_t* values) {
    for (uint8_t i = 0; i < count; ++i) {
        if (!gene_clocks_is_value(&attributes[i], values[i])) return i;
    }
    return count;
}

GENE_CLOCKS_PLAIN int gene_clocks_compare_marks(uint64_t counter, uint32_t robot,
                                                uint64_t other_counter, uint32_t other_robot) {
    if (counter != other_counter) return counter < other_counter ? -1 : 1;
    return robot == other_robot ? 0 : robot < other_robot ? -1 : 1;
}

/* Whether a mark is one that a robot of this fleet made, as far as can be seen. */
GENE_CLOCKS_PLAIN bool gene_clocks_is_genesis_right(const struct gene_clocks_general_checks* checks,
                                                    uint64_t counter, uint32_t robot) {
    const bool is_genesis = counter <= checks->layout->schema->genesis_count;
    return counter > 0 && (robot == 0) == is_genesis;
}

GENE_CLOCKS_PLAIN bool gene_clocks_is_end(const struct gene_clocks_general_checks* checks,
                                          enum gene_clocks_ends_kind kind,
                                          struct gene_clocks_gene_end end) {
    if (kind == gene_clocks_ends_by_index) {
        return end.index < checks->before && end.counter == 0 && end.robot == 0;
    }
    if (kind == gene_clocks_no_ends) return end.index == 0 && end.counter == 0 && end.robot == 0;
    return end.index == 0 && end.counter < checks->stamp &&
           gene_clocks_is_genesis_right(checks, end.counter, end.robot);
}

/* Whether the ends of a gene lie above those of the gene before: source first, then target. */
GENE_CLOCKS_PLAIN bool gene_clocks_are_ends_above(const struct gene_clocks_general_checks* checks,
                                                  const struct gene_clocks_general_gene* gene) {
    const struct gene_clocks_general_gene* const last = &checks->last;
    if (checks->gene == 0) return true;
    if (gene->source.index != last->source.index) return gene->source.index > last->source.index;
    const int sources = gene_clocks_compare_marks(gene->source.counter, gene->source.robot,
                                                  last->source.counter, last->source.robot);
    if (sources != 0) return sources > 0;
    if (gene->target.index != last->target.index) return gene->target.index > last->target.index;
    return gene_clocks_compare_marks(gene->target.counter, gene->target.robot, last->target.counter,
                                     last->target.robot) > 0;
}

GENE_CLOCKS_PLAIN enum gene_clocks_wire_error gene_clocks_check_general_mark(
    const struct gene_clocks_general_checks* checks, const struct gene_clocks_general_gene* gene) {
    if (gene_clocks_compare_marks(checks->last.counter, checks->last.robot, gene->counter,
                                  gene->robot) >= 0) {
        return gene_clocks_wire_not_ascending;
    }
    if (gene->counter >= checks->stamp) return gene_clocks_wire_not_below;
    if (!gene_clocks_is_genesis_right(checks, gene->counter, gene->robot)) {
        return gene_clocks_wire_genesis;
    }
    return gene_clocks_wire_ok;
}

/* Takes a gene as the next one, or says why not; then nothing changes but `part`. */
GENE_CLOCKS_PLAIN enum gene_clocks_wire_error gene_clocks_add_general_gene(
    struct gene_clocks_general_checks* checks, const struct gene_clocks_general_gene* gene,
    const uint64_t* values) {
    const struct gene_clocks_schema* const schema = checks->layout->schema;
    checks->part = gene_clocks_part_mark;
    if (checks->gene_class == schema->class_count) return gene_clocks_wire_gene_count;
    const struct gene_clocks_gene_class* const gene_class = &schema->classes[checks->gene_class];
    if (gene_class->is_marked) {
        const enum gene_clocks_wire_error error = gene_clocks_check_general_mark(checks, gene);
        if (error) return error;
    } else if (gene->counter != 0 || gene->robot != 0) {
        return gene_clocks_wire_genesis; /* a writer's mistake: it would be lost */
    }
    checks->part = gene_clocks_part_source;
    if (!gene_clocks_is_end(checks, gene_class->ends, gene->source)) return gene_clocks_wire_ends;
    checks->part = gene_clocks_part_target;
    if (!gene_clocks_is_end(checks, gene_class->ends, gene->target)) return gene_clocks_wire_ends;
    if (!gene_class->is_marked && !gene_clocks_are_ends_above(checks, gene)) {
        checks->part = gene_clocks_part_source;
        return gene_clocks_wire_not_ascending;
    }
    const uint8_t bad =
        gene_clocks_find_bad_value(gene_class->attributes, gene_class->attribute_count, values);
    if (bad != gene_class->attribute_count) {
        checks->part = GENE_CLOCKS_CAST(uint8_t, gene_clocks_part_attribute + bad);
        return gene_clocks_wire_attribute;
    }
    checks->last = *gene;
    ++checks->gene;
    gene_clocks_skip_classes(checks);
    return gene_clocks_wire_ok;
}

GENE_CLOCKS_END

#endif /* GENE_CLOCKS_GENERAL_CHECKS_H */
