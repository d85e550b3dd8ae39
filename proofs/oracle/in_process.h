/* The proved protocol (protocol.ml) and trace checker (trace.ml) inside another program. Not thread-safe. */
#ifndef GENE_CLOCKS_ORACLE_IN_PROCESS_H
#define GENE_CLOCKS_ORACLE_IN_PROCESS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Once, before all else. */
void gene_clocks_oracle_start(void);

/* The answer to one line, or "malformed: " and what is wrong with it; good until the next call. */
const char* gene_clocks_oracle_answer(const char* line);

/* The verdict on a trace of `size` bytes, as in docs/trace-format.md; good until the next call. */
const char* gene_clocks_oracle_verdict(const char* trace, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* GENE_CLOCKS_ORACLE_IN_PROCESS_H */
