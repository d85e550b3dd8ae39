#include "tests/protocol/wire_in_c.h"

#include <gene_clocks/genome_payload.h>

/* As firmware would have it: all memory is there from the start. */
enum { neurons_max = 1024, connections_max = 1024, payload_max = 65536 };
static struct gene_clocks_gene genes[neurons_max + connections_max];
static uint32_t joined[GENE_CLOCKS_JOINED_WORDS(connections_max)];
static uint8_t payload[payload_max];

uint32_t c_crc32c(const uint8_t* bytes, size_t size) {
    return gene_clocks_crc32c(bytes, size);
}

static struct gene_clocks_fault write(const struct gene_clocks_frame* frame,
                                      const struct gene_clocks_genome* genome,
                                      const struct gene_clocks_wire_limits* limits, uint8_t* out,
                                      size_t capacity, size_t* out_size) {
    struct gene_clocks_genome_writer writer;
    struct gene_clocks_fault fault = gene_clocks_begin_genome(
        &writer, payload, sizeof payload, *genome, frame->stamp, limits, joined);
    for (size_t i = 0; !fault.error && i < (size_t)genome->neurons + genome->connections; ++i) {
        fault = gene_clocks_put_gene(&writer, &genes[i]);
    }
    if (!fault.error) fault = gene_clocks_end_genome(&writer);
    if (fault.error) return fault;
    struct gene_clocks_frame copy = *frame;
    copy.payload = payload;
    copy.payload_size = writer.bytes.size;
    return gene_clocks_encode_frame(&copy, limits, out, capacity, out_size);
}

int c_transcode(const uint8_t* bytes, size_t size, const struct c_wire_limits* c_limits,
                uint8_t* out, size_t capacity, size_t* out_size, size_t* offset) {
    const struct gene_clocks_wire_limits limits = {c_limits->frame_bytes,
                                                   c_limits->genesis_count,
                                                   c_limits->neurons,
                                                   c_limits->connections,
                                                   c_limits->energy,
                                                   c_limits->weight,
                                                   0x5eed};
    struct gene_clocks_frame frame = {0, 0, 0.0f, NULL, 0};
    struct gene_clocks_genome genome = {0, 0, 0, 0};
    *out_size = 0;
    struct gene_clocks_fault fault = gene_clocks_decode_frame(bytes, size, &limits, &frame);
    *offset = fault.offset;
    if (fault.error) return (int)fault.error;
    fault = gene_clocks_decode_genome(frame.payload, frame.payload_size, frame.stamp, &limits,
                                      &genome, genes, joined);
    *offset = fault.offset + (size_t)(frame.payload - bytes);
    if (fault.error) return (int)fault.error;
    *offset = SIZE_MAX;
    return (int)write(&frame, &genome, &limits, out, capacity, out_size).error;
}
