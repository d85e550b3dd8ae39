#include <gtest/gtest.h>

#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/durable_gene_clock_source.hpp>
#include <memory>
#include <set>

#include "tests/neat/sample_genomes.hpp"

namespace gene_clocks::neat {
namespace {

using namespace samples;

constexpr RobotId robot{5};
const std::uint64_t genesis_marks = genesis_mark_count(2, 1);

/// Storage that works when it is told to, and remembers how often it was written.
class SwitchedStorage {
public:
    explicit SwitchedStorage(std::uint64_t stored) : stored_{stored} {}
    StorageStatus store(std::uint64_t counter) {
        if (counter <= stored_) return {};
        if (!works) return {StorageError::device, 5};
        ++writes;
        stored_ = counter;
        return {};
    }
    std::uint64_t stored() const { return stored_; }

    bool works = true;
    int writes = 0;

private:
    std::uint64_t stored_;
};

using Source = DurableGeneClockSource<SwitchedStorage>;

class DurableGeneClockSourceTest : public testing::Test {
protected:
    InnovationNumber mint(Source& source) {
        return source.mark_connection(genome_, {}, 0.0).value();
    }
    static Message message(const std::vector<InnovationNumber>& more_marks, std::uint64_t stamp) {
        return message_of(perceptron(2, 1), more_marks, stamp);
    }
    static Message message_of(Genome genome, const std::vector<InnovationNumber>& more_marks,
                              std::uint64_t stamp) {
        auto topology = *genome.topology;
        for (const auto mark : more_marks) topology.neurons.push_back({mark, NeuronKind::hidden});
        genome.topology = std::make_shared<const Topology>(std::move(topology));
        return {std::make_shared<const Genome>(std::move(genome)), 50.0f, Stamp{stamp}};
    }

    static Reception hear(Agent& agent, const Message& message) {
        return agent.receive(message.genome->id.robot, message);
    }

