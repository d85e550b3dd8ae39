// A robot does not become a number by itself.
#include "gene_clocks/innovation_number.hpp"
using namespace gene_clocks;
#ifdef MENDED
std::uint64_t counter_of(InnovationNumber mark) {
    return mark.counter;
}
#else
std::uint64_t counter_of(InnovationNumber mark) {
    return mark.robot;  // must not compile
}
#endif
