/* Every function of kernel.h under one name, compiled as C and as C++: the object code must be the
 * same (instances). COUNTER is the counter type; C gets it by a copy of the header whose typedef
 * says so. A genome is passed by the address of its first mark in both languages. */
#include <stddef.h>
#include <stdint.h>

#include "gene_clocks/kernel.h"

#ifdef __cplusplus
#define OF(type) type<gene_clocks_counter>
#define GENOME const genome&
#define VISITOR const visitor&
#define ENUM
using gene_clocks_counter = COUNTER;
using namespace gene_clocks::kernel;

struct genome {
    const gene_clocks_mark<gene_clocks_counter>& operator[](size_t index) const {
        return reinterpret_cast<const gene_clocks_mark<gene_clocks_counter>*>(this)[index];
    }
};

struct visitor {
    void (*gene)(void* context, gene_clocks_match match, size_t first, size_t second);
    void* context;
    void operator()(gene_clocks_match match, size_t first, size_t second) const {
        gene(context, match, first, second);
    }
};

extern "C" {
#else
#define OF(type) struct type
#define GENOME const struct gene_clocks_mark*
#define VISITOR const struct gene_clocks_visitor*
#define ENUM enum
#endif

bool less(OF(gene_clocks_mark) a, OF(gene_clocks_mark) b) {
    return gene_clocks_less(a, b);
}

bool equal(OF(gene_clocks_mark) a, OF(gene_clocks_mark) b) {
    return gene_clocks_equal(a, b);
}

bool restore(OF(gene_clocks_state) * state, const OF(gene_clocks_limits) * limits,
             gene_clocks_counter next, gene_clocks_counter durable) {
    return gene_clocks_restore(state, limits, next, durable);
}

bool start(OF(gene_clocks_state) * state, const OF(gene_clocks_limits) * limits,
           gene_clocks_counter genesis_count) {
    return gene_clocks_start(state, limits, genesis_count);
}

bool restart(OF(gene_clocks_state) * state, const OF(gene_clocks_limits) * limits,
             gene_clocks_counter genesis_count, gene_clocks_counter stored) {
    return gene_clocks_restart(state, limits, genesis_count, stored);
}

void reserve(OF(gene_clocks_state) * state, const OF(gene_clocks_limits) * limits) {
    gene_clocks_reserve(state, limits);
}

bool mint(OF(gene_clocks_state) * state, const OF(gene_clocks_limits) * limits,
          gene_clocks_counter count, gene_clocks_counter* first) {
    return gene_clocks_mint(state, limits, count, first);
}

bool observe(OF(gene_clocks_state) * state, const OF(gene_clocks_limits) * limits,
             gene_clocks_counter stamp) {
    return gene_clocks_observe(state, limits, stamp);
}

bool covers(gene_clocks_counter stamp, GENOME marks, size_t size) {
    return gene_clocks_covers(stamp, marks, size);
}

size_t find_unmade(gene_clocks_counter next, uint32_t robot, GENOME marks, size_t size) {
    return gene_clocks_find_unmade(next, robot, marks, size);
}

void earn(gene_clocks_counter* allowance, gene_clocks_counter counters,
          gene_clocks_counter ceiling) {
    gene_clocks_earn(allowance, counters, ceiling);
}

ENUM gene_clocks_admission admit(OF(gene_clocks_state) * state,
                                 const OF(gene_clocks_limits) * limits,
                                 gene_clocks_counter* allowance, gene_clocks_counter stamp) {
    return gene_clocks_admit(state, limits, allowance, stamp);
}

void visit(VISITOR visitor, ENUM gene_clocks_match match, size_t first, size_t second) {
    gene_clocks_visit(visitor, match, first, second);
}

void align(GENOME first, size_t first_size, GENOME second, size_t second_size, VISITOR visitor) {
    gene_clocks_align(first, first_size, second, second_size, visitor);
}

#ifdef __cplusplus
}
#endif
