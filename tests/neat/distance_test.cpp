#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <gene_clocks/neat/distance.hpp>
#include <map>
#include <utility>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

DistanceMeasure measure(WeightDifference weight_difference) {
    OdneatSettings settings;  // c1 = 0.5, c2 = 1.5, c3 = 0.4, as in the paper's Table 1
    settings.weight_difference = weight_difference;
    return DistanceMeasure(settings);
}
DistanceMeasure measure(Mismatch mismatch) {
    OdneatSettings settings;
    settings.mismatch = mismatch;
    return DistanceMeasure(settings);
}
const DistanceMeasure by_age = measure(Mismatch::age);
const DistanceMeasure since_common = measure(Mismatch::since_common);
const DistanceMeasure by_sum = measure(WeightDifference::sum);
const DistanceMeasure by_mean = measure(WeightDifference::mean);

/// Two inputs and two outputs with four initial connections, and hidden neurons that further
/// connections may join.
Genome base() {
    return with_hidden(perceptron(2, 2), 8);
}

/// Adds a connection of this mark somewhere, with weight 0 unless said otherwise.
void add(Genome& genome, InnovationNumber at, float weight = 0.0f, bool enabled = true) {
    const std::uint64_t place = genome.connections() - 4;
    add_gene(genome, at, {genesis(1 + place % 2), genesis(1000 + place / 2), false}, weight,
             enabled);
    ASSERT_EQ(fault_of(genome), "valid");
}

TEST(Distance, OfAGenomeFromItselfIsZero) {
    Genome genome = base();
    genome.weights = {1.0f, -2.0f, 3.0f, 10.0f};
    add(genome, mark(20), 5.0f);
    EXPECT_EQ(distance(genome, genome, by_sum), 0.0f);
    EXPECT_EQ(distance(genome, genome, by_mean), 0.0f);
}

TEST(Distance, TakesTheSumOrTheMeanOfWeightDifferences) {
    Genome first = base();
    Genome second = first;
    first.weights = {1.0f, 0.0f, -2.0f, 4.0f};
    second.weights = {0.0f, 0.0f, 1.0f, 4.0f};
    EXPECT_FLOAT_EQ(distance(first, second, by_sum), 0.4f * (1.0f + 3.0f));
    EXPECT_FLOAT_EQ(distance(first, second, by_mean), 0.4f * (1.0f + 3.0f) / 4.0f);
}

TEST(Distance, LeavesOutTheWeightsOfGenesDisabledInEither) {
    Genome first = base();
    Genome second = first;
    first.weights = {1.0f, 2.0f, 4.0f, 8.0f};
    first.enabled = {0.0f, 1.0f, 0.0f, 1.0f};
    second.enabled = {1.0f, 0.0f, 0.0f, 1.0f};
    EXPECT_FLOAT_EQ(distance(first, second, by_sum), 0.4f * 8.0f);
    EXPECT_FLOAT_EQ(distance(first, second, by_mean), 0.4f * 8.0f / 1.0f);
}

TEST(Distance, HasNoWeightTermWhereNoMatchingGeneIsEnabledInBoth) {
    Genome first = base();
    Genome second = first;
    first.weights = {1.0f, 2.0f, 4.0f, 8.0f};
    first.enabled = {0.0f, 0.0f, 0.0f, 0.0f};
    EXPECT_EQ(distance(first, second, by_sum), 0.0f);
    EXPECT_EQ(distance(first, second, by_mean), 0.0f);
    OdneatSettings settings;
    settings.weight_difference = WeightDifference::mean;
    settings.mismatch = Mismatch::age;
    EXPECT_EQ(distance(first, second, DistanceMeasure(settings)), 0.0f);
}

TEST(Distance, CountsExcessGenes) {
    Genome first = base();
    Genome second = first;
    add(second, mark(20));
    add(second, mark(21));
    // N = 6 genes of the larger genome, E = 2, D = 0.
    EXPECT_FLOAT_EQ(distance(first, second, by_sum), 0.5f * 2.0f / 6.0f);
    EXPECT_FLOAT_EQ(distance(second, first, by_sum), 0.5f * 2.0f / 6.0f);
}

TEST(Distance, CountsDisjointGenes) {
    Genome first = base();
    Genome second = first;
    add(first, mark(30));
    add(second, mark(20));
    add(second, mark(21));
    add(second, mark(30));
    // N = 7, E = 0, D = 2: both lists end with the mark 30.
    EXPECT_FLOAT_EQ(distance(first, second, by_sum), 1.5f * 2.0f / 7.0f);
}

