// Two clocks of one robot would make the same marks.
#include "gene_clocks/gene_clock.hpp"
using namespace gene_clocks;
#ifdef MENDED
GeneClock look_ahead(const GeneClock& clock) {
    auto ahead = clock.clone();
    return ahead;
}
#else
GeneClock look_ahead(const GeneClock& clock) {
    auto ahead = clock;  // must not compile
    return ahead;
}
#endif
