#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gene_clocks/neat/agent.hpp>
#include <limits>
#include <set>
#include <vector>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
constexpr std::size_t inputs = 3;
constexpr std::size_t outputs = 2;
const std::uint64_t genesis_marks = genesis_mark_count(inputs, outputs);

class AgentTest : public testing::Test {
protected:
    AgentTest() {
        // Nothing at random, unless a test asks for it.
        settings_.p_mate = 0.0;
        settings_.p_mutate = 0.0;
        settings_.population = 3;
        settings_.maturation_cycles = 5;
    }

    Agent make_agent(std::uint32_t robot = 1, std::uint64_t genesis_count = genesis_marks) {
        return Agent(RobotId{robot}, settings_, topology_,
                     std::make_unique<GeneClockSource>(RobotId{robot}, genesis_count),
                     RandomStream(1, robot));
    }

    /// A message from robot 9: a genome of which all weights are `weight`.
    Message message(std::uint32_t birth, float weight, float energy, std::uint64_t stamp = 1) {
        Genome genome{{RobotId{9}, birth}, topology_, {}, {}};
        genome.weights.assign(topology_->connection_marks.size(), weight);
        genome.enabled.assign(topology_->connection_marks.size(), 1.0f);
        return {std::make_shared<const Genome>(std::move(genome)), energy, Stamp{stamp}};
    }

    static std::vector<GenomeId> ids(const Agent& agent) {
        std::vector<GenomeId> held;
        for (const auto& member : agent.population().members()) held.push_back(member.genome->id);
        return held;
    }
    static bool holds(const Agent& agent, GenomeId id) {
        return agent.population().find(id).has_value();
    }
    static float fitness_of(const Agent& agent, GenomeId id) {
        return agent.population().members()[agent.population().find(id).value()].fitness;
    }

    OdneatSettings settings_;
    std::shared_ptr<const Topology> topology_ = make_initial_topology(inputs, outputs);
};

// ---- g_a ← random_genome(); P ← {g_a}; e ← e_init ----

TEST_F(AgentTest, StartsWithARandomPerceptronInItsPopulationAndTheInitialEnergy) {
    const Agent agent = make_agent(4);
    EXPECT_EQ(agent.active().id, (GenomeId{RobotId{4}, 0}));
    EXPECT_EQ(agent.active().topology, topology_);
    EXPECT_EQ(agent.robot(), RobotId{4});
    RandomStream twin(1, 4);
    const Genome expected = make_initial_genome({}, topology_, settings_.weight_limit, twin);
    EXPECT_EQ(agent.active().weights, expected.weights);
    EXPECT_EQ(ids(agent), std::vector<GenomeId>{agent.active().id});
    EXPECT_EQ(agent.population().species_count(), 1u);
    EXPECT_EQ(agent.energy(), 100.0f);
    EXPECT_EQ(agent.fitness(), 100.0f);
    EXPECT_EQ(agent.tabu_list().size(), 0u);
    EXPECT_EQ(agent.source().stamp(), Stamp{genesis_marks + 1});
}

// ---- if do_broadcast? then send(g_a, e, neighbors) ----

TEST_F(AgentTest, BroadcastsWithTheFitnessShareOfItsSpecies) {
    settings_.energy_maximum = 500.0;
    Agent agent = make_agent();
    EXPECT_EQ(agent.broadcast_probability(), 1.0);
    agent.receive(RobotId{9}, message(0, 9.0f, 50.0f));  // far: another species
    EXPECT_NEAR(agent.broadcast_probability(), 100.0 / 150.0, 1e-6);
    agent.receive(RobotId{9},
                  message(1, 8.9f, 150.0f));  // its companion: the mean of 50 / 2 and 150 / 2
    EXPECT_NEAR(agent.broadcast_probability(), 100.0 / 150.0, 1e-6);
    agent.receive(RobotId{9}, message(1, 8.9f, 250.0f));  // averaged in: 200
    EXPECT_NEAR(agent.broadcast_probability(), 100.0 / (100.0 + (50.0 + 200.0) / 4.0), 1e-6);
}

TEST_F(AgentTest, TheBroadcastShareFollowsItsFitness) {
    settings_.fitness_period_cycles = 1;
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 50.0f));
    ASSERT_NEAR(agent.broadcast_probability(), 100.0 / 150.0, 1e-6);
    agent.spend(-100.0f);  // fitness: the mean of 100 and 0
    EXPECT_NEAR(agent.broadcast_probability(), 0.5, 1e-6);
}

TEST_F(AgentTest, AMessageCarriesTheActiveGenomeTheEnergyAndTheStamp) {
    Agent agent = make_agent();
    agent.spend(-30.0f);
    const Message sent = agent.message();
    EXPECT_EQ(sent.genome.get(), &agent.active());
    EXPECT_EQ(sent.energy, 70.0f);
    EXPECT_EQ(sent.stamp, Stamp{genesis_marks + 1});
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 1.0f, 500)), Reception::accepted);
    EXPECT_EQ(agent.message().stamp, Stamp{500});
}

// ---- forall g in received: if Tabu.approves(g) and P.accepts(g) then P ← P ∪ {g} ----

TEST_F(AgentTest, AcceptsAnyGenomeWhileThereIsRoom) {
    Agent agent = make_agent();
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 0.0f)), Reception::accepted);
    EXPECT_EQ(agent.receive(RobotId{9}, message(1, -9.0f, 0.0f)), Reception::accepted);
    EXPECT_EQ(agent.population().members().size(), 3u);
    EXPECT_EQ(agent.population().species_count(), 3u);
    EXPECT_EQ(agent.tabu_list().size(), 0u);
}