TEST(Distance, ExcessLiesWithTheGenomeOfTheLargerLastMarkThoughItIsTheSmaller) {
    Genome first = base();
    Genome second = first;
    add(first, mark(50));
    add(second, mark(20));
    add(second, mark(21));
    // N = 6, E = 1 (the mark 50), D = 2.
    EXPECT_FLOAT_EQ(distance(first, second, by_sum), 0.5f * 1.0f / 6.0f + 1.5f * 2.0f / 6.0f);
}

TEST(Distance, TellsEqualCountersApartByTheRobot) {
    Genome first = base();
    Genome second = first;
    add(first, mark(20, 1));
    add(second, mark(20, 2));
    // N = 5; robot 1's gene sorts first: D = 1, E = 1.
    EXPECT_FLOAT_EQ(distance(first, second, by_sum), 0.5f / 5.0f + 1.5f / 5.0f);
}

TEST(Distance, IsEquation1ForMatchingDisjointAndExcessGenesAtOnce) {
    Genome first = base();
    Genome second = first;
    first.weights = {1.0f, 1.0f, 1.0f, 1.0f};
    add(first, mark(20), 2.0f);
    add(first, mark(22), 9.0f);
    add(first, mark(25, 2), 3.0f);
    add(second, mark(21), 9.0f);
    add(second, mark(25, 2), 5.0f);
    add(second, mark(26), 9.0f);
    add(second, mark(27), 9.0f);
    add(second, mark(28), 9.0f);
    // N = 9; matching: the four initial genes and 25 (|Δw| = 4 · 1 + 2); D: 20, 21, 22; E: 26…28.
    const float structure = 0.5f * 3.0f / 9.0f + 1.5f * 3.0f / 9.0f;
    EXPECT_FLOAT_EQ(distance(first, second, by_sum), structure + 0.4f * 6.0f);
    EXPECT_FLOAT_EQ(distance(first, second, by_mean), structure + 0.4f * 6.0f / 5.0f);
}

TEST(Distance, CountsDisabledGenesInNAndAmongUnmatchedOnes) {
    Genome first = base();
    Genome second = first;
    first.enabled.assign(4, 0.0f);
    add(second, mark(20), 0.0f, false);
    add(second, mark(21), 0.0f, false);
    EXPECT_FLOAT_EQ(distance(first, second, by_sum), 0.5f * 2.0f / 6.0f);
}

TEST(Distance, DoesNotCountNeuronGenes) {
    const Genome first = base();
    const Genome second = with_hidden(perceptron(2, 2), 3);
    EXPECT_EQ(distance(first, second, by_sum), 0.0f);
}

TEST(Distance, TakesItsCoefficientsFromTheSettings) {
    OdneatSettings settings;
    settings.c_excess = 2.0;
    settings.c_disjoint = 3.0;
    settings.c_weight = 5.0;
    Genome first = base();
    Genome second = first;
    first.weights[0] = 1.0f;
    add(first, mark(20));
    add(second, mark(21));
    EXPECT_FLOAT_EQ(distance(first, second, DistanceMeasure(settings)),
                    2.0f / 5.0f + 3.0f / 5.0f + 5.0f);
}

TEST(Distance, ByAgeAnOlderMissingGeneCountsMore) {
    Genome all = base();
    for (const std::uint64_t counter : {20u, 21u, 22u}) add(all, mark(counter));
    // (c1 + c2) / 2 = 1; N = 7; of three genes the ages are 5/3, 3/3 and 1/3.
    const auto without = [](std::uint64_t missing) {
        Genome genome = base();
        for (const std::uint64_t counter : {20u, 21u, 22u}) {
            if (counter != missing) add(genome, mark(counter));
        }
        return genome;
    };
    EXPECT_FLOAT_EQ(distance(all, without(20), by_age), 5.0f / 3.0f / 7.0f);
    EXPECT_FLOAT_EQ(distance(all, without(21), by_age), 3.0f / 3.0f / 7.0f);
    EXPECT_FLOAT_EQ(distance(all, without(22), by_age), 1.0f / 3.0f / 7.0f);
}

TEST(Distance, ByAgeIsEquation1WithTheMeanCoefficientForGenomesThatShareInitialGenesAlone) {
    Genome first = base();
    Genome second = first;
    for (const std::uint64_t counter : {20u, 23u}) add(first, mark(counter));
    for (const std::uint64_t counter : {21u, 22u, 24u, 25u, 26u}) add(second, mark(counter));
    EXPECT_FLOAT_EQ(distance(first, second, by_age), 7.0f / 9.0f);
    EXPECT_FLOAT_EQ(distance(first, base(), by_age), 2.0f / 6.0f);
}

