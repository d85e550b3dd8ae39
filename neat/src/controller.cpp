#include <Eigen/Core>
#include <array>
#include <bit>
#include <cassert>
#include <gene_clocks/neat/activation.hpp>
#include <gene_clocks/neat/controller.hpp>
#include <utility>

namespace gene_clocks::neat {
namespace {

using Lanes = Eigen::Array<float, 4, 1>;

Eigen::Map<const Lanes> lanes_at(const float* numbers) {
    return Eigen::Map<const Lanes>(numbers);
}

}  // namespace

Controller::Controller(const Genome& genome, double activation_slope)
    : inputs_(genome.topology->inputs),
      outputs_(genome.topology->outputs),
      active_(genome.topology->neurons.size() - inputs_),
      padded_((active_ + lanes - 1) / lanes * lanes),
      slope_(static_cast<float>(activation_slope)),
      columns_(padded_ * (inputs_ + active_ + 3), 0.0f),
      has_inputs_(padded_ * (inputs_ + active_)),
      values_(has_inputs_ + padded_),
      next_values_(values_ + padded_) {
    const Topology& topology = *genome.topology;
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        if (!genome.is_enabled(i)) continue;
        const auto source = topology.find_neuron(topology.connection_ends[i].source);
        const auto target = topology.find_neuron(topology.connection_ends[i].target);
        assert(source && target);
        const std::size_t row = *target - inputs_;
        columns_[*source * padded_ + row] = genome.weights[i];
        columns_[has_inputs_ + row] = 1.0f;
    }
}

std::span<const float> Controller::update(std::span<const float> inputs) {
    assert(inputs.size() == inputs_);
    const float* const weights = columns_.data();
    const float* const values = weights + values_;
    float* const next = columns_.data() + next_values_;
    for (std::size_t block = 0; block < padded_; block += lanes) {
        const auto weights_from = [&](std::size_t neuron) {
            return lanes_at(weights + neuron * padded_ + block);
        };
        Lanes sum = weights_from(0) * inputs[0];
        for (std::size_t i = 1; i < inputs_; ++i) sum += weights_from(i) * inputs[i];
        for (std::size_t i = 0; i < active_; ++i) sum += weights_from(inputs_ + i) * values[i];
        std::array<float, lanes> numbers;
        Lanes::Map(numbers.data()) = sum;
        numbers = std::bit_cast<std::array<float, lanes>>(
            logistic(std::bit_cast<FourFloats>(numbers), slope_));
        Lanes::Map(next + block) =
            Lanes::Map(numbers.data()) * lanes_at(weights + has_inputs_ + block);
    }
    std::swap(values_, next_values_);
    return {next, outputs_};
}

}  // namespace gene_clocks::neat
