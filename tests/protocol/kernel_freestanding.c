/* Firmware's view: the kernel needs no library. */
#include <gene_clocks/kernel.h>

bool kernel_freestanding(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                         gene_clocks_counter* first);
bool kernel_freestanding(struct gene_clocks_state* state, const struct gene_clocks_limits* limits,
                         gene_clocks_counter* first) {
    return gene_clocks_start(state, limits, 0) && gene_clocks_mint(state, limits, 1, first);
}
