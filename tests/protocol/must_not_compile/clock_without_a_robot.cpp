#include "gene_clocks/gene_clock.hpp"
using namespace gene_clocks;
#ifdef MENDED
GeneClock nobody{RobotId{1}};
#else
GeneClock nobody;  // must not compile
#endif
