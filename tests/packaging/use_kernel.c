/* What firmware in C99 does with the installed kernel: two robots, two genes. */
#include <gene_clocks/kernel.h>
#include <stdint.h>

int main(void) {
    const struct gene_clocks_limits limits = {UINT64_MAX, 0, UINT64_MAX};
    struct gene_clocks_state first;
    struct gene_clocks_state second;
    struct gene_clocks_mark a = {0, 1};
    struct gene_clocks_mark b = {0, 2};

    if (!gene_clocks_start(&first, &limits, 0) || !gene_clocks_start(&second, &limits, 0)) return 1;
    if (!gene_clocks_mint(&first, &limits, 1, &a.counter)) return 1;
    if (!gene_clocks_observe(&second, &limits, first.next)) return 1;
    if (!gene_clocks_mint(&second, &limits, 1, &b.counter)) return 1;
    return gene_clocks_less(a, b) && !gene_clocks_less(b, a) ? 0 : 1;
}
