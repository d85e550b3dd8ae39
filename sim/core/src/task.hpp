#pragma once

#include <cstddef>
#include <gene_clocks/sim/settings.hpp>

namespace gene_clocks::sim {

/// What all robots' controllers ask for in one cycle; arrays with one entry for each robot.
struct Commands {
    std::size_t robots;
    const float* output_0;  ///< in (0, 1)
    const float* output_1;
    float* translation;  ///< in [−1, 1], a share of the largest in one cycle
    float* rotation;     ///< the same; positive is clockwise
};

/// Turns controllers' outputs into movements.
void interpret_outputs(Actuation actuation, const Commands& commands);

/// The navigation task's change of energy (paper, Equation 2, and what the published runs used).
/// `nearest_obstacle` is the smallest of a robot's readings: 1 − d, for the paper's d.
void navigation_energy(NavigationEnergy rule, const Commands& commands,
                       const float* nearest_obstacle, float* energy_change);

}  // namespace gene_clocks::sim
