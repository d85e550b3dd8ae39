// A stamp is the next unused counter and no mark: to compare the two is to be off by one.
#include "gene_clocks/innovation_number.hpp"
using namespace gene_clocks;
#ifdef MENDED
bool is_older(Stamp a, Stamp b) {
    return a < b;
}
#else
bool is_older(Stamp a, InnovationNumber b) {
    return a < b;  // must not compile
}
#endif
