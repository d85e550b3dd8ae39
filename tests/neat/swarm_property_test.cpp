#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/erdos_renyi_generator.hpp>
#include <boost/graph/small_world_generator.hpp>
#include <boost/random/linear_congruential.hpp>
#include <functional>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/congruence_class_source.hpp>
#include <gene_clocks/neat/content_hash_source.hpp>
#include <gene_clocks/neat/global_counter_source.hpp>
#include <gene_clocks/neat/hybrid_logical_clock_source.hpp>
#include <gene_clocks/neat/random_identifier_source.hpp>
#include <gene_clocks/neat/timestamp_source.hpp>
#include <gene_clocks/neat/unmerged_gene_clock_source.hpp>
#include <map>
#include <set>
#include <vector>

#include "tests/neat/sample_genomes.hpp"

// Agents that exchange genomes over random graphs, on a radio that loses, repeats, delays and
// reorders messages; and a checker that watches from outside, with vector clocks.

namespace gene_clocks::neat {
namespace {

using namespace samples;

using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
using SourceMaker =
    std::function<std::unique_ptr<InnovationSource>(RobotId robot, std::uint64_t genesis_marks)>;

std::unique_ptr<InnovationSource> make_gene_clock(RobotId robot, std::uint64_t genesis_marks) {
    return std::make_unique<GeneClockSource>(robot, genesis_marks);
}

struct RadioFaults {
    double loss = 0.0;
    double duplication = 0.0;
    int delay_cycles = 0;  // the longest; each copy has its own
};

/// What an observer knows of a gene: its maker's history when it was made (Fidge 1988, Mattern
/// 1989). It is independent of the marks: one gene happened before another just if its vector is
/// nowhere larger.
struct Gene {
    InnovationNumber mark;
    std::vector<std::uint64_t> history;
};

bool happened_before(const Gene& a, const Gene& b) {
    return &a != &b && std::equal(a.history.begin(), a.history.end(), b.history.begin(),
                                  [](std::uint64_t x, std::uint64_t y) { return x <= y; });
}

class Swarm {
public:
    Swarm(Graph graph, RadioFaults faults, std::uint32_t seed, const SourceMaker& make_source)
        : graph_(std::move(graph)), faults_(faults), random_(seed, 0) {
        settings_.p_mutate = 0.9;
        settings_.p_node = 0.4;
        settings_.p_connection = 0.8;
        settings_.p_mate = 0.5;
        settings_.population = 4;
        settings_.maturation_cycles = 0;
        const auto topology = make_initial_topology(2, 2);
        const std::size_t robots = boost::num_vertices(graph_);
        histories_.assign(robots, std::vector<std::uint64_t>(robots, 0));
        agents_.reserve(robots);
        for (std::uint32_t i = 0; i < robots; ++i) {
            const RobotId robot{i + 1};
            agents_.emplace_back(robot, settings_, topology,
                                 make_source(robot, genesis_mark_count(2, 2)),
                                 RandomStream(seed, i + 1));
        }
    }

    void run(int cycles) {
        for (int cycle = 0; cycle < cycles; ++cycle) {
            for (std::size_t i = 0; i < agents_.size(); ++i) {
                if (random_.chance(agents_[i].broadcast_probability())) broadcast(i, cycle);
                if (random_.chance(0.2)) give_birth(i, cycle);
            }
            deliver(cycle);
        }
    }

    const std::vector<Gene>& genes() const { return genes_; }  // in the order of creation
    const std::vector<Agent>& agents() const { return agents_; }
    bool all_marks_are_new() const { return all_marks_are_new_; }

    /// Pairs of genes whose marks contradict the order in which they happened.
    std::size_t violations_of_the_clock_condition() const {
        std::size_t violations = 0;
        for (const Gene& a : genes_) {
            for (const Gene& b : genes_) {
                if (happened_before(a, b) && !(a.mark < b.mark)) ++violations;
            }
        }
        return violations;
    }

private:
    struct Letter {
        std::size_t to;
        Message message;
        std::vector<std::uint64_t> history;  // of the sender
    };

