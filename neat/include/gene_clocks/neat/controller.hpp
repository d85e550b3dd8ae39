#pragma once

#include <cstddef>
#include <gene_clocks/neat/genome.hpp>
#include <span>
#include <vector>

namespace gene_clocks::neat {

/// The neural network of a genome, with state.
///
/// All neurons are updated at once, once a cycle, from the previous values, which are zero at
/// birth: a path through a hidden neuron takes an extra cycle. A neuron computes
/// 1 / (1 + exp(−slope·x)) of its weighted inputs; one without enabled inputs gives 0.
class Controller {
public:
    /// Shapes: inputs (the bias included) and outputs are those of the genome's topology.
    Controller(const Genome& genome, double activation_slope);

    /// One update. `inputs` holds one value for each input neuron, the bias included. Returns the
    /// outputs, valid until the next call.
    std::span<const float> update(std::span<const float> inputs);

private:
    // Neurons other than inputs are called active; outputs come first, then hidden ones. They are
    // computed four at a time: a sum grows by one source neuron after the other, so that the order
    // of its operations is the same on every processor.
    static constexpr std::size_t lanes = 4;

    std::size_t inputs_;
    std::size_t outputs_;
    std::size_t active_;
    std::size_t padded_;  // active_, up to a multiple of `lanes`
    float slope_;
    // One array, so that a controller's data lie together. Columns of length padded_: first one for
    // each neuron, with its weights into all active neurons; then has_inputs (1, or 0 for a neuron
    // without enabled inputs); then the neurons' values, twice: now and next.
    //
    // Of the standard library, and of no other: a type whose layout or alignment depends on the
    // compiler's flags would differ between this library and a program that uses it.
    std::vector<float> columns_;
    std::size_t has_inputs_;  // offsets into columns_
    std::size_t values_;
    std::size_t next_values_;
};

}  // namespace gene_clocks::neat
