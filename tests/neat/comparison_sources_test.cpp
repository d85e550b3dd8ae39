// The innovation sources that gene clocks are compared with.

#include <gtest/gtest.h>

#include <gene_clocks/neat/congruence_class_source.hpp>
#include <gene_clocks/neat/content_hash_source.hpp>
#include <gene_clocks/neat/global_counter_source.hpp>
#include <gene_clocks/neat/hybrid_logical_clock_source.hpp>
#include <gene_clocks/neat/mutation.hpp>
#include <gene_clocks/neat/random_identifier_source.hpp>
#include <gene_clocks/neat/timestamp_source.hpp>
#include <gene_clocks/neat/unmerged_gene_clock_source.hpp>
#include <initializer_list>
#include <limits>
#include <memory>
#include <set>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

constexpr std::uint64_t genesis_marks = 5;  // of perceptron(2, 1)
constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();

InnovationNumber join(InnovationSource& source, const Genome& genome, ConnectionEnds ends = {},
                      double now_cycles = 0.0) {
    return source.mark_connection(genome, ends, now_cycles).value();
}

/// The genome after its connection `split` was split under `marks`.
Genome after_split(Genome genome, std::size_t split, const SplitMarks& marks) {
    const ConnectionEnds old = genome.topology->connection_ends[split];
    add_hidden(genome, marks.neuron);
    add_gene(genome, marks.incoming, {old.source, marks.neuron, old.recurrent});
    add_gene(genome, marks.outgoing, {marks.neuron, old.target, false});
    return genome;
}

TEST(UnmergedGeneClockSource, CountsAloneWhateverItHears) {
    const Genome genome = perceptron(2, 1);
    UnmergedGeneClockSource source(RobotId{3}, genesis_marks);
    EXPECT_EQ(source.stamp(), Stamp{});
    EXPECT_TRUE(source.observe(Stamp{1000}));
    EXPECT_EQ(join(source, genome), mark(6, 3));
    EXPECT_EQ(source.mark_split(genome, 0, 0.0)->outgoing, mark(9, 3));
}

TEST(SourcesThatLearnNothing, TakeEveryMessageAndSendNoStamp) {
    CongruenceClassSource steps(RobotId{3}, 10, genesis_marks);
    ContentHashSource hashes(genesis_marks);
    GlobalCounterSource counts(std::make_shared<InnovationRecord>(genesis_marks));
    RandomIdentifierSource draws(genesis_marks, RandomStream(1, 1));
    TimestampSource times(RobotId{3}, genesis_marks, {});
    for (InnovationSource* source :
         std::initializer_list<InnovationSource*>{&steps, &hashes, &counts, &draws, &times}) {
        EXPECT_TRUE(source->observe(Stamp{largest}));
        EXPECT_EQ(source->stamp(), Stamp{});
        EXPECT_EQ(source->stamp_to_send(0), Stamp{});
    }
}

TEST(CongruenceClassSource, StepsByTheNumberOfRobots) {
    const Genome genome = perceptron(2, 1);
    CongruenceClassSource source(RobotId{3}, 10, genesis_marks);
    EXPECT_EQ(join(source, genome), mark(8, 3));
    const auto marks = source.mark_split(genome, 0, 0.0).value();
    EXPECT_EQ(marks.neuron, mark(18, 3));
    EXPECT_EQ(marks.incoming, mark(28, 3));
    EXPECT_EQ(marks.outgoing, mark(38, 3));
}

TEST(CongruenceClassSource, NoCounterIsOfTwoRobots) {
    const Genome genome = perceptron(2, 1);
    std::set<std::uint64_t> counters;
    for (std::uint32_t robot = 1; robot <= 7; ++robot) {
        CongruenceClassSource source(RobotId{robot}, 7, genesis_marks);
        for (int i = 0; i < 20; ++i) {
            const std::uint64_t counter = join(source, genome).counter;
            EXPECT_GT(counter, genesis_marks);
            EXPECT_TRUE(counters.insert(counter).second);
        }
    }
}

TEST(CongruenceClassSource, EndsAtTheMaximumInsteadOfWrapping) {
    const Genome genome = perceptron(2, 1);
    CongruenceClassSource source(RobotId{1}, 100, largest - 250);
    EXPECT_EQ(source.mark_split(genome, 0, 0.0), std::nullopt);
    EXPECT_EQ(join(source, genome).counter, largest - 249);
    EXPECT_EQ(join(source, genome).counter, largest - 149);
    EXPECT_EQ(source.mark_connection(genome, {}, 0.0), std::nullopt);
}

