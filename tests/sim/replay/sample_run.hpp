#pragma once

#include <gene_clocks/sim/simulation.hpp>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/replay/replay_recorder.hpp"

namespace gene_clocks::replay {

/// A swarm between two cycles, kept as it was.
struct Snapshot {
    std::vector<float> x_px, y_px, heading_x, heading_y, energy;
    std::vector<std::uint64_t> stamps;
    std::vector<neat::Genome> genomes;
    std::vector<std::pair<float, float>> items;  // −1, −1 where absent
    std::uint64_t sent{}, received{};
    std::set<std::pair<std::size_t, std::size_t>> heard;  // in the cycle before: sender, receiver
};

struct Marking {
    RobotId robot;
    InnovationNumber mark;
    double cycle{};
};

/// Hands everything on to a recorder, and keeps all of it besides, in the plainest way.
class Witness final : public sim::RunObserver {
public:
    explicit Witness(sim::RunObserver& next) : next_(next) {}

    void gene_marked(RobotId robot, InnovationNumber mark, double now_cycles) override {
        markings.push_back({robot, mark, now_cycles});
        next_.gene_marked(robot, mark, now_cycles);
    }
    void message_sent(RobotId robot, Stamp stamp, InnovationNumber newest) override {
        senders_.push_back(static_cast<std::size_t>(robot) - 1);
        next_.message_sent(robot, stamp, newest);
    }
    void message_admitted(RobotId robot, std::uint64_t message, Stamp stamp) override {
        ++received_;
        heard_.emplace(senders_.at(message), static_cast<std::size_t>(robot) - 1);
        next_.message_admitted(robot, message, stamp);
    }
    void between_cycles(const sim::SwarmView& swarm) override {
        Snapshot& now = snapshots.emplace_back();
        now.x_px.assign(swarm.x_px.begin(), swarm.x_px.end());
        now.y_px.assign(swarm.y_px.begin(), swarm.y_px.end());
        now.heading_x.assign(swarm.heading_x.begin(), swarm.heading_x.end());
        now.heading_y.assign(swarm.heading_y.begin(), swarm.heading_y.end());
        for (const neat::Agent& agent : swarm.agents) {
            now.energy.push_back(agent.energy());
            now.stamps.push_back(agent.source().stamp().value);
            now.genomes.push_back(agent.active());
        }
        for (std::size_t i = 0; i < swarm.item_is_present.size(); ++i) {
            now.items.emplace_back(swarm.item_is_present[i] ? swarm.item_x_px[i] : -1.0f,
                                   swarm.item_is_present[i] ? swarm.item_y_px[i] : -1.0f);
        }
        now.sent = senders_.size();
        now.received = received_;
        now.heard = std::exchange(heard_, {});
        cycles.push_back(swarm.cycle);
        next_.between_cycles(swarm);
    }

    std::vector<Snapshot> snapshots;  // by cycle
    std::vector<std::int64_t> cycles;
    std::vector<Marking> markings;

private:
    sim::RunObserver& next_;
    std::vector<std::size_t> senders_;
    std::uint64_t received_ = 0;
    std::set<std::pair<std::size_t, std::size_t>> heard_;
};

inline sim::Arena sample_arena(std::string name = "sample") {
    return {std::move(name), 140.0, 120.0, 5.0, 6.0, 5.0, 5.0, {{40.0, 40.0, 70.0, 70.0, 6.0}}};
}

/// Short, crowded, and with many new genes.
inline sim::Settings sample_settings(sim::Task task = sim::Task::collection,
                                     sim::Source source = sim::Source::gene_clock) {
    sim::Settings settings;
    settings.task = task;
    settings.source = source;
    settings.world.robots = 12;
    settings.world.items = 5;
    settings.world.item_absence_cycles = 9;
    settings.energy.decay = 0.7;
    settings.odneat.maturation_cycles = 60;
    settings.odneat.p_mutate = 0.9;
    settings.odneat.p_node = 0.2;
    settings.odneat.p_connection = 0.4;
    settings.odneat.p_mate = 0.6;
    settings.run.cycles = 2500;
    settings.run.record_creation_times = true;
    return settings;
}

/// A run that a recorder and a witness have seen.
struct SampleRun {
    explicit SampleRun(const sim::Settings& with, FrameChoice frames = {0, 2500, 7},
                       std::uint64_t seed = 1)
        : settings(with),
          recorder(settings, arena.width_px, frames),
          witness(recorder),
          result(sim::simulate_observed(settings, arena, seed, witness).value()) {}

    const Snapshot& end() const { return witness.snapshots.back(); }

    sim::Settings settings;
    sim::Arena arena = sample_arena();
    ReplayRecorder recorder;
    Witness witness;
    sim::RunResult result;
};

/// The marks of a genome's genes beyond the genesis ones.
inline std::set<InnovationNumber> new_marks(const neat::Genome& genome) {
    std::set<InnovationNumber> marks;
    for (const auto& neuron : genome.topology->neurons) marks.insert(neuron.mark);
    marks.insert(genome.topology->connection_marks.begin(),
                 genome.topology->connection_marks.end());
    std::erase_if(marks, [](InnovationNumber mark) { return mark.robot == genesis_robot; });
    return marks;
}

}  // namespace gene_clocks::replay
