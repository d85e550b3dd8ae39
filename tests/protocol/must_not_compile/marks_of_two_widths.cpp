// Marks of clocks with different counters have no common order.
#include "gene_clocks/innovation_number.hpp"
using namespace gene_clocks;
#ifdef MENDED
bool before(InnovationNumber a, InnovationNumber b) {
    return a < b;
}
#else
bool before(InnovationNumber a, BasicInnovationNumber<std::uint32_t> b) {
    return a < b;  // must not compile
}
#endif