TEST(RandomIdentifierSource, DrawsNeuronsFrom1To1000AboveGenesis) {
    const Genome genome = perceptron(2, 1);
    RandomIdentifierSource source(genesis_marks, RandomStream(1, 1));
    std::set<std::uint64_t> seen;
    for (int i = 0; i < 20'000; ++i) {
        seen.insert(source.mark_split(genome, 0, 0.0)->neuron.counter - genesis_marks);
    }
    EXPECT_EQ(seen.size(), 1000u);
    EXPECT_EQ(*seen.begin(), 1u);
    EXPECT_EQ(*seen.rbegin(), 1000u);
}

TEST(RandomIdentifierSource, DrawsAgainWhatTheGenomeHas) {
    Genome genome = perceptron(2, 1);
    RandomIdentifierSource source(genesis_marks, RandomStream(1, 1));
    while (const auto marks = source.mark_split(genome, 0, 0.0)) {
        ASSERT_FALSE(genome.topology->find_neuron(marks->neuron).has_value());
        add_hidden(genome, marks->neuron);
    }
    EXPECT_EQ(genome.topology->neurons.size(), 1000u);  // the three of the perceptron among them
}

TEST(RandomIdentifierSource, KnowsAConnectionByItsNeurons) {
    const Genome genome = perceptron(2, 1);
    RandomIdentifierSource one(genesis_marks, RandomStream(1, 1));
    RandomIdentifierSource other(genesis_marks, RandomStream(1, 2));
    std::set<InnovationNumber> marks;
    for (std::uint64_t source = 1; source <= 40; ++source) {
        for (std::uint64_t target = 1; target <= 40; ++target) {
            const ConnectionEnds ends{genesis(source), genesis(target)};
            EXPECT_EQ(join(one, genome, ends), join(other, genome, ends));
            EXPECT_TRUE(marks.insert(join(one, genome, ends)).second);
        }
    }
    EXPECT_GT(marks.begin()->counter, genesis_marks + 1000);  // no connection is a neuron
}

TEST(ContentHashSource, RobotsMeetInTheSameInnovation) {
    const Genome genome = perceptron(2, 1);
    ContentHashSource one(genesis_marks), other(genesis_marks);
    const auto a = one.mark_split(genome, 0, 1.0).value();
    const auto b = other.mark_split(genome, 0, 99.0).value();
    EXPECT_EQ(a.neuron, b.neuron);
    EXPECT_EQ(a.incoming, b.incoming);
    EXPECT_EQ(a.outgoing, b.outgoing);
    EXPECT_NE(a.neuron, one.mark_split(genome, 1, 1.0)->neuron);
    const ConnectionEnds ends{genesis(1), genesis(3)};
    const ConnectionEnds reversed{genesis(3), genesis(1)};
    EXPECT_EQ(join(one, genome, ends), join(other, genome, ends));
    EXPECT_NE(join(one, genome, ends), join(one, genome, reversed));
}

TEST(ContentHashSource, ASecondSplitOfOneConnectionIsAnotherInnovation) {
    const Genome genome = perceptron(2, 1);
    ContentHashSource one(genesis_marks), other(genesis_marks);
    const auto first = one.mark_split(genome, 0, 0.0).value();
    const Genome grown = after_split(genome, 0, first);
    const std::size_t split = index_of(grown, genesis(4));
    const auto second = one.mark_split(grown, split, 0.0).value();
    EXPECT_NE(second.neuron, first.neuron);
    EXPECT_EQ(second.neuron, other.mark_split(grown, split, 0.0)->neuron);
}

TEST(GlobalCounterSource, EqualInnovationsShareANumberAndOthersCountOn) {
    const Genome genome = perceptron(2, 1);
    const auto record = std::make_shared<InnovationRecord>(genesis_marks);
    GlobalCounterSource one(record), other(record);
    const auto a = one.mark_split(genome, 0, 0.0).value();
    EXPECT_EQ(a.neuron.counter, 6u);
    EXPECT_EQ(a.incoming.counter, 7u);
    EXPECT_EQ(a.outgoing.counter, 8u);
    EXPECT_EQ(other.mark_split(genome, 0, 0.0)->neuron, a.neuron);
    EXPECT_EQ(other.mark_split(genome, 1, 0.0)->neuron.counter, 9u);
    const ConnectionEnds ends{genesis(1), genesis(3)};
    EXPECT_EQ(join(one, genome, ends).counter, 12u);
    EXPECT_EQ(join(other, genome, ends).counter, 12u);
    EXPECT_EQ(join(other, genome, {genesis(3), genesis(1)}).counter, 13u);
}

TEST(GlobalCounterSource, ASecondSplitOfOneConnectionIsAnotherInnovation) {
    const Genome genome = perceptron(2, 1);
    GlobalCounterSource source(std::make_shared<InnovationRecord>(genesis_marks));
    const auto first = source.mark_split(genome, 0, 0.0).value();
    const Genome grown = after_split(genome, 0, first);
    EXPECT_EQ(source.mark_split(grown, index_of(grown, genesis(4)), 0.0)->neuron.counter, 9u);
}