TEST(Distance, ByAgeRanksCountAndNotTheMarksThemselves) {
    const auto pair_at = [](std::uint64_t scale) {
        std::pair<Genome, Genome> pair{base(), base()};
        for (const std::uint64_t counter : {20u, 21u, 25u}) add(pair.first, mark(counter * scale));
        for (const std::uint64_t counter : {20u, 22u, 23u}) add(pair.second, mark(counter * scale));
        return pair;
    };
    const auto counters = pair_at(1);
    const auto times = pair_at(1'000'000'007);
    const float expected = (3.0f + 1.0f) / 3.0f + (3.0f + 1.0f) / 3.0f;
    EXPECT_FLOAT_EQ(distance(counters.first, counters.second, by_age), expected / 7.0f);
    EXPECT_EQ(distance(times.first, times.second, by_age),
              distance(counters.first, counters.second, by_age));
}

TEST(Distance, SinceTheLastCommonGeneAllUnmatchedOnesAreExcess) {
    Genome first = base();
    Genome second = first;
    for (const std::uint64_t counter : {20u, 22u, 25u, 26u}) add(first, mark(counter));
    for (const std::uint64_t counter : {21u, 22u, 24u, 27u}) add(second, mark(counter));
    // 22 is common. Below it 20 and 21; above it 25, 26 and 24, 27.
    EXPECT_FLOAT_EQ(distance(first, second, since_common), (0.5f * 4.0f + 1.5f * 2.0f) / 8.0f);
    // Equation 1 counts 27 alone as excess.
    EXPECT_FLOAT_EQ(distance(first, second, by_sum), (0.5f * 1.0f + 1.5f * 5.0f) / 8.0f);
}

// ---- properties over pairs that random histories make ----

struct Pair {
    Genome first;
    Genome second;
};

/// Two descendants of one ancestor, of sizes that differ; sometimes of one topology.
Pair random_pair() {
    RandomStream random(*rc::gen::arbitrary<std::uint32_t>(), 0);
    const auto inputs = *rc::gen::inRange<std::size_t>(1, 12);
    const auto outputs = *rc::gen::inRange<std::size_t>(1, 4);
    const std::uint64_t genesis_marks = genesis_mark_count(inputs, outputs);
    GeneClockSource clock_1(RobotId{1}, genesis_marks);
    GeneClockSource clock_2(RobotId{2}, genesis_marks);
    Genome ancestor =
        make_initial_genome({}, make_initial_topology(inputs, outputs), weight_limit, random);
    grow(ancestor, *rc::gen::inRange<std::size_t>(0, 12), clock_1, random);
    const bool heard = *rc::gen::arbitrary<bool>() && clock_2.observe(clock_1.stamp());
    RC_CLASSIFY(heard, "the marks interleave");
    Pair pair{ancestor, ancestor};
    grow(pair.first, *rc::gen::inRange<std::size_t>(0, 12), clock_1, random);
    grow(pair.second, *rc::gen::inRange<std::size_t>(0, 12), clock_2, random);
    return pair;
}

DistanceMeasure random_measure() {
    OdneatSettings settings;
    settings.weight_difference = *rc::gen::element(WeightDifference::sum, WeightDifference::mean);
    settings.mismatch =
        *rc::gen::element(Mismatch::excess_disjoint, Mismatch::age, Mismatch::since_common);
    return DistanceMeasure(settings);
}

/// Over unmatched genes, the sum of (2·(k − r) + 1)/k; r counts the genes up to this one that are
/// not initial, k all of them.
template <class Genes>
double naive_ages(const Genes& genes, const Genes& others, std::size_t initial) {
    const auto k = static_cast<double>(genes.size() - initial);
    double ages = 0.0;
    double rank = -static_cast<double>(initial);
    for (const auto& [mark, gene] : genes) {
        rank += 1.0;
        if (!others.contains(mark)) ages += (2 * (k - rank) + 1) / k;
    }
    return ages;
}

/// The distance in double precision from maps, without a merge.
double naive_distance(const Genome& first, const Genome& second, const DistanceMeasure& measure) {
    struct Weight {
        double weight;
        bool enabled;
    };
    const auto genes_of = [](const Genome& genome) {
        std::map<InnovationNumber, Weight> genes;
        for (std::size_t i = 0; i < genome.connections(); ++i) {
            genes[genome.topology->connection_marks[i]] = {genome.weights[i], genome.is_enabled(i)};
        }
        return genes;
    };
    const auto genes_1 = genes_of(first);
    const auto genes_2 = genes_of(second);
    auto end = std::min(genes_1.rbegin()->first, genes_2.rbegin()->first);
    if (measure.mismatch == Mismatch::since_common) {
        for (const auto& [mark, gene] : genes_1) {
            if (genes_2.contains(mark)) end = mark;
        }
    }
    double excess = 0.0, disjoint = 0.0, weights = 0.0, matching = 0.0;
    const auto count_missing = [&](const auto& genes, const auto& others) {
        for (const auto& [mark, gene] : genes) {
            if (others.contains(mark)) continue;
            (end < mark ? excess : disjoint) += 1.0;
        }
    };
    count_missing(genes_1, genes_2);
    count_missing(genes_2, genes_1);
    for (const auto& [mark, gene] : genes_1) {
        const auto other = genes_2.find(mark);
        if (other == genes_2.end() || !gene.enabled || !other->second.enabled) continue;
        weights += std::abs(gene.weight - other->second.weight);
        matching += 1.0;
    }
    if (measure.weight_difference == WeightDifference::mean && matching > 0.0) weights /= matching;
    const double size = static_cast<double>(std::max(genes_1.size(), genes_2.size()));
    if (measure.mismatch == Mismatch::age) {
        const double ages = naive_ages(genes_1, genes_2, first.topology->initial_connections) +
                            naive_ages(genes_2, genes_1, second.topology->initial_connections);
        return (double{measure.c_excess} + double{measure.c_disjoint}) / 2 * ages / size +
               double{measure.c_weight} * weights;
    }
    return double{measure.c_excess} * excess / size + double{measure.c_disjoint} * disjoint / size +
           double{measure.c_weight} * weights;
}

RC_GTEST_PROP(DistanceProperty, EqualsANaiveVersion, ()) {
    const Pair pair = random_pair();
    const DistanceMeasure chosen = random_measure();
    const double expected = naive_distance(pair.first, pair.second, chosen);
    RC_ASSERT(std::abs(double{distance(pair.first, pair.second, chosen)} - expected) <=
              1e-5 * (1.0 + expected));
}

RC_GTEST_PROP(DistanceProperty, IsSymmetricBitForBit, ()) {
    const Pair pair = random_pair();
    const DistanceMeasure chosen = random_measure();
    RC_ASSERT(distance(pair.first, pair.second, chosen) ==
              distance(pair.second, pair.first, chosen));
}

RC_GTEST_PROP(DistanceProperty, IsTheSameBitForBitWhetherATopologyIsSharedOrEqual, ()) {
    Pair pair = random_pair();
    const DistanceMeasure chosen = random_measure();
    RandomStream random(*rc::gen::arbitrary<std::uint32_t>(), 1);
    pair.second = pair.first;
    mutate_weights(pair.second, OdneatSettings{}, random);
    const float shared = distance(pair.first, pair.second, chosen);
    pair.second.topology = std::make_shared<const Topology>(*pair.first.topology);
    RC_ASSERT(distance(pair.first, pair.second, chosen) == shared);
}

RC_GTEST_PROP(DistanceProperty, ByAgeLiesBetweenNothingAndAllNewGenesBeingUnmatched, ()) {
    const Pair pair = random_pair();
    OdneatSettings settings;
    settings.mismatch = Mismatch::age;
    settings.c_weight = 0.0;
    const auto new_genes = [](const Genome& genome) {
        return static_cast<float>(genome.connections() - genome.topology->initial_connections);
    };
    const auto size =
        static_cast<float>(std::max(pair.first.connections(), pair.second.connections()));
    const float bound = (new_genes(pair.first) + new_genes(pair.second)) / size;
    const float found = distance(pair.first, pair.second, DistanceMeasure(settings));
    RC_ASSERT(found >= 0.0f);
    RC_ASSERT(found <= bound * 1.000001f);
    const bool same =
        pair.first.topology->connection_marks == pair.second.topology->connection_marks;
    RC_ASSERT((found == 0.0f) == same);
}

RC_GTEST_PROP(DistanceProperty, AnEarlyExitNeverChangesADecision, ()) {
    const Pair pair = random_pair();
    const DistanceMeasure chosen = random_measure();
    const float exact = distance(pair.first, pair.second, chosen);
    // Limits at, right beside and far from the distance; partial sums come close to the last ones.
    const float infinity = std::numeric_limits<float>::infinity();
    const float share = static_cast<float>(*rc::gen::inRange(0, 2000)) / 1000.0f;
    for (const float limit : {exact, std::nextafter(exact, 0.0f), std::nextafter(exact, infinity),
                              share * exact, 3.0f, 1.0f, 0.0f}) {
        const float limited = distance(pair.first, pair.second, chosen, limit);
        RC_ASSERT((limited < limit) == (exact < limit));
        RC_ASSERT((exact >= limit || limited == exact));
    }
}

}  // namespace
}  // namespace gene_clocks::neat
