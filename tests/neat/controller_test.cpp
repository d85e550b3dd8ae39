#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <gene_clocks/neat/controller.hpp>
#include <map>
#include <vector>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

constexpr double slope = 4.924273;
constexpr float tolerance = 2e-6f;

float activation(double x) {
    return static_cast<float>(1.0 / (1.0 + std::exp(-slope * x)));
}

TEST(Controller, APerceptronAnswersAtOnce) {
    Genome genome = perceptron(3, 2);
    // From inputs 1, 2 and the bias; to outputs 0 and 1 each.
    genome.weights = {0.5f, -1.0f, 0.25f, 2.0f, -0.125f, 0.0f};
    Controller controller(genome, slope);
    const std::vector<float> inputs{0.2f, 0.4f, 1.0f};
    const auto outputs = controller.update(inputs);
    ASSERT_EQ(outputs.size(), 2u);
    EXPECT_NEAR(outputs[0], activation(0.5 * 0.2 + 0.25 * 0.4 - 0.125), tolerance);
    EXPECT_NEAR(outputs[1], activation(-1.0 * 0.2 + 2.0 * 0.4), tolerance);
}

TEST(Controller, LeavesDisabledConnectionsOut) {
    Genome genome = perceptron(2, 1);
    genome.weights = {1.0f, 0.5f};
    genome.enabled = {0.0f, 1.0f};
    Controller controller(genome, slope);
    EXPECT_NEAR(controller.update(std::vector{0.3f, 1.0f})[0], activation(0.5), tolerance);
}

TEST(Controller, ANeuronWithoutEnabledInputsGivesZero) {
    Genome genome = perceptron(2, 2);
    genome.weights = {1.0f, 1.0f, 1.0f, 1.0f};
    genome.enabled = {0.0f, 1.0f, 0.0f, 1.0f};  // output 0 has none
    Controller controller(genome, slope);
    for (int cycle = 0; cycle < 3; ++cycle) {
        const auto outputs = controller.update(std::vector{0.3f, 1.0f});
        EXPECT_EQ(outputs[0], 0.0f);
        EXPECT_GT(outputs[1], 0.5f);
    }
}

TEST(Controller, APathThroughAHiddenNeuronTakesAnExtraCycle) {
    Genome genome = perceptron(1, 1);
    genome.enabled[0] = 0.0f;
    add_hidden(genome, mark(20));
    add_gene(genome, mark(21), {genesis(1), mark(20), false}, 2.0f);
    add_gene(genome, mark(22), {mark(20), genesis(2), false}, 3.0f);
    Controller controller(genome, slope);
    // At birth the hidden neuron's value is 0, whatever the input is.
    EXPECT_EQ(controller.update(std::vector{0.1f})[0], 0.5f);
    EXPECT_NEAR(controller.update(std::vector{-0.2f})[0], activation(3.0 * activation(2.0 * 0.1)),
                tolerance);
    EXPECT_NEAR(controller.update(std::vector{0.9f})[0], activation(3.0 * activation(2.0 * -0.2)),
                tolerance);
}

TEST(Controller, ARecurrentConnectionCarriesStateFromCycleToCycle) {
    Genome genome = perceptron(1, 1);
    genome.weights[0] = 0.0f;
    add_gene(genome, mark(20), {genesis(2), genesis(2), true}, -1.5f);
    Controller controller(genome, slope);
    double value = 0.0;
    for (int cycle = 0; cycle < 20; ++cycle) {
        value = activation(-1.5 * value);
        EXPECT_NEAR(controller.update(std::vector{1.0f})[0], value, 2e-5);
    }
}

TEST(Controller, StartsFromZeroAtEachBirth) {
    Genome genome = perceptron(1, 1);
    add_gene(genome, mark(20), {genesis(2), genesis(2), true}, 1.0f);
    Controller first(genome, slope);
    const float at_birth = first.update(std::vector{0.5f})[0];
    EXPECT_NE(first.update(std::vector{0.5f})[0], at_birth);
    Controller second(genome, slope);
    EXPECT_EQ(second.update(std::vector{0.5f})[0], at_birth);
}

TEST(Controller, ACopyHasAStateOfItsOwn) {
    Genome genome = perceptron(1, 1);
    add_gene(genome, mark(20), {genesis(2), genesis(2), true}, 1.0f);
    Controller first(genome, slope);
    first.update(std::vector{0.5f});
    Controller copy = first;
    const float next = first.update(std::vector{0.5f})[0];
    first.update(std::vector{-0.5f});
    EXPECT_EQ(copy.update(std::vector{0.5f})[0], next);
}

TEST(Controller, TakesItsSlope) {
    Genome genome = perceptron(1, 1);
    genome.weights[0] = 1.0f;
    Controller controller(genome, 1.0);
    EXPECT_NEAR(controller.update(std::vector{2.0f})[0], 1.0 / (1.0 + std::exp(-2.0)), tolerance);
}

/// The network in double precision, neuron by neuron from maps.
class NaiveController {
public:
    explicit NaiveController(const Genome& genome) : genome_(genome) {}

    std::vector<double> update(const std::vector<float>& inputs) {
        const auto& neurons = genome_.topology->neurons;
        for (std::size_t i = 0; i < inputs.size(); ++i) values_[neurons[i].mark] = inputs[i];
        std::map<InnovationNumber, double> sums;
        for (std::size_t i = 0; i < genome_.connections(); ++i) {
            if (!genome_.is_enabled(i)) continue;
            const ConnectionEnds& ends = genome_.topology->connection_ends[i];
            sums[ends.target] += double{genome_.weights[i]} * values_[ends.source];
        }
        values_.clear();
        for (const auto& [neuron, sum] : sums) {
            values_[neuron] = 1.0 / (1.0 + std::exp(-slope * sum));
        }
        std::vector<double> outputs;
        for (const NeuronGene& neuron : neurons) {
            if (neuron.kind == NeuronKind::output) outputs.push_back(values_[neuron.mark]);
        }
        return outputs;
    }

private:
    Genome genome_;
    std::map<InnovationNumber, double> values_;
};

RC_GTEST_PROP(ControllerProperty, EqualsANaiveVersionInDoublePrecision, ()) {
    RandomStream random(*rc::gen::arbitrary<std::uint32_t>(), 0);
    const auto inputs = *rc::gen::inRange<std::size_t>(1, 20);
    const auto outputs = *rc::gen::inRange<std::size_t>(1, 6);
    GeneClockSource clock(RobotId{1}, genesis_mark_count(inputs, outputs));
    Genome genome =
        make_initial_genome({}, make_initial_topology(inputs, outputs), weight_limit, random);
    grow(genome, *rc::gen::inRange<std::size_t>(0, 30), clock, random);
    // Weights so small that rounding errors do not grow from cycle to cycle.
    for (float& weight : genome.weights) weight *= 0.1f;
    Controller controller(genome, slope);
    NaiveController naive(genome);
    for (int cycle = 0; cycle < 30; ++cycle) {
        std::vector<float> readings(inputs);
        for (float& reading : readings) reading = static_cast<float>(random.uniform());
        const auto actual = controller.update(readings);
        const auto expected = naive.update(readings);
        RC_ASSERT(actual.size() == expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            RC_ASSERT(std::abs(double{actual[i]} - expected[i]) < 2e-5);
        }
    }
}

}  // namespace
}  // namespace gene_clocks::neat
