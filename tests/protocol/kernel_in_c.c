#include "tests/protocol/kernel_in_c.h"

#include <gene_clocks/kernel.h>
#include <stdlib.h>

static struct gene_clocks_limits limits_of(const struct c_clock* clock) {
    struct gene_clocks_limits limits = {clock->maximum, clock->block, clock->window};
    return limits;
}

static struct gene_clocks_state state_of(const struct c_clock* clock) {
    struct gene_clocks_state state = {clock->next, clock->durable};
    return state;
}

static int keep(struct c_clock* clock, struct gene_clocks_state state, bool result) {
    clock->next = state.next;
    clock->durable = state.durable;
    return result;
}

static struct gene_clocks_mark mark_of(struct c_mark mark) {
    struct gene_clocks_mark result = {mark.counter, mark.robot};
    return result;
}

/* The caller's to free. */
static struct gene_clocks_mark* marks_of(const struct c_mark* genome, size_t size) {
    struct gene_clocks_mark* marks = malloc((size + 1) * sizeof *marks);
    if (marks == NULL) abort();
    for (size_t i = 0; i < size; ++i) marks[i] = mark_of(genome[i]);
    return marks;
}

int c_less(struct c_mark a, struct c_mark b) {
    return gene_clocks_less(mark_of(a), mark_of(b));
}

int c_start(struct c_clock* clock, uint64_t genesis_count) {
    const struct gene_clocks_limits limits = limits_of(clock);
    struct gene_clocks_state state = state_of(clock);
    const bool result = gene_clocks_start(&state, &limits, genesis_count);
    return keep(clock, state, result);
}

int c_restore(struct c_clock* clock, uint64_t next, uint64_t durable) {
    const struct gene_clocks_limits limits = limits_of(clock);
    struct gene_clocks_state state = state_of(clock);
    const bool result = gene_clocks_restore(&state, &limits, next, durable);
    return keep(clock, state, result);
}

int c_restart(struct c_clock* clock, uint64_t genesis_count, uint64_t stored) {
    const struct gene_clocks_limits limits = limits_of(clock);
    struct gene_clocks_state state = state_of(clock);
    const bool result = gene_clocks_restart(&state, &limits, genesis_count, stored);
    return keep(clock, state, result);
}

int c_mint(struct c_clock* clock, uint64_t count, uint64_t* first) {
    const struct gene_clocks_limits limits = limits_of(clock);
    struct gene_clocks_state state = state_of(clock);
    const bool result = gene_clocks_mint(&state, &limits, count, first);
    return keep(clock, state, result);
}

int c_observe(struct c_clock* clock, uint64_t stamp) {
    const struct gene_clocks_limits limits = limits_of(clock);
    struct gene_clocks_state state = state_of(clock);
    const bool result = gene_clocks_observe(&state, &limits, stamp);
    return keep(clock, state, result);
}

int c_covers(uint64_t stamp, const struct c_mark* genome, size_t size) {
    struct gene_clocks_mark* marks = marks_of(genome, size);
    const bool result = gene_clocks_covers(stamp, marks, size);
    free(marks);
    return result;
}

size_t c_find_unmade(uint64_t next, uint32_t robot, const struct c_mark* genome, size_t size) {
    struct gene_clocks_mark* marks = marks_of(genome, size);
    const size_t result = gene_clocks_find_unmade(next, robot, marks, size);
    free(marks);
    return result;
}

void c_earn(uint64_t* allowance, uint64_t counters, uint64_t ceiling) {
    gene_clocks_earn(allowance, counters, ceiling);
}

int c_admit(struct c_clock* clock, uint64_t* allowance, uint64_t stamp) {
    const struct gene_clocks_limits limits = limits_of(clock);
    struct gene_clocks_state state = state_of(clock);
    const enum gene_clocks_admission result = gene_clocks_admit(&state, &limits, allowance, stamp);
    keep(clock, state, true);
    return (int)result;
}

struct recorder {
    struct c_visit* visits;
    size_t size;
};

static void record(void* context, enum gene_clocks_match match, size_t first, size_t second) {
    struct recorder* recorder = context;
    struct c_visit visit = {(int)match, first, second};
    recorder->visits[recorder->size++] = visit;
}

size_t c_align(const struct c_mark* first, size_t first_size, const struct c_mark* second,
               size_t second_size, struct c_visit* visits) {
    struct recorder recorder = {visits, 0};
    const struct gene_clocks_visitor visitor = {record, &recorder};
    struct gene_clocks_mark* a = marks_of(first, first_size);
    struct gene_clocks_mark* b = marks_of(second, second_size);
    gene_clocks_align(a, first_size, b, second_size, &visitor);
    free(a);
    free(b);
    return recorder.size;
}
