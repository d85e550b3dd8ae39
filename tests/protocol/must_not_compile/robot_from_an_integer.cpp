// A number does not become a robot by itself.
#include "gene_clocks/gene_clock.hpp"
using namespace gene_clocks;
#ifdef MENDED
GeneClock clock_of_seven(RobotId{7});
#else
GeneClock clock_of_seven(7);  // must not compile
#endif
