#pragma once

#include <cmath>
#include <cstdint>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <memory>
#include <utility>
#include <vector>

// Robots and genomes for the tests of this folder.

namespace gene_clocks::neat::paper {

constexpr std::size_t inputs = 3;  // the last is the bias
constexpr std::size_t outputs = 2;

/// Settings in the paper's words, with nothing left to chance: no mating, no mutation.
inline OdneatSettings calm_settings() {
    OdneatSettings settings;
    settings.weight_difference = WeightDifference::mean;
    settings.held_energy = HeldEnergy::running_mean;
    settings.p_mate = 0.0;
    settings.p_mutate = 0.0;
    settings.p_node = 0.0;
    settings.p_connection = 0.0;
    settings.p_weight = 0.0;
    return settings;
}

inline std::shared_ptr<const Topology> topology() {
    static const auto shared = make_initial_topology(inputs, outputs);
    return shared;
}

inline Agent make_robot(std::uint32_t robot, const OdneatSettings& settings,
                        std::uint64_t seed = 1) {
    return Agent(
        RobotId{robot}, settings, topology(),
        std::make_unique<GeneClockSource>(RobotId{robot}, genesis_mark_count(inputs, outputs)),
        RandomStream(seed, robot));
}

/// A perceptron of which all weights are `weight`, made by robot 99.
inline std::shared_ptr<const Genome> genome_of(std::uint32_t birth, float weight) {
    const std::size_t connections = topology()->connection_marks.size();
    return std::make_shared<const Genome>(Genome{{RobotId{99}, birth},
                                                 topology(),
                                                 std::vector<float>(connections, weight),
                                                 std::vector<float>(connections, 1.0f)});
}

inline bool holds(const Agent& robot, GenomeId genome) {
    return robot.population().find(genome).has_value();
}

/// Runs the active genome out of energy and past its maturation.
inline void deplete(Agent& robot, const OdneatSettings& settings) {
    for (std::int64_t age = 0; age <= settings.maturation_cycles; ++age) robot.spend(-200.0f);
}

/// Five standard deviations of a frequency.
inline double tolerance(double probability, int draws) {
    return 5 * std::sqrt(probability * (1 - probability) / draws);
}

}  // namespace gene_clocks::neat::paper
