// What robots inside a fleet achieve that lie about genomes and their energies: the table of
// docs/durability-and-hostile-peers.md, as Markdown.
#include <fmt/format.h>

#include <array>
#include <string>

#include "tests/support/lying_fleet.hpp"

namespace {

using namespace gene_clocks;
using namespace gene_clocks::test;

struct NamedLie {
    const char* name;
    Lie lie;
};
constexpr std::array lies{NamedLie{"(they are silent)", Lie::none},
                          NamedLie{"a genome is another robot's next", Lie::takes_ids},
                          NamedLie{"your active genome is worth nothing", Lie::slanders_own},
                          NamedLie{"others' genomes are worth nothing", Lie::slanders_others},
                          NamedLie{"energies that cannot be", Lie::impossible},
                          NamedLie{"my genome has the highest energy", Lie::boasts}};

std::string in_words(std::size_t members) {
    return members == neat::PeerLimits::any ? "any" : fmt::format("{}", members);
}

void row(const NamedLie& lie, LyingSettings settings) {
    constexpr int runs = 8;
    LyingResult mean;
    double taken = 0.0;
    for (int run = 0; run < runs; ++run) {
        settings.lie = lie.lie;
        settings.seed = static_cast<std::uint64_t>(run + 1);
        const LyingResult result = LyingFleet{settings}.run();
        if (result.lies > 0) {
            taken += static_cast<double>(result.taken) / static_cast<double>(result.lies) / runs;
        }
        mean.lied_members += result.lied_members / runs;
        mean.worst_robot += result.worst_robot / runs;
        mean.lied_parents += result.lied_parents / runs;
        mean.right_answers += result.right_answers / runs;
    }
    fmt::print(
        "| {} | {} | {} | {} | {} | {} | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} % |\n",
        settings.liars, lie.name, settings.senders_are_known ? "each robot's" : "the fleet's",
        in_words(settings.peers.members_per_maker), in_words(settings.peers.members_of_others),
        settings.peers.may_excel ? "yes" : "no", 100.0 * taken, 100.0 * mean.lied_members,
        100.0 * mean.worst_robot, 100.0 * mean.lied_parents, 100.0 * mean.right_answers);
}

}  // namespace

int main() {
    fmt::print(
        "100 robots, 3000 cycles, eight runs each; everything but lies taken is of the second "
        "half\n\n"
        "| liars | they say | keys | of one maker | of others | may excel | lies taken "
        "| of populations | of the worst one | of parents | right answers |\n"
        "| --: | --- | --- | --: | --: | --- | --: | --: | --: | --: | --: |\n");
    constexpr std::size_t any = neat::PeerLimits::any;
    row(lies[0], {});
    for (const neat::PeerLimits peers :
         {neat::PeerLimits{1, any}, {1, 2}, {1, 2, false}, {any, 0}}) {
        row(lies[0], {.peers = peers});
    }
    for (const int liars : {1, 10, 30}) {
        for (const NamedLie& lie : lies) {
            for (const bool senders_are_known : {false, true}) {
                if (lie.lie == Lie::none && !senders_are_known) continue;
                row(lie, {.liars = liars, .senders_are_known = senders_are_known});
            }
        }
        for (const neat::PeerLimits peers : {neat::PeerLimits{1, any}, {1, 2}, {1, 2, false}}) {
            row(lies.back(), {.liars = liars, .peers = peers});
        }
    }
}
