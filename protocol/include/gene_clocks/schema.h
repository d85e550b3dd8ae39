/* What the genes of a fleet have in them (docs/wire-format.md, general genomes): a schema that all
 * its members agree on once. Plain C99, which every C++ from 11 on takes too.
 *
 * A schema is constant data of the program. gene_clocks_lay_out() checks it and works out, once,
 * what reading and writing need; the fingerprint that comes of it goes with every genome, so that
 * members with different schemas do not misread one another.
 *
 * No allocation, no I/O, no global state, no floating-point arithmetic.
 */
#ifndef GENE_CLOCKS_SCHEMA_H
#define GENE_CLOCKS_SCHEMA_H

#include <gene_clocks/bytes.h>
#include <gene_clocks/language.h>
#include <stddef.h>
#include <stdint.h>

GENE_CLOCKS_BEGIN

/* ---- Description ---------------------------------------------------------------------------- */

enum gene_clocks_attribute_type {
    gene_clocks_flag,        /* 0 or 1; takes one bit */
    gene_clocks_enumeration, /* one of 2 to 256 named values, counted from 0; takes the bits it
                                needs */
    gene_clocks_integer,     /* within bounds; the nearer to 0, the shorter */
    gene_clocks_float32,
    gene_clocks_float64
};

/* How a gene names the two genes that it joins. */
enum gene_clocks_ends_kind {
    gene_clocks_no_ends,
    gene_clocks_ends_by_index, /* among the genes of all classes before, counted from 0 */
    gene_clocks_ends_by_mark   /* of genes that need not be in this genome */
};

/* Best made with the macros below. Every name is 1 to 63 characters of printable ASCII without
 * spaces. */
struct gene_clocks_attribute {
    const char* name;
    enum gene_clocks_attribute_type type;
    uint16_t value_count;      /* enumerations */
    const char* const* values; /* enumerations: their names */
    int64_t minimum;           /* integers */
    int64_t maximum;           /* integers */
    uint64_t limit; /* floats: the largest magnitude, as IEEE 754's bits; finite, not 0 */
};

#define GENE_CLOCKS_FLAG(name) \
    { (name), gene_clocks_flag, 0, GENE_CLOCKS_NULL, 0, 0, 0 }
/* `values` is an array of strings. */
#define GENE_CLOCKS_ENUMERATION(name, values) \
    { (name), gene_clocks_enumeration, sizeof(values) / sizeof((values)[0]), (values), 0, 0, 0 }
#define GENE_CLOCKS_INTEGER(name, minimum, maximum) \
    { (name), gene_clocks_integer, 0, GENE_CLOCKS_NULL, (minimum), (maximum), 0 }
#define GENE_CLOCKS_FLOAT32(name, limit_bits) \
    { (name), gene_clocks_float32, 0, GENE_CLOCKS_NULL, 0, 0, (limit_bits) }
#define GENE_CLOCKS_FLOAT64(name, limit_bits) \
    { (name), gene_clocks_float64, 0, GENE_CLOCKS_NULL, 0, 0, (limit_bits) }

/* The bits of the largest finite floats, for attributes without another limit. */
#define GENE_CLOCKS_FLOAT32_MAX_BITS UINT64_C(0x7f7fffff)
#define GENE_CLOCKS_FLOAT64_MAX_BITS UINT64_C(0x7fefffffffffffff)

/* One kind of genes. They are told apart, and sorted, by their marks or, where they have none, by
 * their ends. */
struct gene_clocks_gene_class {
    const char* name;
    bool is_marked;
    enum gene_clocks_ends_kind ends;
    const struct gene_clocks_attribute* attributes;
    uint8_t attribute_count;
};

enum {
    gene_clocks_classes_max = 8,
    gene_clocks_attributes_max = 32,     /* of a class, and of a genome */
    gene_clocks_name_size_max = 63,      /* bytes */
    gene_clocks_attribute_bits_max = 56, /* of a class's flags and enumerations together */
    gene_clocks_enumeration_max = 256    /* values */
};

