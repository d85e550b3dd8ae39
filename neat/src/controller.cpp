#include "gene_clocks/neat/controller.hpp"

#include <cassert>

#include "gene_clocks/neat/activation.hpp"

namespace gene_clocks::neat {

Controller::Controller(const Genome& genome, double activation_slope)
    : inputs_(static_cast<Eigen::Index>(genome.topology->inputs)),
      outputs_(static_cast<Eigen::Index>(genome.topology->outputs)),
      active_(static_cast<Eigen::Index>(genome.topology->neurons.size()) - inputs_),
      padded_((active_ + lanes - 1) / lanes * lanes),
      slope_(static_cast<float>(activation_slope)),
      weights_(Eigen::ArrayXXf::Zero(padded_, inputs_ + active_)),
      has_inputs_(Eigen::ArrayXf::Zero(padded_)),
      values_(Eigen::ArrayXf::Zero(padded_)),
      sums_(Eigen::ArrayXf::Zero(padded_)) {
    const Topology& topology = *genome.topology;
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        if (!genome.is_enabled(i)) continue;
        const auto source = topology.find_neuron(topology.connection_ends[i].source);
        const auto target = topology.find_neuron(topology.connection_ends[i].target);
        assert(source && target);
        const auto row = static_cast<Eigen::Index>(*target) - inputs_;
        weights_(row, static_cast<Eigen::Index>(*source)) = genome.weights[i];
        has_inputs_(row) = 1.0f;
    }
}

std::span<const float> Controller::update(std::span<const float> inputs) {
    assert(static_cast<Eigen::Index>(inputs.size()) == inputs_);
    for (Eigen::Index block = 0; block < padded_; block += lanes) {
        const auto weights_from = [&](Eigen::Index neuron) {
            return Lanes::Map(weights_.data() + neuron * padded_ + block);
        };
        Lanes sum = weights_from(0) * inputs[0];
        for (Eigen::Index i = 1; i < inputs_; ++i) {
            sum += weights_from(i) * inputs[static_cast<std::size_t>(i)];
        }
        for (Eigen::Index i = 0; i < active_; ++i) sum += weights_from(inputs_ + i) * values_(i);
        sums_.segment<lanes>(block) = sum;
    }
    float* const values = values_.data();
    const float* const sums = sums_.data();
    const float* const has_inputs = has_inputs_.data();
    for (Eigen::Index i = 0; i < padded_; i += lanes) {
        for (Eigen::Index lane = i; lane < i + lanes; ++lane) {
            values[lane] = logistic(sums[lane], slope_) * has_inputs[lane];
        }
    }
    return {values, static_cast<std::size_t>(outputs_)};
}

}  // namespace gene_clocks::neat
