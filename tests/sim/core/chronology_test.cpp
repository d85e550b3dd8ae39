#include "sim/core/src/chronology/chronology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/visitors.hpp>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <gene_clocks/neat/message_codec.hpp>
#include <gene_clocks/sim/run_observer.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <map>
#include <optional>
#include <vector>

#include "tests/sim/core/naive_geometry.hpp"

namespace gene_clocks::sim {
namespace {

using neat::Birth;
using neat::Genome;
using neat::Topology;
using GenomePointer = std::shared_ptr<const Genome>;

/// Sequences of events by hand, among four robots with one input, the bias and one output.
class ChronologyTest : public testing::Test {
protected:
    static constexpr std::size_t robots = 4;

    GenomePointer genome(std::uint32_t robot, std::shared_ptr<const Topology> topology) {
        const std::vector<float> values(topology->connection_marks.size(), 1.0f);
        return std::make_shared<const Genome>(
            Genome{{RobotId{robot + 1}, ++births_}, std::move(topology), values, values});
    }
    static InnovationNumber mark(std::uint64_t counter, std::uint32_t robot) {
        return {counter, RobotId{robot + 1}};
    }
    /// The robot's offspring splits the connection of that index; its genes are marked `first` and
    /// what follows by `maker`.
    GenomePointer split(std::uint32_t robot, const GenomePointer& parent, std::size_t connection,
                        std::uint64_t first, std::uint32_t maker) {
        auto topology = std::make_shared<Topology>(*parent->topology);
        const neat::ConnectionEnds ends = topology->connection_ends[connection];
        const InnovationNumber neuron = mark(first, maker);
        topology->insert(neat::NeuronGene{neuron, neat::NeuronKind::hidden});
        topology->insert(mark(first + 1, maker), {ends.source, neuron, false});
        topology->insert(mark(first + 2, maker), {neuron, ends.target, false});
        return bear(robot, parent, std::move(topology));
    }
    /// The robot's offspring joins the output to itself, or the output to a neuron.
    GenomePointer join(std::uint32_t robot, const GenomePointer& parent, InnovationNumber gene,
                       InnovationNumber target) {
        auto topology = std::make_shared<Topology>(*parent->topology);
        topology->insert(gene, {output_, target, true});
        return bear(robot, parent, std::move(topology));
    }
    GenomePointer bear(std::uint32_t robot, const GenomePointer& parent,
                       std::shared_ptr<const Topology> topology) {
        const auto child = genome(robot, std::move(topology));
        Birth birth;
        birth.first_parent = parent;
        birth.inherited = parent->topology;
        chronology_->born(robot, birth, *child);
        return child;
    }
    void mate(std::uint32_t robot, const GenomePointer& first, const GenomePointer& second,
              std::shared_ptr<const Topology> inherited) {
        Birth birth;
        birth.mated = true;
        birth.first_parent = first;
        birth.second_parent = second;
        birth.inherited = inherited;
        chronology_->born(robot, birth, *genome(robot, std::move(inherited)));
    }
    void delay(std::int64_t cycles) { chronology_.emplace(robots, cycles, initial_); }
    ChronologyMeasures measures() const { return chronology_->measures(); }

