// Prints what fragments cost, as docs/wire-format.md states it: for frames of the sizes that its
// other table has, sent by robot 42.

#include <cstdio>
#include <gene_clocks/fragments.hpp>

int main() {
    using namespace gene_clocks;
    std::printf("| frame | 20 bytes at a time | 100 | 250 | 382 |\n");
    std::printf("| --- | --- | --- | --- | --- |\n");
    for (const std::size_t frame : {100u, 169u, 339u, 1696u}) {
        const std::vector<std::uint8_t> message(frame, 1);
        std::printf("| %zu |", frame);
        for (const std::size_t limit : {20u, 100u, 250u, 382u}) {
            const auto fragments = split_message(message, RobotId{42}, 0, limit);
            std::size_t bytes = 0;
            for (const auto& fragment : *fragments) bytes += fragment.size();
            std::printf(" %zu × %zu = %zu |", fragments->size(), fragments->front().size(), bytes);
        }
        std::printf("\n");
    }
    std::printf("\nA message under way takes %zu bytes beside its memory.\n",
                sizeof(gene_clocks_assembly));
}
