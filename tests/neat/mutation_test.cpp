#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gene_clocks/neat/mutation.hpp>
#include <map>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

/// Hands out marks 101, 102, … and remembers what it was asked.
class RecordingSource final : public InnovationSource {
public:
    std::optional<SplitMarks> mark_split(const Genome& genome, std::size_t connection,
                                         double now_cycles) override {
        ++calls;
        asked_size = genome.connections();
        split = connection;
        asked_at = now_cycles;
        if (exhausted) return std::nullopt;
        const std::uint64_t first = next;
        next += 3;
        return SplitMarks{mark(first), mark(first + 1), mark(first + 2)};
    }
    std::optional<InnovationNumber> mark_connection(const Genome& genome,
                                                    const ConnectionEnds& ends,
                                                    double now_cycles) override {
        ++calls;
        asked_size = genome.connections();
        joined = ends;
        asked_at = now_cycles;
        if (exhausted) return std::nullopt;
        return mark(next++);
    }
    Stamp stamp() const override { return {}; }
    bool observe(Stamp) override { return true; }

    int calls = 0;
    std::uint64_t next = 101;
    std::size_t asked_size = 0;
    std::size_t split = 0;
    ConnectionEnds joined;
    double asked_at = 0.0;
    bool exhausted = false;
};

/// The tolerance for a frequency: five standard deviations.
double tolerance(double probability, int draws) {
    return 5 * std::sqrt(probability * (1 - probability) / draws);
}

class MutationTest : public testing::Test {
protected:
    bool add_neuron_to(Genome& genome) {
        const bool added = add_neuron(genome, settings_, source_, 12.5, random_);
        EXPECT_EQ(fault_of(genome), "valid");
        return added;
    }
    bool add_connection_to(Genome& genome) {
        const bool added = add_connection(genome, settings_, source_, 12.5, random_);
        EXPECT_EQ(fault_of(genome), "valid");
        return added;
    }

    OdneatSettings settings_;
    RecordingSource source_;
    RandomStream random_{1, 1};
};

using AddNeuron = MutationTest;

TEST_F(AddNeuron, SplitsAConnection) {
    Genome genome = perceptron(2, 1);  // an input, the bias, an output
    genome.weights = {-3.5f, 7.0f};
    ASSERT_TRUE(add_neuron_to(genome));

    const Topology& topology = *genome.topology;
    ASSERT_EQ(topology.neurons.size(), 4u);
    EXPECT_EQ(topology.neurons[3], (NeuronGene{mark(101), NeuronKind::hidden}));
    ASSERT_EQ(genome.connections(), 4u);
    EXPECT_EQ(topology.connection_marks[2], mark(102));
    EXPECT_EQ(topology.connection_ends[2], (ConnectionEnds{genesis(1), mark(101), false}));
    EXPECT_EQ(topology.connection_marks[3], mark(103));
    EXPECT_EQ(topology.connection_ends[3], (ConnectionEnds{mark(101), genesis(3), false}));
    EXPECT_EQ(genome.weights, (std::vector<float>{-3.5f, 7.0f, 1.0f, -3.5f}));
    EXPECT_EQ(genome.enabled, (std::vector<float>{0.0f, 1.0f, 1.0f, 1.0f}));
}

TEST_F(AddNeuron, AsksForMarksOfTheGenomeAsItWas) {
    Genome genome = perceptron(2, 1);
    ASSERT_TRUE(add_neuron_to(genome));
    EXPECT_EQ(source_.calls, 1);
    EXPECT_EQ(source_.asked_size, 2u);
    EXPECT_EQ(source_.split, 0u);
    EXPECT_EQ(source_.asked_at, 12.5);
}

TEST_F(AddNeuron, NeverSplitsAConnectionFromTheBiasOrADisabledOne) {
    Genome genome = perceptron(2, 2);
    genome.enabled[0] = genome.enabled[1] = 0.0f;  // what is left comes from the bias
    const Genome before = genome;
    for (int i = 0; i < 1000; ++i) ASSERT_FALSE(add_neuron_to(genome));
    EXPECT_TRUE(same_genes(genome, before));
    EXPECT_EQ(genome.topology, before.topology);
    EXPECT_EQ(source_.calls, 0);
}

