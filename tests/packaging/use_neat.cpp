// One agent with a gene clock hears another: what every consumer of the odNEAT layer does.
#include <array>
#include <cstdio>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <memory>

int main() {
    using namespace gene_clocks;
    const neat::OdneatSettings settings;
    const auto topology = neat::make_initial_topology(3, 2);
    const auto genesis = neat::genesis_mark_count(3, 2);
    const auto make_agent = [&](std::uint32_t robot) {
        return neat::Agent(RobotId{robot}, settings, topology,
                           std::make_unique<neat::GeneClockSource>(RobotId{robot}, genesis),
                           neat::RandomStream(1, robot));
    };
    neat::Agent first = make_agent(1);
    neat::Agent second = make_agent(2);

    const neat::Reception reception = second.receive(first.robot(), first.message());
    const auto outputs = second.control(std::array{0.5f, 0.25f, 1.0f});
    std::printf("outputs: %g %g\n", static_cast<double>(outputs[0]),
                static_cast<double>(outputs[1]));
    return reception == neat::Reception::accepted && outputs.size() == 2 ? 0 : 1;
}
