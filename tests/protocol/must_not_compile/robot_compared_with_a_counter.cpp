#include "gene_clocks/innovation_number.hpp"
using namespace gene_clocks;
#ifdef MENDED
bool same(InnovationNumber a, InnovationNumber b) {
    return a.robot == b.robot;
}
#else
bool same(InnovationNumber a, InnovationNumber b) {
    return a.robot == b.counter;  // must not compile
}
#endif
