// A signed counter would overflow without a defined result.
#include "gene_clocks/gene_clock.hpp"
using namespace gene_clocks;
#ifdef MENDED
BasicGeneClock<unsigned> counting{RobotId{1}};
#else
BasicGeneClock<int> counting{RobotId{1}};  // must not compile
#endif
