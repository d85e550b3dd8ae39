// Robots that mutate, gossip over graphs that change, crash and come back, over a network that
// loses, repeats and reorders: an observer's checks hold for every run, and fail for every swarm
// that breaks a rule.
#include <gtest/gtest.h>
#include <rapidcheck/state.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <gene_clocks/align.hpp>
#include <iostream>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/faulty_swarm.hpp"
#include "tests/support/history.hpp"
#include "tests/support/property.hpp"

namespace gene_clocks {
namespace {

using test::FaultySwarm;
using test::Slip;
using test::Topology;

/// What a command has to know to make sense.
struct Model {
    std::vector<bool> is_up;
    [[nodiscard]] std::size_t size() const { return is_up.size(); }
};

struct Command : rc::state::Command<Model, FaultySwarm> {};

struct AtARobot : Command {
    std::size_t robot;
    explicit AtARobot(const Model& model)
        : robot{*rc::gen::inRange<std::size_t>(0, model.size())} {}
    void checkPreconditions(const Model& model) const override { RC_PRE(model.is_up[robot]); }
};

struct Mutate : AtARobot {
    std::uint64_t genes = *rc::gen::element<std::uint64_t>(1, 3);  // add-connection, add-neuron
    using AtARobot::AtARobot;
    void run(const Model&, FaultySwarm& swarm) const override { swarm.mutate(robot, genes); }
    void show(std::ostream& out) const override {
        out << "robot " << robot + 1 << " creates " << genes << " gene(s)";
    }
};

struct Send : AtARobot {
    using AtARobot::AtARobot;
    void run(const Model&, FaultySwarm& swarm) const override { swarm.send(robot); }
    void show(std::ostream& out) const override { out << "robot " << robot + 1 << " broadcasts"; }
};

struct Flush : AtARobot {
    using AtARobot::AtARobot;
    void run(const Model&, FaultySwarm& swarm) const override { swarm.flush(robot); }
    void show(std::ostream& out) const override { out << "robot " << robot + 1 << " stores"; }
};

struct Forge : AtARobot {
    std::uint64_t leap = *rc::gen::inRange<std::uint64_t>(0, 200);
    using AtARobot::AtARobot;
    void run(const Model&, FaultySwarm& swarm) const override { swarm.forge(robot, leap); }
    void show(std::ostream& out) const override {
        out << "robot " << robot + 1 << " hears a forged stamp " << leap << " ahead";
    }
};

struct Crash : AtARobot {
    using AtARobot::AtARobot;
    void apply(Model& model) const override { model.is_up[robot] = false; }
    void run(const Model&, FaultySwarm& swarm) const override { swarm.crash(robot); }
    void show(std::ostream& out) const override { out << "robot " << robot + 1 << " crashes"; }
};

struct Restart : AtARobot {
    using AtARobot::AtARobot;
    void checkPreconditions(const Model& model) const override { RC_PRE(!model.is_up[robot]); }
    void apply(Model& model) const override { model.is_up[robot] = true; }
    void run(const Model&, FaultySwarm& swarm) const override { swarm.restart(robot); }
    void show(std::ostream& out) const override { out << "robot " << robot + 1 << " restarts"; }
};

/// Everyone who is up creates a gene and broadcasts, and all of it arrives.
struct Exchange : Command {
    void run(const Model& model, FaultySwarm& swarm) const override {
        for (std::size_t r = 0; r < model.size(); ++r) {
            if (model.is_up[r] && r % 3 == 0) swarm.mutate(r, 1);
            if (model.is_up[r]) swarm.send(r);
        }
        swarm.deliver(everything);
    }
    void show(std::ostream& out) const override { out << "all broadcast, every third a new gene"; }
    static constexpr std::size_t everything = 1'000'000;
};

struct Deliver : Command {
    std::size_t count = *rc::gen::inRange<std::size_t>(1, 20);
    void run(const Model&, FaultySwarm& swarm) const override { swarm.deliver(count); }
    void show(std::ostream& out) const override { out << count << " message(s) arrive"; }
};

struct Drop : Command {
    std::size_t pick = *rc::gen::arbitrary<std::size_t>();
    void run(const Model&, FaultySwarm& swarm) const override { swarm.drop(pick); }
    void show(std::ostream& out) const override { out << "message " << pick << " is lost"; }
};

struct Duplicate : Command {
    std::size_t pick = *rc::gen::arbitrary<std::size_t>();
    void run(const Model&, FaultySwarm& swarm) const override { swarm.duplicate(pick); }
    void show(std::ostream& out) const override { out << "message " << pick << " is doubled"; }
};

struct Reorder : Command {
    std::uint32_t seed = *rc::gen::arbitrary<std::uint32_t>();
    void run(const Model&, FaultySwarm& swarm) const override { swarm.reorder(seed); }
    void show(std::ostream& out) const override { out << "messages are shuffled, seed " << seed; }
};

struct Rewire : Command {
    Topology topology = *test::topologies();
    std::uint32_t seed = *rc::gen::arbitrary<std::uint32_t>();
    void run(const Model&, FaultySwarm& swarm) const override { swarm.rewire(topology, seed); }
    void show(std::ostream& out) const override {
        out << "the graph becomes " << topology << ", seed " << seed;
    }
};

struct Partition : Command {
    std::uint32_t seed = *rc::gen::arbitrary<std::uint32_t>();
    void run(const Model&, FaultySwarm& swarm) const override { swarm.partition(seed); }
    void show(std::ostream& out) const override { out << "the swarm splits, seed " << seed; }
};

struct Heal : Command {
    void run(const Model&, FaultySwarm& swarm) const override { swarm.heal(); }
    void show(std::ostream& out) const override { out << "the swarm is one again"; }
};

/// "all robots sort genes in the exact same manner" (paper, section 3.1): whatever two robots
/// share, each sorts its own way of arrival into the same sequence. And alignment, which knows
/// marks alone, finds exactly the genes that have a common origin.
void assert_robots_agree(const FaultySwarm& swarm, std::size_t a, std::size_t b) {
    const auto sorted = [&](std::size_t robot) {
        auto genes = swarm.genes(robot);
        std::ranges::sort(genes, {}, &FaultySwarm::Gene::mark);
        return genes;
    };
    const auto ours = sorted(a);
    const auto theirs = sorted(b);
    const auto origins_shared = [](const auto& genes, const auto& others) {
        std::set<std::size_t> known;
        for (const auto& gene : others) known.insert(gene.origin);
        std::vector<std::size_t> shared;
        for (const auto& gene : genes) {
            if (known.contains(gene.origin)) shared.push_back(gene.origin);
        }
        return shared;
    };
    const auto shared = origins_shared(ours, theirs);
    RC_ASSERT(shared == origins_shared(theirs, ours));

    std::vector<std::size_t> matching;
    align(
        ours, theirs,
        [&](GeneMatch match, std::size_t i, std::size_t j) {
            if (match != GeneMatch::matching) return;
            RC_ASSERT(ours[i].origin == theirs[j].origin);
            matching.push_back(ours[i].origin);
        },
        &FaultySwarm::Gene::mark);
    RC_ASSERT(matching == shared);
}

void run_swarm(std::size_t most_robots, Slip slip) {
    const auto robots = *rc::gen::inRange<std::size_t>(2, most_robots + 1).as("robots");
    // Also so near the maximum that the clocks run out.
    const auto genesis_count =
        *rc::gen::element<std::uint64_t>(0, 22, std::numeric_limits<std::uint64_t>::max() - 30)
             .as("genesis marks");
    const GeneClock::Limits limits{
        .block = *rc::gen::element<std::uint64_t>(0, 1, 10).as("block"),
        .window = *rc::gen::element<std::uint64_t>(100, 1'000'000).as("window")};
    FaultySwarm swarm{robots, genesis_count, limits, slip};
    using rc::state::gen::execOneOfWithArgs;
    rc::state::check(Model{std::vector<bool>(robots, true)}, swarm,
                     execOneOfWithArgs<Mutate, Mutate, Send, Send, Deliver, Deliver, Drop,
                                       Duplicate, Reorder, Flush, Crash, Restart, Restart, Rewire,
                                       Partition, Heal, Forge, Exchange>());

    test::assert_nothing_sent_is_forgotten(swarm.history());
    test::assert_marks_unique(swarm.history());
    test::assert_clock_condition(swarm.history(), swarm.size());
    for (std::size_t r = 1; r < swarm.size(); ++r) {
        assert_robots_agree(swarm, r - 1, r);
        assert_robots_agree(swarm, 0, r);
    }
    RC_CLASSIFY(robots > 50, "more than 50 robots");
    RC_CLASSIFY(swarm.history().size() > 1000, "more than 1000 events");
}

TEST(SwarmProperty, FewRobotsKeepEveryPromise) {
    test::check_property([] { run_swarm(8, Slip::none); }, 20);
}
TEST(SwarmProperty, ManyRobotsKeepEveryPromise) {
    test::check_property([] { run_swarm(200, Slip::none); }, 2);
}

// Most canaries break more than uniqueness, so that its checker has a test of its own.
TEST(SwarmChecker, SeesAMarkThatTwoGenesShare) {
    const test::Event mint{
        .robot = 0, .counter_after = 2, .minted = InnovationNumber{1, RobotId{1}}};
    test::History history{mint, mint};
    EXPECT_ANY_THROW(test::assert_marks_unique(history));
    history.front().is_undone = true;
    EXPECT_NO_THROW(test::assert_marks_unique(history));
}

// The canaries: a swarm that breaks one rule must be caught, or the checks above are worth nothing.
class Canary : public testing::TestWithParam<Slip> {};

TEST_P(Canary, IsCaught) {
    rc::detail::TestParams params = rc::detail::configuration().testParams;
    params.maxSuccess = 2000;  // of which the first few should be enough
    const rc::detail::TestMetadata metadata{"", ""};
    const auto result =
        rc::detail::checkTestable([] { run_swarm(8, GetParam()); }, metadata, params);
    std::ostringstream message;
    rc::detail::printResultMessage(result, message);
    EXPECT_TRUE(result.is<rc::detail::FailureResult>()) << message.str();
    std::cout << message.str() << '\n';
}

std::string name_of(const testing::TestParamInfo<Slip>& info) {
    constexpr std::array names{"None",         "NoMerge",  "LastUsedSent", "SentBeforeFlush",
                               "FreshRestart", "GenesKept"};
    return names.at(static_cast<std::size_t>(info.param));
}
INSTANTIATE_TEST_SUITE_P(SwarmProperty, Canary,
                         testing::Values(Slip::no_merge, Slip::last_used_sent,
                                         Slip::sent_before_flush, Slip::fresh_restart,
                                         Slip::genes_kept),
                         name_of);

}  // namespace
}  // namespace gene_clocks