TEST_F(AgentTest, AFullPopulationTakesAFitterGenomeForItsWorst) {
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 20.0f));
    agent.receive(RobotId{9}, message(1, -9.0f, 30.0f));
    EXPECT_EQ(agent.receive(RobotId{9}, message(2, 5.0f, 25.0f)), Reception::accepted);
    EXPECT_FALSE(holds(agent, {RobotId{9}, 0}));
    EXPECT_TRUE(holds(agent, {RobotId{9}, 2}));
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 2}), 25.0f);
    EXPECT_EQ(agent.tabu_list().size(), 1u);
    // What was dropped is known as poor.
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 200.0f)), Reception::tabu);
}

TEST_F(AgentTest, AFullPopulationRefusesAGenomeThatIsNoFitter) {
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 20.0f));
    agent.receive(RobotId{9}, message(1, -9.0f, 30.0f));
    const auto before = ids(agent);
    EXPECT_EQ(agent.receive(RobotId{9}, message(2, 5.0f, 20.0f)), Reception::unfit);
    EXPECT_EQ(ids(agent), before);
    EXPECT_EQ(agent.tabu_list().size(), 0u);
}

TEST_F(AgentTest, TheActiveGenomeIsNeverEvicted) {
    settings_.fitness_period_cycles = 1;
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 120.0f));
    agent.receive(RobotId{9}, message(1, -9.0f, 130.0f));
    agent.spend(-100.0f);  // the active genome is the worst by far now
    EXPECT_EQ(agent.receive(RobotId{9}, message(2, 5.0f, 110.0f)), Reception::unfit);
    EXPECT_EQ(agent.receive(RobotId{9}, message(2, 5.0f, 125.0f)), Reception::accepted);
    EXPECT_TRUE(holds(agent, agent.active().id));
    EXPECT_FALSE(holds(agent, {RobotId{9}, 0}));
}

TEST_F(AgentTest, APopulationOfOneHoldsTheActiveGenomeAlone) {
    settings_.population = 1;
    Agent agent = make_agent();
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 200.0f)), Reception::unfit);
    const GenomeId first = agent.active().id;
    agent.spend(-100.0f);
    agent.replace(0.0);
    EXPECT_NE(agent.active().id, first);
    EXPECT_EQ(ids(agent), std::vector<GenomeId>{agent.active().id});
}

TEST_F(AgentTest, TheEnergyOfAHeldGenomeIsAveragedIn) {
    settings_.held_energy = HeldEnergy::running_mean;
    Agent agent = make_agent();
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 20.0f)), Reception::accepted);
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 40.0f)), Reception::updated);
    EXPECT_FLOAT_EQ(fitness_of(agent, {RobotId{9}, 0}), 30.0f);
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 90.0f)), Reception::updated);
    EXPECT_FLOAT_EQ(fitness_of(agent, {RobotId{9}, 0}), 50.0f);
    EXPECT_EQ(agent.population().members().size(), 2u);
}

TEST_F(AgentTest, TheEnergyOfAHeldGenomeIsOverwrittenWhereTheSettingsSaySo) {
    settings_.held_energy = HeldEnergy::overwrite;
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 20.0f));
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 40.0f)), Reception::updated);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 0}), 40.0f);
}

TEST_F(AgentTest, EveryReportOfAHeldGenomeCounts) {
    settings_.held_energy = HeldEnergy::overwrite;
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 50.0f));
    agent.receive(RobotId{9}, message(1, -9.0f, 40.0f));
    // Full, and a new genome with this energy would not be accepted.
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 30.0f)), Reception::updated);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 0}), 30.0f);
}

TEST_F(AgentTest, AHeldGenomeMustPassTheAcceptanceTestFirstWhereTheSettingsSaySo) {
    settings_.held_energy = HeldEnergy::overwrite;
    settings_.held_reports = HeldReports::acceptable;
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 50.0f));
    agent.receive(RobotId{9}, message(1, -9.0f, 40.0f));
    // Full, and no fitter than the worst: not even that genome's own entry changes.
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 40.0f)), Reception::unfit);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 0}), 50.0f);
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 41.0f)), Reception::updated);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 0}), 41.0f);
}

TEST_F(AgentTest, TheTabuListIsAskedBeforeThePopulation) {
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 20.0f));
    agent.receive(RobotId{9}, message(1, -9.0f, 30.0f));
    agent.receive(RobotId{9}, message(2, 5.0f, 25.0f));  // drops genome 0
    // Both tabu and unfit: a tabu genome renews its entry although it would not be accepted.
    for (int i = 0; i < 200; ++i) {
        ASSERT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 0.0f)), Reception::tabu);
    }
    EXPECT_EQ(agent.tabu_list().size(), 1u);
    // And an unfit one ages the entries.
    for (int i = 0; i < 50; ++i) {
        ASSERT_EQ(agent.receive(RobotId{9}, message(3, 0.0f, 0.0f)), Reception::unfit);
    }
    EXPECT_EQ(agent.tabu_list().size(), 0u);
}

