/* The wire format as a C program reads and writes it, behind functions that C++ can call. */
#ifndef GENE_CLOCKS_TESTS_WIRE_IN_C_H
#define GENE_CLOCKS_TESTS_WIRE_IN_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct c_wire_limits {
    uint32_t frame_bytes;
    uint64_t genesis_count;
    uint16_t neurons, connections;
    float energy, weight;
};

uint32_t c_crc32c(const uint8_t* bytes, size_t size);

/* Decodes a frame and its genome, and writes the same again to `out`, which has room for
 * `capacity`. Returns the error of whichever failed, with `offset` as in the frame for decoding
 * and SIZE_MAX for encoding; `out_size` is what was written. */
int c_transcode(const uint8_t* frame, size_t size, const struct c_wire_limits* limits, uint8_t* out,
                size_t capacity, size_t* out_size, size_t* offset);

#ifdef __cplusplus
}
#endif
#endif
