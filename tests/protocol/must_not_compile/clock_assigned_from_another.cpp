// Nor may a clock become the copy of another one by assignment.
#include <utility>

#include "gene_clocks/gene_clock.hpp"
using namespace gene_clocks;
#ifdef MENDED
void hand_on(GeneClock& to, GeneClock& from) {
    to = std::move(from);
}
#else
void hand_on(GeneClock& to, GeneClock& from) {
    to = from;  // must not compile
}
#endif
