#pragma once

#include <Eigen/Core>
#include <span>

#include "gene_clocks/neat/genome.hpp"

namespace gene_clocks::neat {

/// The neural network of a genome, with state.
///
/// All neurons are updated at once, once a cycle, from the previous values, which are zero at
/// birth: a path through a hidden neuron takes an extra cycle. A neuron computes
/// 1 / (1 + exp(−slope·x)) of its weighted inputs; one without enabled inputs gives 0.
class Controller {
public:
    /// Shapes: `inputs` (the bias included) and outputs are those of the genome's topology.
    Controller(const Genome& genome, double activation_slope);

    /// One update. `inputs` holds one value for each input neuron, the bias included. Returns the
    /// outputs, valid until the next call.
    std::span<const float> update(std::span<const float> inputs);

private:
    static constexpr Eigen::Index lanes = 4;
    using Lanes = Eigen::Array<float, lanes, 1>;

    // Neurons other than inputs are called active; outputs come first, then hidden ones, padded
    // to a multiple of `lanes`.
    Eigen::Index inputs_;
    Eigen::Index outputs_;
    Eigen::Index active_;
    Eigen::Index padded_;
    float slope_;
    // Column-major, padded_ × (inputs_ + active_): weights into each active neuron from each
    // neuron. A column is added at a time, so that each sum has the same order of operations on
    // every processor.
    Eigen::ArrayXXf weights_;
    Eigen::ArrayXf has_inputs_;  // 1, or 0 for a neuron without enabled inputs
    Eigen::ArrayXf values_;      // of the active neurons
    Eigen::ArrayXf sums_;
};

}  // namespace gene_clocks::neat
