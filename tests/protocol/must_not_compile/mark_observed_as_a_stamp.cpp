// What is observed is the next unused counter, not the last used one.
#include "gene_clocks/gene_clock.hpp"
using namespace gene_clocks;
#ifdef MENDED
bool receive(GeneClock& clock, Stamp stamp, InnovationNumber) {
    return clock.observe(stamp);
}
#else
bool receive(GeneClock& clock, Stamp, InnovationNumber gene) {
    return clock.observe(gene);  // must not compile
}
#endif
