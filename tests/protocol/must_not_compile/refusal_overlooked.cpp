// A refused message has to be dropped, so the answer cannot be ignored.
#include "gene_clocks/gene_clock.hpp"
using namespace gene_clocks;
#ifdef MENDED
bool receive(GeneClock& clock, Stamp stamp) {
    return clock.observe(stamp);
}
#else
void receive(GeneClock& clock, Stamp stamp) {
    clock.observe(stamp);  // must not compile
}
#endif