TEST_F(AgentTest, TheClockAdvancesOnEveryMessageAcceptedOrNot) {
    Agent agent = make_agent();
    ASSERT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 20.0f, 100)), Reception::accepted);
    EXPECT_EQ(agent.source().stamp(), Stamp{100});
    ASSERT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 30.0f, 200)), Reception::updated);
    EXPECT_EQ(agent.source().stamp(), Stamp{200});
    agent.receive(RobotId{9}, message(1, -9.0f, 30.0f));
    ASSERT_EQ(agent.receive(RobotId{9}, message(2, 5.0f, 0.0f, 300)), Reception::unfit);
    EXPECT_EQ(agent.source().stamp(), Stamp{300});
    agent.receive(RobotId{9}, message(2, 5.0f, 40.0f));  // drops genome 0
    ASSERT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 30.0f, 400)), Reception::tabu);
    EXPECT_EQ(agent.source().stamp(), Stamp{400});
    ASSERT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 30.0f, 350)), Reception::tabu);
    EXPECT_EQ(agent.source().stamp(), Stamp{400});
}

/// A source that refuses stamps above a limit, as a gene clock with an admission window does.
class WaryClockSource final : public InnovationSource {
public:
    std::optional<SplitMarks> mark_split(const Genome&, std::size_t, double) override {
        return std::nullopt;
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds&,
                                                    double) override {
        return std::nullopt;
    }
    Stamp stamp() const override { return Stamp{next_}; }
    bool observe(Stamp stamp) override {
        if (stamp.value > 1000) return false;
        next_ = std::max(next_, stamp.value);
        return true;
    }

private:
    std::uint64_t next_ = 1;
};

TEST_F(AgentTest, AMessageWhoseStampIsRefusedLeavesNoTrace) {
    settings_.tabu_receptions = 2;
    Agent agent(RobotId{1}, settings_, topology_, std::make_unique<WaryClockSource>(),
                RandomStream(1, 1));
    agent.receive(RobotId{9}, message(0, 9.0f, 20.0f));
    agent.receive(RobotId{9}, message(1, -9.0f, 30.0f));
    agent.receive(RobotId{9}, message(2, 5.0f, 25.0f, 7));  // drops genome 0, which is tabu now
    const auto before = ids(agent);
    const double share = agent.broadcast_probability();
    const RandomStream random = agent.random();
    for (int i = 0; i < 10; ++i) {
        // Fit to be accepted; held already; and of the kind that ages or renews the tabu entry.
        for (const std::uint32_t birth : {0u, 1u, 3u}) {
            const float weight = birth == 0 ? 9.0f : birth == 1 ? -9.0f : 1.0f;
            ASSERT_EQ(agent.receive(RobotId{9}, message(birth, weight, 190.0f, 1001)),
                      Reception::refused);
        }
    }
    EXPECT_EQ(ids(agent), before);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 1}), 30.0f);
    EXPECT_EQ(agent.broadcast_probability(), share);
    EXPECT_EQ(agent.source().stamp(), Stamp{7});
    RandomStream untouched = random;
    RandomStream now = agent.random();
    EXPECT_EQ(now.bits(), untouched.bits());
    // The tabu entry is as old as it was: it leaves at its second other reception.
    ASSERT_EQ(agent.tabu_list().size(), 1u);
    agent.receive(RobotId{9}, message(1, -9.0f, 0.0f));
    EXPECT_EQ(agent.tabu_list().size(), 1u);
    agent.receive(RobotId{9}, message(1, -9.0f, 0.0f));
    EXPECT_EQ(agent.tabu_list().size(), 0u);
}

// ---- execute(g_a); e ← e + ΔE ----

TEST_F(AgentTest, RunsTheControllerOfItsActiveGenome) {
    Agent agent = make_agent();
    Controller controller(agent.active(), settings_.activation_slope);
    const std::vector<float> readings{0.25f, -0.5f, 1.0f};
    for (int cycle = 0; cycle < 3; ++cycle) {
        const auto expected = controller.update(readings);
        const auto actual = agent.control(readings);
        EXPECT_TRUE(std::equal(actual.begin(), actual.end(), expected.begin(), expected.end()));
    }
}

TEST_F(AgentTest, KeepsItsEnergyInRange) {
    Agent agent = make_agent();
    agent.gain(30.0f);
    EXPECT_EQ(agent.energy(), 130.0f);
    agent.gain(1000.0f);
    EXPECT_EQ(agent.energy(), 200.0f);
    agent.spend(-0.5f);
    EXPECT_EQ(agent.energy(), 199.5f);
    agent.spend(-1000.0f);
    EXPECT_EQ(agent.energy(), 0.0f);
}

TEST_F(AgentTest, ItsFitnessIsTheRunningMeanOfItsEnergyEveryTenCycles) {
    Agent agent = make_agent();
    double sum = 100.0;  // the initial energy is the first sample
    double samples = 1.0;
    for (int cycle = 1; cycle <= 100; ++cycle) {
        agent.spend(cycle % 3 == 0 ? 2.0f : -1.5f);
        if (cycle % 10 == 0) {
            sum += agent.energy();
            samples += 1.0;
        }
        ASSERT_FLOAT_EQ(agent.fitness(), static_cast<float>(sum / samples)) << cycle;
        ASSERT_EQ(fitness_of(agent, agent.active().id), agent.fitness());
    }
}

TEST_F(AgentTest, AGainBetweenCyclesDoesNotAgeTheGenome) {
    settings_.fitness_period_cycles = 2;
    Agent agent = make_agent();
    for (int i = 0; i < 10; ++i) agent.gain(5.0f);
    EXPECT_EQ(agent.fitness(), 100.0f);
    agent.spend(0.0f);
    agent.spend(0.0f);
    EXPECT_FLOAT_EQ(agent.fitness(), 125.0f);
}

