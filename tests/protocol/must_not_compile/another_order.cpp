// Alignment runs in the order of innovation numbers and in no other, say one by robot first.
#include <vector>

#include "gene_clocks/align.hpp"
using namespace gene_clocks;
struct RobotFirst {
    InnovationNumber mark;
    friend auto operator<=>(RobotFirst a, RobotFirst b) { return a.mark.robot <=> b.mark.robot; }
    friend bool operator==(RobotFirst a, RobotFirst b) = default;
};
void align_by_robot(const std::vector<RobotFirst>& a, const std::vector<RobotFirst>& b) {
    const auto visit = [](GeneMatch, std::size_t, std::size_t) {};
#ifdef MENDED
    align(a, b, visit, &RobotFirst::mark);
#else
    align(a, b, visit);  // must not compile
#endif
}
