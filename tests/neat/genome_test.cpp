#include <gtest/gtest.h>

#include <cmath>
#include <gene_clocks/neat/genome.hpp>
#include <limits>
#include <set>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

TEST(InitialTopology, HasOneGenesisMarkForEachGeneNeuronsFirst) {
    const auto topology = make_initial_topology(10, 2);
    EXPECT_EQ(genesis_mark_count(10, 2), 10u + 2u + 10u * 2u);
    std::uint64_t counter = 1;
    for (const NeuronGene& neuron : topology->neurons) EXPECT_EQ(neuron.mark, genesis(counter++));
    for (const auto& mark : topology->connection_marks) EXPECT_EQ(mark, genesis(counter++));
    EXPECT_EQ(counter - 1, genesis_mark_count(10, 2));
}

TEST(InitialTopology, HasInputsThenBiasThenOutputs) {
    const auto topology = make_initial_topology(3, 2);
    const auto& neurons = topology->neurons;
    ASSERT_EQ(neurons.size(), 5u);
    EXPECT_EQ(neurons[0].kind, NeuronKind::input);
    EXPECT_EQ(neurons[1].kind, NeuronKind::input);
    EXPECT_EQ(neurons[2].kind, NeuronKind::bias);
    EXPECT_EQ(neurons[3].kind, NeuronKind::output);
    EXPECT_EQ(neurons[4].kind, NeuronKind::output);
    EXPECT_EQ(topology->inputs, 3u);
    EXPECT_EQ(topology->outputs, 2u);
}

TEST(InitialTopology, ConnectsEveryInputToEveryOutput) {
    const auto topology = make_initial_topology(4, 3);
    EXPECT_EQ(topology->initial_connections, 12u);
    ASSERT_EQ(topology->connection_ends.size(), 12u);
    for (std::size_t input = 0; input < 4; ++input) {
        for (std::size_t output = 4; output < 7; ++output) {
            EXPECT_TRUE(
                topology->joined(topology->neurons[input].mark, topology->neurons[output].mark));
        }
    }
    for (const ConnectionEnds& ends : topology->connection_ends) EXPECT_FALSE(ends.recurrent);
}

TEST(InitialTopology, TheSmallestHasABiasAndAnOutput) {
    Genome genome = perceptron(1, 1);
    EXPECT_EQ(genome.topology->neurons[0].kind, NeuronKind::bias);
    EXPECT_EQ(fault_of(genome), "valid");
}

TEST(Topology, FindsNeuronsByMark) {
    Genome genome = with_hidden(perceptron(2, 1), 1);
    add_hidden(genome, mark(2000, 3));
    EXPECT_EQ(genome.topology->find_neuron(mark(2000, 3)), 4u);
    EXPECT_EQ(genome.topology->find_neuron(mark(2000, 2)), std::nullopt) << "of another robot";
    EXPECT_EQ(genome.topology->find_neuron(genesis(1)), 0u);
    EXPECT_EQ(genome.topology->find_neuron(genesis(3)), 2u);
    EXPECT_EQ(genome.topology->find_neuron(genesis(1000)), 3u);
    EXPECT_EQ(genome.topology->find_neuron(genesis(500)), std::nullopt);
    EXPECT_EQ(genome.topology->find_neuron(genesis(2000)), std::nullopt);
    EXPECT_EQ(genome.topology->find_neuron(mark(3, 7)), std::nullopt);
}

TEST(Topology, JoinedLooksAtTheDirection) {
    const auto topology = make_initial_topology(2, 1);
    EXPECT_TRUE(topology->joined(genesis(1), genesis(3)));
    EXPECT_FALSE(topology->joined(genesis(3), genesis(1)));
    EXPECT_FALSE(topology->joined(genesis(3), genesis(3)));
}

TEST(Topology, InsertKeepsTheOrderOfMarksAndReturnsTheIndex) {
    Topology topology = *make_initial_topology(2, 1);  // marks up to 5
    const ConnectionEnds loop{genesis(3), genesis(3), true};
    const ConnectionEnds back{genesis(100), genesis(3), false};
    const ConnectionEnds forth{genesis(3), genesis(100), true};
    EXPECT_EQ(topology.insert(NeuronGene{genesis(100), NeuronKind::hidden}), 3u);
    EXPECT_EQ(topology.insert(NeuronGene{mark(50), NeuronKind::hidden}), 3u);
    EXPECT_EQ(topology.insert(mark(20), loop), 2u);
    EXPECT_EQ(topology.insert(mark(30), back), 3u);
    EXPECT_EQ(topology.insert(mark(20, 0), forth), 2u);  // the same counter, a lower robot
    const std::vector<InnovationNumber> marks{genesis(4), genesis(5), mark(20, 0), mark(20),
                                              mark(30)};
    EXPECT_EQ(topology.connection_marks, marks);
    EXPECT_EQ(topology.connection_ends[2], forth);
    EXPECT_EQ(topology.connection_ends[3], loop);
    EXPECT_EQ(topology.connection_ends[4], back);
}