// ---- if e ≤ e_threshold and not in_maturation_period then ----

TEST_F(AgentTest, IsDepletedWithoutEnergyOncePastMaturation) {
    Agent agent = make_agent();
    agent.spend(-100.0f);
    for (int age = 1; age <= 5; ++age) {
        EXPECT_FALSE(agent.is_depleted()) << age;
        agent.spend(0.0f);
    }
    EXPECT_TRUE(agent.is_depleted());  // of age 6
    agent.gain(0.1f);
    EXPECT_FALSE(agent.is_depleted());
}

TEST_F(AgentTest, IsNeverDepletedWithEnergyLeft) {
    Agent agent = make_agent();
    for (int age = 0; age < 1000; ++age) agent.spend(0.0f);
    EXPECT_FALSE(agent.is_depleted());
}

// ---- Tabu ← Tabu ∪ {g_a}; offspring; P ← P ∪ {g_offsp}; g_a ← g_offsp; e ← e_init ----

TEST_F(AgentTest, AReplacementStartsAnewWithAnOffspringOfItsPopulation) {
    Agent agent = make_agent(4);
    const auto dead = agent.message().genome;
    for (int i = 0; i < 7; ++i) agent.spend(-20.0f);
    ASSERT_TRUE(agent.is_depleted());
    const Birth birth = agent.replace(0.0);
    EXPECT_FALSE(birth.mated);
    EXPECT_EQ(birth.mutation, Mutation::none);
    EXPECT_EQ(agent.active().id, (GenomeId{RobotId{4}, 1}));
    EXPECT_TRUE(same_genes(agent.active(), *dead));  // a clone, but a new genome
    EXPECT_EQ(agent.energy(), 100.0f);
    EXPECT_EQ(agent.fitness(), 100.0f);
    EXPECT_FALSE(agent.is_depleted());
    EXPECT_EQ(ids(agent), (std::vector<GenomeId>{dead->id, agent.active().id}));
    EXPECT_EQ(agent.tabu_list().size(), 1u);
}

// ---- Whom an agent believes ----

TEST_F(AgentTest, TakesAGenomeFromNobodyButItsMaker) {
    Agent agent = make_agent();
    const Message of_nine = message(0, 9.0f, 50.0f, 500);
    for (const std::uint32_t sender : {0u, 1u, 8u, 10u}) {
        EXPECT_EQ(agent.receive(RobotId{sender}, of_nine), Reception::not_its_maker) << sender;
    }
    EXPECT_EQ(agent.source().stamp(), Stamp{genesis_marks + 1}) << "it was dropped whole";
    EXPECT_EQ(agent.receive(RobotId{9}, of_nine), Reception::accepted);
    EXPECT_EQ(agent.receive(RobotId{8}, message(0, 9.0f, 150.0f)), Reception::not_its_maker);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 0}), 50.0f) << "nobody else has its energy";
}

// Neither a stranger who speaks as someone else, nor an echo: nothing that is heard is one's own.
TEST_F(AgentTest, HearsNothingAboutItsOwnGenomes) {
    Agent agent = make_agent();
    Message own = agent.message();
    const GenomeId next{RobotId{1}, agent.active().id.birth + 1};
    for (const std::uint32_t sender : {1u, 9u}) {
        for (const float energy : {0.0f, 150.0f}) {
            own.energy = energy;
            EXPECT_EQ(agent.receive(RobotId{sender}, own), Reception::not_its_maker);
        }
        Genome stolen = *message(0, 9.0f, 0.0f).genome;
        stolen.id = next;
        EXPECT_EQ(agent.receive(RobotId{sender},
                                {std::make_shared<const Genome>(std::move(stolen)), 150.0f, {}}),
                  Reception::not_its_maker);
    }
    EXPECT_EQ(fitness_of(agent, agent.active().id), 100.0f);
    EXPECT_EQ(agent.fitness(), 100.0f);
    agent.replace(0.0);
    EXPECT_EQ(agent.active().id, next);
    EXPECT_EQ(agent.population().members().size(), 2u);
}

TEST_F(AgentTest, RefusesEnergiesThatNoRobotHas) {
    const float inf = std::numeric_limits<float>::infinity();
    settings_.energy_maximum = 150.0;
    Agent agent = make_agent();
    for (const float energy : {-1.0f, -std::numeric_limits<float>::denorm_min(), 150.001f, 1e30f,
                               inf, -inf, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, energy, 500)),
                  Reception::impossible_energy)
            << energy;
    }
    EXPECT_EQ(agent.source().stamp(), Stamp{genesis_marks + 1});
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 150.0f)), Reception::accepted);
    EXPECT_EQ(agent.receive(RobotId{9}, message(1, 5.0f, 0.0f)), Reception::accepted);
    EXPECT_EQ(agent.receive(RobotId{9}, message(1, 5.0f, 151.0f)), Reception::impossible_energy);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 1}), 0.0f);
}

TEST_F(AgentTest, BelievesTheEnergyOfAGenomeThatHasNotLived) {
    settings_.energy_initial = 300.0;  // beyond the maximum, until its first cycle
    Agent agent = make_agent();
    EXPECT_EQ(agent.receive(RobotId{2}, make_agent(2).message()), Reception::accepted);
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 300.5f)), Reception::impossible_energy);
}

