#include "gene_clocks/gene_clock.hpp"
using namespace gene_clocks;
#ifdef MENDED
bool receive(GeneClock& clock, std::uint64_t counter) {
    return clock.observe(Stamp{counter});
}
#else
bool receive(GeneClock& clock, std::uint64_t counter) {
    return clock.observe(counter);  // must not compile
}
#endif
