#include <gtest/gtest.h>

#include <cmath>
#include <gene_clocks/neat/population.hpp>
#include <vector>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

constexpr int draws = 40'000;

double tolerance(double probability) {
    return 5 * std::sqrt(probability * (1 - probability) / draws);
}

/// A genome whose distance from another of these is |place − place|, up to rounding.
std::shared_ptr<const Genome> genome_at(float place, std::uint32_t birth) {
    Genome genome = perceptron(1, 1, {RobotId{1}, birth});
    genome.weights[0] = place;
    return std::make_shared<const Genome>(std::move(genome));
}

class PopulationTest : public testing::Test {
protected:
    PopulationTest() {
        settings_.c_weight = 1.0;
        settings_.species_threshold = 3.0;
        settings_.population = 6;
    }

    Population make() { return Population(settings_); }

    std::vector<std::size_t> species_of(const Population& population) {
        std::vector<std::size_t> species;
        for (const auto& member : population.members()) species.push_back(member.species);
        return species;
    }
    using Species = std::vector<std::size_t>;

    OdneatSettings settings_;
    RandomStream random_{1, 1};
};

TEST_F(PopulationTest, IsFullAtItsSize) {
    Population population = make();
    for (std::uint32_t i = 0; i < 6; ++i) {
        EXPECT_FALSE(population.is_full());
        population.add(genome_at(0.0f, i), 1.0f);
    }
    EXPECT_TRUE(population.is_full());
    population.remove(3);
    EXPECT_FALSE(population.is_full());
}

TEST_F(PopulationTest, FindsAGenomeById) {
    Population population = make();
    population.add(genome_at(0.0f, 7), 1.0f);
    population.add(genome_at(0.0f, 9), 1.0f);
    EXPECT_EQ(population.find({RobotId{1}, 9}), 1u);
    EXPECT_EQ(population.find({RobotId{1}, 8}), std::nullopt);
    EXPECT_EQ(population.find({RobotId{2}, 9}), std::nullopt);
}

TEST_F(PopulationTest, TheWorstIsTheFirstOfLowestRawFitness) {
    Population population = make();
    EXPECT_EQ(population.worst(), std::nullopt);
    population.add(genome_at(0.0f, 0), 5.0f);
    population.add(genome_at(0.0f, 1), 2.0f);
    population.add(genome_at(0.0f, 2), 2.0f);
    EXPECT_EQ(population.worst(), 1u);
    EXPECT_EQ(population.worst(GenomeId{RobotId{1}, 1}), 2u);
    population.remove(2);
    EXPECT_EQ(population.worst(GenomeId{RobotId{1}, 1}), 0u);
    population.remove(0);
    EXPECT_EQ(population.worst(GenomeId{RobotId{1}, 1}), std::nullopt);
}

TEST_F(PopulationTest, RawFitnessDecidesTheWorstNotSharedFitness) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 8.0f);
    population.add(genome_at(0.0f, 1), 8.0f);
    population.add(genome_at(0.0f, 2), 8.0f);  // shared: 8 / 3 each
    population.add(genome_at(9.0f, 3), 4.0f);  // alone in its species: 4
    EXPECT_EQ(population.worst(), 3u);
}

TEST_F(PopulationTest, PlacesAGenomeInTheFirstSpeciesThatIsNearer) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 1.0f);
    population.add(genome_at(5.0f, 1), 1.0f);
    population.add(genome_at(2.5f, 2), 1.0f);  // near both representatives
    population.add(genome_at(4.0f, 3), 1.0f);  // near genome 2, but that represents nothing
    EXPECT_EQ(species_of(population), (Species{0, 1, 0, 1}));
    EXPECT_EQ(population.species_count(), 2u);
}

TEST_F(PopulationTest, ADistanceOfTheThresholdFoundsASpecies) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 1.0f);
    population.add(genome_at(3.0f, 1), 1.0f);
    population.add(genome_at(std::nextafter(3.0f, 0.0f), 2), 1.0f);
    EXPECT_EQ(species_of(population), (Species{0, 1, 0}));
}

TEST_F(PopulationTest, TheNextMemberRepresentsASpeciesWhoseRepresentativeLeaves) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 1.0f);
    population.add(genome_at(2.0f, 1), 1.0f);
    population.add(genome_at(-2.0f, 2), 1.0f);
    population.remove(0);
    population.add(genome_at(4.5f, 3), 1.0f);   // nearer than 3 to place 2, which represents now
    population.add(genome_at(-3.5f, 4), 1.0f);  // would have been near place -2
    EXPECT_EQ(species_of(population), (Species{0, 0, 0, 1}));
}

