/* The kernel as a C program sees it, behind functions that C++ can call. */
#ifndef GENE_CLOCKS_TESTS_KERNEL_IN_C_H
#define GENE_CLOCKS_TESTS_KERNEL_IN_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct c_clock {
    uint64_t maximum, block, window, next, durable;
};
struct c_mark {
    uint64_t counter;
    uint32_t robot;
};
struct c_visit {
    int match;
    size_t first, second;
};

int c_less(struct c_mark a, struct c_mark b);
int c_start(struct c_clock* clock, uint64_t genesis_count);
int c_restore(struct c_clock* clock, uint64_t next, uint64_t durable);
int c_restart(struct c_clock* clock, uint64_t genesis_count, uint64_t stored);
int c_mint(struct c_clock* clock, uint64_t count, uint64_t* first);
int c_observe(struct c_clock* clock, uint64_t stamp);
int c_covers(uint64_t stamp, const struct c_mark* genome, size_t size);
size_t c_find_unmade(uint64_t next, uint32_t robot, const struct c_mark* genome, size_t size);
void c_earn(uint64_t* allowance, uint64_t counters, uint64_t ceiling);
int c_admit(struct c_clock* clock, uint64_t* allowance, uint64_t stamp);
/* Writes what is visited to `visits`, which has room for all; returns how many. */
size_t c_align(const struct c_mark* first, size_t first_size, const struct c_mark* second,
               size_t second_size, struct c_visit* visits);

#ifdef __cplusplus
}
#endif
#endif
