#include <array>
#include <bit>
#include <cassert>
#include <gene_clocks/neat/activation.hpp>
#include <gene_clocks/neat/controller.hpp>
#include <utility>

namespace gene_clocks::neat {

Controller::Controller(const Genome& genome, double activation_slope)
    : inputs_(static_cast<Eigen::Index>(genome.topology->inputs)),
      outputs_(static_cast<Eigen::Index>(genome.topology->outputs)),
      active_(static_cast<Eigen::Index>(genome.topology->neurons.size()) - inputs_),
      padded_((active_ + lanes - 1) / lanes * lanes),
      slope_(static_cast<float>(activation_slope)),
      columns_(Eigen::ArrayXf::Zero(padded_ * (inputs_ + active_ + 3))),
      has_inputs_(padded_ * (inputs_ + active_)),
      values_(has_inputs_ + padded_),
      next_values_(values_ + padded_) {
    const Topology& topology = *genome.topology;
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        if (!genome.is_enabled(i)) continue;
        const auto source = topology.find_neuron(topology.connection_ends[i].source);
        const auto target = topology.find_neuron(topology.connection_ends[i].target);
        assert(source && target);
        const auto row = static_cast<Eigen::Index>(*target) - inputs_;
        columns_(static_cast<Eigen::Index>(*source) * padded_ + row) = genome.weights[i];
        columns_(has_inputs_ + row) = 1.0f;
    }
}

std::span<const float> Controller::update(std::span<const float> inputs) {
    assert(static_cast<Eigen::Index>(inputs.size()) == inputs_);
    const float* const values = columns_.data() + values_;
    float* const next = columns_.data() + next_values_;
    for (Eigen::Index block = 0; block < padded_; block += lanes) {
        Lanes sum = weights_from(0, block) * inputs[0];
        for (Eigen::Index i = 1; i < inputs_; ++i) {
            sum += weights_from(i, block) * inputs[static_cast<std::size_t>(i)];
        }
        for (Eigen::Index i = 0; i < active_; ++i) {
            sum += weights_from(inputs_ + i, block) * values[i];
        }
        std::array<float, lanes> numbers;
        Lanes::Map(numbers.data()) = sum;
        numbers = std::bit_cast<std::array<float, lanes>>(
            logistic(std::bit_cast<FourFloats>(numbers), slope_));
        Eigen::Map<Lanes, Eigen::Aligned16>(next + block) =
            Lanes::Map(numbers.data()) *
            Eigen::Map<const Lanes, Eigen::Aligned16>(columns_.data() + has_inputs_ + block);
    }
    std::swap(values_, next_values_);
    return {next, static_cast<std::size_t>(outputs_)};
}

}  // namespace gene_clocks::neat