    Genome genome_ = perceptron(2, 1);
    SwitchedStorage storage_{genesis_marks + 1};
};

TEST_F(DurableGeneClockSourceTest, HoldsWhatStorageDoesNotCover) {
    const auto source = Source::restart(robot, storage_, genesis_marks);
    ASSERT_TRUE(source);
    EXPECT_EQ(source->stamp_to_send(source->first_birth()), Stamp{genesis_marks + 1});
    EXPECT_EQ(storage_.writes, 1) << "no gene was made yet, but the first genome";

    storage_.works = false;
    mint(*source);
    const auto mark = mint(*source);
    EXPECT_EQ(source->stamp_to_send(source->first_birth()), std::nullopt);
    EXPECT_EQ(source->storage_status(), (StorageStatus{StorageError::device, 5}));
    storage_.works = true;
    EXPECT_EQ(source->stamp_to_send(source->first_birth()), Stamp{mark.counter + 1});
    EXPECT_EQ(storage_.stored(), mark.counter + 1);
}

TEST_F(DurableGeneClockSourceTest, MarksTheThreeGenesOfASplitInTheirOrder) {
    const auto source = Source::restart(robot, storage_, genesis_marks);
    const auto marks = source->mark_split(genome_, 0, 0.0);
    ASSERT_TRUE(marks);
    EXPECT_EQ(marks->neuron, (InnovationNumber{genesis_marks + 1, robot}));
    EXPECT_EQ(marks->incoming, (InnovationNumber{genesis_marks + 2, robot}));
    EXPECT_EQ(marks->outgoing, (InnovationNumber{genesis_marks + 3, robot}));
    EXPECT_EQ(source->stamp(), Stamp{genesis_marks + 4});
}

TEST_F(DurableGeneClockSourceTest, WritesOncePerBlock) {
    const auto source = Source::restart(robot, storage_, genesis_marks, {.block = 99});
    for (int i = 0; i < 1000; ++i) {
        mint(*source);
        ASSERT_TRUE(source->stamp_to_send(source->first_birth()));
    }
    EXPECT_EQ(storage_.writes, 10);
}

TEST_F(DurableGeneClockSourceTest, GoesOnAboveWhatItSentBefore) {
    Stamp sent;
    {
        const auto source = Source::restart(robot, storage_, genesis_marks, {.block = 10});
        mint(*source);
        ASSERT_TRUE(source->observe(Stamp{100}));
        mint(*source);
        sent = source->stamp_to_send(source->first_birth()).value();
        mint(*source);  // lost with the crash, and never sent
    }
    const auto source = Source::restart(robot, storage_, genesis_marks);
    EXPECT_GE(mint(*source).counter, sent.value);
}

TEST_F(DurableGeneClockSourceTest, HoldsAGenomeUntilItsNumberIsStored) {
    const auto source = Source::restart(robot, storage_, genesis_marks, {.block = 9});
    const std::uint32_t first = source->first_birth();
    EXPECT_EQ(first, genesis_marks + 1);
    storage_.works = false;
    EXPECT_EQ(source->stamp_to_send(first), std::nullopt) << "no gene was made, but a genome";
    storage_.works = true;
    for (std::uint32_t i = 0; i < 100; ++i) {
        ASSERT_TRUE(source->stamp_to_send(first + i));
        ASSERT_GT(storage_.stored(), first + i);
    }
    EXPECT_EQ(storage_.writes, 10) << "a block at a time";
    EXPECT_EQ(source->stamp(), Stamp{genesis_marks + 1}) << "the clock has not moved";
}

TEST_F(DurableGeneClockSourceTest, HoldsAGenomeThatNoCounterIsLeftFor) {
    const auto source =
        Source::restart(robot, storage_, genesis_marks, {.maximum = genesis_marks + 3});
    const std::uint32_t first = source->first_birth();
    EXPECT_TRUE(source->stamp_to_send(first + 1));
    EXPECT_EQ(source->stamp_to_send(first + 2), std::nullopt);
    EXPECT_EQ(source->storage_status().error, StorageError::bad_counter);
    EXPECT_TRUE(Source::restart(robot, storage_, genesis_marks, {.maximum = genesis_marks + 3}));
}

// docs/durability-and-hostile-peers.md has these figures.
TEST_F(DurableGeneClockSourceTest, CostsTheFleetACounterForEachGenomeAtMost) {
    constexpr std::uint64_t genomes = 5000;
    constexpr std::uint64_t block = 10;
    {
        const auto source = Source::restart(robot, storage_, genesis_marks, {.block = block});
        for (std::uint32_t i = 0; i < genomes; ++i) {
            ASSERT_TRUE(source->stamp_to_send(source->first_birth() + i));
        }
        EXPECT_EQ(source->stamp(), Stamp{genesis_marks + 1}) << "no gene was made";
    }
    const auto back = Source::restart(robot, storage_, genesis_marks, {.block = block});
    const Stamp stamp = back->stamp_to_send(back->first_birth()).value();
    EXPECT_GT(stamp.value, genesis_marks + genomes);
    EXPECT_LE(stamp.value, genesis_marks + 1 + genomes + 2 * block);

    const auto cycles_refused = [&](AdmissionGate::Policy policy) {
        GeneClock newcomer{RobotId{9}, genesis_marks};
        AdmissionGate gate{policy};
        int cycles = 0;
        for (; gate.admit(newcomer, stamp, std::vector<InnovationNumber>{}) != Admission::admitted;
             ++cycles) {
            gate.elapse();
        }
        return cycles;
    };
    EXPECT_EQ(cycles_refused({.allowance = 1000 + genomes + 2 * block, .per_cycle = 4}), 0);
    EXPECT_GE(cycles_refused({.allowance = 1000, .per_cycle = 4}), 1000) << "it counts genes alone";
}

TEST_F(DurableGeneClockSourceTest, NumbersGenomesModulo2To32) {
    storage_ = SwitchedStorage{(std::uint64_t{5} << 32) - 1};
    const auto source = Source::restart(robot, storage_, genesis_marks);
    EXPECT_EQ(source->first_birth(), UINT32_MAX);
    EXPECT_TRUE(source->stamp_to_send(2));  // the fourth of this life
    EXPECT_EQ(storage_.stored(), (std::uint64_t{5} << 32) + 3);
}

TEST_F(DurableGeneClockSourceTest, DoesNotStartFromWhatNoClockStored) {
    SwitchedStorage closed{0};
    EXPECT_EQ(Source::restart(robot, closed, genesis_marks), nullptr);
    SwitchedStorage high{101};
    EXPECT_EQ(Source::restart(robot, high, genesis_marks, {.maximum = 100}), nullptr);
    EXPECT_EQ(Source::restart(genesis_robot, storage_, genesis_marks), nullptr);
}

TEST_F(DurableGeneClockSourceTest, DoesNotStartAmongTheGenesisMarks) {
    SwitchedStorage for_fewer{genesis_marks};
    EXPECT_EQ(Source::restart(robot, for_fewer, genesis_marks), nullptr);
    EXPECT_TRUE(Source::restart(robot, storage_, genesis_marks));
}

// ---- In an agent ----

class DurableAgentTest : public DurableGeneClockSourceTest {
protected:
    Agent agent(AdmissionGate::Policy admission = {}) {
        auto source = Source::restart(robot, storage_, genesis_marks, {}, admission);
        source_ = source.get();
        return Agent(robot, settings_, make_initial_topology(2, 1), std::move(source),
                     RandomStream(1, 1));
    }
    OdneatSettings settings_;
    Source* source_ = nullptr;
};

TEST_F(DurableAgentTest, HoldsItsBroadcast) {
    Agent holding = agent();
    ASSERT_NE(holding.broadcast(), nullptr);
    storage_.works = false;
    // What it heard counts as well: its next genes lie above that.
    ASSERT_EQ(hear(holding, message({}, 200)), Reception::accepted);
    EXPECT_EQ(holding.broadcast(), nullptr);
    storage_.works = true;
    const Message* sent = holding.broadcast();
    ASSERT_NE(sent, nullptr);
    EXPECT_EQ(sent->stamp, Stamp{200});
    EXPECT_EQ(sent->genome.get(), &holding.active());
    EXPECT_GE(storage_.stored(), 200u);
}

TEST_F(DurableAgentTest, SendsNoGenomeIdInTwoLives) {
    // In some lives more genomes than genes are made, in others the clock runs ahead.
    RandomStream random(3, 0);
    std::set<GenomeId> sent;
    for (int life = 0; life < 40; ++life) {
        Agent living = agent();
        std::set<GenomeId> of_this_life;
        const std::uint32_t births = random.below(30);
        for (std::uint32_t i = 0; i <= births; ++i) {
            if (random.chance(0.1)) {
                ASSERT_NE(hear(living, message({}, living.source().stamp().value + 7)),
                          Reception::refused);
            }
            if (random.chance(0.7)) {
                ASSERT_NE(living.broadcast(), nullptr);
                of_this_life.insert(living.message().genome->id);
            }
            living.replace(0.0);
        }
        for (const GenomeId id : of_this_life) EXPECT_TRUE(sent.insert(id).second) << id.birth;
    }
    EXPECT_GT(sent.size(), 300u);
}

TEST_F(DurableAgentTest, ReportsAMarkOfItsOwnThatItNeverMade) {
    Agent wary = agent();
    const std::size_t members = wary.population().members().size();
    EXPECT_EQ(hear(wary, message({{150, robot}}, 200)), Reception::identity_conflict);
    EXPECT_EQ(source_->gate().conflicting_mark(), (InnovationNumber{150, robot}));
    EXPECT_EQ(wary.population().members().size(), members);
    EXPECT_EQ(source_->stamp(), Stamp{genesis_marks + 1});
}

TEST_F(DurableAgentTest, LooksAtTheMarksOfConnectionsToo) {
    Agent wary = agent();
    auto genome = perceptron(2, 1);
    add_hidden(genome, mark(150, 9));
    add_gene(genome, mark(151, 5), {genesis(1), mark(150, 9), false});
    EXPECT_EQ(hear(wary, message_of(genome, {}, 200)), Reception::identity_conflict);
    EXPECT_EQ(source_->gate().conflicting_mark(), (InnovationNumber{151, robot}));
}

TEST_F(DurableAgentTest, RefusesWhatTheGateRefusesAndLaterAdmitsIt) {
    Agent paced = agent({.allowance = 10, .per_cycle = 5});
    EXPECT_EQ(hear(paced, message({{30, RobotId{9}}}, 31)), Reception::refused);
    EXPECT_EQ(hear(paced, message({{31, RobotId{9}}}, 31)), Reception::refused);
    EXPECT_EQ(source_->gate().counts()[Admission::beyond_allowance], 1u);
    EXPECT_EQ(source_->gate().counts()[Admission::gene_not_covered], 1u);
    for (int cycle = 0; cycle < 3; ++cycle) source_->elapse();
    EXPECT_EQ(hear(paced, message({{30, RobotId{9}}}, 31)), Reception::accepted);
}

}  // namespace
}  // namespace gene_clocks::neat