    std::uint32_t births_ = 0;
    std::shared_ptr<const Topology> initial_ = neat::make_initial_topology(2, 1);
    InnovationNumber output_ = initial_->neurons[2].mark;
    std::optional<Chronology> chronology_{std::in_place, robots, 0, initial_};
    GenomePointer start_ = genome(0, initial_);
};

TEST_F(ChronologyTest, ComparesMarksWithCauseAndWithTime) {
    chronology_->begin_cycle(1);
    const auto first = join(0, start_, mark(10, 0), output_);
    chronology_->begin_cycle(2);
    chronology_->sent(0, 0, first, Stamp{});
    chronology_->admitted(1, 0);
    join(1, start_, mark(5, 1), output_);  // after the first by cause and time, before it by mark
    join(0, start_, mark(4, 0), output_);  // after its own first; concurrent with the second
    const ChronologyMeasures all = measures();
    EXPECT_EQ(all.genes, 3u);
    EXPECT_EQ(all.pairs, 3u);
    EXPECT_EQ(all.caused_pairs, 2u);
    EXPECT_EQ(all.timed_pairs, 2u);
    EXPECT_EQ(all.cause_inverted, 2u);
    EXPECT_EQ(all.time_inverted, 2u);
    ASSERT_EQ(chronology_->creations().size(), 3u);
    EXPECT_EQ(chronology_->creations()[1].mark, mark(5, 1));
    EXPECT_EQ(chronology_->creations()[1].robot, RobotId{2});
    EXPECT_EQ(chronology_->creations()[1].cycle, 2.0);
}

TEST_F(ChronologyTest, GenesOfOneSplitFollowOneAnother) {
    split(0, start_, 0, 10, 0);
    EXPECT_EQ(measures().genes, 3u);
    EXPECT_EQ(measures().caused_pairs, 3u);
    EXPECT_EQ(measures().timed_pairs, 3u);
    EXPECT_EQ(measures().time_inverted, 0u);
}

TEST_F(ChronologyTest, EqualCountersAreComparedByRobot) {
    chronology_->begin_cycle(1);
    join(1, start_, mark(10, 1), output_);
    chronology_->begin_cycle(2);
    join(0, start_, mark(10, 0), output_);
    chronology_->begin_cycle(3);
    join(2, start_, mark(10, 2), output_);
    EXPECT_EQ(measures().timed_pairs, 3u);
    EXPECT_EQ(measures().time_inverted, 1u);
}

TEST_F(ChronologyTest, NewsTravelsThroughOthers) {
    const auto gene = join(0, start_, mark(10, 0), output_);
    chronology_->sent(0, 0, gene, Stamp{});
    chronology_->admitted(1, 0);
    chronology_->sent(1, 1, genome(1, initial_), Stamp{});
    chronology_->admitted(2, 1);
    join(2, start_, mark(11, 2), output_);  // heard of the first
    join(3, start_, mark(12, 3), output_);  // heard of nothing
    EXPECT_EQ(measures().caused_pairs, 1u);
}

TEST_F(ChronologyTest, ADelayedMessageTellsWhatItsSenderKnewAtSending) {
    delay(2);
    chronology_->sent(0, 0, start_, Stamp{});
    chronology_->begin_cycle(1);
    join(0, start_, mark(10, 0), output_);
    chronology_->begin_cycle(2);
    chronology_->admitted(1, 0);
    join(1, start_, mark(11, 1), output_);
    EXPECT_EQ(measures().caused_pairs, 0u);
    chronology_->sent(0, 1, start_, Stamp{});
    chronology_->begin_cycle(4);
    chronology_->admitted(1, 1);
    join(1, start_, mark(12, 1), output_);
    EXPECT_EQ(measures().caused_pairs, 2u);
}

TEST(CausalPast, AMessageTellsNothingOfWhatItsSenderCreatesLater) {
    CausalPast past(2, 0);
    past.sent(0, 0, 0);
    past.admitted(1, 0);
    past.created(0);
    EXPECT_EQ(past.known(1)[0], 0);
    past.sent(0, 1, 0);
    past.admitted(1, 1);
    EXPECT_EQ(past.known(1)[0], 1);
}

TEST_F(ChronologyTest, CollisionsAreOfTheSameInnovationOrOfDifferentOnes) {
    split(0, start_, 0, 10, 9);
    EXPECT_EQ(measures().same_collisions + measures().different_collisions, 0u);
    split(1, start_, 0, 10, 9);  // the same
    EXPECT_EQ(measures().same_collisions, 3u);
    EXPECT_EQ(measures().different_collisions, 0u);
    split(2, start_, 1, 10, 9);  // another connection
    EXPECT_EQ(measures().same_collisions, 3u);
    EXPECT_EQ(measures().different_collisions, 3u);
    split(3, start_, 0, 10, 9);  // like the first, but not like the third
    EXPECT_EQ(measures().same_collisions, 3u);
    EXPECT_EQ(measures().different_collisions, 6u);
}

TEST_F(ChronologyTest, SplittingAConnectionAgainIsAnotherInnovation) {
    const auto once = split(0, start_, 0, 10, 0);
    const auto twice = split(0, once, 0, 20, 0);
    mate(1, once, twice, twice->topology);
    EXPECT_EQ(measures().crossovers, 1u);
    EXPECT_EQ(measures().crossovers_missed, 0u);
    EXPECT_EQ(measures().crossovers_repeated, 0u);
}

TEST_F(ChronologyTest, AlignmentsMissHomologyOrSeeItWhereThereIsNone) {
    const auto one = split(0, start_, 0, 10, 0);
    const auto same_elsewhere = split(1, start_, 0, 20, 1);
    const auto other_alike = split(2, start_, 1, 10, 0);
    chronology_->accepted(*one, *same_elsewhere);
    EXPECT_EQ(measures().alignments, 1u);
    EXPECT_EQ(measures().matching, 2u);
    EXPECT_EQ(measures().disjoint, 2u);
    EXPECT_EQ(measures().excess, 2u);
    EXPECT_EQ(measures().missed_homologies, 2u);
    EXPECT_EQ(measures().false_homologies, 0u);
    chronology_->accepted(*one, *other_alike);
    EXPECT_EQ(measures().alignments, 2u);
    EXPECT_EQ(measures().matching, 6u);
    EXPECT_EQ(measures().missed_homologies, 2u);
    EXPECT_EQ(measures().false_homologies, 2u);
    chronology_->accepted(*one, *one);
    EXPECT_EQ(measures().matching, 10u);
}

TEST_F(ChronologyTest, CrossoversMissHomologyAndRepeatStructure) {
    const auto one = split(0, start_, 0, 10, 0);
    const auto same_elsewhere = split(1, start_, 0, 20, 1);
    const auto other_alike = split(2, start_, 1, 10, 0);
    mate(0, one, same_elsewhere, one->topology);
    EXPECT_EQ(measures().crossovers, 1u);
    EXPECT_EQ(measures().crossovers_missed, 1u);
    EXPECT_EQ(measures().crossovers_false, 0u);
    EXPECT_EQ(measures().crossovers_repeated, 0u);
    // A child with all genes of both.
    auto both = std::make_shared<Topology>(*one->topology);
    both->insert(same_elsewhere->topology->neurons.back());
    for (const std::size_t i : {2u, 3u}) {
        both->insert(same_elsewhere->topology->connection_marks[i],
                     same_elsewhere->topology->connection_ends[i]);
    }
    mate(0, one, same_elsewhere, both);
    EXPECT_EQ(measures().crossovers_repeated, 1u);
    mate(0, one, other_alike, one->topology);
    EXPECT_EQ(measures().crossovers, 3u);
    EXPECT_EQ(measures().crossovers_missed, 2u);
    EXPECT_EQ(measures().crossovers_false, 1u);
    EXPECT_EQ(measures().genes, 9u);  // crossover creates none
}

TEST_F(ChronologyTest, FinalGenomesAreComparedWithTheOrderOfCreation) {
    chronology_->begin_cycle(1);
    const auto parent = join(0, start_, mark(50, 0), output_);
    chronology_->begin_cycle(2);
    const auto child = split(1, parent, 0, 10, 1);  // connections 11 and 12, before the parent's 50
    chronology_->ended(*child, Stamp{7});
    EXPECT_EQ(measures().genome_pairs, 3u);
    EXPECT_EQ(measures().genome_inverted, 2u);
    chronology_->ended(*parent, Stamp{10});
    EXPECT_EQ(measures().genome_pairs, 3u);
    EXPECT_EQ(measures().stamp_smallest, 7u);
    EXPECT_EQ(measures().stamp_mean, 8.5);
    EXPECT_EQ(measures().stamp_largest, 10u);
}

TEST_F(ChronologyTest, BytesAreThoseOfTheWireFormat) {
    neat::OdneatSettings settings;
    settings.p_node = 0.5;
    neat::MessageCodec codec(initial_, neat::wire_limits(*initial_, settings));
    neat::GeneClockSource clock(RobotId{1}, initial_->size());
    neat::RandomStream random(1, 1);
    GenomePointer active = start_;
    std::uint64_t bytes = 0;
    std::uint64_t stamps = 0;
    for (std::uint64_t message = 0; message < 300; ++message) {
        Genome mutant = *active;
        mutant.id.birth = static_cast<std::uint32_t>(7 * message);
        neat::mutate(mutant, settings, clock, 0.0, random);
        const auto child = std::make_shared<const Genome>(std::move(mutant));
        Birth birth;
        birth.first_parent = active;
        birth.inherited = active->topology;
        chronology_->born(0, birth, *child);
        active = child;
        chronology_->sent(0, message, active, clock.stamp());
        bytes += codec.encode(RobotId{1}, {active, 50.0f, clock.stamp()})->size();
        stamps += clock.stamp().value < 128 ? 1u : 2u;
        ASSERT_EQ(measures().bytes_sent, bytes);
        ASSERT_EQ(measures().stamp_bytes, stamps);
    }
    EXPECT_GT(clock.stamp().value, 130u);  // both sizes came
    chronology_->sent(0, 300, active, Stamp{});
    EXPECT_EQ(measures().stamp_bytes, stamps);
}

TEST_F(ChronologyTest, BytesDoNotDependOnWhetherANeuronComesBeforeItsConnections) {
    const auto in_order = split(0, start_, 0, 10, 0);
    auto topology = std::make_shared<Topology>(*initial_);
    const neat::ConnectionEnds ends = topology->connection_ends[0];
    topology->insert(neat::NeuronGene{mark(12, 0), neat::NeuronKind::hidden});
    topology->insert(mark(10, 0), {ends.source, mark(12, 0), false});
    topology->insert(mark(11, 0), {mark(12, 0), ends.target, false});
    EXPECT_EQ(neat::payload_bytes(*genome(0, topology)), neat::payload_bytes(*in_order));
}

/// Draws all events of a run as a graph, in which an edge is one robot's next event or a message.
class EventGraph final : public RunObserver {
public:
    using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;

