// How far honest clocks advance among robots that send arbitrary counters, and what the admission
// policies make of it: the tables of docs/durability-and-hostile-peers.md, as Markdown.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>

#include "tests/support/hostile_fleet.hpp"

namespace {

using namespace gene_clocks;
using namespace gene_clocks::test;

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

struct Defence {
    const char* name;
    std::uint64_t window;
    AdmissionGate::Policy admission;
};
constexpr std::array defences{Defence{"none", most, {}}, Defence{"window 1000", 1000, {}},
                              Defence{"allowance 1000 + 4 a cycle", most, {1000, 4}}};

double per_cent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

FleetResult run(const Defence& defence, FleetSettings settings) {
    settings.window = defence.window;
    settings.admission = defence.admission;
    return HostileFleet{settings}.run();
}

void attacks() {
    fmt::print(
        "| hostile | they send | defence | largest honest clock | genes not made | honest messages "
        "refused |\n| --: | --- | --- | --: | --: | --: |\n");
    for (const int hostile : {0, 1, 10, 50}) {
        for (const auto attack : {Attack::arbitrary, Attack::greedy}) {
            if (hostile == 0 && attack == Attack::greedy) continue;
            for (const Defence& defence : defences) {
                const auto result = run(defence, {.hostile = hostile, .attack = attack});
                fmt::print("| {} | {} | {} | {} | {:.1f} % | {:.1f} % |\n", hostile,
                           hostile == 0                  ? "–"
                           : attack == Attack::arbitrary ? "anything"
                                                         : "the most admitted",
                           defence.name, result.largest_clock,
                           per_cent(result.genes_not_made, result.genes + result.genes_not_made),
                           per_cent(result.honest_refused, result.honest_heard));
            }
        }
    }
}

void partitions() {
    fmt::print(
        "\n| defence | largest clock | smallest clock | honest messages refused |\n"
        "| --- | --: | --: | --: |\n");
    for (const Defence& defence : defences) {
        const auto result = run(defence, {.partition_cycles = 50'000});
        fmt::print("| {} | {} | {} | {:.1f} % |\n", defence.name, result.largest_clock,
                   result.smallest_clock, per_cent(result.honest_refused, result.honest_heard));
    }
}

}  // namespace

int main() {
    fmt::print(
        "100 robots, 100 000 cycles, two messages heard and 0.01 genes made in each by each\n\n");
    attacks();
    partitions();
}
