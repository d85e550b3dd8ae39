#include "sim/replay/gene_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim/replay/sample_run.hpp"

namespace gene_clocks::replay {
namespace {

using sim::Source;
using sim::Task;

class GeneHistoryTest : public testing::TestWithParam<Source> {
protected:
    SampleRun run_{sample_settings(Task::collection, GetParam())};
    const GeneHistory& history_ = run_.recorder.genes();

    std::set<InnovationNumber> marks_of_set(std::size_t set) const {
        std::set<InnovationNumber> marks;
        for (const GeneNumber gene : history_.gene_sets()[set]) {
            marks.insert(history_.genes()[gene].mark);
        }
        return marks;
    }
};

TEST_P(GeneHistoryTest, ActivationsTellEachRobotsGenesInEveryCycle) {
    std::vector<std::size_t> active(12, 0);
    std::size_t next = 0;
    std::size_t genes = 0;
    for (std::size_t cycle = 0; cycle < run_.witness.snapshots.size(); ++cycle) {
        const auto& activations = history_.activations();
        for (; next < activations.size() &&
               activations[next].cycle == static_cast<std::int64_t>(cycle);
             ++next) {
            active.at(activations[next].robot) = activations[next].gene_set;
        }
        for (std::size_t i = 0; i < active.size(); ++i) {
            const auto expected = new_marks(run_.witness.snapshots[cycle].genomes[i]);
            ASSERT_EQ(marks_of_set(active[i]), expected) << "cycle " << cycle << ", robot " << i;
            genes = std::max(genes, expected.size());
        }
    }
    EXPECT_EQ(next, history_.activations().size());
    EXPECT_EQ(active, history_.active());
    EXPECT_GT(genes, 3u);
    // Each robot's first genome, and one for each birth.
    EXPECT_EQ(history_.activations().size(), 12 + run_.result.counters.births);
}

TEST_P(GeneHistoryTest, EveryMarkIsThereWithItsFirstCreation) {
    std::map<InnovationNumber, std::pair<Marking, std::uint32_t>> expected;
    for (const Marking& marking : run_.witness.markings) {
        ++expected.try_emplace(marking.mark, marking, 0u).first->second.second;
    }
    const auto& genes = history_.genes();
    ASSERT_EQ(genes.size(), history_.genesis_genes() + expected.size());
    EXPECT_GT(expected.size(), 40u);
    for (std::size_t i = history_.genesis_genes(); i < genes.size(); ++i) {
        const auto& [first, times] = expected.at(genes[i].mark);
        EXPECT_EQ(genes[i].created_cycle, first.cycle);
        EXPECT_EQ(genes[i].genome.robot, first.robot);
        EXPECT_EQ(genes[i].times_marked, times);
    }
}

TEST_P(GeneHistoryTest, GenesAreOfTheGenomeThatTheyWereCreatedIn) {
    const auto& genes = history_.genes();
    for (std::size_t i = history_.genesis_genes(); i < genes.size(); ++i) {
        const Gene& gene = genes[i];
        // Created in that cycle, it is there before the next one.
        const Snapshot& then =
            run_.witness.snapshots.at(static_cast<std::size_t>(gene.created_cycle) + 1);
        const neat::Genome& genome =
            then.genomes.at(static_cast<std::size_t>(gene.genome.robot) - 1);
        EXPECT_EQ(genome.id, gene.genome);
        EXPECT_EQ(marks_of_set(gene.gene_set), new_marks(genome));

        const auto& connections = genome.topology->connection_marks;
        const auto place = std::ranges::find(connections, gene.mark);
        if (gene.kind == GeneKind::neuron) {
            EXPECT_TRUE(genome.topology->find_neuron(gene.mark));
            // What it splits joins its two neighbours, and is disabled.
            ASSERT_EQ(gene.builds_upon.size(), 1u);
            const auto split = static_cast<std::size_t>(
                std::ranges::find(connections, genes[gene.builds_upon[0]].mark) -
                connections.begin());
            ASSERT_LT(split, connections.size());
            EXPECT_FALSE(genome.is_enabled(split));
            const auto& ends = genome.topology->connection_ends;
            EXPECT_TRUE(std::ranges::any_of(ends, [&](const auto& in) {
                return in.target == gene.mark && in.source == ends[split].source;
            }));
            EXPECT_TRUE(std::ranges::any_of(ends, [&](const auto& out) {
                return out.source == gene.mark && out.target == ends[split].target;
            }));
        } else {
            ASSERT_NE(place, connections.end());
            const auto& ends =
                genome.topology
                    ->connection_ends[static_cast<std::size_t>(place - connections.begin())];
            ASSERT_EQ(gene.builds_upon.size(), 2u);
            EXPECT_EQ(genes[gene.builds_upon[0]].mark, ends.source);
            EXPECT_EQ(genes[gene.builds_upon[1]].mark, ends.target);
            EXPECT_EQ(gene.kind == GeneKind::recurrent_connection, ends.recurrent);
        }
    }
}

// Random identifiers are given twice by chance, content hashes on purpose.
INSTANTIATE_TEST_SUITE_P(Sources, GeneHistoryTest,
                         testing::Values(Source::gene_clock, Source::random_identifier,
                                         Source::content_hash, Source::timestamp));

TEST(GeneHistory, GenesisGenesComeFirst) {
    const SampleRun run(sample_settings());
    const GeneHistory& history = run.recorder.genes();
    ASSERT_EQ(history.genesis_genes(), sim::genesis_count(run.settings));
    for (std::size_t i = 0; i < history.genesis_genes(); ++i) {
        EXPECT_EQ(history.genes()[i].mark, (InnovationNumber{i + 1, genesis_robot}));
    }
    // 18 inputs and 2 outputs: the first connection joins the first input and the first output.
    EXPECT_EQ(history.genes()[20].builds_upon, (std::vector<GeneNumber>{0, 18}));
    EXPECT_TRUE(history.gene_sets().at(0).empty());
}

// A robot that reboots right after a birth loses what it has just marked; one that loses its
// counter, too, gives such a mark again.
TEST(GeneHistory, RebootsLoseGenesThatNobodyCarried) {
    for (const auto clock : {sim::RebootClock::kept, sim::RebootClock::lost}) {
        sim::Settings settings = sample_settings();
        settings.reboot.probability = 0.01;
        settings.reboot.clock = clock;
        settings.odneat.maturation_cycles = 5;
        settings.energy.decay = 4.0;
        const SampleRun run(settings);
        const GeneHistory& history = run.recorder.genes();
        std::set<InnovationNumber> carried;
        for (const Snapshot& then : run.witness.snapshots) {
            for (const neat::Genome& genome : then.genomes) carried.merge(new_marks(genome));
        }
        std::size_t lost = 0;
        for (std::size_t i = history.genesis_genes(); i < history.genes().size(); ++i) {
            const Gene& gene = history.genes()[i];
            EXPECT_EQ(gene.was_active, carried.contains(gene.mark));
            EXPECT_EQ(gene.was_active, !gene.builds_upon.empty());
            lost += !gene.was_active;
        }
        EXPECT_GT(carried.size(), 20u);
        EXPECT_GT(lost, 0u);
        for (std::size_t i = 0; i < 12; ++i) {
            std::set<InnovationNumber> active;
            for (const GeneNumber gene : history.gene_sets()[history.active()[i]]) {
                active.insert(history.genes()[gene].mark);
            }
            EXPECT_EQ(active, new_marks(run.end().genomes[i]));
        }
    }
}

TEST(GeneHistory, MarksGivenTwiceAreSeen) {
    const SampleRun run(sample_settings(Task::collection, Source::random_identifier));
    EXPECT_TRUE(std::ranges::any_of(run.recorder.genes().genes(),
                                    [](const Gene& gene) { return gene.times_marked > 1; }));
    const SampleRun clocks(sample_settings());
    EXPECT_TRUE(std::ranges::all_of(clocks.recorder.genes().genes(),
                                    [](const Gene& gene) { return gene.times_marked == 1; }));
}

}  // namespace
}  // namespace gene_clocks::replay