    void gene_marked(RobotId robot, InnovationNumber mark, double now_cycles) override {
        genes_.push_back({add_event(robot), robot, mark, now_cycles});
    }
    void message_sent(RobotId robot, Stamp, InnovationNumber) override {
        sendings_.push_back(add_event(robot));
    }
    void message_admitted(RobotId robot, std::uint64_t message, Stamp) override {
        boost::add_edge(sendings_.at(message), add_event(robot), graph_);
    }

    /// Each gene with each later one; causes by search.
    ChronologyMeasures count() const {
        ChronologyMeasures found;
        found.genes = genes_.size();
        std::map<InnovationNumber, int> namesakes;
        for (std::size_t i = 0; i < genes_.size(); ++i) {
            const auto reached = reachable(genes_[i].event);
            if (namesakes[genes_[i].mark]++ > 0) ++found.same_collisions;  // or different
            for (std::size_t j = i + 1; j < genes_.size(); ++j) {
                const Gene &one = genes_[i], &other = genes_[j];
                const bool is_inverted = other.mark < one.mark;
                ++found.pairs;
                if (one.cycle != other.cycle || one.robot == other.robot) {
                    ++found.timed_pairs;
                    found.time_inverted += is_inverted;
                }
                if (reached[other.event]) {
                    ++found.caused_pairs;
                    found.cause_inverted += is_inverted;
                }
            }
        }
        return found;
    }

private:
    struct Gene {
        std::size_t event;
        RobotId robot;
        InnovationNumber mark;
        double cycle;
    };
    std::size_t add_event(RobotId robot) {
        const std::size_t event = boost::add_vertex(graph_);
        const auto [last, is_first] = last_.try_emplace(robot, event);
        if (!is_first) boost::add_edge(std::exchange(last->second, event), event, graph_);
        return event;
    }
    std::vector<bool> reachable(std::size_t event) const {
        std::vector<boost::default_color_type> colours(boost::num_vertices(graph_));
        boost::breadth_first_search(graph_, event,
                                    boost::color_map(boost::make_iterator_property_map(
                                        colours.begin(), boost::get(boost::vertex_index, graph_))));
        std::vector<bool> reached(colours.size());
        std::transform(colours.begin(), colours.end(), reached.begin(),
                       [](auto colour) { return colour == boost::black_color; });
        return reached;
    }

