/* The wire format, version 1 (docs/wire-format.md): the genome in a frame's payload. In C99 and in
 * constexpr C++20 at once, like kernel.h.
 *
 * A genome goes over the wire as one list of genes in the order of their marks, neurons and
 * connections together: so order, uniqueness, what lies below the stamp and that a connection's
 * neurons precede it are all checked gene by gene, with no more memory than a set of the pairs of
 * neurons that are joined. Reader and writer share one set of checks, so that what can be written
 * is exactly what can be read.
 *
 * No allocation, no I/O, no global state, no floating-point arithmetic.
 */
#ifndef GENE_CLOCKS_GENOME_PAYLOAD_H
#define GENE_CLOCKS_GENOME_PAYLOAD_H

#include <gene_clocks/kernel.h>
#include <gene_clocks/wire.h>

/* clang-format off */
#ifdef __cplusplus
#define GENE_CLOCKS_FUNCTION constexpr
#define GENE_CLOCKS_MARK gene_clocks_mark<uint64_t>
#define GENE_CLOCKS_BITS_OF(number) std::bit_cast<uint32_t>(number)
#define GENE_CLOCKS_FLOAT_OF(bits) std::bit_cast<float>(bits)
namespace gene_clocks::kernel {
#else
#define GENE_CLOCKS_FUNCTION static inline
#define GENE_CLOCKS_MARK struct gene_clocks_mark
#define GENE_CLOCKS_BITS_OF(value) ((union gene_clocks_float){.number = (value)}.bits)
#define GENE_CLOCKS_FLOAT_OF(value) ((union gene_clocks_float){.bits = (value)}.number)
#endif
/* clang-format on */

/* ---- Genes ---------------------------------------------------------------------------------- */

enum gene_clocks_gene_kind {
    gene_clocks_input,
    gene_clocks_bias,
    gene_clocks_output,
    gene_clocks_hidden,
    gene_clocks_connection
};

/* The neurons that a connection joins, counted from 0 in the order of their marks. */
struct gene_clocks_ends {
    uint16_t source;
    uint16_t target;
};

struct gene_clocks_gene {
    GENE_CLOCKS_MARK mark;
    enum gene_clocks_gene_kind kind;
    /* Of connections only: */
    bool is_enabled;
    bool is_recurrent;
    struct gene_clocks_ends ends;
    float weight;
};

/* Identity of a genome (the robot that made it, and a number that this robot gives to no other),
 * and how many genes follow. */
struct gene_clocks_genome {
    uint32_t robot;
    uint32_t birth;
    uint16_t neurons;
    uint16_t connections;
};

/* The most bytes that the parts of a payload take, and the fewest that a gene takes. */
enum {
    gene_clocks_genome_header_bytes_max = 5 + 5 + 3 + 3,
    gene_clocks_neuron_bytes_max = 1 + 10 + 5,
    gene_clocks_connection_bytes_max = gene_clocks_neuron_bytes_max + 3 + 3 + 4,
    gene_clocks_neuron_bytes_min = 1,
    gene_clocks_connection_bytes_min = 1 + 1 + 1 + 4
};

/* The words of scratch memory that checking up to `connections` connections takes. A macro, so
 * that firmware can have it in an array. */
#define GENE_CLOCKS_JOINED_WORDS(connections) (4 * (size_t)(connections))

/* ---- The checks ----------------------------------------------------------------------------- */

/* A genome so far: what decides whether a gene may come next.
 *
 * Invariants: all marks so far are at most `last`, which is below the stamp; inputs and bias are
 * the first `inputs` neurons, the `outputs` come right after them, all of them before any
 * connection; `joined` holds the ends of all connections so far. */
struct gene_clocks_genome_checks {
    const struct gene_clocks_wire_limits* limits;
    /* A hash table with linear probing, the caller's memory. Its size is a power of two, and at
     * least twice the connections that were announced, so that a free place is always near. */
    uint32_t* joined;
    uint32_t joined_mask;
    uint32_t multiplier; /* odd */
    uint64_t stamp;
    GENE_CLOCKS_MARK last; /* <0, 0> before the first gene */
    struct gene_clocks_genome genome;
    uint16_t neurons;
    uint16_t connections;
    uint16_t inputs; /* with the bias */
    uint16_t outputs;
    bool has_bias;
};

/* No pair of neurons is packed to this: indices are below 65535, the most neurons there can be. */
#define GENE_CLOCKS_NOT_JOINED 0xffffffffu

/* Begins to check a genome with these counts, which are within the limits. */
GENE_CLOCKS_FUNCTION struct gene_clocks_genome_checks gene_clocks_start_checks(
    struct gene_clocks_genome genome, uint64_t stamp, const struct gene_clocks_wire_limits* limits,
    uint32_t* joined) {
    uint32_t size = 1;
    while (size < 2u * genome.connections) size *= 2;
    if (genome.connections > 0) {
        for (uint32_t i = 0; i < size; ++i) joined[i] = GENE_CLOCKS_NOT_JOINED;
    }
    const uint32_t multiplier = 2 * limits->salt + 0x9e3779b9u;
    const struct gene_clocks_genome_checks checks = {
        limits, joined, size - 1, multiplier, stamp, {0, 0}, genome, 0, 0, 0, 0, false};
    return checks;
}

/* Where the search for a pair begins. Pairs come in rows and columns, so that a multiplication
 * alone heaps them up in a table with linear probing, for some salts; what follows it is
 * MurmurHash3's. */
GENE_CLOCKS_FUNCTION uint32_t gene_clocks_place_of(const struct gene_clocks_genome_checks* checks,
                                                   uint32_t pair) {
    uint32_t hash = pair * checks->multiplier;
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return (uint32_t)((uint64_t)hash * (checks->joined_mask + 1u) >> 32);
}

/* Notes that a connection joins these neurons; false where one does already. In constant time as a
 * rule; in time linear in the connections for a genome made up by someone who knows the salt. */
GENE_CLOCKS_FUNCTION bool gene_clocks_join(const struct gene_clocks_genome_checks* checks,
                                           struct gene_clocks_ends ends) {
    const uint32_t pair = (uint32_t)ends.source << 16 | ends.target;
    uint32_t place = gene_clocks_place_of(checks, pair);
    while (checks->joined[place] != GENE_CLOCKS_NOT_JOINED) {
        if (checks->joined[place] == pair) return false;
        place = (place + 1) & checks->joined_mask;
    }
    checks->joined[place] = pair;
    return true;
}

GENE_CLOCKS_FUNCTION enum gene_clocks_wire_error gene_clocks_check_mark(
    const struct gene_clocks_genome_checks* checks, GENE_CLOCKS_MARK mark) {
    if (!gene_clocks_less(checks->last, mark)) return gene_clocks_wire_not_ascending;
    if (mark.counter >= checks->stamp) return gene_clocks_wire_not_below;
    const bool is_genesis = mark.counter <= checks->limits->genesis_count;
    if (mark.counter == 0 || (mark.robot == 0) != is_genesis) return gene_clocks_wire_genesis;
    return gene_clocks_wire_ok;
}

GENE_CLOCKS_FUNCTION enum gene_clocks_wire_error gene_clocks_check_neuron(
    const struct gene_clocks_genome_checks* checks, const struct gene_clocks_gene* gene) {
    if (checks->neurons == checks->genome.neurons) return gene_clocks_wire_gene_count;
    if (gene->kind > gene_clocks_connection) return gene_clocks_wire_kind; /* a writer's mistake */
    bool is_in_turn = checks->outputs > 0;                                 /* for a hidden neuron */
    if (gene->kind != gene_clocks_hidden) {
        is_in_turn = checks->connections == 0 && gene->mark.robot == 0 &&
                     checks->neurons == checks->inputs + checks->outputs &&
                     checks->has_bias == (gene->kind == gene_clocks_output);
    }
    return is_in_turn ? gene_clocks_wire_ok : gene_clocks_wire_kind;
}

GENE_CLOCKS_FUNCTION enum gene_clocks_wire_error gene_clocks_check_connection(
    const struct gene_clocks_genome_checks* checks, const struct gene_clocks_gene* gene) {
    if (checks->connections == checks->genome.connections) return gene_clocks_wire_gene_count;
    if (checks->outputs == 0) return gene_clocks_wire_kind;
    const struct gene_clocks_ends ends = gene->ends;
    if (ends.source >= checks->neurons || ends.target >= checks->neurons ||
        ends.target < checks->inputs) {
        return gene_clocks_wire_ends;
    }
    if (!gene_clocks_is_within(GENE_CLOCKS_BITS_OF(gene->weight), checks->limits->weight)) {
        return gene_clocks_wire_weight;
    }
    /* Last, since it notes the pair. */
    if (!gene_clocks_join(checks, ends)) return gene_clocks_wire_repeated_ends;
    return gene_clocks_wire_ok;
}

/* Takes a gene as the next one, or says why not; then nothing changes. */
GENE_CLOCKS_FUNCTION enum gene_clocks_wire_error gene_clocks_add_gene(
    struct gene_clocks_genome_checks* checks, const struct gene_clocks_gene* gene) {
    enum gene_clocks_wire_error error = gene_clocks_check_mark(checks, gene->mark);
    if (error) return error;
    if (gene->kind == gene_clocks_connection) {
        error = gene_clocks_check_connection(checks, gene);
        if (error) return error;
        ++checks->connections;
    } else {
        error = gene_clocks_check_neuron(checks, gene);
        if (error) return error;
        ++checks->neurons;
        if (gene->kind == gene_clocks_output) {
            ++checks->outputs;
        } else if (gene->kind != gene_clocks_hidden) {
            ++checks->inputs;
            checks->has_bias = gene->kind == gene_clocks_bias;
        }
    }
    checks->last = gene->mark;
    return gene_clocks_wire_ok;
}

/* Whether all genes that were announced are there, and with them an output. */
GENE_CLOCKS_FUNCTION enum gene_clocks_wire_error gene_clocks_check_whole(
    const struct gene_clocks_genome_checks* checks) {
    if (checks->neurons != checks->genome.neurons ||
        checks->connections != checks->genome.connections) {
        return gene_clocks_wire_gene_count;
    }
    return checks->outputs > 0 ? gene_clocks_wire_ok : gene_clocks_wire_kind;
}

/* ---- Reading -------------------------------------------------------------------------------- */

struct gene_clocks_genome_reader {
    struct gene_clocks_reader bytes;
    struct gene_clocks_genome_checks checks;
};

/* Begins to read a payload: its identity and its counts, which are then in
 * reader->checks.genome, within the limits and not more than the bytes can hold. `stamp` is that
 * of the frame. `joined` is scratch memory of GENE_CLOCKS_JOINED_WORDS(limits->connections) words;
 * it, `limits` and `bytes` must outlive the reader. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_open_genome(
    struct gene_clocks_genome_reader* reader, const uint8_t* bytes, size_t size, uint64_t stamp,
    const struct gene_clocks_wire_limits* limits, uint32_t* joined) {
    const unsigned bits[4] = {32, 32, 16, 16};
    uint64_t fields[4] = {0, 0, 0, 0};
    reader->bytes.bytes = bytes;
    reader->bytes.size = size;
    reader->bytes.offset = 0;
    for (int i = 0; i < 4; ++i) {
        const size_t at = reader->bytes.offset;
        enum gene_clocks_wire_error error =
            gene_clocks_get_varint(&reader->bytes, bits[i], &fields[i]);
        if (!error && i == 0 && fields[0] == 0) error = gene_clocks_wire_robot;
        if (!error && i == 2 && fields[2] > limits->neurons) {
            error = gene_clocks_wire_too_many_genes;
        }
        if (!error && i == 3 && fields[3] > limits->connections) {
            error = gene_clocks_wire_too_many_genes;
        }
        if (error) return gene_clocks_fault_at(error, at);
    }
    const uint64_t least =
        fields[2] * gene_clocks_neuron_bytes_min + fields[3] * gene_clocks_connection_bytes_min;
    if (least > size - reader->bytes.offset) {
        return gene_clocks_fault_at(gene_clocks_wire_truncated, size);
    }
    const struct gene_clocks_genome genome = {(uint32_t)fields[0], (uint32_t)fields[1],
                                              (uint16_t)fields[2], (uint16_t)fields[3]};
    reader->checks = gene_clocks_start_checks(genome, stamp, limits, joined);
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* How many genes are still to be read. */
GENE_CLOCKS_FUNCTION size_t gene_clocks_genes_left(const struct gene_clocks_genome_reader* reader) {
    const struct gene_clocks_genome_checks* checks = &reader->checks;
    return (size_t)(checks->genome.neurons - checks->neurons) +
           (size_t)(checks->genome.connections - checks->connections);
}

/* The head of a gene: bit 0 tells connections from neurons; bits 1 and 2 are a neuron's kind, or
 * whether a connection is enabled and recurrent; bit 3 says that a robot follows; bits 4 to 7 are
 * how far the counter lies above that of the gene before, where 15 says that more follows. */
enum {
    gene_clocks_head_connection = 1,
    gene_clocks_head_enabled = 2,
    gene_clocks_head_recurrent = 4,
    gene_clocks_head_robot = 8,
    gene_clocks_head_far = 15
};

/* Reads the mark of the gene that begins at `start`, whose head was read. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_get_mark(
    struct gene_clocks_genome_reader* reader, size_t start, uint8_t head, GENE_CLOCKS_MARK* mark) {
    const GENE_CLOCKS_MARK last = reader->checks.last;
    uint64_t more = 0;
    if (head >> 4 == gene_clocks_head_far) {
        const size_t at = reader->bytes.offset;
        const enum gene_clocks_wire_error error = gene_clocks_get_varint(&reader->bytes, 64, &more);
        if (error) return gene_clocks_fault_at(error, at);
    }
    /* Before the sum, which may have more than 64 bits. */
    const uint64_t room = reader->checks.stamp - 1 - last.counter;
    const uint64_t leap = head >> 4;
    if (more > room || leap > room - more) {
        return gene_clocks_fault_at(gene_clocks_wire_not_below, start);
    }
    mark->counter = last.counter + leap + more;
    mark->robot = last.robot;
    if (head & gene_clocks_head_robot) {
        const size_t at = reader->bytes.offset;
        uint64_t robot = 0;
        enum gene_clocks_wire_error error = gene_clocks_get_varint(&reader->bytes, 32, &robot);
        if (!error && robot == last.robot) error = gene_clocks_wire_not_shortest;
        if (error) return gene_clocks_fault_at(error, at);
        mark->robot = (uint32_t)robot;
    }
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Reads what a connection has beside its mark. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_get_connection(
    struct gene_clocks_reader* bytes, struct gene_clocks_gene* gene) {
    uint64_t source = 0, target = 0;
    uint32_t weight = 0;
    size_t at = bytes->offset;
    enum gene_clocks_wire_error error = gene_clocks_get_varint(bytes, 16, &source);
    if (error) return gene_clocks_fault_at(error, at);
    at = bytes->offset;
    error = gene_clocks_get_varint(bytes, 16, &target);
    if (error) return gene_clocks_fault_at(error, at);
    at = bytes->offset;
    error = gene_clocks_get_word(bytes, &weight);
    if (error) return gene_clocks_fault_at(error, at);
    gene->ends.source = (uint16_t)source;
    gene->ends.target = (uint16_t)target;
    gene->weight = GENE_CLOCKS_FLOAT_OF(weight);
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Reads the next gene and checks that it may come there. Precondition: genes are left, and none
 * was refused. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_next_gene(
    struct gene_clocks_genome_reader* reader, struct gene_clocks_gene* gene) {
    const size_t start = reader->bytes.offset;
    if (start == reader->bytes.size) {
        return gene_clocks_fault_at(gene_clocks_wire_truncated, start);
    }
    const uint8_t head = reader->bytes.bytes[start];
    reader->bytes.offset = start + 1;
    struct gene_clocks_gene read = {{0, 0}, gene_clocks_connection, false, false, {0, 0}, 0.0f};
    struct gene_clocks_fault fault = gene_clocks_get_mark(reader, start, head, &read.mark);
    if (fault.error) return fault;
    if (head & gene_clocks_head_connection) {
        read.is_enabled = (head & gene_clocks_head_enabled) != 0;
        read.is_recurrent = (head & gene_clocks_head_recurrent) != 0;
        fault = gene_clocks_get_connection(&reader->bytes, &read);
        if (fault.error) return fault;
    } else {
        read.kind = (enum gene_clocks_gene_kind)(head >> 1 & 3u);
    }
    const enum gene_clocks_wire_error error = gene_clocks_add_gene(&reader->checks, &read);
    if (error) return gene_clocks_fault_at(error, start);
    *gene = read;
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Ends the reading, after all genes. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_close_genome(
    const struct gene_clocks_genome_reader* reader) {
    const enum gene_clocks_wire_error error = gene_clocks_check_whole(&reader->checks);
    if (error) return gene_clocks_fault_at(error, reader->bytes.offset);
    if (reader->bytes.offset != reader->bytes.size) {
        return gene_clocks_fault_at(gene_clocks_wire_trailing, reader->bytes.offset);
    }
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Reads a whole genome into arrays: `genes` has room for limits->neurons + limits->connections,
 * `joined` is scratch memory as above. Where it is refused, `genome` does not change and the arrays
 * hold nothing of meaning. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_decode_genome(
    const uint8_t* payload, size_t size, uint64_t stamp,
    const struct gene_clocks_wire_limits* limits, struct gene_clocks_genome* genome,
    struct gene_clocks_gene* genes, uint32_t* joined) {
    struct gene_clocks_genome_reader reader = {
        {NULL, 0, 0}, {NULL, NULL, 0, 0, 0, {0, 0}, {0, 0, 0, 0}, 0, 0, 0, 0, false}};
    struct gene_clocks_fault fault =
        gene_clocks_open_genome(&reader, payload, size, stamp, limits, joined);
    if (fault.error) return fault;
    while (gene_clocks_genes_left(&reader) > 0) {
        fault = gene_clocks_next_gene(&reader, genes++);
        if (fault.error) return fault;
    }
    fault = gene_clocks_close_genome(&reader);
    if (!fault.error) *genome = reader.checks.genome;
    return fault;
}

/* ---- Writing -------------------------------------------------------------------------------- */

struct gene_clocks_genome_writer {
    struct gene_clocks_writer bytes;
    struct gene_clocks_genome_checks checks;
};

/* Writes identity and counts, without a check. */
GENE_CLOCKS_FUNCTION void gene_clocks_put_genome_header_unchecked(
    struct gene_clocks_writer* bytes, const struct gene_clocks_genome* genome) {
    gene_clocks_put_varint(bytes, genome->robot);
    gene_clocks_put_varint(bytes, genome->birth);
    gene_clocks_put_varint(bytes, genome->neurons);
    gene_clocks_put_varint(bytes, genome->connections);
}

/* Begins to write a genome with `genome`'s identity and counts, to travel with `stamp`. `joined` as
 * for reading. With a capacity of 0, where `buffer` may be null, the size is found. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_begin_genome(
    struct gene_clocks_genome_writer* writer, uint8_t* buffer, size_t capacity,
    struct gene_clocks_genome genome, uint64_t stamp, const struct gene_clocks_wire_limits* limits,
    uint32_t* joined) {
    const struct gene_clocks_writer bytes = {buffer, capacity, 0};
    if (genome.robot == 0) return gene_clocks_fault_at(gene_clocks_wire_robot, 0);
    if (genome.neurons > limits->neurons || genome.connections > limits->connections) {
        return gene_clocks_fault_at(gene_clocks_wire_too_many_genes, 0);
    }
    writer->bytes = bytes;
    writer->checks = gene_clocks_start_checks(genome, stamp, limits, joined);
    gene_clocks_put_genome_header_unchecked(&writer->bytes, &genome);
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Writes a gene that comes after one with the mark `last`, without a check: to find the size of
 * what no reader would take, too. */
GENE_CLOCKS_FUNCTION void gene_clocks_put_gene_unchecked(struct gene_clocks_writer* bytes,
                                                         GENE_CLOCKS_MARK last,
                                                         const struct gene_clocks_gene* gene) {
    const uint64_t leap = gene->mark.counter - last.counter;
    const bool is_far = leap >= gene_clocks_head_far;
    unsigned head = (is_far ? (unsigned)gene_clocks_head_far : (unsigned)leap) << 4;
    if (gene->mark.robot != last.robot) head |= gene_clocks_head_robot;
    if (gene->kind == gene_clocks_connection) {
        head |= gene_clocks_head_connection;
        if (gene->is_enabled) head |= gene_clocks_head_enabled;
        if (gene->is_recurrent) head |= gene_clocks_head_recurrent;
    } else {
        head |= (unsigned)gene->kind << 1;
    }
    gene_clocks_put_byte(bytes, (uint8_t)head);
    if (is_far) gene_clocks_put_varint(bytes, leap - gene_clocks_head_far);
    if (gene->mark.robot != last.robot) gene_clocks_put_varint(bytes, gene->mark.robot);
    if (gene->kind == gene_clocks_connection) {
        gene_clocks_put_varint(bytes, gene->ends.source);
        gene_clocks_put_varint(bytes, gene->ends.target);
        gene_clocks_put_word(bytes, GENE_CLOCKS_BITS_OF(gene->weight));
    }
}

/* Writes the next gene, in the order of marks. Where it may not come there, nothing changes. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_put_gene(
    struct gene_clocks_genome_writer* writer, const struct gene_clocks_gene* gene) {
    const GENE_CLOCKS_MARK last = writer->checks.last;
    const enum gene_clocks_wire_error error = gene_clocks_add_gene(&writer->checks, gene);
    if (error) return gene_clocks_fault_at(error, writer->bytes.size);
    gene_clocks_put_gene_unchecked(&writer->bytes, last, gene);
    return gene_clocks_fault_at(gene_clocks_wire_ok, 0);
}

/* Ends the writing; the payload is the first writer->bytes.size bytes of the buffer. */
GENE_CLOCKS_FUNCTION struct gene_clocks_fault gene_clocks_end_genome(
    const struct gene_clocks_genome_writer* writer) {
    enum gene_clocks_wire_error error = gene_clocks_check_whole(&writer->checks);
    if (!error && writer->bytes.size > writer->bytes.capacity) error = gene_clocks_wire_no_room;
    return gene_clocks_fault_at(error, error ? writer->bytes.size : 0);
}

#ifdef __cplusplus
} /* namespace gene_clocks::kernel */
#endif

#undef GENE_CLOCKS_FUNCTION
#undef GENE_CLOCKS_MARK
#undef GENE_CLOCKS_BITS_OF
#undef GENE_CLOCKS_FLOAT_OF

#endif /* GENE_CLOCKS_GENOME_PAYLOAD_H */
