// Property: whatever mutation, crossover and selection do, every genome stays valid, and its marks
// are one causal chain: a new gene sorts after all genes that its genome had before.

#include <gene_clocks/neat/crossover.hpp>
#include <gene_clocks/neat/distance.hpp>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <gene_clocks/neat/mutation.hpp>
#include <vector>

#include "fuzz/byte_reader.hpp"
#include "fuzz/require.hpp"

namespace {

using namespace gene_clocks;
using neat::Genome;

constexpr std::size_t robot_count = 3;

InnovationNumber last_mark(const Genome& genome) {
    const auto& topology = *genome.topology;
    return std::max(topology.neurons.back().mark, topology.connection_marks.back());
}

/// A genome, and the stamp that would travel with it.
struct Held {
    Genome genome;
    Stamp stamp;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::ByteReader bytes({data, size});
    neat::OdneatSettings settings;
    settings.p_recurrent = static_cast<double>(bytes.byte()) / 255.0;
    settings.sigma = static_cast<double>(bytes.byte()) / 25.0;
    const std::size_t inputs = 1 + bytes.below(4);
    const std::size_t outputs = 1 + bytes.below(3);
    neat::RandomStream random(bytes.word(), 0);
    const auto topology = neat::make_initial_topology(inputs, outputs);
    const auto genesis_count = neat::genesis_mark_count(inputs, outputs);

    std::vector<neat::GeneClockSource> clocks;
    std::vector<Held> genomes;
    std::uint32_t births = 0;
    for (std::uint32_t robot = 1; robot <= robot_count; ++robot) {
        clocks.emplace_back(RobotId{robot}, genesis_count);
        genomes.push_back({neat::make_initial_genome({RobotId{robot}, births++}, topology,
                                                     settings.weight_limit, random),
                           clocks.back().stamp()});
    }
    const neat::DistanceMeasure measure(settings);
    for (int step = 0; step < 64 && !bytes.empty(); ++step) {
        const std::size_t robot = bytes.below(robot_count);
        const std::size_t other = bytes.below(robot_count);
        const std::uint8_t operation = bytes.byte() % 5;
        auto& clock = clocks[robot];
        Genome& genome = genomes[robot].genome;
        // The robot holds the genome that it works on: it has observed its stamp.
        GENE_CLOCKS_REQUIRE(clock.observe(genomes[robot].stamp));
        const InnovationNumber newest = last_mark(genome);
        const std::size_t size_before = genome.topology->size();
        switch (operation) {
            case 0:
                neat::add_neuron(genome, settings, clock, 0.0, random);
                break;
            case 1:
                neat::add_connection(genome, settings, clock, 0.0, random);
                break;
            case 2:
                neat::mutate_weights(genome, settings, random);
                break;
            case 3: {
                GENE_CLOCKS_REQUIRE(clock.observe(genomes[other].stamp));
                const auto fitness = [&] { return static_cast<float>(bytes.below(3)); };
                const neat::Parent first{&genome, fitness()};
                const neat::Parent second{&genomes[other].genome, fitness()};
                genome = neat::crossover({RobotId{static_cast<std::uint32_t>(robot + 1)}, births++},
                                         first, second, settings, random);
                break;
            }
            default: {  // a message replaces the genome
                GENE_CLOCKS_REQUIRE(clock.observe(genomes[other].stamp));
                genome = genomes[other].genome;
                break;
            }
        }
        if (operation < 2 && genome.topology->size() > size_before) {
            GENE_CLOCKS_REQUIRE(newest < genome.topology->connection_marks.back());
        }
        genomes[robot].stamp = clock.stamp();
        GENE_CLOCKS_REQUIRE(last_mark(genome).counter < clock.stamp().value);
        GENE_CLOCKS_REQUIRE(neat::is_valid(genome, settings.weight_limit));
        const Genome& peer = genomes[other].genome;
        const float distance = neat::distance(genome, peer, measure);
        GENE_CLOCKS_REQUIRE(distance >= 0.0f);
        GENE_CLOCKS_REQUIRE((neat::distance(genome, peer, measure, 1.0f) < 1.0f) ==
                            (distance < 1.0f));
    }
    return 0;
}