struct gene_clocks_schema {
    uint64_t genesis_count; /* genesis marks 1 ... genesis_count, the same in the whole fleet */
    const struct gene_clocks_attribute* attributes; /* of a genome as a whole */
    uint8_t attribute_count;
    const struct gene_clocks_gene_class* classes; /* 1 to 8 */
    uint8_t class_count;
};

/* ---- Checks --------------------------------------------------------------------------------- */

enum gene_clocks_schema_error {
    gene_clocks_schema_ok,
    gene_clocks_schema_classes,    /* none, or more than gene_clocks_classes_max */
    gene_clocks_schema_attributes, /* more than gene_clocks_attributes_max */
    gene_clocks_schema_name,       /* empty, too long, or with other characters */
    gene_clocks_schema_repeated,   /* a name that stands beside it already */
    gene_clocks_schema_identity,   /* genes that have neither marks nor ends */
    gene_clocks_schema_ends,       /* ends by index with no class before */
    gene_clocks_schema_type,       /* no such type, or kind of ends */
    gene_clocks_schema_values,     /* not 2 to 256 values */
    gene_clocks_schema_bounds,     /* a minimum above the maximum; a limit of 0 or not finite */
    gene_clocks_schema_bits        /* flags and enumerations of more than 56 bits */
};

/* Where a schema is wrong: the class (class_count for the genome itself) and the attribute of it.
 */
struct gene_clocks_schema_fault {
    enum gene_clocks_schema_error error;
    uint8_t gene_class;
    uint8_t attribute; /* attribute_count where it is the class itself */
};

/* The size of a name, or 0 where it is none. */
GENE_CLOCKS_PLAIN uint8_t gene_clocks_name_size(const char* name) {
    uint8_t size = 0;
    if (!name) return 0;
    for (; name[size] != '\0'; ++size) {
        if (size == gene_clocks_name_size_max || name[size] < '!' || name[size] > '~') return 0;
    }
    return size;
}

GENE_CLOCKS_PLAIN bool gene_clocks_is_same_name(const char* a, const char* b) {
    for (; *a == *b; ++a, ++b) {
        if (*a == '\0') return true;
    }
    return false;
}

/* The bits that `count` values need. */
GENE_CLOCKS_PLAIN uint8_t gene_clocks_bits_for(uint16_t count) {
    uint8_t bits = 0;
    while (count > UINT32_C(1) << bits) ++bits;
    return bits;
}

GENE_CLOCKS_PLAIN enum gene_clocks_schema_error gene_clocks_check_values(
    const struct gene_clocks_attribute* attribute) {
    if (attribute->value_count < 2 || attribute->value_count > gene_clocks_enumeration_max ||
        !attribute->values) {
        return gene_clocks_schema_values;
    }
    for (uint16_t i = 0; i < attribute->value_count; ++i) {
        if (gene_clocks_name_size(attribute->values[i]) == 0) return gene_clocks_schema_name;
        for (uint16_t j = 0; j < i; ++j) {
            if (gene_clocks_is_same_name(attribute->values[i], attribute->values[j])) {
                return gene_clocks_schema_repeated;
            }
        }
    }
    return gene_clocks_schema_ok;
}

GENE_CLOCKS_PLAIN enum gene_clocks_schema_error gene_clocks_check_attribute(
    const struct gene_clocks_attribute* attribute) {
    if (gene_clocks_name_size(attribute->name) == 0) return gene_clocks_schema_name;
    bool is_bounded = true;
    switch (attribute->type) {
        case gene_clocks_flag:
            break;
        case gene_clocks_enumeration:
            return gene_clocks_check_values(attribute);
        case gene_clocks_integer:
            is_bounded = attribute->minimum <= attribute->maximum;
            break;
        case gene_clocks_float32:
            is_bounded = attribute->limit - 1 < GENE_CLOCKS_FLOAT32_MAX_BITS;
            break;
        case gene_clocks_float64:
            is_bounded = attribute->limit - 1 < GENE_CLOCKS_FLOAT64_MAX_BITS;
            break;
        default:
            return gene_clocks_schema_type;
    }
    return is_bounded ? gene_clocks_schema_ok : gene_clocks_schema_bounds;
}