TEST_F(AddNeuron, DrawsUniformlyAmongTheSplittable) {
    settings_.structural_tries = 1000;  // so many that one finds a place
    std::map<std::size_t, int> splits;
    constexpr int draws = 30'000;
    for (int i = 0; i < draws; ++i) {
        Genome genome = perceptron(4, 1);
        genome.enabled[1] = 0.0f;
        ASSERT_TRUE(add_neuron_to(genome));
        ++splits[source_.split];
    }
    ASSERT_EQ(splits.size(), 2u);  // connections 0 and 2; 1 is disabled, 3 from the bias
    EXPECT_NEAR(splits[0] / double{draws}, 0.5, tolerance(0.5, draws));
}

TEST_F(AddNeuron, GivesUpAfterItsTries) {
    for (const std::int64_t tries : {1, 2, 20}) {
        settings_.structural_tries = tries;
        int added = 0;
        constexpr int draws = 20'000;
        for (int i = 0; i < draws; ++i) {
            Genome genome = perceptron(10, 1);  // one gene in ten can be split
            std::fill(genome.enabled.begin() + 1, genome.enabled.end(), 0.0f);
            added += add_neuron_to(genome) ? 1 : 0;
        }
        const double expected = 1.0 - std::pow(0.9, static_cast<double>(tries));
        EXPECT_NEAR(added / double{draws}, expected, tolerance(expected, draws)) << tries;
    }
}

TEST_F(AddNeuron, TheIncomingHalfKeepsARecurrentFlag) {
    Genome genome = perceptron(1, 1);  // bias and output
    add_gene(genome, mark(50), {genesis(2), genesis(2), true}, 0.5f);
    ASSERT_TRUE(add_neuron_to(genome));
    const Topology& topology = *genome.topology;
    EXPECT_EQ(topology.connection_ends[2], (ConnectionEnds{genesis(2), mark(101), true}));
    EXPECT_EQ(topology.connection_ends[3], (ConnectionEnds{mark(101), genesis(2), false}));
}

TEST_F(AddNeuron, KeepsEachGenesDataTogetherWhereTheMarksSortBeforeOthers) {
    Genome genome = perceptron(2, 1);
    genome.weights = {0.25f, 0.5f};
    add_gene(genome, mark(500), {genesis(3), genesis(3), true}, 0.75f, false);
    ASSERT_TRUE(add_neuron_to(genome));  // only the first gene can be split
    const std::vector<InnovationNumber> marks{genesis(4), genesis(5), mark(102), mark(103),
                                              mark(500)};
    EXPECT_EQ(genome.topology->connection_marks, marks);
    EXPECT_EQ(genome.weights, (std::vector<float>{0.25f, 0.5f, 1.0f, 0.25f, 0.75f}));
    EXPECT_EQ(genome.enabled, (std::vector<float>{0.0f, 1.0f, 1.0f, 1.0f, 0.0f}));
}

TEST_F(AddNeuron, LeavesTheSharedTopologyAlone) {
    Genome genome = perceptron(2, 1);
    const auto shared = genome.topology;
    const Topology copy = *shared;
    ASSERT_TRUE(add_neuron_to(genome));
    EXPECT_TRUE(same_structure(*shared, copy));
    EXPECT_NE(genome.topology, shared);
}

TEST_F(AddNeuron, HappensNotWhereTheSourceIsExhausted) {
    Genome genome = perceptron(2, 1);
    const Genome before = genome;
    source_.exhausted = true;
    EXPECT_FALSE(add_neuron_to(genome));
    EXPECT_EQ(source_.calls, 1);
    EXPECT_TRUE(same_genes(genome, before));
}

using AddConnection = MutationTest;

