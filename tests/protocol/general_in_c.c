#include "tests/protocol/general_in_c.h"

#include <gene_clocks/general_genome.h>

int c_lay_out(const struct gene_clocks_schema* schema, uint8_t* out, size_t capacity,
              size_t* out_size, uint32_t* fingerprint) {
    struct gene_clocks_layout layout;
    const struct gene_clocks_schema_fault fault = gene_clocks_lay_out(schema, &layout);
    *out_size = 0;
    if (fault.error) return (int)fault.error;
    gene_clocks_write_schema(schema, out, capacity, out_size);
    *fingerprint = layout.fingerprint;
    return 0;
}

int c_transcode_general(const uint8_t* payload, size_t size, uint64_t stamp,
                        const struct gene_clocks_schema* schema, uint32_t genes_max, uint8_t* out,
                        size_t capacity, size_t* out_size, size_t* offset) {
    struct gene_clocks_layout layout;
    struct gene_clocks_general_reader reader;
    struct gene_clocks_general_writer writer;
    uint64_t values[gene_clocks_attributes_max];
    *out_size = 0;
    *offset = SIZE_MAX;
    if (gene_clocks_lay_out(schema, &layout).error) return -1;
    struct gene_clocks_fault fault =
        gene_clocks_open_general(&reader, payload, size, stamp, &layout, genes_max, values);
    *offset = fault.offset;
    if (fault.error) return (int)fault.error;
    *offset = SIZE_MAX;
    fault = gene_clocks_begin_general(&writer, out, capacity, &reader.checks.genome, values, stamp,
                                      &layout, genes_max);
    if (fault.error) return (int)fault.error;
    while (gene_clocks_are_genes_left(&reader.checks)) {
        struct gene_clocks_general_gene gene;
        fault = gene_clocks_next_general_gene(&reader, &gene, values);
        *offset = fault.offset;
        if (fault.error) return (int)fault.error;
        *offset = SIZE_MAX;
        fault = gene_clocks_put_general_gene(&writer, &gene, values);
        if (fault.error) return (int)fault.error;
    }
    fault = gene_clocks_close_general(&reader);
    *offset = fault.offset;
    if (fault.error) return (int)fault.error;
    *offset = SIZE_MAX;
    *out_size = writer.bytes.size;
    return (int)gene_clocks_end_general(&writer).error;
}
