/* The arithmetic of a gene clock, in C99 and in constexpr C++20 at once.
 *
 * C firmware includes this header as it is and gets 64-bit counters. C++ gets the same text as
 * function templates over any unsigned counter type, which is how the explicit-state tests run
 * the shipped code with 8-bit counters. GeneClock, InnovationNumber and align() are thin wrappers
 * around these functions: there is no second implementation of any of this in protocol/. (The
 * distance of neat/ counts unmatched genes by a merge of its own, for speed; tests/oracle compares
 * it with the proved alignment.)
 *
 * The comments that begin with an at sign are contracts in ACSL. Frama-C proves that every
 * function keeps its contract for all inputs, without overflow or invalid access
 * (proofs/kernel/prove); only of gene_clocks_visit, which calls what the user brings, it is
 * assumed. Each contract names the step of the Coq model (proofs/theories) that it mirrors, if
 * there is one.
 *
 * No allocation, no I/O, no global state, no undefined behaviour on any input that meets the
 * stated preconditions.
 */
#ifndef GENE_CLOCKS_KERNEL_H
#define GENE_CLOCKS_KERNEL_H

#include <stddef.h>
#include <stdint.h>

/* clang-format off */
#ifdef __cplusplus
#define GENE_CLOCKS_TYPE template <class gene_clocks_counter>
#define GENE_CLOCKS_FUNCTION template <class gene_clocks_counter> constexpr
#define GENE_CLOCKS_OF(type) type<gene_clocks_counter>
#define GENE_CLOCKS_OVER_MARKS constexpr
#define GENE_CLOCKS_MARKS auto&   /* anything that marks[index] reads a mark from */
#define GENE_CLOCKS_VISITOR auto& /* anything to call with a match and two indices */
namespace gene_clocks::kernel {
#else
#include <stdbool.h>
#define GENE_CLOCKS_TYPE
#define GENE_CLOCKS_FUNCTION static inline
#define GENE_CLOCKS_OF(type) struct type
#define GENE_CLOCKS_OVER_MARKS static inline
#define GENE_CLOCKS_MARKS const struct gene_clocks_mark*
#define GENE_CLOCKS_VISITOR const struct gene_clocks_visitor*
typedef uint64_t gene_clocks_counter;
#endif
/* clang-format on */

/* ---- Types ---------------------------------------------------------------------------------- */

/* The mark of a gene: the paper's <r, c_r>. Robot 0 is reserved for the initial genes. */
GENE_CLOCKS_TYPE struct gene_clocks_mark {
    gene_clocks_counter counter;
    uint32_t robot;
};

/* What a deployment fixes once. */
GENE_CLOCKS_TYPE struct gene_clocks_limits {
    gene_clocks_counter maximum; /* no stamp ever exceeds it; minting stops there */
    gene_clocks_counter block;   /* how far ahead of need a flush reserves counters */
    gene_clocks_counter window;  /* how far a received stamp may run ahead of the clock */
};

/* What changes. Invariant: 1 <= next <= durable <= limits.maximum. */
GENE_CLOCKS_TYPE struct gene_clocks_state {
    gene_clocks_counter next;    /* the smallest counter that this robot may still use */
    gene_clocks_counter durable; /* on stable storage before anything leaves the robot */
};

/* How a gene stands in the alignment of two genomes (paper, section 3.2). */
enum gene_clocks_match {
    gene_clocks_matching,        /* the mark is in both genomes */
    gene_clocks_disjoint_first,  /* only in the first, below the second's last mark */
    gene_clocks_disjoint_second, /* only in the second, below the first's last mark */
    gene_clocks_excess_first,    /* only in the first, beyond the second's last mark */
    gene_clocks_excess_second    /* only in the second, beyond the first's last mark */
};

/* What becomes of a received message. All but the first are refusals, and change nothing. */
enum gene_clocks_admission {
    gene_clocks_admitted,
    gene_clocks_beyond_maximum,   /* the stamp exceeds what all robots agreed on */
    gene_clocks_beyond_window,    /* the stamp leaps further than one message may */
    gene_clocks_beyond_allowance, /* the stamp leaps further than has been earned by now */
    gene_clocks_gene_not_covered, /* a gene does not lie below the stamp: forged or damaged */
    gene_clocks_identity_conflict /* a gene bears this robot's id, but this robot never made it */
};

#ifndef __cplusplus
/* What gene_clocks_align() calls for every gene, with the context that the caller gave. It must
 * leave both genomes alone. In C++ it is anything that can be called with the other three. */
struct gene_clocks_visitor {
    void (*gene)(void* context, enum gene_clocks_match match, size_t first, size_t second);
    void* context;
};
#endif

/* ---- The vocabulary of the contracts -------------------------------------------------------- */

/*@ predicate below(struct gene_clocks_mark a, struct gene_clocks_mark b) =
      a.counter < b.counter || (a.counter == b.counter && a.robot < b.robot);

    predicate same(struct gene_clocks_mark a, struct gene_clocks_mark b) =
      a.counter == b.counter && a.robot == b.robot;

    predicate usable(struct gene_clocks_state* state, struct gene_clocks_limits* limits) =
      \valid(state) && \valid_read(limits) && \separated(state, limits) &&
      1 <= state->next <= state->durable <= limits->maximum;

    logic integer reserved(integer next, integer durable, struct gene_clocks_limits* limits) =
      next <= durable ? durable : \min(next + limits->block, limits->maximum);

    predicate unmade(struct gene_clocks_mark mark, integer next, integer robot) =
      mark.robot == robot && mark.counter >= next;

    predicate readable(struct gene_clocks_mark* genome, integer size) =
      \valid_read(genome + (0 .. size - 1));

    predicate sorted(struct gene_clocks_mark* genome, integer size) =
      \forall integer i, j; 0 <= i < j < size ==> below(genome[i], genome[j]);

    lemma below_head_below_tail:
      \forall struct gene_clocks_mark mark, struct gene_clocks_mark* genome, integer size, head, k;
      sorted(genome, size) && 0 <= head <= k < size && below(mark, genome[head]) ==>
      below(mark, genome[k]);

    predicate split(struct gene_clocks_mark* first, integer first_size,
                    struct gene_clocks_mark* second, integer second_size,
                    integer i, integer j) =
      0 <= i <= first_size && 0 <= j <= second_size &&
      (\forall integer p, q; 0 <= p < i && j <= q < second_size ==> below(first[p], second[q])) &&
      (\forall integer p, q; i <= p < first_size && 0 <= q < j ==> below(second[q], first[p]));

    predicate apart(struct gene_clocks_mark mark,
                    struct gene_clocks_mark* genome, integer size, integer rank) =
      0 <= rank <= size &&
      (\forall integer k; 0 <= k < rank ==> below(genome[k], mark)) &&
      (\forall integer k; rank <= k < size ==> below(mark, genome[k]));

    logic integer in_first(integer match) =
      match == gene_clocks_matching || match == gene_clocks_disjoint_first ||
      match == gene_clocks_excess_first ? 1 : 0;

    logic integer in_second(integer match) =
      match == gene_clocks_matching || match == gene_clocks_disjoint_second ||
      match == gene_clocks_excess_second ? 1 : 0;

    predicate stands(integer match,
                     struct gene_clocks_mark* first, integer first_size,
                     struct gene_clocks_mark* second, integer second_size,
                     integer i, integer j) =
      i + in_first(match) <= first_size && j + in_second(match) <= second_size &&
      (match == gene_clocks_matching ==> same(first[i], second[j])) &&
      (match == gene_clocks_disjoint_first ==>
         j < second_size && apart(first[i], second, second_size, j)) &&
      (match == gene_clocks_disjoint_second ==>
         i < first_size && apart(second[j], first, first_size, i)) &&
      (match == gene_clocks_excess_first ==>
         j == second_size && apart(first[i], second, second_size, second_size)) &&
      (match == gene_clocks_excess_second ==>
         i == first_size && apart(second[j], first, first_size, first_size)); */

/* ---- Order ---------------------------------------------------------------------------------- */

/* Total order on marks: counter first, then robot (paper, section 3.1). */
/*@ // Coq: Mark.mark_lt
    assigns \nothing;
    ensures \result <==> below(a, b); */
GENE_CLOCKS_FUNCTION bool gene_clocks_less(GENE_CLOCKS_OF(gene_clocks_mark) a,
                                           GENE_CLOCKS_OF(gene_clocks_mark) b) {
    return a.counter != b.counter ? a.counter < b.counter : a.robot < b.robot;
}

/*@ // Coq: Mark.mark_eqb
    assigns \nothing;
    ensures \result <==> same(a, b); */
GENE_CLOCKS_FUNCTION bool gene_clocks_equal(GENE_CLOCKS_OF(gene_clocks_mark) a,
                                            GENE_CLOCKS_OF(gene_clocks_mark) b) {
    return a.counter == b.counter && a.robot == b.robot;
}

/* ---- Clock ---------------------------------------------------------------------------------- */

/* Takes up a state: a stored one, or the one that another clock was left in. Returns false, and
 * changes nothing, where it breaks the invariant of gene_clocks_state. */
/*@ // Coq: Clock.restore
    requires \valid(state) && \valid_read(limits) && \separated(state, limits);
    assigns *state;
    ensures \result <==> 1 <= next <= durable <= limits->maximum;
    ensures \result ==> usable(state, limits) && state->next == next && state->durable == durable;
    ensures !\result ==> *state == \old(*state); */
GENE_CLOCKS_FUNCTION bool gene_clocks_restore(GENE_CLOCKS_OF(gene_clocks_state) * state,
                                              const GENE_CLOCKS_OF(gene_clocks_limits) * limits,
                                              gene_clocks_counter next,
                                              gene_clocks_counter durable) {
    if (next == 0 || next > durable || durable > limits->maximum) return false;
    state->next = next;
    state->durable = durable;
    return true;
}

/* Starts a clock above the genesis marks 1 ... genesis_count. Returns false, and changes nothing,
 * where these leave no counter to mint. */
/*@ // Coq: Clock.start
    requires \valid(state) && \valid_read(limits) && \separated(state, limits);
    assigns *state;
    ensures \result <==> genesis_count < limits->maximum;
    ensures \result ==> usable(state, limits) && state->next == state->durable == genesis_count + 1;
    ensures !\result ==> *state == \old(*state); */
GENE_CLOCKS_FUNCTION bool gene_clocks_start(GENE_CLOCKS_OF(gene_clocks_state) * state,
                                            const GENE_CLOCKS_OF(gene_clocks_limits) * limits,
                                            gene_clocks_counter genesis_count) {
    if (genesis_count >= limits->maximum) return false;
    const gene_clocks_counter next = (gene_clocks_counter)(genesis_count + 1);
    return gene_clocks_restore(state, limits, next, next);
}

/* Goes on after a crash, of which only the durable counter is left: no counter below it is used
 * again. Returns false, and changes nothing, where no clock of this deployment stored it: among its
 * genesis marks, as in a store that was made for fewer of them, or beyond its maximum. */
/*@ // Coq: Clock.restart
    requires \valid(state) && \valid_read(limits) && \separated(state, limits);
    assigns *state;
    ensures \result <==> genesis_count < stored <= limits->maximum;
    ensures \result ==> usable(state, limits) && state->next == state->durable == stored;
    ensures !\result ==> *state == \old(*state); */
GENE_CLOCKS_FUNCTION bool gene_clocks_restart(GENE_CLOCKS_OF(gene_clocks_state) * state,
                                              const GENE_CLOCKS_OF(gene_clocks_limits) * limits,
                                              gene_clocks_counter genesis_count,
                                              gene_clocks_counter stored) {
    return stored > genesis_count && gene_clocks_restore(state, limits, stored, stored);
}

/* Raises `durable` to cover `next`, a block ahead where there is room. */
/*@ // Coq: Clock.reserve
    requires \valid(state) && \valid_read(limits) && \separated(state, limits);
    requires state->next <= limits->maximum;
    assigns state->durable;
    ensures state->durable == reserved(state->next, \old(state->durable), limits); */
GENE_CLOCKS_FUNCTION void gene_clocks_reserve(GENE_CLOCKS_OF(gene_clocks_state) * state,
                                              const GENE_CLOCKS_OF(gene_clocks_limits) * limits) {
    if (state->next > state->durable) {
        const gene_clocks_counter room = (gene_clocks_counter)(limits->maximum - state->next);
        state->durable = limits->block < room ? (gene_clocks_counter)(state->next + limits->block)
                                              : limits->maximum;
    }
}

/* Takes `count` consecutive counters, all or none. Returns true and the first of them, or false
 * where fewer are left, and changes nothing: a clock never wraps. */
/*@ // Coq: Clock.mint
    requires usable(state, limits) && \valid(first);
    requires \separated(state, first) && \separated(limits, first);
    assigns *state, *first;
    ensures usable(state, limits);
    behavior minted:
      assumes state->next + count <= limits->maximum;
      ensures \result && *first == \old(state->next);
      ensures state->next == \old(state->next) + count;
      ensures state->durable == reserved(state->next, \old(state->durable), limits);
    behavior exhausted:
      assumes state->next + count > limits->maximum;
      assigns \nothing;
      ensures !\result;
    complete behaviors;
    disjoint behaviors; */
GENE_CLOCKS_FUNCTION bool gene_clocks_mint(GENE_CLOCKS_OF(gene_clocks_state) * state,
                                           const GENE_CLOCKS_OF(gene_clocks_limits) * limits,
                                           gene_clocks_counter count, gene_clocks_counter* first) {
    if (count > (gene_clocks_counter)(limits->maximum - state->next)) return false;
    *first = state->next;
    state->next = (gene_clocks_counter)(state->next + count);
    gene_clocks_reserve(state, limits);
    return true;
}

/* Reception of a stamp, the sender's next unused counter: maximum, no increment. Returns false
 * where the stamp lies beyond the maximum or the window, and changes nothing: the message must
 * then be dropped whole. */
/*@ // Coq: Clock.observe
    requires usable(state, limits);
    assigns *state;
    ensures usable(state, limits);
    behavior admitted:
      assumes stamp <= limits->maximum && stamp <= state->next + limits->window;
      ensures \result && state->next == \max(\old(state->next), stamp);
      ensures state->durable == reserved(state->next, \old(state->durable), limits);
    behavior refused:
      assumes stamp > limits->maximum || stamp > state->next + limits->window;
      assigns \nothing;
      ensures !\result;
    complete behaviors;
    disjoint behaviors; */
GENE_CLOCKS_FUNCTION bool gene_clocks_observe(GENE_CLOCKS_OF(gene_clocks_state) * state,
                                              const GENE_CLOCKS_OF(gene_clocks_limits) * limits,
                                              gene_clocks_counter stamp) {
    if (stamp > limits->maximum) return false;
    if (stamp > state->next) {
        if ((gene_clocks_counter)(stamp - state->next) > limits->window) return false;
        state->next = stamp;
        gene_clocks_reserve(state, limits);
    }
    return true;
}

/* Whether every gene lies below the stamp that came with it, as in every message of a robot that
 * keeps the protocol. To be asked before gene_clocks_observe where a message may be forged. */
/*@ // Coq: Protocol.credible
    requires readable(genome, size);
    assigns \nothing;
    ensures \result <==> \forall integer k; 0 <= k < size ==> genome[k].counter < stamp; */
GENE_CLOCKS_FUNCTION bool gene_clocks_covers(gene_clocks_counter stamp, GENE_CLOCKS_MARKS genome,
                                             size_t size) {
    /*@ loop invariant 0 <= index <= size;
        loop invariant \forall integer k; 0 <= k < index ==> genome[k].counter < stamp;
        loop assigns index;
        loop variant size - index; */
    for (size_t index = 0; index < size; ++index) {
        if (genome[index].counter >= stamp) return false;
    }
    return true;
}

/* The index of the first gene that bears this robot's id with a counter that the robot has not used
 * yet, or `size`. Such a gene proves that another robot has the same id, that this one's storage
 * was set back, or that the message is forged. To be asked before gene_clocks_observe, which would
 * hide the difference. */
/*@ // Coq: Admission.unmade
    requires readable(genome, size);
    assigns \nothing;
    ensures 0 <= \result <= size;
    ensures \forall integer k; 0 <= k < \result ==> !unmade(genome[k], next, robot);
    ensures \result < size ==> unmade(genome[\result], next, robot); */
GENE_CLOCKS_FUNCTION size_t gene_clocks_find_unmade(gene_clocks_counter next, uint32_t robot,
                                                    GENE_CLOCKS_MARKS genome, size_t size) {
    /*@ loop invariant 0 <= index <= size;
        loop invariant \forall integer k; 0 <= k < index ==> !unmade(genome[k], next, robot);
        loop assigns index;
        loop variant size - index; */
    for (size_t index = 0; index < size; ++index) {
        if (genome[index].robot == robot && genome[index].counter >= next) return index;
    }
    return size;
}

/* ---- Allowance ------------------------------------------------------------------------------ */

/* An allowance is the number of counters that receptions may still add to a clock. It grows with
 * time, by what the whole fleet may use up meanwhile, and never beyond `ceiling`. */
/*@ // Coq: Admission.earn
    requires \valid(allowance) && *allowance <= ceiling;
    assigns *allowance;
    ensures *allowance == \min(\old(*allowance) + counters, ceiling); */
GENE_CLOCKS_FUNCTION void gene_clocks_earn(gene_clocks_counter* allowance,
                                           gene_clocks_counter counters,
                                           gene_clocks_counter ceiling) {
    *allowance = counters < (gene_clocks_counter)(ceiling - *allowance)
                     ? (gene_clocks_counter)(*allowance + counters)
                     : ceiling;
}

/* Reception of a stamp, as gene_clocks_observe, that is also paid for out of the allowance. The sum
 * of clock and allowance stays as it is. */
/*@ // Coq: Admission.accept
    requires usable(state, limits) && \valid(allowance);
    requires \separated(allowance, state, limits);
    assigns *state, *allowance;
    ensures usable(state, limits);
    behavior above_all:
      assumes stamp > limits->maximum;
      assigns \nothing;
      ensures \result == gene_clocks_beyond_maximum;
    behavior too_far:
      assumes stamp <= limits->maximum && stamp > state->next + limits->window;
      assigns \nothing;
      ensures \result == gene_clocks_beyond_window;
    behavior too_early:
      assumes stamp <= limits->maximum && stamp <= state->next + limits->window;
      assumes stamp > state->next + *allowance;
      assigns \nothing;
      ensures \result == gene_clocks_beyond_allowance;
    behavior admitted:
      assumes stamp <= limits->maximum && stamp <= state->next + limits->window;
      assumes stamp <= state->next + *allowance;
      ensures \result == gene_clocks_admitted;
      ensures state->next == \max(\old(state->next), stamp);
      ensures state->durable == reserved(state->next, \old(state->durable), limits);
      ensures state->next + *allowance == \old(state->next) + \old(*allowance);
    complete behaviors;
    disjoint behaviors; */
GENE_CLOCKS_FUNCTION enum gene_clocks_admission gene_clocks_admit(
    GENE_CLOCKS_OF(gene_clocks_state) * state, const GENE_CLOCKS_OF(gene_clocks_limits) * limits,
    gene_clocks_counter* allowance, gene_clocks_counter stamp) {
    if (stamp > limits->maximum) return gene_clocks_beyond_maximum;
    const gene_clocks_counter leap =
        (gene_clocks_counter)(stamp > state->next ? stamp - state->next : 0);
    if (leap > limits->window) return gene_clocks_beyond_window;
    if (leap > *allowance) return gene_clocks_beyond_allowance;
    *allowance = (gene_clocks_counter)(*allowance - leap);
    gene_clocks_observe(state, limits, stamp);
    return gene_clocks_admitted;
}

/* ---- Alignment ------------------------------------------------------------------------------ */

#ifdef __cplusplus
constexpr void gene_clocks_visit(auto& visit, enum gene_clocks_match match, size_t first,
                                 size_t second) {
    visit(match, first, second);
}
#else
/*@ ghost const struct gene_clocks_mark* aligned_first;  */ /* what is being aligned */
/*@ ghost const struct gene_clocks_mark* aligned_second; */
/*@ ghost size_t aligned_first_size;                     */
/*@ ghost size_t aligned_second_size;                    */
/*@ ghost size_t visited_first;                          */ /* genes visited so far */
/*@ ghost size_t visited_second;                         */
/*@ requires \valid_read(visit);
    requires in_turn: first == visited_first && second == visited_second;
    requires as_told: stands(match, aligned_first, aligned_first_size,
                             aligned_second, aligned_second_size, first, second);
    assigns visited_first, visited_second;
    ensures visited_first == first + in_first(match);
    ensures visited_second == second + in_second(match); */
static inline void gene_clocks_visit(const struct gene_clocks_visitor* visit,
                                     enum gene_clocks_match match, size_t first, size_t second) {
    visit->gene(visit->context, match, first, second);
}
#endif

/* Visits every gene of two sorted genomes once, in mark order, and says how it stands. The index
 * on the other side is the number of genes of the other genome that lie before it. */
/*@ // Coq: Alignment.align
    requires readable(first, first_size) && sorted(first, first_size);
    requires readable(second, second_size) && sorted(second, second_size);
    requires \valid_read(visit);
    assigns aligned_first \from first;
    assigns aligned_second \from second;
    assigns aligned_first_size, aligned_second_size;
    assigns visited_first, visited_second;
    ensures each_once: visited_first == first_size;
    ensures each_once: visited_second == second_size; */
GENE_CLOCKS_OVER_MARKS void gene_clocks_align(GENE_CLOCKS_MARKS first, size_t first_size,
                                              GENE_CLOCKS_MARKS second, size_t second_size,
                                              GENE_CLOCKS_VISITOR visit) {
    size_t i = 0;
    size_t j = 0;
    /*@ ghost aligned_first = first, aligned_first_size = first_size; */
    /*@ ghost aligned_second = second, aligned_second_size = second_size; */
    /*@ ghost visited_first = visited_second = 0; */
    /*@ loop invariant visited_first == i && visited_second == j;
        loop invariant split(first, first_size, second, second_size, i, j);
        loop assigns i, j, visited_first, visited_second;
        loop variant first_size - i + second_size - j; */
    while (i < first_size && j < second_size) {
        if (gene_clocks_equal(first[i], second[j])) {
            gene_clocks_visit(visit, gene_clocks_matching, i, j);
            ++i;
            ++j;
        } else if (gene_clocks_less(first[i], second[j])) {
            gene_clocks_visit(visit, gene_clocks_disjoint_first, i, j);
            ++i;
        } else {
            gene_clocks_visit(visit, gene_clocks_disjoint_second, i, j);
            ++j;
        }
    }
    /*@ loop invariant visited_first == i && visited_second == j;
        loop invariant split(first, first_size, second, second_size, i, j);
        loop invariant i < first_size ==> j == second_size;
        loop assigns i, visited_first, visited_second;
        loop variant first_size - i; */
    for (; i < first_size; ++i) gene_clocks_visit(visit, gene_clocks_excess_first, i, j);
    /*@ loop invariant visited_first == i == first_size;
        loop invariant visited_second == j;
        loop invariant split(first, first_size, second, second_size, i, j);
        loop assigns j, visited_first, visited_second;
        loop variant second_size - j; */
    for (; j < second_size; ++j) gene_clocks_visit(visit, gene_clocks_excess_second, i, j);
}

#ifdef __cplusplus
} /* namespace gene_clocks::kernel */
#endif

#undef GENE_CLOCKS_TYPE
#undef GENE_CLOCKS_FUNCTION
#undef GENE_CLOCKS_OF
#undef GENE_CLOCKS_OVER_MARKS
#undef GENE_CLOCKS_MARKS
#undef GENE_CLOCKS_VISITOR

#endif /* GENE_CLOCKS_KERNEL_H */