TEST_F(AddConnection, JoinsTwoNeuronsWithANewMark) {
    settings_.p_recurrent = 0.0;
    Genome genome = perceptron(2, 1);
    add_hidden(genome, mark(20));
    // Free feed-forward pairs: both inputs to the hidden neuron, and that to the output.
    ASSERT_TRUE(add_connection_to(genome));
    ASSERT_EQ(genome.connections(), 3u);
    EXPECT_EQ(genome.topology->connection_marks[2], mark(101));
    EXPECT_EQ(genome.topology->connection_ends[2], source_.joined);
    EXPECT_EQ(genome.enabled[2], 1.0f);
    EXPECT_EQ(source_.calls, 1);
    EXPECT_EQ(source_.asked_size, 2u);
    EXPECT_EQ(source_.asked_at, 12.5);
}

TEST_F(AddConnection, KeepsEachGenesDataTogetherWhereTheMarkSortsBeforeOthers) {
    settings_.p_recurrent = 1.0;
    Genome genome = perceptron(1, 2);
    genome.weights = {0.25f, 0.5f};
    add_gene(genome, mark(500), {genesis(2), genesis(2), true}, 7.0f, false);
    ASSERT_TRUE(add_connection_to(genome));
    ASSERT_EQ(genome.connections(), 4u);
    EXPECT_EQ(genome.topology->connection_marks[2], mark(101));
    EXPECT_EQ(genome.topology->connection_marks[3], mark(500));
    EXPECT_LT(std::abs(genome.weights[2]), 1.0f);
    EXPECT_EQ(genome.weights[3], 7.0f);
    EXPECT_EQ(genome.enabled, (std::vector<float>{1.0f, 1.0f, 1.0f, 0.0f}));
}

TEST_F(AddConnection, AWholeFeedForwardNetworkLeavesNoPlace) {
    settings_.p_recurrent = 0.0;
    Genome genome = perceptron(3, 2);
    genome.enabled[0] = 0.0f;  // a pair joined by a disabled gene is joined
    const Genome before = genome;
    for (int i = 0; i < 1000; ++i) ASSERT_FALSE(add_connection_to(genome));
    EXPECT_TRUE(same_genes(genome, before));
    EXPECT_EQ(source_.calls, 0);
}

TEST_F(AddConnection, FillsEveryFeedForwardPlaceAndNoOther) {
    settings_.p_recurrent = 0.0;
    Genome genome = perceptron(2, 2);
    add_hidden(genome, mark(20));
    for (int i = 0; i < 2000; ++i) add_connection_to(genome);
    // From both inputs to the hidden neuron, and from that to both outputs.
    ASSERT_EQ(genome.connections(), 4u + 4u);
    for (const auto input : {genesis(1), genesis(2)}) {
        EXPECT_TRUE(genome.topology->joined(input, mark(20)));
    }
    for (const auto output : {genesis(3), genesis(4)}) {
        EXPECT_TRUE(genome.topology->joined(mark(20), output));
    }
    for (const auto& ends : genome.topology->connection_ends) EXPECT_FALSE(ends.recurrent);
}

TEST_F(AddConnection, FillsEveryRecurrentPlaceAndNoOther) {
    settings_.p_recurrent = 1.0;
    Genome genome = perceptron(2, 2);
    add_hidden(genome, mark(20));
    add_gene(genome, mark(21), {genesis(1), mark(20), false});
    add_gene(genome, mark(22), {mark(20), genesis(3), false});
    for (int i = 0; i < 2000; ++i) add_connection_to(genome);
    // Three self-loops; outputs 3 and 4 to one another and back to the hidden neuron.
    ASSERT_EQ(genome.connections(), 4u + 2u + 7u);
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        const ConnectionEnds& ends = genome.topology->connection_ends[i];
        EXPECT_EQ(ends.recurrent, genome.topology->connection_marks[i] >= mark(101));
        if (ends.recurrent) {
            EXPECT_TRUE(ends.source == ends.target || ends.source == genesis(3) ||
                        ends.source == genesis(4));
        }
    }
}

