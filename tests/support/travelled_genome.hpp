#pragma once

#include <algorithm>
#include <cstdint>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/neat/mutation.hpp>
#include <memory>
#include <vector>

namespace gene_clocks::test {

/// A genome and the stamp that its last robot would send with it.
struct Travelled {
    neat::Genome genome;
    Stamp stamp;
};

/// A perceptron (by default that of the navigation task, 20 connections), grown to `connections` by
/// the project's operators while it travels among a hundred robots. Each mutates
/// it once; between two of its mutations the swarm makes up to 50 other genes.
inline Travelled travelled_genome(std::size_t connections, std::uint64_t seed,
                                  std::size_t inputs = 10, std::size_t outputs = 2) {
    const neat::OdneatSettings settings;
    neat::RandomStream random(seed, 0);
    const auto topology = neat::make_initial_topology(inputs, outputs);
    Travelled travelled{
        neat::make_initial_genome({RobotId{1}, 0}, topology, settings.weight_limit, random),
        {topology->size() + 1}};
    neat::Genome& genome = travelled.genome;
    while (genome.connections() < connections) {
        const RobotId robot{1 + random.below(100)};
        neat::GeneClockSource clock(robot, travelled.stamp.value - 1 + random.below(50));
        // Two in three new connections come from splits, which add two.
        if (genome.connections() % 3 != 0 && genome.connections() + 2 <= connections) {
            neat::add_neuron(genome, settings, clock, 0.0, random);
        } else {
            neat::add_connection(genome, settings, clock, 0.0, random);
        }
        genome.id = {robot, genome.id.birth + 1};
        travelled.stamp = clock.stamp();
    }
    neat::mutate_weights(genome, settings, random);
    return travelled;
}

}  // namespace gene_clocks::test
