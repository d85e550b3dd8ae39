/* What follows from the contracts of the kernel for a caller that strings its functions together.
 *
 * Every function here is a claim: its contract is proved from the contracts of the kernel's
 * functions alone. It runs nowhere. */
#include <gene_clocks/kernel.h>

/* Coq: new_gene_is_last, clock_condition (the step from reception to creation). What a robot mints
 * after it has observed a message sorts after every gene of the message and after all that it has
 * minted before. */
/*@ requires usable(state, limits) && \valid(old_mark) && \valid(new_mark);
    requires \separated(state, limits, old_mark, new_mark);
    requires readable(genome, size) && \separated(genome + (0 .. size - 1), state, old_mark, new_mark);
    assigns *state, *old_mark, *new_mark;
    ensures \result ==> usable(state, limits);
    ensures \result ==> \forall integer k; 0 <= k < size ==>
        \forall struct gene_clocks_mark mark; mark.counter == *new_mark ==> below(genome[k], mark);
    ensures \result ==> *old_mark < *new_mark; */
bool mint_after_reception(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                          gene_clocks_counter stamp, const struct gene_clocks_mark* genome,
                          size_t size, gene_clocks_counter* old_mark,
                          gene_clocks_counter* new_mark) {
    return gene_clocks_mint(state, limits, 1, old_mark) &&
           gene_clocks_covers(stamp, genome, size) && gene_clocks_observe(state, limits, stamp) &&
           gene_clocks_mint(state, limits, 1, new_mark);
}

/* Coq: mint_all_or_nothing, marks_unique (on one robot). Two mints give ranges that do not meet. */
/*@ requires usable(state, limits) && \valid(first) && \valid(second);
    requires \separated(state, limits, first, second);
    assigns *state, *first, *second;
    ensures \result ==> *first + count <= *second;
    ensures \result ==> *second + count <= limits->maximum; */
bool mint_twice(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                gene_clocks_counter count, gene_clocks_counter* first,
                gene_clocks_counter* second) {
    return gene_clocks_mint(state, limits, count, first) &&
           gene_clocks_mint(state, limits, count, second);
}

/* Coq: restart_is_safe, nothing_sent_is_forgotten. What was durable when something was sent is
 * enough: after a restart from it, or from anything later, no counter that had been minted before
 * the sending comes again, and the stamp does not fall. */
/*@ requires usable(state, limits) && \valid(before) && \valid(after);
    requires \separated(state, limits, before, after);
    assigns *state, *before, *after;
    ensures \result ==> *before < *after; */
bool restart_between_mints(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                           gene_clocks_counter genesis_count, gene_clocks_counter stored,
                           gene_clocks_counter* before, gene_clocks_counter* after) {
    return gene_clocks_mint(state, limits, 1, before) && stored >= state->durable &&
           gene_clocks_restart(state, limits, genesis_count, stored) && gene_clocks_mint(state, limits, 1, after);
}

/* Coq: lt_strict_total. */
/*@ lemma below_irreflexive: \forall struct gene_clocks_mark a; !below(a, a);
    lemma below_transitive: \forall struct gene_clocks_mark a, b, c;
      below(a, b) && below(b, c) ==> below(a, c);
    lemma below_total: \forall struct gene_clocks_mark a, b;
      below(a, b) || same(a, b) || below(b, a);
    lemma below_is_one_way: \forall struct gene_clocks_mark a, b;
      below(a, b) ==> !same(a, b) && !below(b, a);
    lemma counter_decides: \forall struct gene_clocks_mark a, b;
      a.counter < b.counter ==> below(a, b); */

/* Coq: align_sound. What the kernel tells a visitor has the meaning that the paper gives it. */
/*@ lemma disjoint_or_excess_is_absent:
      \forall struct gene_clocks_mark mark, struct gene_clocks_mark* genome, integer size, rank, k;
      apart(mark, genome, size, rank) && 0 <= k < size ==> !same(mark, genome[k]);
    lemma disjoint_is_below_the_last:
      \forall struct gene_clocks_mark mark, struct gene_clocks_mark* genome, integer size, rank;
      apart(mark, genome, size, rank) && rank < size ==> below(mark, genome[size - 1]);
    lemma excess_is_beyond_the_last:
      \forall struct gene_clocks_mark mark, struct gene_clocks_mark* genome, integer size;
      apart(mark, genome, size, size) && size > 0 ==> below(genome[size - 1], mark); */