/* ---- Layout --------------------------------------------------------------------------------- */

/* How the genes of a class, or the attributes of a genome, lie in bytes. */
struct gene_clocks_class_layout {
    uint8_t bits;       /* of flags and enumerations */
    uint8_t head_bytes; /* what these bits take, with the head of the mark */
    uint8_t leap_bits;  /* 0 where there is no mark */
    uint16_t bytes_min; /* the fewest that a gene takes */
};

/* Everything about a schema that reading and writing need. The schema must outlive it. */
struct gene_clocks_layout {
    const struct gene_clocks_schema* schema;
    uint32_t fingerprint;
    struct gene_clocks_class_layout genome; /* its attributes */
    struct gene_clocks_class_layout classes[gene_clocks_classes_max];
};

/* The head of a marked gene has its flags and enumerations, a bit for the robot, and at least
 * three bits for how far the counter leaps. */
enum { gene_clocks_leap_bits_min = 3 };

/* Lays out a list of attributes; the attribute that is wrong in `fault`. */
GENE_CLOCKS_PLAIN enum gene_clocks_schema_error gene_clocks_lay_out_attributes(
    const struct gene_clocks_attribute* attributes, uint8_t count, uint8_t* wrong,
    struct gene_clocks_class_layout* layout) {
    unsigned bits = 0;
    unsigned bytes = 0;
    *wrong = count;
    if (count > gene_clocks_attributes_max) return gene_clocks_schema_attributes;
    for (uint8_t i = 0; i < count; ++i) {
        const struct gene_clocks_attribute* const attribute = &attributes[i];
        *wrong = i;
        const enum gene_clocks_schema_error error = gene_clocks_check_attribute(attribute);
        if (error) return error;
        for (uint8_t j = 0; j < i; ++j) {
            if (gene_clocks_is_same_name(attribute->name, attributes[j].name)) {
                return gene_clocks_schema_repeated;
            }
        }
        if (attribute->type == gene_clocks_flag) bits += 1;
        if (attribute->type == gene_clocks_enumeration) {
            bits += gene_clocks_bits_for(attribute->value_count);
        }
        if (attribute->type == gene_clocks_integer) bytes += 1;
        if (attribute->type == gene_clocks_float32) bytes += 4;
        if (attribute->type == gene_clocks_float64) bytes += 8;
        if (bits > gene_clocks_attribute_bits_max) return gene_clocks_schema_bits;
    }
    *wrong = count;
    layout->bits = GENE_CLOCKS_CAST(uint8_t, bits);
    layout->leap_bits = 0;
    layout->head_bytes = GENE_CLOCKS_CAST(uint8_t, (bits + 7) / 8);
    layout->bytes_min = GENE_CLOCKS_CAST(uint16_t, layout->head_bytes + bytes);
    return gene_clocks_schema_ok;
}