TEST_F(AddConnection, IsRecurrentWithItsProbability) {
    settings_.p_recurrent = 0.3;
    int recurrent = 0;
    constexpr int draws = 20'000;
    // So many free places of either kind that twenty tries find one.
    Genome base = perceptron(2, 2);
    for (std::uint64_t i = 0; i < 10; ++i) add_hidden(base, mark(20 + i));
    for (int i = 0; i < draws; ++i) {
        Genome genome = base;
        ASSERT_TRUE(add_connection_to(genome));
        recurrent += source_.joined.recurrent ? 1 : 0;
    }
    EXPECT_NEAR(recurrent / double{draws}, 0.3, tolerance(0.3, draws));
}

TEST_F(AddConnection, HalfOfTheRecurrentTriesAreSelfLoops) {
    settings_.p_recurrent = 1.0;
    int self_loops = 0;
    constexpr int draws = 20'000;
    for (int i = 0; i < draws; ++i) {
        Genome genome = perceptron(3, 4);
        ASSERT_TRUE(add_connection_to(genome));
        self_loops += source_.joined.source == source_.joined.target ? 1 : 0;
    }
    // The other half draws both ends among four outputs, all of which give a recurrent one.
    const double expected = 0.5 + 0.5 / 4.0;
    EXPECT_NEAR(self_loops / double{draws}, expected, tolerance(expected, draws));
}

TEST_F(AddConnection, DrawsEndsUniformly) {
    settings_.structural_tries = 1000;  // so many that one finds a place
    settings_.p_recurrent = 0.0;
    std::map<std::pair<std::uint64_t, std::uint64_t>, int> counts;
    constexpr int draws = 40'000;
    Genome base = perceptron(2, 1);
    add_hidden(base, mark(20));
    for (int i = 0; i < draws; ++i) {
        Genome genome = base;
        ASSERT_TRUE(add_connection_to(genome));
        ++counts[{source_.joined.source.counter, source_.joined.target.counter}];
    }
    ASSERT_EQ(counts.size(), 3u);
    for (const auto& [ends, count] : counts) {
        EXPECT_NEAR(count / double{draws}, 1.0 / 3.0, tolerance(1.0 / 3.0, draws));
    }
}

TEST_F(AddConnection, DrawsItsWeightUniformlyFromMinusOneToOne) {
    settings_.p_recurrent = 1.0;
    double sum = 0.0, squares = 0.0, lowest = 1.0, highest = -1.0;
    constexpr int draws = 50'000;
    for (int i = 0; i < draws; ++i) {
        Genome genome = perceptron(1, 1);
        ASSERT_TRUE(add_connection_to(genome));
        const double weight = genome.weights.back();
        sum += weight;
        squares += weight * weight;
        lowest = std::min(lowest, weight);
        highest = std::max(highest, weight);
    }
    EXPECT_NEAR(sum / draws, 0.0, 5 * std::sqrt(1.0 / 3.0 / draws));
    EXPECT_NEAR(squares / draws, 1.0 / 3.0, 0.01);
    EXPECT_GE(lowest, -1.0);
    EXPECT_LT(lowest, -0.999);
    EXPECT_LE(highest, 1.0);
    EXPECT_GT(highest, 0.999);
}

TEST_F(AddConnection, GivesUpAfterItsTries) {
    settings_.p_recurrent = 0.0;
    for (const std::int64_t tries : {1, 3}) {
        settings_.structural_tries = tries;
        int added = 0;
        constexpr int draws = 20'000;
        for (int i = 0; i < draws; ++i) {
            Genome genome = perceptron(2, 1);
            add_hidden(genome, mark(20));
            added += add_connection_to(genome) ? 1 : 0;
        }
        // Of the 4 · 2 pairs of a source and a target, three are free and feed-forward.
        const double expected = 1.0 - std::pow(5.0 / 8.0, static_cast<double>(tries));
        EXPECT_NEAR(added / double{draws}, expected, tolerance(expected, draws)) << tries;
    }
}

