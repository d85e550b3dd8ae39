#include "sim/core/src/task.hpp"

#include <cmath>

#include "sim/core/src/lanes.hpp"

namespace gene_clocks::sim {

GENE_CLOCKS_MULTIVERSION
void interpret_outputs(Actuation actuation, const Commands& commands) {
    const float* __restrict output_0 = commands.output_0;
    const float* __restrict output_1 = commands.output_1;
    float* __restrict translation = commands.translation;
    float* __restrict rotation = commands.rotation;
    if (actuation == Actuation::translation_rotation) {
        for (std::size_t i = 0; i < commands.robots; ++i) {
            translation[i] = 2.0f * (output_0[i] - 0.5f);
            rotation[i] = 2.0f * (output_1[i] - 0.5f);
        }
    } else {
        // Left and right wheel in [−1, 1]; the left one alone turns the robot clockwise.
        for (std::size_t i = 0; i < commands.robots; ++i) {
            translation[i] = output_0[i] + output_1[i] - 1.0f;
            rotation[i] = output_0[i] - output_1[i];
        }
    }
}

GENE_CLOCKS_MULTIVERSION
static void reference_energy(std::size_t robots, const float* __restrict translation,
                             const float* __restrict rotation,
                             const float* __restrict nearest_obstacle,
                             float* __restrict energy_change) {
    for (std::size_t i = 0; i < robots; ++i) {
        const float right = (translation[i] - rotation[i] * 0.5f) * (1.0f / 1.5f);
        const float left = (translation[i] + rotation[i] * 0.5f) * (1.0f / 1.5f);
        const float speed = std::abs(right * 0.5f + 0.5f) + std::abs(left * 0.5f + 0.5f);
        const float straightness = 1.0f - std::sqrt(std::abs(right - left));
        energy_change[i] = 2.0f * speed * straightness * nearest_obstacle[i] - 1.0f;
    }
}

/// Wheel velocities from −½ to ½, so that |v_l + v_r| and |v_l − v_r| lie in [0, 1], the interval
/// that f_n maps linearly to [−1, 1].
GENE_CLOCKS_MULTIVERSION
static void equation_2_energy(std::size_t robots, const float* __restrict translation,
                              const float* __restrict rotation,
                              const float* __restrict nearest_obstacle,
                              float* __restrict energy_change) {
    for (std::size_t i = 0; i < robots; ++i) {
        // With wheels v_l + v_r is the translation and v_l − v_r the rotation, as shares.
        const float gain = std::abs(translation[i]) * (1.0f - std::sqrt(std::abs(rotation[i]))) *
                           nearest_obstacle[i];
        energy_change[i] = 2.0f * gain - 1.0f;
    }
}

void navigation_energy(NavigationEnergy rule, const Commands& commands,
                       const float* nearest_obstacle, float* energy_change) {
    const auto compute = rule == NavigationEnergy::reference ? reference_energy : equation_2_energy;
    compute(commands.robots, commands.translation, commands.rotation, nearest_obstacle,
            energy_change);
}

}  // namespace gene_clocks::sim