constexpr std::uint64_t readings_per_cycle = std::uint64_t{1} << 26;
constexpr std::uint64_t epoch = readings_per_cycle << 31;

TEST(HybridLogicalClockSource, ReadsPhysicalTimeWhereItIsAhead) {
    const Genome genome = perceptron(2, 1);
    HybridLogicalClockSource source(RobotId{2}, genesis_marks, {});
    EXPECT_EQ(join(source, genome, {}, 10.0), mark(epoch + 10 * readings_per_cycle, 2));
    EXPECT_EQ(join(source, genome, {}, 20.0), mark(epoch + 20 * readings_per_cycle, 2));
}

TEST(HybridLogicalClockSource, CountsWithinATick) {
    const Genome genome = perceptron(2, 1);
    HybridLogicalClockSource source(RobotId{2}, genesis_marks, {});
    const auto marks = source.mark_split(genome, 0, 10.0).value();
    EXPECT_EQ(marks.neuron, mark(epoch + 10 * readings_per_cycle, 2));
    EXPECT_EQ(marks.incoming, mark(epoch + 10 * readings_per_cycle + 1, 2));
    EXPECT_EQ(marks.outgoing, mark(epoch + 10 * readings_per_cycle + 2, 2));
    EXPECT_EQ(join(source, genome, {}, 10.0), mark(epoch + 10 * readings_per_cycle + 3, 2));
}

TEST(HybridLogicalClockSource, GoesOnAboveAReadingFromAClockThatIsAhead) {
    const Genome genome = perceptron(2, 1);
    HybridLogicalClockSource ahead(RobotId{1}, genesis_marks, {.offset_cycles = 1000.0});
    HybridLogicalClockSource source(RobotId{2}, genesis_marks, {});
    const InnovationNumber known = join(ahead, genome, {}, 10.0);
    EXPECT_TRUE(source.observe(ahead.stamp()));
    EXPECT_EQ(join(source, genome, {}, 10.0), mark(known.counter + 1, 2));
    EXPECT_TRUE(source.observe(Stamp{3}));  // an old one changes nothing
    EXPECT_EQ(join(source, genome, {}, 10.0), mark(known.counter + 2, 2));
}

TEST(HybridLogicalClockSource, RefusesAReadingThatLeavesNoRoom) {
    const Genome genome = perceptron(2, 1);
    HybridLogicalClockSource source(RobotId{2}, genesis_marks, {});
    constexpr std::uint64_t limit = std::uint64_t{1} << 63;
    EXPECT_FALSE(source.observe(Stamp{limit}));
    EXPECT_FALSE(source.observe(Stamp{largest}));
    EXPECT_EQ(source.stamp(), Stamp{genesis_marks});
    EXPECT_TRUE(source.observe(Stamp{limit - 3}));
    EXPECT_EQ(source.mark_split(genome, 0, 0.0), std::nullopt);
    EXPECT_EQ(join(source, genome), mark(limit - 2, 2));
    EXPECT_EQ(source.mark_connection(genome, {}, 0.0), std::nullopt);
}

TEST(LocalTime, IsTimeWithOffsetAndDrift) {
    EXPECT_EQ(LocalTime{}.at(123.5), 123.5);
    EXPECT_EQ((LocalTime{.offset_cycles = -2.0, .drift_rate = 0.5}).at(10.0), 13.0);
}

TEST(LocalTime, SynchronisationSetsOffsetAndDriftBack) {
    const LocalTime time{
        .offset_cycles = 1000.0, .drift_rate = 0.01, .synchronised_every_cycles = 100.0};
    EXPECT_DOUBLE_EQ(time.at(50.0), 1050.5);  // not yet
    EXPECT_DOUBLE_EQ(time.at(100.0), 100.0);
    EXPECT_DOUBLE_EQ(time.at(150.0), 150.5);
    EXPECT_DOUBLE_EQ(time.at(1099.0), 1099.99);
}

TEST(LocalTime, ErrorsOfSynchronisationAreBoundedAndChangeEveryPeriod) {
    const LocalTime time{
        .synchronised_every_cycles = 100.0, .synchronisation_error_cycles = 5.0, .seed = 7};
    std::set<double> errors;
    double smallest = 0.0, greatest = 0.0;
    for (int period = 1; period <= 1000; ++period) {
        const double start = 100.0 * period;
        const double error = time.at(start) - start;
        EXPECT_NEAR(time.at(start + 99.0) - start - 99.0, error, 1e-6);
        smallest = std::min(smallest, error);
        greatest = std::max(greatest, error);
        errors.insert(error);
    }
    EXPECT_GT(errors.size(), 990u);
    EXPECT_NEAR(smallest, -5.0, 0.1);
    EXPECT_NEAR(greatest, 5.0, 0.1);
}

}  // namespace
}  // namespace gene_clocks::neat
