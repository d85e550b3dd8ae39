/* General genomes as a C program reads and writes them, behind functions that C++ can call. */
#ifndef GENE_CLOCKS_TESTS_GENERAL_IN_C_H
#define GENE_CLOCKS_TESTS_GENERAL_IN_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct gene_clocks_schema;

/* Lays a schema out and returns the error, with its fingerprint and its canonical bytes in `out`.
 */
int c_lay_out(const struct gene_clocks_schema* schema, uint8_t* out, size_t capacity,
              size_t* out_size, uint32_t* fingerprint);

/* Reads a payload gene by gene and writes the same again to `out`, with no memory between. Returns
 * the error of whichever failed, with its offset (SIZE_MAX for writing). */
int c_transcode_general(const uint8_t* payload, size_t size, uint64_t stamp,
                        const struct gene_clocks_schema* schema, uint32_t genes_max, uint8_t* out,
                        size_t capacity, size_t* out_size, size_t* offset);

#ifdef __cplusplus
}
#endif
#endif
