// The large scopes that the tests have no time for: a line per scope; fails unless every promise
// holds in as many worlds as are recorded.
#include <fmt/core.h>

#include <chrono>
#include <cstdlib>

#include "tests/model/explorer.hpp"
#include "tests/model/scopes.hpp"

int main() {
    using namespace gene_clocks::model;
    bool all_hold = true;
    for (const auto& [name, scope, states, transitions] : full_scopes) {
        const auto start = std::chrono::steady_clock::now();
        const Result result = explore<GeneClocks>(scope);
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        const bool holds = result.violation.empty() && result.states == states &&
                           result.transitions == transitions;
        all_hold &= holds;
        fmt::print(
            "{}: {} worlds, {} transitions, {} steps deep, {:.0f} s: {}\n", name, result.states,
            result.transitions, result.depth, elapsed.count(),
            holds ? "every promise holds"
            : result.violation.empty()
                ? fmt::format("{} worlds and {} transitions are recorded", states, transitions)
                : result.violation);
        for (const auto& step : result.trace) fmt::print("    {}\n", step);
        std::fflush(stdout);
    }
    return all_hold ? EXIT_SUCCESS : EXIT_FAILURE;
}