TEST(Topology, SizeCountsNeuronsAndConnections) {
    Genome genome = perceptron(10, 2);
    EXPECT_EQ(genome.topology->size(), 32u);
    EXPECT_EQ(genome.topology->initial_size(), 32u);
    add_hidden(genome, mark(100));
    add_gene(genome, mark(101), {genesis(1), mark(100), false});
    EXPECT_EQ(genome.topology->size(), 34u);
    EXPECT_EQ(genome.topology->initial_size(), 32u);
}

TEST(InitialGenome, DrawsItsWeightsFromTheStandardNormalDistribution) {
    RandomStream random(1, 1);
    const auto topology = make_initial_topology(100, 1000);
    const Genome genome = make_initial_genome({RobotId{3}, 5}, topology, weight_limit, random);
    EXPECT_EQ(genome.id, (GenomeId{RobotId{3}, 5}));
    EXPECT_EQ(genome.topology, topology);
    double sum = 0.0;
    double squares = 0.0;
    for (const float weight : genome.weights) {
        sum += weight;
        squares += weight * weight;
    }
    EXPECT_NEAR(sum / 1e5, 0.0, 0.016);
    EXPECT_NEAR(squares / 1e5, 1.0, 0.023);
    EXPECT_EQ(genome.enabled, std::vector<float>(100'000, 1.0f));
    EXPECT_EQ(fault_of(perceptron(10, 2)), "valid");
}

TEST(InitialGenome, ClipsItsWeights) {
    RandomStream random(1, 1);
    const Genome genome = make_initial_genome({}, make_initial_topology(100, 10), 0.5, random);
    const std::set<float> weights(genome.weights.begin(), genome.weights.end());
    EXPECT_EQ(*weights.begin(), -0.5f);
    EXPECT_EQ(*weights.rbegin(), 0.5f);
    EXPECT_GT(weights.size(), 300u);  // about 38 % lie within the limit
}

/// A valid genome with hidden neurons, disabled and recurrent genes, to be broken in one place.
class GenomeFault : public testing::Test {
protected:
    GenomeFault() : genome_(perceptron(3, 2)), topology_(*genome_.topology) {
        genome_.enabled[0] = 0.0f;
        add_hidden(genome_, mark(20));
        add_gene(genome_, mark(21), {genesis(1), mark(20), false}, 1.0f);
        add_gene(genome_, mark(22), {mark(20), genesis(4), false}, -10.0f);
        add_gene(genome_, mark(23), {genesis(4), genesis(4), true}, 10.0f);
        topology_ = *genome_.topology;
    }

    /// The fault of the genome with the changed topology.
    std::string fault() {
        genome_.topology = std::make_shared<const Topology>(topology_);
        return fault_of(genome_);
    }

    Genome genome_;
    Topology topology_;
};

TEST_F(GenomeFault, NoneAtFirst) {
    EXPECT_EQ(fault(), "valid");
    EXPECT_TRUE(is_valid(genome_, weight_limit));
}

TEST_F(GenomeFault, NoTopology) {
    genome_.topology = nullptr;
    EXPECT_EQ(fault_of(genome_), "there is no topology");
    EXPECT_FALSE(is_valid(genome_, weight_limit));
}

TEST_F(GenomeFault, MoreMarksThanEnds) {
    topology_.connection_ends.pop_back();
    EXPECT_EQ(fault(), "the gene arrays differ in length");
}

TEST_F(GenomeFault, MoreMarksThanWeights) {
    genome_.weights.pop_back();
    EXPECT_EQ(fault(), "the gene arrays differ in length");
}

TEST_F(GenomeFault, MoreMarksThanEnabledFlags) {
    genome_.enabled.pop_back();
    EXPECT_EQ(fault(), "the gene arrays differ in length");
}

TEST_F(GenomeFault, FewerMarksThanEnds) {
    topology_.connection_ends.push_back(topology_.connection_ends.back());
    EXPECT_EQ(fault(), "the gene arrays differ in length");
}

TEST_F(GenomeFault, FewerMarksThanWeights) {
    genome_.weights.push_back(0.0f);
    EXPECT_EQ(fault(), "the gene arrays differ in length");
}

TEST_F(GenomeFault, FewerMarksThanEnabledFlags) {
    genome_.enabled.push_back(1.0f);
    EXPECT_EQ(fault(), "the gene arrays differ in length");
}

TEST_F(GenomeFault, NeuronMarksOutOfOrder) {
    std::swap(topology_.neurons[0].mark, topology_.neurons[1].mark);
    EXPECT_EQ(fault(), "marks are not sorted and unique");
}

TEST_F(GenomeFault, ANeuronMarkTwice) {
    topology_.neurons.back().mark = topology_.neurons[topology_.neurons.size() - 2].mark;
    EXPECT_EQ(fault(), "marks are not sorted and unique");
}

TEST_F(GenomeFault, ConnectionMarksOutOfOrder) {
    std::swap(topology_.connection_marks[6], topology_.connection_marks[7]);
    EXPECT_EQ(fault(), "marks are not sorted and unique");
}

TEST_F(GenomeFault, AConnectionMarkTwice) {
    topology_.connection_marks[7] = topology_.connection_marks[6];
    EXPECT_EQ(fault(), "marks are not sorted and unique");
}

TEST_F(GenomeFault, NoInputs) {
    topology_.inputs = 0;
    EXPECT_EQ(fault(), "the initial genes do not come first");
}

TEST_F(GenomeFault, NoOutputs) {
    topology_.outputs = 0;
    for (NeuronGene& neuron : topology_.neurons) {
        if (neuron.kind == NeuronKind::output) neuron.kind = NeuronKind::hidden;
    }
    EXPECT_EQ(fault(), "the initial genes do not come first");
}

TEST_F(GenomeFault, FewerNeuronsThanInputsAndOutputs) {
    topology_.outputs = 4;
    topology_.neurons.back().kind = NeuronKind::output;
    EXPECT_EQ(fault(), "the initial genes do not come first");
}

TEST_F(GenomeFault, AnInputOfAnotherKind) {
    topology_.neurons[0].kind = NeuronKind::hidden;
    EXPECT_EQ(fault(), "the initial genes do not come first");
}

TEST_F(GenomeFault, ABiasOfAnotherKind) {
    topology_.neurons[2].kind = NeuronKind::input;
    EXPECT_EQ(fault(), "the initial genes do not come first");
}

TEST_F(GenomeFault, AnOutputOfAnotherKind) {
    topology_.neurons[4].kind = NeuronKind::hidden;
    EXPECT_EQ(fault(), "the initial genes do not come first");
}

TEST_F(GenomeFault, AHiddenNeuronOfAnotherKind) {
    topology_.neurons[5].kind = NeuronKind::output;
    EXPECT_EQ(fault(), "the initial genes do not come first");
}

TEST_F(GenomeFault, FewerConnectionsThanInitialOnes) {
    topology_.initial_connections = 10;
    EXPECT_EQ(fault(), "the initial genes do not come first");
}

TEST_F(GenomeFault, AnInitialConnectionOfARobotsMark) {
    topology_.connection_marks[2].robot = RobotId{9};
    EXPECT_EQ(fault(), "the initial genes do not come first");
}

TEST_F(GenomeFault, AConnectionFromAMissingNeuron) {
    topology_.connection_ends[7].source = mark(19);
    EXPECT_EQ(fault(), "a connection's neuron is missing");
}

TEST_F(GenomeFault, AConnectionToAMissingNeuron) {
    topology_.connection_ends[7].target = mark(19);
    EXPECT_EQ(fault(), "a connection's neuron is missing");
}

TEST_F(GenomeFault, AConnectionIntoAnInput) {
    topology_.connection_ends[7].target = genesis(1);
    EXPECT_EQ(fault(), "a connection ends in an input");
}

TEST_F(GenomeFault, AConnectionIntoTheBias) {
    topology_.connection_ends[7].target = genesis(3);
    EXPECT_EQ(fault(), "a connection ends in an input");
}

TEST_F(GenomeFault, TwoConnectionsBetweenTheSameNeurons) {
    topology_.connection_ends[8] = topology_.connection_ends[7];
    EXPECT_EQ(fault(), "two connections join the same neurons");
}

TEST_F(GenomeFault, AWeightAboveTheLimit) {
    genome_.weights[1] = std::nextafter(10.0f, 11.0f);
    EXPECT_EQ(fault(), "a weight is out of range");
}

TEST_F(GenomeFault, AWeightBelowTheLimit) {
    genome_.weights[1] = std::nextafter(-10.0f, -11.0f);
    EXPECT_EQ(fault(), "a weight is out of range");
}

TEST_F(GenomeFault, AWeightThatIsNoNumber) {
    genome_.weights[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(fault(), "a weight is out of range");
}

TEST_F(GenomeFault, AGeneHalfEnabled) {
    genome_.enabled[1] = 0.5f;
    EXPECT_EQ(fault(), "a gene is neither enabled nor disabled");
}

TEST_F(GenomeFault, AnEnabledFlagThatIsNoNumber) {
    genome_.enabled[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(fault(), "a gene is neither enabled nor disabled");
}

}  // namespace
}  // namespace gene_clocks::neat