    void broadcast(std::size_t from, int cycle) {
        for (auto [to, end] = boost::adjacent_vertices(from, graph_); to != end; ++to) {
            if (random_.chance(faults_.loss)) continue;
            const int copies = random_.chance(faults_.duplication) ? 2 : 1;
            for (int copy = 0; copy < copies; ++copy) {
                const int due = cycle + static_cast<int>(random_.below(
                                            static_cast<std::uint32_t>(faults_.delay_cycles) + 1));
                letters_.emplace(due, Letter{*to, agents_[from].message(), histories_[from]});
            }
        }
    }

    void deliver(int cycle) {
        while (!letters_.empty() && letters_.begin()->first <= cycle) {
            const Letter letter = std::move(letters_.begin()->second);
            letters_.erase(letters_.begin());
            auto& history = histories_[letter.to];
            for (std::size_t i = 0; i < history.size(); ++i) {
                history[i] = std::max(history[i], letter.history[i]);
            }
            agents_[letter.to].receive(letter.message.genome->id.robot, letter.message);
        }
    }

    void give_birth(std::size_t parent, int cycle) {
        Agent& agent = agents_[parent];
        agent.spend(static_cast<float>(random_.uniform(-100.0, 100.0)));
        const Birth birth = agent.replace(cycle);
        std::set<InnovationNumber> fresh;
        const auto look_at = [&](InnovationNumber mark) {
            if (mark.robot != genesis_robot && !marks_.contains(mark)) fresh.insert(mark);
        };
        for (const NeuronGene& neuron : agent.active().topology->neurons) look_at(neuron.mark);
        for (const auto& mark : agent.active().topology->connection_marks) look_at(mark);
        // A mark that is used a second time is not fresh, and would be missed here.
        const std::size_t expected = birth.mutation == Mutation::add_neuron       ? 3
                                     : birth.mutation == Mutation::add_connection ? 1
                                                                                  : 0;
        all_marks_are_new_ = all_marks_are_new_ && fresh.size() == expected;
        for (const InnovationNumber& mark : fresh) {
            all_marks_are_new_ = all_marks_are_new_ && mark.robot == agent.robot();
            ++histories_[parent][parent];
            genes_.push_back({mark, histories_[parent]});
            marks_.insert(mark);
        }
    }