TEST_F(AddConnection, HappensNotWhereTheSourceIsExhausted) {
    settings_.p_recurrent = 1.0;
    Genome genome = perceptron(2, 1);
    const Genome before = genome;
    source_.exhausted = true;
    EXPECT_FALSE(add_connection_to(genome));
    EXPECT_EQ(source_.calls, 1);
    EXPECT_TRUE(same_genes(genome, before));
}

/// Inputs 1 and the bias 2, output 3, hidden neurons 20, 30 and 40: 1 → 20 → 30 → 3.
class IsRecurrent : public testing::Test {
protected:
    IsRecurrent() : genome_(perceptron(2, 1)) {
        for (const std::uint64_t neuron : {20u, 30u, 40u}) add_hidden(genome_, mark(neuron));
        add_gene(genome_, mark(50), {genesis(1), mark(20), false});
        add_gene(genome_, mark(51), {mark(20), mark(30), false});
        add_gene(genome_, mark(52), {mark(30), genesis(3), false});
    }
    Genome genome_;
};

TEST_F(IsRecurrent, SelfLoopsAre) {
    EXPECT_TRUE(is_recurrent(genome_, mark(20), mark(20)));
    EXPECT_TRUE(is_recurrent(genome_, mark(40), mark(40)));
}

TEST_F(IsRecurrent, EverythingOutOfAnOutputIs) {
    EXPECT_TRUE(is_recurrent(genome_, genesis(3), mark(40)));
    EXPECT_TRUE(is_recurrent(genome_, genesis(3), mark(20)));
}

TEST_F(IsRecurrent, APathBackMakesACycle) {
    EXPECT_TRUE(is_recurrent(genome_, mark(30), mark(20)));
    EXPECT_FALSE(is_recurrent(genome_, mark(20), mark(30)));
    EXPECT_FALSE(is_recurrent(genome_, mark(40), mark(20)));
    EXPECT_FALSE(is_recurrent(genome_, mark(30), mark(40)));
}

TEST_F(IsRecurrent, ALongPathBackMakesACycle) {
    add_gene(genome_, mark(53), {mark(30), mark(40), false});
    EXPECT_TRUE(is_recurrent(genome_, mark(40), mark(20)));
}

TEST_F(IsRecurrent, DisabledConnectionsMakeNoPath) {
    genome_.enabled[index_of(genome_, mark(51))] = 0.0f;
    EXPECT_FALSE(is_recurrent(genome_, mark(30), mark(20)));
}

TEST_F(IsRecurrent, RecurrentConnectionsMakeNoPath) {
    add_gene(genome_, mark(53), {mark(30), mark(40), true});
    EXPECT_FALSE(is_recurrent(genome_, mark(40), mark(20)));
}

TEST_F(IsRecurrent, TheSearchEndsWhereThereIsACycleAlready) {
    // Crossover can enable a gene whose reverse was added while it was disabled.
    add_gene(genome_, mark(53), {mark(30), mark(20), false});
    EXPECT_FALSE(is_recurrent(genome_, mark(40), mark(20)));
    EXPECT_TRUE(is_recurrent(genome_, mark(30), mark(20)));
}

using MutateWeights = MutationTest;

TEST_F(MutateWeights, AddsANormalVariableOfTheGivenDeviationToEnabledWeights) {
    settings_.sigma = 0.3;
    Genome genome = perceptron(100, 100);
    for (std::size_t i = 0; i < genome.connections(); i += 2) genome.enabled[i] = 0.0f;
    genome.weights.assign(genome.connections(), 2.0f);
    mutate_weights(genome, settings_, random_);
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        const double change = genome.weights[i] - 2.0;
        if (i % 2 == 0) {
            ASSERT_EQ(change, 0.0);
        } else {
            sum += change;
            squares += change * change;
        }
    }
    EXPECT_NEAR(sum / 5000, 0.0, 5 * 0.3 / std::sqrt(5000.0));
    EXPECT_NEAR(std::sqrt(squares / 5000), 0.3, 0.02);
}