TEST_F(PopulationTest, TheRepresentativeStaysWhereAnotherMemberLeaves) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 1.0f);
    population.add(genome_at(2.0f, 1), 1.0f);
    population.remove(1);
    population.add(genome_at(4.5f, 2), 1.0f);
    EXPECT_EQ(species_of(population), (Species{0, 1}));
}

TEST_F(PopulationTest, ASpeciesWithoutMembersIsNoMore) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 1.0f);
    population.add(genome_at(5.0f, 1), 2.0f);
    population.add(genome_at(10.0f, 2), 3.0f);
    EXPECT_EQ(population.remove(1)->id.birth, 1u);
    EXPECT_EQ(population.species_count(), 2u);
    EXPECT_EQ(species_of(population), (Species{0, 1}));
    EXPECT_DOUBLE_EQ(population.species_share(1), 0.75);
    population.add(genome_at(5.0f, 3), 1.0f);
    EXPECT_EQ(species_of(population), (Species{0, 1, 2}));
}

TEST_F(PopulationTest, SpeciateDividesAllMembersAnewInTheOrderTheyCame) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 1.0f);
    population.add(genome_at(5.0f, 1), 1.0f);
    population.add(genome_at(2.5f, 2), 1.0f);
    population.add(genome_at(6.0f, 3), 1.0f);
    population.remove(0);
    EXPECT_EQ(species_of(population), (Species{1, 0, 1}));
    population.speciate();
    // Genome 1 founds the first species now, and genome 2 is near it.
    EXPECT_EQ(species_of(population), (Species{0, 0, 0}));
    EXPECT_EQ(population.species_count(), 1u);
    population.speciate();
    EXPECT_EQ(species_of(population), (Species{0, 0, 0}));
}

TEST_F(PopulationTest, MembersShareTheFitnessOfTheirSpecies) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 6.0f);
    population.add(genome_at(1.0f, 1), 2.0f);
    population.add(genome_at(9.0f, 2), 5.0f);
    // Each member's fitness over the size of its species: (6/2 + 2/2) / 2 = 2, against 5.
    EXPECT_FLOAT_EQ(static_cast<float>(population.species_share(0)), 2.0f / 7.0f);
    EXPECT_FLOAT_EQ(static_cast<float>(population.species_share(1)), 2.0f / 7.0f);
    EXPECT_FLOAT_EQ(static_cast<float>(population.species_share(2)), 5.0f / 7.0f);
}

TEST_F(PopulationTest, TheShareFollowsChangesOfFitnessAndMembers) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 6.0f);
    EXPECT_DOUBLE_EQ(population.species_share(0), 1.0);
    population.add(genome_at(9.0f, 1), 2.0f);
    EXPECT_DOUBLE_EQ(population.species_share(0), 0.75);
    population.set_fitness(1, 6.0f);
    EXPECT_DOUBLE_EQ(population.species_share(0), 0.5);
    population.report(1, 18.0f, HeldEnergy::overwrite);
    EXPECT_DOUBLE_EQ(population.species_share(0), 0.25);
    population.remove(1);
    EXPECT_DOUBLE_EQ(population.species_share(0), 1.0);
}

TEST_F(PopulationTest, TheShareIsZeroWhereNoSpeciesHasFitness) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 0.0f);
    population.add(genome_at(9.0f, 1), 0.0f);
    EXPECT_EQ(population.species_share(0), 0.0);
}

TEST_F(PopulationTest, AReportOverwritesOrIsAveragedIn) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 100.0f);
    population.add(genome_at(0.0f, 1), 100.0f);
    for (const float energy : {50.0f, 30.0f, 200.0f}) {
        population.report(0, energy, HeldEnergy::overwrite);
        population.report(1, energy, HeldEnergy::running_mean);
    }
    EXPECT_EQ(population.members()[0].fitness, 200.0f);
    EXPECT_FLOAT_EQ(population.members()[1].fitness, (100.0f + 50.0f + 30.0f + 200.0f) / 4.0f);
}

TEST_F(PopulationTest, SelectsSpeciesInProportionToTheirFitness) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 6.0f);
    population.add(genome_at(1.0f, 1), 2.0f);   // with the first: 2
    population.add(genome_at(9.0f, 2), 5.0f);   // 5
    population.add(genome_at(-9.0f, 3), 0.0f);  // 0
    population.add(genome_at(-5.0f, 4), 1.0f);  // 1
    ASSERT_EQ(population.species_count(), 4u);
    std::vector<int> counts(4);
    for (int i = 0; i < draws; ++i) ++counts[population.select_species(random_)];
    EXPECT_NEAR(counts[0] / double{draws}, 2.0 / 8.0, tolerance(2.0 / 8.0));
    EXPECT_NEAR(counts[1] / double{draws}, 5.0 / 8.0, tolerance(5.0 / 8.0));
    EXPECT_EQ(counts[2], 0);
    EXPECT_NEAR(counts[3] / double{draws}, 1.0 / 8.0, tolerance(1.0 / 8.0));
}

