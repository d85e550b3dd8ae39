// Two robots, two genes: what every consumer of the protocol does.
#include <cstddef>
#include <cstdio>
#include <gene_clocks/align.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <vector>

int main() {
    using namespace gene_clocks;
    GeneClock first{RobotId{1}};
    GeneClock second{RobotId{2}};

    const auto a = first.mint();
    if (!a || !second.observe(first.stamp())) return 1;
    const auto b = second.mint();
    if (!b || !(*a < *b)) return 1;

    std::size_t matching = 0;
    align(std::vector{*a, *b}, std::vector{*a}, [&](GeneMatch match, std::size_t, std::size_t) {
        matching += match == GeneMatch::matching;
    });
    std::printf("matching genes: %zu\n", matching);
    return matching == 1 ? 0 : 1;
}