    Graph graph_;
    std::vector<Gene> genes_;
    std::vector<std::size_t> sendings_;  // by number of message
    std::map<RobotId, std::size_t> last_;
};

/// Real runs: short ones, with much structure and many crossovers.
class ChronologyOfRunsTest : public testing::Test {
protected:
    ChronologyOfRunsTest() {
        settings_.world.robots = 20;
        settings_.run.cycles = 20'000;
        settings_.odneat.p_mate = 0.8;
        settings_.odneat.p_node = 0.3;
        settings_.odneat.p_connection = 0.4;
        settings_.odneat.species_threshold = 20.0;
    }
    ChronologyMeasures run(Source source) {
        settings_.source = source;
        const RunResult result = simulate(settings_, naive::arena(), 1).value();
        EXPECT_EQ(result.chronology.genes, result.counters.genes_created);
        EXPECT_EQ(result.chronology.alignments, result.counters.genomes_accepted);
        EXPECT_EQ(result.chronology.crossovers, result.counters.matings);
        EXPECT_GT(result.chronology.genes, 60u);
        EXPECT_GT(result.chronology.crossovers, 10u);
        EXPECT_GT(result.chronology.caused_pairs, 1000u);
        EXPECT_LT(result.chronology.caused_pairs, result.chronology.pairs);
        return result.chronology;
    }
    Settings settings_;
};

TEST_F(ChronologyOfRunsTest, CountsAgreeWithSearchesInTheGraphOfAllEvents) {
    settings_.world.robots = 12;
    settings_.run.cycles = 1000;
    settings_.radio.loss = 0.4;
    for (const std::int64_t delay : {0, 3}) {
        settings_.radio.delay_cycles = delay;
        for (const SourceDisplay& display : sources) {
            const Source source = display.source;
            settings_.source = source;
            EventGraph graph;
            const ChronologyMeasures all =
                simulate_observed(settings_, naive::arena(), 2, graph)->chronology;
            const ChronologyMeasures expected = graph.count();
            SCOPED_TRACE(testing::Message() << "source " << static_cast<int>(source) << ", delay "
                                            << delay << ", " << all.genes << " genes");
            EXPECT_GT(all.genes, 20u);
            EXPECT_EQ(all.genes, expected.genes);
            EXPECT_EQ(all.pairs, expected.pairs);
            EXPECT_EQ(all.timed_pairs, expected.timed_pairs);
            EXPECT_EQ(all.time_inverted, expected.time_inverted);
            EXPECT_GT(all.caused_pairs, 0u);
            EXPECT_EQ(all.caused_pairs, expected.caused_pairs);
            EXPECT_EQ(all.cause_inverted, expected.cause_inverted);
            EXPECT_EQ(all.same_collisions + all.different_collisions, expected.same_collisions);
        }
    }
}

TEST_F(ChronologyOfRunsTest, LogicalClocksNeverInvertCauseAndNeverCollide) {
    for (const Source source : {Source::gene_clock, Source::hybrid_logical_clock}) {
        const ChronologyMeasures all = run(source);
        EXPECT_EQ(all.cause_inverted, 0u);
        EXPECT_EQ(all.genome_inverted, 0u);
        EXPECT_EQ(all.same_collisions + all.different_collisions, 0u);
        EXPECT_EQ(all.false_homologies, 0u);
        EXPECT_EQ(all.crossovers_false, 0u);
        EXPECT_GT(all.missed_homologies, 0u);
        EXPECT_GT(all.stamp_smallest, 0u);
        EXPECT_LE(static_cast<double>(all.stamp_smallest), all.stamp_mean);
        EXPECT_LE(all.stamp_mean, static_cast<double>(all.stamp_largest));
        EXPECT_GT(all.stamp_bytes, 0u);
    }
}

TEST_F(ChronologyOfRunsTest, GeneClocksInvertTimeOnlyBetweenStrangers) {
    EXPECT_GT(run(Source::gene_clock).time_inverted, 0u);
}

TEST_F(ChronologyOfRunsTest, ClocksThatDoNotHearInvertCause) {
    for (const Source source :
         {Source::gene_clock_no_merge, Source::congruence_class, Source::timestamp_drift}) {
        const ChronologyMeasures all = run(source);
        EXPECT_GT(all.cause_inverted, 0u);
        EXPECT_GT(all.time_inverted, 0u);
        EXPECT_EQ(all.same_collisions + all.different_collisions, 0u);
        EXPECT_EQ(all.stamp_bytes, 0u);
    }
}

TEST_F(ChronologyOfRunsTest, PerfectTimestampsNeverInvertTime) {
    const ChronologyMeasures all = run(Source::timestamp);
    EXPECT_GT(all.timed_pairs, 1000u);
    EXPECT_EQ(all.time_inverted, 0u);
    EXPECT_EQ(all.cause_inverted, 0u);
    EXPECT_EQ(all.genome_inverted, 0u);
}

TEST_F(ChronologyOfRunsTest, MarksOfWhatIsTheSameInnovationAreNeverMistaken) {
    for (const Source source : {Source::global_counter, Source::content_hash}) {
        const ChronologyMeasures all = run(source);
        EXPECT_GT(all.same_collisions, 0u);
        EXPECT_EQ(all.different_collisions, 0u);
        EXPECT_EQ(all.missed_homologies, 0u);
        EXPECT_EQ(all.false_homologies, 0u);
        EXPECT_EQ(all.crossovers_missed, 0u);
        EXPECT_EQ(all.crossovers_false, 0u);
        EXPECT_EQ(all.crossovers_repeated, 0u);
    }
}

TEST_F(ChronologyOfRunsTest, RandomIdentifiersNameDifferentInnovationsAlike) {
    const ChronologyMeasures all = run(Source::random_identifier);
    EXPECT_GT(all.different_collisions, 0u);
    EXPECT_GT(all.time_inverted, 0u);
}

}  // namespace
}  // namespace gene_clocks::sim
