#include "sim/replay/genealogy.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/sim/replay/sample_run.hpp"

namespace gene_clocks::replay {
namespace {

class GenealogyTest : public testing::Test {
protected:
    SampleRun run_{sample_settings()};
    const GeneHistory& history_ = run_.recorder.genes();
    const std::vector<FinalGene> genealogy_ = genealogy(history_);

    const Gene& gene(const FinalGene& final_gene) const {
        return history_.genes()[final_gene.gene];
    }
};

TEST_F(GenealogyTest, HasTheGenesOfTheFinalSwarmWithTheirCarriers) {
    std::map<InnovationNumber, std::uint32_t> expected;
    for (const neat::Genome& genome : run_.end().genomes) {
        for (const InnovationNumber mark : new_marks(genome)) ++expected[mark];
    }
    std::map<InnovationNumber, std::uint32_t> carriers;
    for (const FinalGene& final_gene : genealogy_) {
        carriers[gene(final_gene).mark] = final_gene.carriers;
    }
    EXPECT_EQ(carriers, expected);
    EXPECT_GT(carriers.size(), 10u);
    EXPECT_EQ(carriers.size(), genealogy_.size());
}

TEST_F(GenealogyTest, MostCarriedComeFirstEqualsByTheirMarks) {
    std::size_t equals = 0;
    for (std::size_t i = 1; i < genealogy_.size(); ++i) {
        EXPECT_GE(genealogy_[i - 1].carriers, genealogy_[i].carriers);
        if (genealogy_[i - 1].carriers != genealogy_[i].carriers) continue;
        EXPECT_LT(gene(genealogy_[i - 1]).mark, gene(genealogy_[i]).mark);
        ++equals;
    }
    EXPECT_GT(equals, 0u);
    EXPECT_GT(genealogy_.front().carriers, genealogy_.back().carriers);
}

/// What `follows` must be, from the genomes as they were; returns how many genes of the final swarm
/// follow one, and how many came after a gene of their genome that was lost later.
std::pair<std::size_t, std::size_t> check_followers(const SampleRun& run) {
    const GeneHistory& history = run.recorder.genes();
    const std::vector<FinalGene> rows = genealogy(history);
    std::map<InnovationNumber, double> created;
    for (const Marking& marking : run.witness.markings)
        created.emplace(marking.mark, marking.cycle);
    std::set<InnovationNumber> lasted;
    for (const FinalGene& row : rows) lasted.insert(history.genes()[row.gene].mark);
    std::size_t followers = 0, after_lost = 0;
    for (const FinalGene& row : rows) {
        const Gene& subject = history.genes()[row.gene];
        const Snapshot& birth =
            run.witness.snapshots.at(static_cast<std::size_t>(subject.created_cycle) + 1);
        double youngest = -1.0, youngest_lost = -1.0;
        for (const InnovationNumber mark :
             new_marks(birth.genomes[static_cast<std::size_t>(subject.genome.robot) - 1])) {
            if (created.at(mark) >= subject.created_cycle) continue;
            double& latest = lasted.contains(mark) ? youngest : youngest_lost;
            latest = std::max(latest, created.at(mark));
        }
        after_lost += youngest_lost > youngest;
        EXPECT_EQ(row.follows.has_value(), youngest >= 0.0);
        if (!row.follows) continue;
        EXPECT_EQ(history.genes()[*row.follows].created_cycle, youngest);
        EXPECT_TRUE(lasted.contains(history.genes()[*row.follows].mark));
        ++followers;
    }
    return {followers, after_lost};
}

TEST_F(GenealogyTest, AGeneFollowsTheYoungestOfItsGenomeThatHasLasted) {
    const auto [followers, after_lost] = check_followers(run_);
    EXPECT_GT(followers, 3u);
    // A crossover that keeps one parent's genes loses none without those that came after it.
    EXPECT_EQ(after_lost, 0u);
}

TEST_F(GenealogyTest, TheTableHasARowForEachGene) {
    std::ostringstream out;
    write_genealogy_csv(history_, out);
    std::istringstream lines(out.str());
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line,
              "mark,counter,robot,kind,created_cycle,created_by,birth,times_marked,builds_upon,"
              "follows,carriers,share");
    for (const FinalGene& final_gene : genealogy_) {
        ASSERT_TRUE(std::getline(lines, line));
        std::vector<std::string> cells(1);
        for (const char character : line) {
            if (character == ',') {
                cells.emplace_back();
            } else {
                cells.back() += character;
            }
        }
        ASSERT_EQ(cells.size(), 12u);
        const Gene& subject = gene(final_gene);
        EXPECT_EQ(cells[0], cells[1] + "@" + cells[2]);
        EXPECT_EQ(std::stoull(cells[1]), subject.mark.counter);
        EXPECT_EQ(std::stoul(cells[2]), static_cast<std::uint32_t>(subject.mark.robot));
        EXPECT_EQ(cells[3] == "neuron", subject.kind == GeneKind::neuron);
        EXPECT_EQ(std::stod(cells[4]), subject.created_cycle);
        EXPECT_EQ(std::stoul(cells[5]), static_cast<std::uint32_t>(subject.genome.robot));
        EXPECT_EQ(std::stoul(cells[6]), subject.genome.birth);
        EXPECT_EQ(cells[7], "1");
        EXPECT_EQ(std::ranges::count(cells[8], '@'), static_cast<long>(subject.builds_upon.size()));
        EXPECT_EQ(cells[9].empty(), !final_gene.follows);
        EXPECT_EQ(std::stoul(cells[10]), final_gene.carriers);
        EXPECT_DOUBLE_EQ(std::stod(cells[11]), final_gene.carriers / 12.0);
    }
    EXPECT_FALSE(std::getline(lines, line));
}

TEST(Genealogy, MarksWithoutARobotLeaveItsCellEmpty) {
    const SampleRun run(sample_settings(sim::Task::collection, sim::Source::content_hash));
    std::ostringstream out;
    write_genealogy_csv(run.recorder.genes(), out);
    std::istringstream lines(out.str());
    std::string line;
    std::getline(lines, line);
    ASSERT_TRUE(std::getline(lines, line));
    const std::string counter = line.substr(0, line.find('@'));
    EXPECT_TRUE(line.starts_with(counter + "@," + counter + ",,")) << line;
}

}  // namespace
}  // namespace gene_clocks::replay