TEST_F(AgentTest, GivesARobotNoMoreThanItsShareOfThePopulation) {
    settings_.population = 5;
    Agent agent(RobotId{1}, settings_, topology_,
                std::make_unique<GeneClockSource>(RobotId{1}, genesis_marks), RandomStream(1, 1),
                {.members_per_maker = 2});
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 50.0f)), Reception::accepted);
    EXPECT_EQ(agent.receive(RobotId{9}, message(1, -9.0f, 40.0f)), Reception::accepted);
    EXPECT_EQ(agent.receive(RobotId{9}, message(2, 5.0f, 40.0f)), Reception::unfit)
        << "there is room, but not for a third, unless it is fitter than one of them";
    EXPECT_EQ(agent.receive(RobotId{9}, message(2, 5.0f, 60.0f)), Reception::accepted);
    EXPECT_FALSE(holds(agent, {RobotId{9}, 1})) << "the less fit of the two";
    EXPECT_EQ(agent.tabu_list().size(), 0u) << "nobody fills the list of another";
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 70.0f)), Reception::updated);
    EXPECT_EQ(agent.population().members().size(), 3u);

    Genome of_eight = *message(0, -9.0f, 0.0f).genome;
    of_eight.id.robot = RobotId{8};
    const Message from_eight{std::make_shared<const Genome>(std::move(of_eight)), 0.0f, {}};
    EXPECT_EQ(agent.receive(RobotId{8}, from_eight), Reception::accepted) << "another's share";
    EXPECT_EQ(agent.receive(RobotId{9}, message(3, -5.0f, 80.0f)), Reception::accepted);
    EXPECT_TRUE(holds(agent, {RobotId{8}, 0})) << "less fit, but not a genome of that robot";
    EXPECT_FALSE(holds(agent, {RobotId{9}, 0}));
}

TEST_F(AgentTest, AsksForNoOtherPlaceForAGenomeThatItHolds) {
    settings_.population = 5;
    settings_.held_reports = HeldReports::acceptable;
    Agent agent(RobotId{1}, settings_, topology_,
                std::make_unique<GeneClockSource>(RobotId{1}, genesis_marks), RandomStream(1, 1),
                {.members_per_maker = 1});
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 50.0f)), Reception::accepted);
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 40.0f)), Reception::updated);
}

TEST_F(AgentTest, KeepsPlacesForItsOwnGenomes) {
    settings_.population = 5;
    Agent agent(RobotId{1}, settings_, topology_,
                std::make_unique<GeneClockSource>(RobotId{1}, genesis_marks), RandomStream(1, 1),
                {.members_of_others = 2});
    const auto from = [&](std::uint32_t robot, float weight, float energy) {
        Genome genome = *message(0, weight, 0.0f).genome;
        genome.id.robot = RobotId{robot};
        return agent.receive(RobotId{robot},
                             {std::make_shared<const Genome>(std::move(genome)), energy, {}});
    };
    EXPECT_EQ(from(7, 9.0f, 50.0f), Reception::accepted);
    EXPECT_EQ(from(8, -9.0f, 40.0f), Reception::accepted);
    EXPECT_EQ(from(9, 5.0f, 40.0f), Reception::unfit) << "the others have their places";
    EXPECT_EQ(from(9, 5.0f, 41.0f), Reception::accepted);
    EXPECT_FALSE(holds(agent, {RobotId{8}, 0}));
    EXPECT_EQ(agent.tabu_list().size(), 0u);
    for (int births = 0; births < 3; ++births) agent.replace(0.0);
    const auto held = ids(agent);
    EXPECT_EQ(held.size(), 5u);
    EXPECT_EQ(
        std::count_if(held.begin(), held.end(), [](GenomeId id) { return id.robot == RobotId{1}; }),
        4)
        << "of its own, which may have as many places as they like";
}

TEST_F(AgentTest, MayBelieveThatNobodyIsFitterThanItsOwn) {
    Agent agent(RobotId{1}, settings_, topology_,
                std::make_unique<GeneClockSource>(RobotId{1}, genesis_marks), RandomStream(1, 1),
                {.may_excel = false});
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 199.0f)), Reception::accepted);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 0}), 100.0f) << "what its own active genome has";
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 50.0f)), Reception::updated);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 0}), 75.0f);
    EXPECT_EQ(agent.receive(RobotId{9}, message(1, -9.0f, 30.0f)), Reception::accepted);
    EXPECT_EQ(fitness_of(agent, {RobotId{9}, 1}), 30.0f);

    Agent failing(RobotId{1}, settings_, topology_,
                  std::make_unique<GeneClockSource>(RobotId{1}, genesis_marks), RandomStream(1, 1),
                  {.may_excel = false});
    EXPECT_EQ(failing.receive(RobotId{9}, message(0, 9.0f, 100.0f)), Reception::accepted);
    for (int cycle = 0; cycle < 10; ++cycle) failing.spend(-10.0f);
    EXPECT_EQ(failing.fitness(), 50.0f);
    EXPECT_EQ(failing.receive(RobotId{9}, message(1, -9.0f, 90.0f)), Reception::accepted);
    EXPECT_EQ(fitness_of(failing, {RobotId{9}, 1}), 50.0f) << "fitter than its own is another's";
}

