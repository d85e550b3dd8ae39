// A short run in an arena of the consumer's own.
#include <cstdio>
#include <gene_clocks/sim/simulation.hpp>

int main() {
    using namespace gene_clocks;
    const sim::Arena arena{"square", 200.0, 200.0, 5.0, 5.0, 5.0, 5.0, {}};
    sim::Settings settings;
    settings.world.robots = 20;
    settings.run.cycles = 500;
    const auto result = sim::simulate(settings, arena, 1);
    std::printf("messages received: %llu\n",
                static_cast<unsigned long long>(result->counters.messages_received));
    return result->samples.size() == 5 && result->counters.messages_received > 0 ? 0 : 1;
}