GENE_CLOCKS_PLAIN enum gene_clocks_schema_error gene_clocks_lay_out_class(
    const struct gene_clocks_schema* schema, uint8_t index, uint8_t* wrong,
    struct gene_clocks_class_layout* layout) {
    const struct gene_clocks_gene_class* const gene_class = &schema->classes[index];
    *wrong = gene_class->attribute_count;
    if (gene_clocks_name_size(gene_class->name) == 0) return gene_clocks_schema_name;
    for (uint8_t i = 0; i < index; ++i) {
        if (gene_clocks_is_same_name(gene_class->name, schema->classes[i].name)) {
            return gene_clocks_schema_repeated;
        }
    }
    switch (gene_class->ends) {
        case gene_clocks_no_ends:
            if (!gene_class->is_marked) return gene_clocks_schema_identity;
            break;
        case gene_clocks_ends_by_index:
            if (index == 0) return gene_clocks_schema_ends;
            break;
        case gene_clocks_ends_by_mark:
            break;
        default:
            return gene_clocks_schema_type;
    }
    const enum gene_clocks_schema_error error = gene_clocks_lay_out_attributes(
        gene_class->attributes, gene_class->attribute_count, wrong, layout);
    if (error) return error;
    unsigned bytes = layout->bytes_min;
    if (gene_class->is_marked) {
        bytes -= layout->head_bytes;
        layout->head_bytes =
            GENE_CLOCKS_CAST(uint8_t, (1 + layout->bits + gene_clocks_leap_bits_min + 7) / 8);
        layout->leap_bits = GENE_CLOCKS_CAST(uint8_t, 8 * layout->head_bytes - 1 - layout->bits);
        bytes += layout->head_bytes;
    }
    if (gene_class->ends == gene_clocks_ends_by_index) bytes += 2;
    if (gene_class->ends == gene_clocks_ends_by_mark) bytes += 4;
    layout->bytes_min = GENE_CLOCKS_CAST(uint16_t, bytes);
    return gene_clocks_schema_ok;
}

/* ---- Canonical bytes and fingerprint -------------------------------------------------------- */

/* A writer that also sums up what it is given, whether or not there is room. */
struct gene_clocks_schema_writer {
    struct gene_clocks_writer bytes;
    uint32_t crc;
};

GENE_CLOCKS_PLAIN void gene_clocks_put_schema_byte(struct gene_clocks_schema_writer* writer,
                                                   uint8_t byte) {
    gene_clocks_put_byte(&writer->bytes, byte);
    writer->crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
        writer->crc = writer->crc >> 1 ^ ((writer->crc & 1u) ? UINT32_C(0x82f63b78) : 0u);
    }
}

/* A number, lowest byte first: a varint, or so many bytes where `bytes` is not 0. */
GENE_CLOCKS_PLAIN void gene_clocks_put_schema_number(struct gene_clocks_schema_writer* writer,
                                                     uint64_t value, unsigned bytes) {
    for (; bytes > 0; --bytes, value >>= 8) {
        gene_clocks_put_schema_byte(writer, GENE_CLOCKS_CAST(uint8_t, value & 0xffu));
        if (bytes == 1) return;
    }
    for (; value >= 0x80u; value >>= 7) {
        gene_clocks_put_schema_byte(writer, GENE_CLOCKS_CAST(uint8_t, 0x80u | (value & 0x7fu)));
    }
    gene_clocks_put_schema_byte(writer, GENE_CLOCKS_CAST(uint8_t, value));
}

GENE_CLOCKS_PLAIN void gene_clocks_put_name(struct gene_clocks_schema_writer* writer,
                                            const char* name) {
    const uint8_t size = gene_clocks_name_size(name);
    gene_clocks_put_schema_byte(writer, size);
    for (uint8_t i = 0; i < size; ++i) {
        gene_clocks_put_schema_byte(writer, GENE_CLOCKS_CAST(uint8_t, name[i]));
    }
}

/* Integers near 0 as small numbers: 0, -1, 1, -2, ... */
GENE_CLOCKS_PLAIN uint64_t gene_clocks_zigzag(int64_t value) {
    const uint64_t bits = GENE_CLOCKS_CAST(uint64_t, value);
    return value < 0 ? ~(bits << 1) : bits << 1;
}
GENE_CLOCKS_PLAIN int64_t gene_clocks_unzigzag(uint64_t value) {
    const uint64_t bits = value >> 1;
    return GENE_CLOCKS_CAST(int64_t, (value & 1u) ? ~bits : bits);
}