TEST_F(PopulationTest, SelectsAnySpeciesWhereNoneHasFitness) {
    Population population = make();
    for (std::uint32_t i = 0; i < 4; ++i) {
        population.add(genome_at(4.0f * static_cast<float>(i), i), 0.0f);
    }
    ASSERT_EQ(population.species_count(), 4u);
    std::vector<int> counts(4);
    for (int i = 0; i < draws; ++i) ++counts[population.select_species(random_)];
    for (const int count : counts) EXPECT_NEAR(count / double{draws}, 0.25, tolerance(0.25));
}

TEST_F(PopulationTest, AParentIsTheFitterOfTwoDistinctMembers) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 3.0f);
    population.add(genome_at(9.0f, 1), 9.0f);  // of another species
    population.add(genome_at(0.0f, 2), 1.0f);
    population.add(genome_at(0.0f, 3), 2.0f);
    std::vector<int> counts(4);
    for (int i = 0; i < draws; ++i) ++counts[population.select_parent(0, random_)];
    // Of the three pairs, two have the fittest and one has the second without it.
    EXPECT_NEAR(counts[0] / double{draws}, 2.0 / 3.0, tolerance(2.0 / 3.0));
    EXPECT_EQ(counts[1], 0);
    EXPECT_EQ(counts[2], 0);
    EXPECT_NEAR(counts[3] / double{draws}, 1.0 / 3.0, tolerance(1.0 / 3.0));
}

TEST_F(PopulationTest, EquallyFitMembersAreParentsEquallyOften) {
    Population population = make();
    for (std::uint32_t i = 0; i < 4; ++i) population.add(genome_at(0.0f, i), 1.0f);
    std::vector<int> counts(4);
    for (int i = 0; i < draws; ++i) ++counts[population.select_parent(0, random_)];
    for (const int count : counts) EXPECT_NEAR(count / double{draws}, 0.25, tolerance(0.25));
}

TEST_F(PopulationTest, TheOnlyMemberIsTheParent) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 1.0f);
    population.add(genome_at(9.0f, 1), 0.0f);
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(population.select_parent(0, random_), 0u);
        EXPECT_EQ(population.select_parent(1, random_), 1u);
    }
}

TEST_F(PopulationTest, TheSecondParentMayBeTheFirstUnlessTheRuleSaysOtherwise) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 3.0f);
    population.add(genome_at(9.0f, 1), 9.0f);  // of another species
    population.add(genome_at(0.0f, 2), 1.0f);
    population.add(genome_at(0.0f, 3), 2.0f);
    const auto shares = [&](SecondParent rule, std::size_t first) {
        std::vector<double> counts(4);
        for (int i = 0; i < draws; ++i) {
            counts[population.select_second_parent(rule, 0, first, random_)] += 1.0 / draws;
        }
        return counts;
    };
    const auto expect = [&](SecondParent rule, std::size_t first, std::vector<double> expected) {
        const auto found = shares(rule, first);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(found[i], expected[i], tolerance(expected[i]) + 1e-9)
                << i << " for " << first;
        }
    };
    // Of three in the species, the fittest wins two of three pairs; of two, the fitter always wins.
    expect(SecondParent::tournament, 0, {2.0 / 3.0, 0.0, 0.0, 1.0 / 3.0});
    expect(SecondParent::other, 0, {0.0, 0.0, 0.0, 1.0});
    expect(SecondParent::other, 3, {1.0, 0.0, 0.0, 0.0});
    expect(SecondParent::population, 0, {0.0, 2.0 / 3.0, 0.0, 1.0 / 3.0});
    expect(SecondParent::population, 3, {1.0 / 3.0, 2.0 / 3.0, 0.0, 0.0});
}

TEST_F(PopulationTest, WhereNobodyElseIsAdmittedTheSecondParentIsTheFirst) {
    Population population = make();
    population.add(genome_at(0.0f, 0), 1.0f);
    for (const auto rule :
         {SecondParent::tournament, SecondParent::other, SecondParent::population}) {
        EXPECT_EQ(population.select_second_parent(rule, 0, 0, random_), 0u);
    }
    population.add(genome_at(9.0f, 1), 0.0f);
    EXPECT_EQ(population.select_second_parent(SecondParent::other, 1, 1, random_), 1u);
    EXPECT_EQ(population.select_second_parent(SecondParent::population, 1, 1, random_), 0u);
}

}  // namespace
}  // namespace gene_clocks::neat