// Whatever the caller does with its own: agents of a swarm share what they were made with.
TEST_F(AgentTest, KeepsItsSettings) {
    auto given = std::make_unique<OdneatSettings>(settings_);
    Agent agent(RobotId{1}, *given, topology_,
                std::make_unique<GeneClockSource>(RobotId{1}, genesis_marks), RandomStream(1, 1));
    given->population = 1;
    given.reset();
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 50.0f)), Reception::accepted);
    agent.replace(0.0);
    agent.reboot(topology_);
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 50.0f)), Reception::accepted);

    Agent by_default{RobotId{1},
                     {},
                     topology_,
                     std::make_unique<GeneClockSource>(RobotId{1}, genesis_marks),
                     RandomStream(1, 1)};
    by_default.spend(-10.0f);
    EXPECT_EQ(by_default.energy(), 90.0f);
}

TEST_F(AgentTest, TheDeadGenomeIsTabu) {
    Agent agent = make_agent(4);
    Message like_the_dead = agent.message();
    auto genome = std::make_shared<Genome>(agent.active());
    genome->id = {RobotId{9}, 0};
    like_the_dead.genome = std::move(genome);
    agent.replace(0.0);
    EXPECT_EQ(agent.receive(RobotId{9}, like_the_dead), Reception::tabu);
}

TEST_F(AgentTest, TheOffspringCountsItsOwnAgeAndSamples) {
    Agent agent = make_agent();
    for (int i = 0; i < 7; ++i) agent.spend(-20.0f);
    agent.replace(0.0);
    for (int cycle = 1; cycle < 10; ++cycle) agent.spend(-4.0f);
    EXPECT_EQ(agent.fitness(), 100.0f);
    agent.spend(-4.0f);
    EXPECT_FLOAT_EQ(agent.fitness(), (100.0f + 60.0f) / 2.0f);
}

TEST_F(AgentTest, TheControllerIsThatOfTheOffspring) {
    settings_.p_mutate = 1.0;
    settings_.p_node = settings_.p_connection = 0.0;
    settings_.p_weight = 1.0;
    settings_.sigma = 1.0;
    Agent agent = make_agent();
    agent.control(std::vector{0.5f, 0.5f, 1.0f});
    EXPECT_EQ(agent.replace(0.0).mutation, Mutation::weights);
    Controller controller(agent.active(), settings_.activation_slope);
    const std::vector<float> readings{0.5f, 0.25f, 1.0f};
    EXPECT_EQ(agent.control(readings)[0], controller.update(readings)[0]);
}

TEST_F(AgentTest, TheShareIsThatOfTheOffspring) {
    settings_.population = 4;
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 50.0f));
    ASSERT_NEAR(agent.broadcast_probability(), 100.0 / 150.0, 1e-6);
    const auto dead = agent.message().genome;
    agent.replace(0.0);
    // The offspring shares the fitness of its parent's species.
    const double expected = same_genes(agent.active(), *dead)
                                ? (200.0 / 4.0) / (200.0 / 4.0 + 50.0)
                                : (150.0 / 4.0) / (150.0 / 4.0 + 100.0);
    EXPECT_NEAR(agent.broadcast_probability(), expected, 1e-6);
}

TEST_F(AgentTest, AFullPopulationDropsItsWorstForTheOffspring) {
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 20.0f));
    agent.receive(RobotId{9}, message(1, -9.0f, 90.0f));
    const GenomeId dead = agent.active().id;
    agent.replace(0.0);
    // The dead genome's recorded fitness is still 100: genome 0 is the worst.
    EXPECT_EQ(ids(agent), (std::vector<GenomeId>{dead, {RobotId{9}, 1}, agent.active().id}));
    EXPECT_EQ(agent.tabu_list().size(), 2u);
    EXPECT_EQ(agent.receive(RobotId{9}, message(0, 9.0f, 200.0f)), Reception::tabu);
}

TEST_F(AgentTest, TheDeadGenomeMayBeTheWorstAndIsListedOnce) {
    settings_.fitness_period_cycles = 1;
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 80.0f));
    agent.receive(RobotId{9}, message(1, -9.0f, 90.0f));
    const GenomeId dead = agent.active().id;
    for (int i = 0; i < 100; ++i) agent.spend(-100.0f);
    agent.replace(0.0);
    EXPECT_FALSE(holds(agent, dead));
    EXPECT_EQ(agent.population().members().size(), 3u);
    EXPECT_EQ(agent.tabu_list().size(), 1u);
}

TEST_F(AgentTest, TheDeadGenomeIsStillAParent) {
    // Two species of equal fitness, the dead genome's and another's: half of the offspring each.
    int of_the_dead = 0;
    constexpr int births = 2000;
    for (std::uint32_t i = 0; i < births; ++i) {
        Agent agent = make_agent(100 + i);
        agent.receive(RobotId{9}, message(0, 9.0f, 100.0f));
        const auto dead = agent.message().genome;
        agent.replace(0.0);
        of_the_dead += agent.active().weights == dead->weights ? 1 : 0;
    }
    EXPECT_NEAR(of_the_dead / double{births}, 0.5, 5 * std::sqrt(0.25 / births));
}

