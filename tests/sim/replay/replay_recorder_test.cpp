#include "sim/replay/replay_recorder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/replay/decoded.hpp"
#include "tests/sim/replay/sample_run.hpp"

namespace gene_clocks::replay {
namespace {

/// The cycles of the frames, counted one by one.
std::vector<std::size_t> frame_cycles(const FrameChoice& frames) {
    std::vector<std::size_t> cycles;
    for (std::int64_t cycle = frames.from; cycle < frames.to; cycle += frames.every) {
        cycles.push_back(static_cast<std::size_t>(cycle));
    }
    cycles.push_back(static_cast<std::size_t>(frames.to));
    return cycles;
}

constexpr FrameChoice whole{0, 2500, 7};
constexpr FrameChoice part{100, 1203, 20};
constexpr FrameChoice each{500, 700, 1};
constexpr FrameChoice only_ends{3, 5, 1000};

class RecorderTest : public testing::TestWithParam<FrameChoice> {
protected:
    SampleRun run_{sample_settings(), GetParam()};
    const std::vector<std::size_t> cycles_ = frame_cycles(GetParam());
};

TEST_P(RecorderTest, FramesAreThoseAskedFor) {
    EXPECT_EQ(static_cast<std::size_t>(GetParam().frames()), cycles_.size());
    EXPECT_EQ(decoded::rows(run_.recorder.x().bytes(), 12).size(), cycles_.size());
}

TEST_P(RecorderTest, RobotsAreWhereTheyWere) {
    const ReplayRecorder& recorder = run_.recorder;
    const auto x = decoded::rows(recorder.x().bytes(), 12);
    const auto y = decoded::rows(recorder.y().bytes(), 12);
    const auto heading = decoded::rows(recorder.heading().bytes(), 12);
    const auto energy = decoded::rows(recorder.energy().bytes(), 12);
    const auto clock = decoded::rows(recorder.clock().bytes(), 12);
    ASSERT_EQ(x.size(), cycles_.size());
    ASSERT_EQ(clock.size(), cycles_.size());
    const double place = recorder.quanta().place_px;
    EXPECT_EQ(place, 0.1);
    for (std::size_t frame = 0; frame < cycles_.size(); ++frame) {
        const Snapshot& then = run_.witness.snapshots.at(cycles_[frame]);
        for (std::size_t i = 0; i < 12; ++i) {
            EXPECT_NEAR(static_cast<double>(x[frame][i]) * place, then.x_px[i], 0.5001 * place);
            EXPECT_NEAR(static_cast<double>(y[frame][i]) * place, then.y_px[i], 0.5001 * place);
            const double turn =
                2.0 * std::numbers::pi * static_cast<double>(heading[frame][i]) / Quanta::headings;
            const double cosine =
                std::cos(turn) * then.heading_x[i] + std::sin(turn) * then.heading_y[i];
            EXPECT_GT(cosine, std::cos(1.0001 * std::numbers::pi / Quanta::headings));
            EXPECT_GE(heading[frame][i], 0);
            EXPECT_LT(heading[frame][i], Quanta::headings);
            EXPECT_NEAR(static_cast<double>(energy[frame][i]) * recorder.quanta().energy,
                        then.energy[i], 0.5001);
            EXPECT_EQ(static_cast<std::uint64_t>(clock[frame][i]), then.stamps[i]);
        }
    }
}

TEST_P(RecorderTest, MessagesAreThoseSinceTheFrameBefore) {
    decoded::Reader reader(run_.recorder.heard().bytes());
    const auto messages = decoded::rows(run_.recorder.messages().bytes(), 2);
    ASSERT_EQ(messages.size(), cycles_.size());
    std::size_t pairs = 0;
    for (std::size_t frame = 0; frame < cycles_.size(); ++frame) {
        // Before the first frame, the cycle just before it counts.
        const std::size_t begin = frame == 0 ? cycles_[0] : cycles_[frame - 1] + 1;
        std::set<std::pair<std::size_t, std::size_t>> expected;
        for (std::size_t cycle = begin; cycle <= cycles_[frame]; ++cycle) {
            expected.insert(run_.witness.snapshots[cycle].heard.begin(),
                            run_.witness.snapshots[cycle].heard.end());
        }
        std::set<std::pair<std::size_t, std::size_t>> heard;
        std::uint64_t pair = 0;
        for (std::uint64_t left = reader.next(); left > 0; --left) {
            pair += reader.next();
            heard.emplace(pair / 12, pair % 12);
        }
        EXPECT_EQ(heard, expected) << "frame " << frame;
        pairs += heard.size();
        const Snapshot& then = run_.witness.snapshots[cycles_[frame]];
        EXPECT_EQ(static_cast<std::uint64_t>(messages[frame][0]), then.sent);
        EXPECT_EQ(static_cast<std::uint64_t>(messages[frame][1]), then.received);
    }
    EXPECT_TRUE(reader.is_at_end());
    EXPECT_TRUE(cycles_.size() <= 2 || pairs > cycles_.size() / 4) << pairs;
}

TEST_P(RecorderTest, ItemsAreWhereTheyWere) {
    decoded::Reader reader(run_.recorder.items().bytes());
    std::vector<std::pair<double, double>> items(5, {-1.0, -1.0});
    std::size_t absent = 0;
    for (const std::size_t cycle : cycles_) {
        for (std::uint64_t left = reader.next(); left > 0; --left) {
            auto& item = items.at(reader.next());
            const bool is_present = reader.next() == 1;
            item.first = is_present ? 0.1 * static_cast<double>(reader.next()) : -1.0;
            item.second = is_present ? 0.1 * static_cast<double>(reader.next()) : -1.0;
        }
        for (std::size_t i = 0; i < items.size(); ++i) {
            const auto& then = run_.witness.snapshots[cycle].items[i];
            EXPECT_NEAR(items[i].first, then.first, 0.0501);
            EXPECT_NEAR(items[i].second, then.second, 0.0501);
            absent += then.first < 0;
        }
    }
    EXPECT_TRUE(reader.is_at_end());
    EXPECT_TRUE(cycles_.size() <= 300 || absent > 0);
}

INSTANTIATE_TEST_SUITE_P(Frames, RecorderTest, testing::Values(whole, part, each, only_ends));

TEST(ReplayRecorderTest, RecordingChangesNothing) {
    for (const sim::Task task : {sim::Task::navigation, sim::Task::collection}) {
        const SampleRun run(sample_settings(task));
        const auto alone = sim::simulate(run.settings, run.arena, 1).value();
        EXPECT_EQ(run.result.trajectory_hash, alone.trajectory_hash);
        EXPECT_EQ(run.result.counters.messages_received, alone.counters.messages_received);
    }
}

TEST(ReplayRecorderTest, SeesTheSwarmBeforeEveryCycleAndAfterTheLast) {
    const SampleRun run(sample_settings());
    ASSERT_EQ(run.witness.cycles.size(), 2501u);
    for (std::size_t i = 0; i < run.witness.cycles.size(); ++i) {
        EXPECT_EQ(run.witness.cycles[i], static_cast<std::int64_t>(i));
    }
}

TEST(ReplayRecorderTest, DelayedMessagesHaveTheirSender) {
    sim::Settings settings = sample_settings();
    settings.radio.delay_cycles = 5;
    settings.radio.loss = 0.3;
    const SampleRun run(settings, {0, 2500, 1});
    decoded::Reader reader(run.recorder.heard().bytes());
    std::size_t pairs = 0;
    for (const Snapshot& then : run.witness.snapshots) {
        std::uint64_t pair = 0;
        for (std::uint64_t left = reader.next(); left > 0; --left, ++pairs) {
            pair += reader.next();
            EXPECT_TRUE(then.heard.contains({pair / 12, pair % 12}));
        }
    }
    EXPECT_GT(pairs, 100u);
}

TEST(ReplayRecorderTest, PlacesInHugeArenasAreCoarser) {
    const sim::Settings settings = sample_settings();
    EXPECT_EQ(ReplayRecorder(settings, 6553.0, whole).quanta().place_px, 0.1);
    EXPECT_DOUBLE_EQ(ReplayRecorder(settings, 65535.0, whole).quanta().place_px, 1.0);
}

}  // namespace
}  // namespace gene_clocks::replay
