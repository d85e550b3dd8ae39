#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/paper/paper_agents.hpp"

// Section 3.2, Evolutionary Algorithm: Algorithm 1 and the text around it.

namespace gene_clocks::neat::paper {
namespace {

// "At all times, each robot has an active genome that is initialized with a fully-connected
// single-layer perceptron."
TEST(Section32, TheFirstActiveGenomeIsAFullyConnectedPerceptron) {
    const OdneatSettings settings = calm_settings();
    const Agent robot = make_robot(1, settings);
    const Topology& genome = *robot.active().topology;
    ASSERT_EQ(genome.neurons.size(), inputs + outputs);
    ASSERT_EQ(genome.connection_marks.size(), inputs * outputs);
    for (std::size_t input = 0; input < inputs; ++input) {
        for (std::size_t output = inputs; output < inputs + outputs; ++output) {
            EXPECT_TRUE(genome.joined(genome.neurons[input].mark, genome.neurons[output].mark));
        }
    }
}

// "Robots locally broadcast their active genomes at every timestep, with a probability proportional
// to the fitness of the species of the genome"
TEST(Section32, TheProbabilityOfABroadcastIsProportionalToTheSpeciesFitness) {
    OdneatSettings settings = calm_settings();
    settings.energy_initial = 50.0;
    settings.energy_maximum = 250.0;
    Agent poor = make_robot(1, settings);
    OdneatSettings double_settings = settings;
    double_settings.energy_initial = 100.0;
    Agent rich = make_robot(1, double_settings);
    // The rest of the population is the same: one species, of such fitness that the sum is 300.
    poor.receive(RobotId{99}, {genome_of(0, 10.0f), 250.0f, {}});
    rich.receive(RobotId{99}, {genome_of(0, 10.0f), 200.0f, {}});
    ASSERT_EQ(poor.population().species_count(), 2u);
    EXPECT_NEAR(poor.broadcast_probability(), 50.0 / 300.0, 1e-6);
    EXPECT_NEAR(rich.broadcast_probability(), 100.0 / 300.0, 1e-6);
}

// "Received genomes are stored in a limited-size local population, which also contains previous
// active genomes."
TEST(Section32, ThePopulationHoldsReceivedAndPreviousActiveGenomes) {
    OdneatSettings settings = calm_settings();
    settings.population = 4;
    Agent robot = make_robot(1, settings);
    const GenomeId previous = robot.active().id;
    robot.receive(RobotId{99}, {genome_of(0, 10.0f), 60.0f, {}});
    robot.replace(0.0);
    EXPECT_TRUE(holds(robot, previous));
    EXPECT_TRUE(holds(robot, {RobotId{99}, 0}));
    EXPECT_TRUE(holds(robot, robot.active().id));
    for (std::uint32_t i = 1; i < 20; ++i) {
        robot.receive(
            RobotId{99},
            {genome_of(i, static_cast<float>(i) - 10.0f), 60.0f + static_cast<float>(i), {}});
        EXPECT_LE(robot.population().members().size(), 4u);
    }
}

// "When the population is full, the addition of a fit genome implies the removal of the worst
// genome in the population."
TEST(Section32, AFitGenomeReplacesTheWorstOfAFullPopulation) {
    OdneatSettings settings = calm_settings();
    settings.population = 3;
    Agent robot = make_robot(1, settings);
    robot.receive(RobotId{99}, {genome_of(0, 10.0f), 40.0f, {}});
    robot.receive(RobotId{99}, {genome_of(1, -10.0f), 30.0f, {}});
    EXPECT_EQ(robot.receive(RobotId{99}, {genome_of(2, 5.0f), 35.0f, {}}), Reception::accepted);
    EXPECT_TRUE(holds(robot, {RobotId{99}, 0}));
    EXPECT_FALSE(holds(robot, {RobotId{99}, 1}));
    EXPECT_TRUE(holds(robot, {RobotId{99}, 2}));
    EXPECT_EQ(robot.receive(RobotId{99}, {genome_of(3, -5.0f), 35.0f, {}}), Reception::unfit);
}

// Algorithm 1: "e ← e + ΔE/Δt"
TEST(Section32, EveryCycleChangesTheEnergy) {
    const OdneatSettings settings = calm_settings();
    Agent robot = make_robot(1, settings);
    robot.spend(1.5f);
    robot.spend(-0.25f);
    EXPECT_EQ(robot.energy(), 101.25f);
}

// "the robots periodically measure their respective energy levels at regular intervals. The energy
// measures are averaged to compute the controller's fitness f_r(t)"
TEST(Section32, FitnessIsTheAverageOfPeriodicEnergyMeasures) {
    OdneatSettings settings = calm_settings();
    settings.fitness_period_cycles = 4;
    Agent robot = make_robot(1, settings);
    std::vector<double> measures{robot.energy()};
    for (int cycle = 1; cycle <= 40; ++cycle) {
        robot.spend(cycle % 2 == 0 ? 3.0f : -5.0f);
        if (cycle % 4 == 0) measures.push_back(robot.energy());
        double sum = 0.0;
        for (const double measure : measures) sum += measure;
        EXPECT_NEAR(robot.fitness(), sum / static_cast<double>(measures.size()), 1e-4);
    }
}

// "whenever the energy level drops below a given threshold, a new offspring is produced and
// replaces the active genome, and the energy level is reset to its default initial value"
TEST(Section32, ADepletedGenomeIsReplacedAndTheEnergyReset) {
    const OdneatSettings settings = calm_settings();
    Agent robot = make_robot(1, settings);
    const GenomeId depleted = robot.active().id;
    EXPECT_FALSE(robot.is_depleted());
    deplete(robot, settings);
    ASSERT_TRUE(robot.is_depleted());
    robot.replace(0.0);
    EXPECT_NE(robot.active().id, depleted);
    EXPECT_EQ(robot.energy(), settings.energy_initial);
    EXPECT_FALSE(robot.is_depleted());
}

// "the genomes in the population are grouped in non-overlapping species by genotypic similarity"
TEST(Section32, SpeciesDoNotOverlapAndGroupTheSimilar) {
    OdneatSettings settings = calm_settings();
    settings.population = 6;
    Population population(settings);
    for (const float weight : {-10.0f, 10.0f, -9.0f, 9.0f, 0.0f}) {
        population.add(genome_of(static_cast<std::uint32_t>(weight + 10.0f), weight), 1.0f);
    }
    const auto& members = population.members();
    EXPECT_EQ(population.species_count(), 3u);
    EXPECT_EQ(members[0].species, members[2].species);
    EXPECT_EQ(members[1].species, members[3].species);
    EXPECT_NE(members[0].species, members[1].species);
    EXPECT_NE(members[4].species, members[0].species);
    EXPECT_NE(members[4].species, members[1].species);
}

// "When a broadcast occurs, the robot's active genome, its current energy level, and c_r in the
// case of GC, are sent to all neighboring robots."
TEST(Section32, ABroadcastHasTheActiveGenomeTheEnergyAndTheCounter) {
    const OdneatSettings settings = calm_settings();
    Agent robot = make_robot(1, settings);
    robot.spend(-12.5f);
    EXPECT_EQ(robot.message().genome->id, robot.active().id);
    EXPECT_EQ(robot.message().energy, 87.5f);
    EXPECT_EQ(robot.message().stamp.value, genesis_mark_count(inputs, outputs) + 1);
}

// "If a given robot receives the same genome twice, the energy level is averaged with the previous
// value to provide a better estimator of the performance of the stored genome."
TEST(Section32, TheEnergyOfAGenomeReceivedTwiceIsAveraged) {
    const OdneatSettings settings = calm_settings();
    Agent robot = make_robot(1, settings);
    robot.receive(RobotId{99}, {genome_of(0, 10.0f), 60.0f, {}});
    EXPECT_EQ(robot.receive(RobotId{99}, {genome_of(0, 10.0f), 90.0f, {}}), Reception::updated);
    const auto held = robot.population().find({RobotId{99}, 0});
    EXPECT_FLOAT_EQ(robot.population().members()[held.value()].fitness, 75.0f);
}

// "First, a species is selected with a probability proportional to its average adjusted fitness."
TEST(Section32, SpeciesAreSelectedInProportionToTheirAverageAdjustedFitness) {
    const OdneatSettings settings = calm_settings();
    Population population(settings);
    population.add(genome_of(0, 10.0f), 60.0f);   // adjusted: 30
    population.add(genome_of(1, 10.0f), 20.0f);   // adjusted: 10, so the average is 20
    population.add(genome_of(2, -10.0f), 60.0f);  // 60
    RandomStream random(1, 1);
    constexpr int draws = 20'000;
    int first = 0;
    for (int i = 0; i < draws; ++i) first += population.select_species(random) == 0 ? 1 : 0;
    EXPECT_NEAR(first / double{draws}, 20.0 / 80.0, tolerance(0.25, draws));
}

// "Then, with a probability p_mate two parents are selected within the chosen species and are
// recombined. […] With a probability (1 − p_mate), only one parent is selected from the species"
TEST(Section32, AnOffspringHasTwoParentsOfOneSpeciesOrOne) {
    OdneatSettings settings = calm_settings();
    settings.c_weight = 0.0;  // so that all are of one species, though their weights differ
    settings.population = 9;
    constexpr int births = 3000;
    for (const double p_mate : {0.0, 0.5, 1.0}) {
        settings.p_mate = p_mate;
        int mated = 0;
        for (std::uint32_t i = 0; i < births; ++i) {
            Agent robot = make_robot(1, settings, i);
            for (std::uint32_t other = 0; other < 3; ++other) {
                robot.receive(RobotId{99},
                              {genome_of(other, 5.0f + static_cast<float>(other)), 90.0f, {}});
            }
            mated += robot.replace(0.0).mated ? 1 : 0;
        }
        // Four members, of which the fittest is a parent with ½ and the others with 1/6 each (three
        // equal ones): the two draws differ with 1 − 1/4 − 3/36.
        const double expected = p_mate * (1.0 - 0.25 - 3.0 / 36.0);
        EXPECT_NEAR(mated / double{births}, expected, tolerance(expected, births) + 1e-9);
    }
}

// "Finally, the resulting offspring is mutated with a probability p_mutate."
TEST(Section32, AnOffspringIsMutatedWithItsProbability) {
    OdneatSettings settings = calm_settings();
    settings.p_mutate = 0.3;
    settings.p_weight = 1.0;
    constexpr int births = 5000;
    int mutated = 0;
    for (std::uint32_t i = 0; i < births; ++i) {
        Agent robot = make_robot(1, settings, i);
        const auto weights = robot.active().weights;
        robot.replace(0.0);
        mutated += robot.active().weights != weights ? 1 : 0;
    }
    EXPECT_NEAR(mutated / double{births}, 0.3, tolerance(0.3, births));
}

// Algorithm 1: "P ← P ∪ {g_offsp}; g_a ← g_offsp; e ← e_init"
TEST(Section32, TheOffspringJoinsThePopulationAndRuns) {
    const OdneatSettings settings = calm_settings();
    Agent robot = make_robot(1, settings);
    deplete(robot, settings);
    robot.replace(0.0);
    EXPECT_TRUE(holds(robot, robot.active().id));
    EXPECT_EQ(robot.message().genome->id, robot.active().id);
    EXPECT_EQ(robot.energy(), 100.0f);
}

// "A new genome is given some time T_m to be executed and evaluated even if its energy level drops
// below the threshold level."
TEST(Section32, AGenomeIsNotReplacedBeforeItsMaturation) {
    OdneatSettings settings = calm_settings();
    settings.maturation_cycles = 19;
    Agent robot = make_robot(1, settings);
    for (int cycle = 1; cycle <= 19; ++cycle) {
        robot.spend(-200.0f);
        EXPECT_FALSE(robot.is_depleted()) << cycle;
    }
    robot.spend(0.0f);
    EXPECT_TRUE(robot.is_depleted());
    robot.replace(0.0);
    robot.spend(-200.0f);
    EXPECT_FALSE(robot.is_depleted());
}

// "a tabu list to keep track of recent poor genomes, either genomes dropped because they depleted
// their energy, or the genomes that are not competitive enough and are dropped from the population
// because it was full"
TEST(Section32, TheTabuListHoldsDepletedAndDroppedGenomes) {
    OdneatSettings settings = calm_settings();
    settings.population = 2;
    Agent robot = make_robot(1, settings);
    EXPECT_EQ(robot.tabu_list().size(), 0u);
    robot.receive(RobotId{99}, {genome_of(0, 10.0f), 10.0f, {}});
    robot.receive(RobotId{99}, {genome_of(1, -10.0f), 20.0f, {}});  // genome 0 is dropped
    EXPECT_EQ(robot.tabu_list().size(), 1u);
    EXPECT_EQ(robot.receive(RobotId{99}, {genome_of(0, 10.0f), 200.0f, {}}), Reception::tabu);

    Agent other = make_robot(2, settings);
    Message like_the_depleted = other.message();
    Genome genome = other.active();
    genome.id = {RobotId{99}, 7};
    like_the_depleted.genome = std::make_shared<const Genome>(std::move(genome));
    deplete(other, settings);
    other.replace(0.0);
    EXPECT_EQ(other.tabu_list().size(), 1u);
    EXPECT_EQ(other.receive(RobotId{99}, like_the_depleted), Reception::tabu);
}

// "This is used to filter out received genomes that are similar to one or more individuals in the
// tabu list, before adding them to the local population"
TEST(Section32, AGenomeSimilarToATabuOneIsNotAdded) {
    OdneatSettings settings = calm_settings();
    settings.population = 2;
    Agent robot = make_robot(1, settings);
    robot.receive(RobotId{99}, {genome_of(0, 10.0f), 10.0f, {}});
    robot.receive(RobotId{99}, {genome_of(1, -10.0f), 20.0f, {}});
    // The mean weight difference is 1, so the distance 0.4 is below the threshold.
    EXPECT_EQ(robot.receive(RobotId{99}, {genome_of(2, 9.0f), 200.0f, {}}), Reception::tabu);
    EXPECT_FALSE(holds(robot, {RobotId{99}, 2}));
    EXPECT_EQ(robot.receive(RobotId{99}, {genome_of(3, 5.0f), 200.0f, {}}), Reception::accepted);
}

}  // namespace
}  // namespace gene_clocks::neat::paper