TEST_F(AgentTest, AllMembersAreDividedAnewAtABirth) {
    settings_.energy_maximum = 500.0;
    settings_.population = 4;
    settings_.c_weight = 1.0 / static_cast<double>(inputs * outputs);  // distance = |Δ weight|
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 10.0f, 1.0f));  // founds a species
    agent.receive(RobotId{9}, message(1, 8.0f, 500.0f));
    agent.receive(RobotId{9},
                  message(2, 6.0f, 400.0f));  // 4 from the representative: a third species
    ASSERT_EQ(agent.population().species_count(), 3u);
    // Genome 0, the worst, leaves; genome 1 founds the species, and genome 2 is near it.
    agent.replace(0.0);
    EXPECT_FALSE(holds(agent, {RobotId{9}, 0}));
    const auto& members = agent.population().members();
    const auto species_of = [&](std::uint32_t birth) {
        return members[agent.population().find({RobotId{9}, birth}).value()].species;
    };
    EXPECT_EQ(species_of(1), species_of(2));
}

TEST_F(AgentTest, MatesOnlyTwoDifferentGenomes) {
    settings_.p_mate = 1.0;
    Agent alone = make_agent();
    EXPECT_FALSE(alone.replace(0.0).mated);

    // Two members of a species give the same parent in every draw: the fitter of the two.
    settings_.c_weight = 0.0;
    Agent two = make_agent();
    two.receive(RobotId{9}, message(0, 9.0f, 50.0f));
    EXPECT_FALSE(two.replace(0.0).mated);

    settings_.population = 4;
    int mated = 0;
    int mixed = 0;
    constexpr int births = 2000;
    for (std::uint32_t i = 0; i < births; ++i) {
        Agent three = make_agent(100 + i);
        three.receive(RobotId{9}, message(0, 9.0f, 50.0f));
        three.receive(RobotId{9}, message(1, -9.0f, 60.0f));
        const auto active = three.message().genome;
        const bool is_mated = three.replace(0.0).mated;
        mated += is_mated ? 1 : 0;
        // A child of two genomes of one topology has weights of either.
        if (!is_mated) continue;
        std::size_t from_active = 0;
        for (std::size_t gene = 0; gene < active->weights.size(); ++gene) {
            const float weight = three.active().weights[gene];
            ASSERT_TRUE(weight == active->weights[gene] || weight == -9.0f);
            from_active += weight == active->weights[gene] ? 1 : 0;
        }
        mixed += from_active > 0 && from_active < active->weights.size() ? 1 : 0;
    }
    EXPECT_GT(mixed, mated / 2) << "a child with genes of one parent only has not two parents";
    // The fittest is drawn with 2/3, the second with 1/3: different in 4 of 9.
    const double expected = 4.0 / 9.0;
    EXPECT_NEAR(mated / double{births}, expected,
                5 * std::sqrt(expected * (1 - expected) / births));
}

TEST_F(AgentTest, EachParentHasItsOwnFitness) {
    // The active genome (100) and a larger one: the child has the genes of the fitter of the two,
    // whichever is drawn first. Were they equally fit, it would be the smaller one's.
    settings_.p_mate = 1.0;
    settings_.second_parent = SecondParent::population;
    for (const float energy : {60.0f, 140.0f}) {
        int from_larger = 0;
        std::set<GenomeId> first;
        for (std::uint32_t robot = 11; robot <= 60; ++robot) {
            Agent agent = make_agent(robot);
            Message large = message(0, 9.0f, energy, 100);
            auto genome = std::make_shared<Genome>(*large.genome);
            add_hidden(*genome, mark(90, 9));
            add_gene(*genome, mark(91, 9), {genesis(1), mark(90, 9), false}, 1.0f);
            add_gene(*genome, mark(92, 9), {mark(90, 9), genesis(inputs + 1), false}, 1.0f);
            large.genome = std::move(genome);
            ASSERT_EQ(agent.receive(RobotId{9}, large), Reception::accepted);
            const Birth birth = agent.replace(0.0);
            ASSERT_TRUE(birth.mated);
            first.insert({birth.first_parent->id.robot == RobotId{9} ? RobotId{9} : RobotId{1}, 0});
            from_larger += agent.active().connections() == large.genome->connections();
        }
        EXPECT_EQ(first.size(), 2u) << "each must be the first parent at times";
        EXPECT_EQ(from_larger, energy > 100.0f ? 50 : 0);
    }
}

TEST_F(AgentTest, MatesWhomTheSettingsSay) {
    settings_.p_mate = 1.0;
    settings_.population = 10;
    const auto mates_always = [&](SecondParent rule, float farther_by) {
        settings_.second_parent = rule;
        int mated = 0;
        for (std::uint32_t robot = 11; robot <= 60; ++robot) {
            Agent agent = make_agent(robot);
            Message other = message(0, 0.0f, 90.0f);
            auto genome = std::make_shared<Genome>(agent.active());
            genome->id = other.genome->id;
            float& weight = genome->weights[0];  // and stays in range
            weight += weight > 0.0f ? -farther_by : farther_by;
            other.genome = std::move(genome);
            agent.receive(RobotId{9}, other);
            mated += agent.replace(0.0).mated ? 1 : 0;
        }
        return mated == 50;
    };
    EXPECT_FALSE(mates_always(SecondParent::tournament, 3.0f));  // the fitter of two, twice
    EXPECT_TRUE(mates_always(SecondParent::other, 3.0f));
    EXPECT_FALSE(mates_always(SecondParent::other, 9.0f));  // of another species
    EXPECT_TRUE(mates_always(SecondParent::population, 9.0f));
}