TEST_F(MutateWeights, ClipsAtTheLimit) {
    settings_.sigma = 5.0;
    Genome genome = perceptron(10, 10);
    genome.weights.assign(genome.connections(), 9.0f);
    for (int i = 0; i < 100; ++i) mutate_weights(genome, settings_, random_);
    EXPECT_EQ(fault_of(genome), "valid");
    EXPECT_GT(std::count(genome.weights.begin(), genome.weights.end(), 10.0f), 0);
    EXPECT_GT(std::count(genome.weights.begin(), genome.weights.end(), -10.0f), 0);
}

TEST_F(MutateWeights, KeepsTheSharedTopology) {
    Genome genome = perceptron(10, 10);
    const auto shared = genome.topology;
    mutate_weights(genome, settings_, random_);
    EXPECT_EQ(genome.topology, shared);
}

using Mutate = MutationTest;

TEST_F(Mutate, DoesOneThingOrNothingWithTheProbabilitiesOfAChain) {
    settings_.p_node = 0.3;
    settings_.p_connection = 0.4;
    settings_.p_weight = 0.5;
    settings_.p_recurrent = 1.0;
    std::map<Mutation, int> counts;
    constexpr int draws = 40'000;
    const Genome base = perceptron(3, 2);
    for (int i = 0; i < draws; ++i) {
        Genome genome = base;
        const Mutation done = mutate(genome, settings_, source_, 0.0, random_);
        ++counts[done];
        // What was done is what the genome shows, and nothing else.
        ASSERT_EQ(genome.topology->neurons.size(),
                  base.topology->neurons.size() + (done == Mutation::add_neuron ? 1u : 0u));
        const std::size_t new_connections = done == Mutation::add_neuron       ? 2
                                            : done == Mutation::add_connection ? 1
                                                                               : 0;
        ASSERT_EQ(genome.connections(), base.connections() + new_connections);
        const bool same_initial_weights =
            std::equal(base.weights.begin(), base.weights.end(), genome.weights.begin());
        ASSERT_EQ(same_initial_weights, done != Mutation::weights);
    }
    const auto expect = [&](Mutation mutation, double probability) {
        EXPECT_NEAR(counts[mutation] / double{draws}, probability, tolerance(probability, draws));
    };
    expect(Mutation::add_neuron, 0.3);
    expect(Mutation::add_connection, 0.7 * 0.4);
    expect(Mutation::weights, 0.7 * 0.6 * 0.5);
    expect(Mutation::none, 0.7 * 0.6 * 0.5);
}

TEST_F(Mutate, DoesNothingElseWhereAStructuralMutationFindsNoPlace) {
    Genome genome = perceptron(1, 1);  // only the bias: nothing to split, no free forward place
    const Genome before = genome;
    settings_.p_node = 1.0;
    settings_.p_connection = 1.0;
    settings_.p_weight = 1.0;
    EXPECT_EQ(mutate(genome, settings_, source_, 0.0, random_), Mutation::none);
    settings_.p_node = 0.0;
    settings_.p_recurrent = 0.0;
    EXPECT_EQ(mutate(genome, settings_, source_, 0.0, random_), Mutation::none);
    EXPECT_TRUE(same_genes(genome, before));
}

TEST_F(Mutate, DoesNoStructuralMutationWhereTheSourceIsExhausted) {
    source_.exhausted = true;
    Genome genome = perceptron(3, 2);
    const Genome before = genome;
    settings_.p_node = 1.0;
    EXPECT_EQ(mutate(genome, settings_, source_, 0.0, random_), Mutation::none);
    settings_.p_node = 0.0;
    settings_.p_connection = 1.0;
    settings_.p_recurrent = 1.0;
    EXPECT_EQ(mutate(genome, settings_, source_, 0.0, random_), Mutation::none);
    EXPECT_TRUE(same_genes(genome, before));
}

}  // namespace
}  // namespace gene_clocks::neat
