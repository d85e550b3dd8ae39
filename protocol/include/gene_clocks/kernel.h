/* The arithmetic of a gene clock, in C99 and in constexpr C++20 at once.
 *
 * C firmware includes this header as it is and gets 64-bit counters. C++ gets the same text as
 * function templates over any unsigned counter type, which is how the explicit-state tests run
 * the shipped code with 8-bit counters. GeneClock and align() are thin wrappers around these
 * functions: there is no second implementation.
 *
 * No allocation, no I/O, no global state, no undefined behaviour on any input that meets the
 * stated preconditions.
 */
#ifndef GENE_CLOCKS_KERNEL_H
#define GENE_CLOCKS_KERNEL_H

#include <stdint.h>

#ifdef __cplusplus
#define GENE_CLOCKS_TYPE template <class gene_clocks_counter>
#define GENE_CLOCKS_FUNCTION template <class gene_clocks_counter> constexpr
#define GENE_CLOCKS_OF(type) type<gene_clocks_counter>
namespace gene_clocks::kernel {
#else
#define GENE_CLOCKS_TYPE
#define GENE_CLOCKS_FUNCTION static inline
#define GENE_CLOCKS_OF(type) struct type
typedef uint64_t gene_clocks_counter;
#endif

/* What a deployment fixes once. */
GENE_CLOCKS_TYPE struct gene_clocks_limits {
    gene_clocks_counter maximum; /* no stamp ever exceeds it; minting stops there */
    gene_clocks_counter block;   /* how far ahead of need a flush reserves counters */
    gene_clocks_counter window;  /* how far a received stamp may run ahead of the clock */
};

/* What changes. Invariant: next <= durable <= limits.maximum. */
GENE_CLOCKS_TYPE struct gene_clocks_state {
    gene_clocks_counter next;    /* the smallest counter that this robot may still use */
    gene_clocks_counter durable; /* on stable storage before anything leaves the robot */
};

/* Total order on marks: counter first, then robot (paper, section 3.1). */
GENE_CLOCKS_FUNCTION int gene_clocks_less(gene_clocks_counter counter_a, uint32_t robot_a,
                                          gene_clocks_counter counter_b, uint32_t robot_b) {
    return counter_a != counter_b ? counter_a < counter_b : robot_a < robot_b;
}

/* Raises `durable` to cover `next`, a block ahead where there is room. */
GENE_CLOCKS_FUNCTION void gene_clocks_reserve(GENE_CLOCKS_OF(gene_clocks_state) * state,
                                              const GENE_CLOCKS_OF(gene_clocks_limits) * limits) {
    if (state->next > state->durable) {
        state->durable = limits->block > (gene_clocks_counter)(limits->maximum - state->next)
                             ? limits->maximum
                             : (gene_clocks_counter)(state->next + limits->block);
    }
}

/* Takes `count` consecutive counters, all or none. Returns 1 and the first of them, or 0 and
 * changes nothing where fewer are left: a clock never wraps. */
GENE_CLOCKS_FUNCTION int gene_clocks_mint(GENE_CLOCKS_OF(gene_clocks_state) * state,
                                          const GENE_CLOCKS_OF(gene_clocks_limits) * limits,
                                          gene_clocks_counter count, gene_clocks_counter* first) {
    if (count > (gene_clocks_counter)(limits->maximum - state->next)) return 0;
    *first = state->next;
    state->next = (gene_clocks_counter)(state->next + count);
    gene_clocks_reserve(state, limits);
    return 1;
}

/* Reception of a stamp (the sender's next unused counter): maximum, no increment. Returns 1, or
 * 0 and changes nothing where the stamp lies beyond the maximum or the admission window. */
GENE_CLOCKS_FUNCTION int gene_clocks_observe(GENE_CLOCKS_OF(gene_clocks_state) * state,
                                             const GENE_CLOCKS_OF(gene_clocks_limits) * limits,
                                             gene_clocks_counter stamp) {
    if (stamp > limits->maximum) return 0;
    if (stamp > state->next) {
        if ((gene_clocks_counter)(stamp - state->next) > limits->window) return 0;
        state->next = stamp;
        gene_clocks_reserve(state, limits);
    }
    return 1;
}

/* After a crash only `durable` is left; the clock goes on from there. */
GENE_CLOCKS_FUNCTION void gene_clocks_restart(GENE_CLOCKS_OF(gene_clocks_state) * state) {
    state->next = state->durable;
}

#ifdef __cplusplus
} /* namespace gene_clocks::kernel */
#endif

#endif /* GENE_CLOCKS_KERNEL_H */