TEST_F(AgentTest, MatesAndMutatesWithTheirProbabilities) {
    settings_.p_mate = 0.3;
    settings_.p_mutate = 0.6;
    settings_.p_node = 1.0;
    settings_.c_weight = 0.0;
    settings_.population = 4;
    int mated = 0;
    int mutated = 0;
    constexpr int births = 4000;
    for (std::uint32_t i = 0; i < births; ++i) {
        Agent agent = make_agent(100 + i);
        agent.receive(RobotId{9}, message(0, 9.0f, 50.0f));
        agent.receive(RobotId{9}, message(1, -9.0f, 60.0f));
        const Birth birth = agent.replace(0.0);
        mated += birth.mated ? 1 : 0;
        mutated += birth.mutation == Mutation::add_neuron ? 1 : 0;
    }
    const auto tolerance = [](double p) { return 5 * std::sqrt(p * (1 - p) / births); };
    EXPECT_NEAR(mated / double{births}, 0.3 * 4.0 / 9.0, tolerance(0.3 * 4.0 / 9.0));
    EXPECT_NEAR(mutated / double{births}, 0.6, tolerance(0.6));
}

TEST_F(AgentTest, MarksTheGenesOfAMutationWithItsOwnClock) {
    settings_.p_mutate = 1.0;
    settings_.p_node = 1.0;
    Agent agent = make_agent(4);
    agent.receive(RobotId{9}, message(0, 0.0f, 0.0f, 500));
    ASSERT_EQ(agent.replace(0.0).mutation, Mutation::add_neuron);
    EXPECT_EQ(agent.active().topology->neurons.back().mark, mark(500, 4));
    EXPECT_EQ(agent.active().topology->connection_marks.back(), mark(502, 4));
    EXPECT_EQ(agent.message().stamp, Stamp{503});
}

/// A source that notes when it was asked.
class TimedSource final : public InnovationSource {
public:
    explicit TimedSource(std::vector<double>& times) : times_(times) {}
    std::optional<SplitMarks> mark_split(const Genome&, std::size_t, double now_cycles) override {
        times_.push_back(now_cycles);
        return std::nullopt;
    }
    std::optional<InnovationNumber> mark_connection(const Genome&, const ConnectionEnds&,
                                                    double now_cycles) override {
        times_.push_back(now_cycles);
        return std::nullopt;
    }
    Stamp stamp() const override { return Stamp{}; }
    bool observe(Stamp) override { return true; }

private:
    std::vector<double>& times_;
};

TEST_F(AgentTest, MarksTheGenesOfAMutationAtTheTimeOfTheBirth) {
    settings_.p_mutate = settings_.p_node = 1.0;
    std::vector<double> times;
    const auto replace_at = [&](double now_cycles) {
        Agent agent(RobotId{1}, settings_, topology_, std::make_unique<TimedSource>(times),
                    RandomStream(1, 1));
        agent.replace(now_cycles);
    };
    replace_at(17.0);
    settings_.p_node = 0.0;
    settings_.p_connection = settings_.p_recurrent = 1.0;  // an output's loop, say
    replace_at(23.5);
    EXPECT_EQ(times, (std::vector{17.0, 23.5}));
}

TEST_F(AgentTest, AnExhaustedClockMeansNoStructuralMutation) {
    settings_.p_mutate = 1.0;
    settings_.p_node = 1.0;
    Agent agent = make_agent(4, largest - 3);
    const auto before = agent.message().genome;
    EXPECT_EQ(agent.replace(0.0).mutation, Mutation::none);
    EXPECT_TRUE(same_genes(agent.active(), *before));
    EXPECT_EQ(agent.message().stamp, Stamp{largest - 2});
}

TEST_F(AgentTest, ARebootLosesAllButTheClockAndTheIds) {
    settings_.p_mutate = settings_.p_node = 1.0;
    settings_.p_weight = 0.0;
    Agent agent = make_agent();
    agent.receive(RobotId{9}, message(0, 9.0f, 50.0f, 100));
    agent.replace(0.0);
    const GenomeId before = agent.active().id;
    const Stamp stamp = agent.source().stamp();
    ASSERT_GT(stamp, Stamp{100});
    ASSERT_EQ(agent.population().members().size(), 3u);
    ASSERT_EQ(agent.tabu_list().size(), 1u);
    agent.gain(-70.0f);

    agent.reboot(topology_);
    EXPECT_EQ(agent.active().topology, topology_);
    EXPECT_EQ(ids(agent), std::vector<GenomeId>{agent.active().id});
    EXPECT_EQ(agent.tabu_list().size(), 0u);
    EXPECT_EQ(agent.energy(), 100.0f);
    EXPECT_EQ(agent.fitness(), 100.0f);
    EXPECT_EQ(agent.broadcast_probability(), 1.0);
    EXPECT_EQ(agent.source().stamp(), stamp);
    EXPECT_GT(agent.active().id, before);
    EXPECT_EQ(agent.message().genome->id, agent.active().id);

    const GenomeId between = agent.active().id;
    agent.reboot(topology_, std::make_unique<GeneClockSource>(RobotId{1}, genesis_marks));
    EXPECT_EQ(agent.source().stamp(), Stamp{genesis_marks + 1});
    EXPECT_GT(agent.active().id, between);
}

TEST_F(AgentTest, CanBeMoved) {
    Agent agent = make_agent();
    const GenomeId id = agent.active().id;
    const Agent moved = std::move(agent);
    EXPECT_EQ(moved.active().id, id);
}

}  // namespace
}  // namespace gene_clocks::neat
