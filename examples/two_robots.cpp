// Two robots, no coordinator: each marks genes by its own clock, and they hear each other once.
#include <cinttypes>
#include <cstddef>
#include <cstdio>
#include <gene_clocks/align.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <vector>

using namespace gene_clocks;

struct Gene {
    InnovationNumber mark;
    float weight;
};

int main() {
    // Both start from the same three genes, whose marks are 1…3 of robot 0.
    std::vector<Gene> ours, theirs;
    for (std::uint64_t counter = 1; counter <= 3; ++counter) {
        ours.push_back({{counter, genesis_robot}, 0.5f});
    }
    theirs = ours;
    GeneClock our_clock{RobotId{7}, /*genesis_count=*/3};
    GeneClock their_clock{RobotId{8}, /*genesis_count=*/3};

    // Each makes a gene without knowing of the other: both marks have counter 4 and yet differ.
    ours.push_back({*our_clock.mint(), 1.0f});
    theirs.push_back({*their_clock.mint(), -1.0f});

    // Their genome arrives here with their stamp, which our clock hears before anything else.
    if (!our_clock.observe(their_clock.stamp(), theirs, &Gene::mark)) return 1;

    // So what we make from now on sorts after what they had made.
    ours.push_back({*our_clock.mint(), 2.0f});
    if (!(theirs.back().mark < ours.back().mark)) return 1;

    const char* const names[] = {"matching", "disjoint, ours", "disjoint, theirs", "excess, ours",
                                 "excess, theirs"};
    int counts[5] = {};
    align(
        ours, theirs,
        [&](GeneMatch match, std::size_t i, std::size_t j) {
            const bool is_theirs =
                match == GeneMatch::disjoint_second || match == GeneMatch::excess_second;
            const InnovationNumber mark = is_theirs ? theirs[j].mark : ours[i].mark;
            std::printf("<%" PRIu64 ", %" PRIu32 "> %s\n", mark.counter,
                        static_cast<std::uint32_t>(mark.robot), names[static_cast<int>(match)]);
            ++counts[static_cast<int>(match)];
        },
        &Gene::mark);
    const bool as_expected = counts[0] == 3 && counts[1] == 1 && counts[2] == 1 && counts[3] == 1;
    return as_expected && counts[4] == 0 ? 0 : 1;
}
