// A mark is ⟨counter, robot⟩, and neither can stand in the other's place.
#include "gene_clocks/innovation_number.hpp"
using namespace gene_clocks;
#ifdef MENDED
constexpr InnovationNumber mark{5, RobotId{7}};
#else
constexpr InnovationNumber mark{RobotId{7}, 5};  // must not compile
#endif
static_assert(mark.counter == 5);