    Graph graph_;
    RadioFaults faults_;
    RandomStream random_;
    OdneatSettings settings_;
    std::vector<Agent> agents_;
    std::vector<std::vector<std::uint64_t>> histories_;
    std::multimap<int, Letter> letters_;  // by the cycle in which they arrive
    std::vector<Gene> genes_;
    std::set<InnovationNumber> marks_;
    bool all_marks_are_new_ = true;
};

Graph random_graph() {
    const auto robots = *rc::gen::inRange<std::size_t>(2, 16);
    boost::minstd_rand random(*rc::gen::inRange<std::uint32_t>(1, 1'000'000));
    using SmallWorld = boost::small_world_iterator<boost::minstd_rand, Graph>;
    using ErdosRenyi = boost::erdos_renyi_iterator<boost::minstd_rand, Graph>;
    if (robots > 5 && *rc::gen::arbitrary<bool>()) {
        const double rewired = *rc::gen::element(0.0, 0.1, 0.5);  // 0: a ring
        return Graph(SmallWorld(random, robots, 2, rewired), SmallWorld(), robots);
    }
    // From almost no links, which makes islands, to all.
    const double density = *rc::gen::element(0.02, 0.2, 0.5, 0.999);
    return Graph(ErdosRenyi(random, robots, density), ErdosRenyi(), robots);
}

RadioFaults random_faults() {
    return {*rc::gen::element(0.0, 0.3, 0.9), *rc::gen::element(0.0, 0.5),
            *rc::gen::element(0, 1, 10)};
}

RC_GTEST_PROP(SwarmProperty, GeneClocksMarkUniquelyAndRespectCauseAndEffect, ()) {
    Swarm swarm(random_graph(), random_faults(), *rc::gen::arbitrary<std::uint32_t>(),
                make_gene_clock);
    swarm.run(*rc::gen::inRange(0, 80));
    RC_CLASSIFY(swarm.genes().size() >= 50, "at least 50 genes");
    RC_ASSERT(swarm.all_marks_are_new());
    RC_ASSERT(swarm.violations_of_the_clock_condition() == 0u);
}

RC_GTEST_PROP(SwarmProperty, EveryGenomeIsACausalChainInTheOrderOfItsMarks, ()) {
    Swarm swarm(random_graph(), random_faults(), *rc::gen::arbitrary<std::uint32_t>(),
                make_gene_clock);
    swarm.run(*rc::gen::inRange(0, 60));
    std::map<InnovationNumber, const Gene*> genes;
    for (const Gene& gene : swarm.genes()) genes[gene.mark] = &gene;
    for (const Agent& agent : swarm.agents()) {
        for (const auto& member : agent.population().members()) {
            RC_ASSERT(fault_of(*member.genome) == "valid");
            std::set<InnovationNumber> marks;
            for (const auto& neuron : member.genome->topology->neurons) marks.insert(neuron.mark);
            for (const auto& mark : member.genome->topology->connection_marks) marks.insert(mark);
            const Gene* previous = nullptr;
            for (const InnovationNumber& mark : marks) {
                if (mark.robot == genesis_robot) continue;
                const Gene* gene = genes.at(mark);
                RC_ASSERT((!previous || happened_before(*previous, *gene)));
                previous = gene;
            }
        }
    }
}

RC_GTEST_PROP(SwarmProperty, TimestampsAreUniqueWhateverTheDrift, ()) {
    RandomStream drift(*rc::gen::arbitrary<std::uint32_t>(), 0);
    Swarm swarm(random_graph(), random_faults(), *rc::gen::arbitrary<std::uint32_t>(),
                [&](RobotId robot, std::uint64_t genesis_marks) {
                    const LocalTime time{drift.uniform(-1e3, 1e3), drift.uniform(-0.9, 0.9)};
                    return std::make_unique<TimestampSource>(robot, genesis_marks, time);
                });
    swarm.run(*rc::gen::inRange(0, 60));
    RC_ASSERT(swarm.all_marks_are_new());
}

RC_GTEST_PROP(SwarmProperty, HybridLogicalClocksRespectCauseAndEffectWhateverTheDrift, ()) {
    RandomStream drift(*rc::gen::arbitrary<std::uint32_t>(), 0);
    Swarm swarm(random_graph(), random_faults(), *rc::gen::arbitrary<std::uint32_t>(),
                [&](RobotId robot, std::uint64_t genesis_marks) {
                    const LocalTime time{.offset_cycles = drift.uniform(-1e3, 1e3),
                                         .drift_rate = drift.uniform(-0.9, 0.9)};
                    return std::make_unique<HybridLogicalClockSource>(robot, genesis_marks, time);
                });
    swarm.run(*rc::gen::inRange(0, 60));
    RC_ASSERT(swarm.all_marks_are_new());
    RC_ASSERT(swarm.violations_of_the_clock_condition() == 0u);
}

/// Sources that promise nothing about time, or that give robots the same mark: their genomes must
/// be sound all the same.
RC_GTEST_PROP(SwarmProperty, GenomesStayValidUnderEveryMarking, ()) {
    const auto record = std::make_shared<InnovationRecord>(genesis_mark_count(2, 2));
    const auto identifier_seed = *rc::gen::arbitrary<std::uint32_t>();
    const std::vector<SourceMaker> makers{
        [](RobotId robot, std::uint64_t genesis_marks) {
            return std::make_unique<UnmergedGeneClockSource>(robot, genesis_marks);
        },
        [](RobotId robot, std::uint64_t genesis_marks) {
            return std::make_unique<CongruenceClassSource>(robot, 1000, genesis_marks);
        },
        [&](RobotId robot, std::uint64_t genesis_marks) {
            return std::make_unique<RandomIdentifierSource>(
                genesis_marks, RandomStream(identifier_seed, static_cast<std::uint64_t>(robot)));
        },
        [](RobotId, std::uint64_t genesis_marks) {
            return std::make_unique<ContentHashSource>(genesis_marks);
        },
        [&](RobotId, std::uint64_t) { return std::make_unique<GlobalCounterSource>(record); }};
    const std::size_t maker = *rc::gen::inRange<std::size_t>(0, makers.size());
    Swarm swarm(random_graph(), random_faults(), *rc::gen::arbitrary<std::uint32_t>(),
                makers[maker]);
    swarm.run(*rc::gen::inRange(0, 60));
    for (const Agent& agent : swarm.agents()) {
        for (const auto& member : agent.population().members()) {
            RC_ASSERT(fault_of(*member.genome) == "valid");
        }
    }
}

// The checker must be able to fail: it refutes what is known to break the clock condition.

Swarm ring_of_ten(const SourceMaker& make_source) {
    boost::minstd_rand random(1);
    using SmallWorld = boost::small_world_iterator<boost::minstd_rand, Graph>;
    Swarm swarm(Graph(SmallWorld(random, 10, 2, 0.0), SmallWorld(), 10), {}, 1, make_source);
    swarm.run(60);
    return swarm;
}

TEST(SwarmChecker, FindsNothingWithGeneClocks) {
    const Swarm swarm = ring_of_ten(make_gene_clock);
    EXPECT_GT(swarm.genes().size(), 100u);
    EXPECT_TRUE(swarm.all_marks_are_new());
    EXPECT_EQ(swarm.violations_of_the_clock_condition(), 0u);
}

TEST(SwarmChecker, FindsNothingWithSynchronisedTimestamps) {
    const Swarm swarm = ring_of_ten([](RobotId robot, std::uint64_t genesis_marks) {
        return std::make_unique<TimestampSource>(robot, genesis_marks, LocalTime{});
    });
    EXPECT_TRUE(swarm.all_marks_are_new());
    EXPECT_EQ(swarm.violations_of_the_clock_condition(), 0u);
}

TEST(SwarmChecker, RefutesGeneClocksThatDoNotMerge) {
    const Swarm swarm = ring_of_ten([](RobotId robot, std::uint64_t genesis_marks) {
        return std::make_unique<UnmergedGeneClockSource>(robot, genesis_marks);
    });
    EXPECT_TRUE(swarm.all_marks_are_new());
    EXPECT_GT(swarm.violations_of_the_clock_condition(), 0u);
}

TEST(SwarmChecker, RefutesCongruenceClasses) {
    const Swarm swarm = ring_of_ten([](RobotId robot, std::uint64_t genesis_marks) {
        return std::make_unique<CongruenceClassSource>(robot, 10, genesis_marks);
    });
    EXPECT_TRUE(swarm.all_marks_are_new());
    EXPECT_GT(swarm.violations_of_the_clock_condition(), 0u);
}

TEST(SwarmChecker, RefutesTimestampsOfClocksThatAreSetApart) {
    const Swarm swarm = ring_of_ten([](RobotId robot, std::uint64_t genesis_marks) {
        const LocalTime time{.offset_cycles = robot == RobotId{1} ? 1000.0 : 0.0};
        return std::make_unique<TimestampSource>(robot, genesis_marks, time);
    });
    EXPECT_TRUE(swarm.all_marks_are_new());
    EXPECT_GT(swarm.violations_of_the_clock_condition(), 0u);
}

/// A clock of each robot's own, or of one id for all.
class BrokenClockSource final : public InnovationSource {
public:
    explicit BrokenClockSource(RobotId robot, std::uint64_t genesis_marks)
        : clock_(robot, genesis_marks) {}
    std::optional<SplitMarks> mark_split(const Genome& genome, std::size_t connection,
                                         double now_cycles) override {
        return clock_.mark_split(genome, connection, now_cycles);
    }
    std::optional<InnovationNumber> mark_connection(const Genome& genome,
                                                    const ConnectionEnds& ends,
                                                    double now_cycles) override {
        return clock_.mark_connection(genome, ends, now_cycles);
    }
    Stamp stamp() const override { return clock_.stamp(); }
    bool observe(Stamp) override { return true; }  // takes no maximum

private:
    GeneClockSource clock_;
};

TEST(SwarmChecker, RefutesAClockThatTakesNoMaximumOnReception) {
    const Swarm swarm = ring_of_ten([](RobotId robot, std::uint64_t genesis_marks) {
        return std::make_unique<BrokenClockSource>(robot, genesis_marks);
    });
    EXPECT_GT(swarm.violations_of_the_clock_condition(), 0u);
}

TEST(SwarmChecker, RefutesRobotsOfOneIdThatTakeNoMaximum) {
    const Swarm swarm = ring_of_ten([](RobotId, std::uint64_t genesis_marks) {
        return std::make_unique<BrokenClockSource>(RobotId{1}, genesis_marks);
    });
    EXPECT_FALSE(swarm.all_marks_are_new());
}

}  // namespace
}  // namespace gene_clocks::neat
