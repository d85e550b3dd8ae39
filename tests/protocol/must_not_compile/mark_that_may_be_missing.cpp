// A clock can be exhausted, so a caller has to look before it uses a mark.
#include "gene_clocks/gene_clock.hpp"
using namespace gene_clocks;
#ifdef MENDED
std::optional<InnovationNumber> mark_gene(GeneClock& clock) {
    return clock.mint();
}
#else
InnovationNumber mark_gene(GeneClock& clock) {
    return clock.mint();  // must not compile
}
#endif