GENE_CLOCKS_PLAIN void gene_clocks_put_attributes(struct gene_clocks_schema_writer* writer,
                                                  const struct gene_clocks_attribute* attributes,
                                                  uint8_t count) {
    gene_clocks_put_schema_byte(writer, count);
    for (uint8_t i = 0; i < count; ++i) {
        const struct gene_clocks_attribute* const attribute = &attributes[i];
        gene_clocks_put_name(writer, attribute->name);
        gene_clocks_put_schema_byte(writer, GENE_CLOCKS_CAST(uint8_t, attribute->type));
        switch (attribute->type) {
            case gene_clocks_flag:
                break;
            case gene_clocks_enumeration:
                gene_clocks_put_schema_number(writer, attribute->value_count, 0);
                for (uint16_t value = 0; value < attribute->value_count; ++value) {
                    gene_clocks_put_name(writer, attribute->values[value]);
                }
                break;
            case gene_clocks_integer:
                gene_clocks_put_schema_number(writer, gene_clocks_zigzag(attribute->minimum), 0);
                gene_clocks_put_schema_number(writer, gene_clocks_zigzag(attribute->maximum), 0);
                break;
            case gene_clocks_float32:
                gene_clocks_put_schema_number(writer, attribute->limit, 4);
                break;
            case gene_clocks_float64:
                gene_clocks_put_schema_number(writer, attribute->limit, 8);
                break;
        }
    }
}

enum { gene_clocks_general_form = 1 };

/* Writes the canonical bytes of a schema that was laid out, and returns their CRC-32C, the
 * fingerprint. With a capacity of 0, where `buffer` may be null, nothing is written. */
GENE_CLOCKS_PLAIN uint32_t gene_clocks_write_schema(const struct gene_clocks_schema* schema,
                                                    uint8_t* buffer, size_t capacity,
                                                    size_t* size) {
    struct gene_clocks_schema_writer writer = {{buffer, capacity, 0}, UINT32_C(0xffffffff)};
    gene_clocks_put_schema_byte(&writer, gene_clocks_general_form);
    gene_clocks_put_schema_number(&writer, schema->genesis_count, 0);
    gene_clocks_put_attributes(&writer, schema->attributes, schema->attribute_count);
    gene_clocks_put_schema_byte(&writer, schema->class_count);
    for (uint8_t i = 0; i < schema->class_count; ++i) {
        const struct gene_clocks_gene_class* const gene_class = &schema->classes[i];
        gene_clocks_put_name(&writer, gene_class->name);
        gene_clocks_put_schema_byte(&writer, gene_class->is_marked ? 1 : 0);
        gene_clocks_put_schema_byte(&writer, GENE_CLOCKS_CAST(uint8_t, gene_class->ends));
        gene_clocks_put_attributes(&writer, gene_class->attributes, gene_class->attribute_count);
    }
    *size = writer.bytes.size;
    return writer.crc ^ UINT32_C(0xffffffff);
}

/* Checks a schema and lays it out. Where it is refused, `layout` holds nothing of meaning. */
GENE_CLOCKS_PLAIN struct gene_clocks_schema_fault gene_clocks_lay_out(
    const struct gene_clocks_schema* schema, struct gene_clocks_layout* layout) {
    struct gene_clocks_schema_fault fault = {gene_clocks_schema_ok, schema->class_count, 0};
    layout->schema = schema;
    if (schema->class_count == 0 || schema->class_count > gene_clocks_classes_max) {
        fault.error = gene_clocks_schema_classes;
        return fault;
    }
    fault.error = gene_clocks_lay_out_attributes(schema->attributes, schema->attribute_count,
                                                 &fault.attribute, &layout->genome);
    if (fault.error) return fault;
    for (uint8_t i = 0; i < schema->class_count; ++i) {
        fault.gene_class = i;
        fault.error = gene_clocks_lay_out_class(schema, i, &fault.attribute, &layout->classes[i]);
        if (fault.error) return fault;
    }
    size_t size = 0;
    layout->fingerprint = gene_clocks_write_schema(schema, GENE_CLOCKS_NULL, 0, &size);
    return fault;
}

GENE_CLOCKS_END

#endif /* GENE_CLOCKS_SCHEMA_H */
