#pragma once

#include <cstddef>
#include <cstdint>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/sim/arena.hpp>
#include <gene_clocks/sim/run_observer.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <gene_clocks/sim/swarm_view.hpp>
#include <memory>
#include <vector>

/// A run as somebody who stands beside it sees it: notes of the swarm between any two cycles, and
/// of all messages. Tests of the way from simulator to results compare what the run says with what
/// follows from these notes.
namespace gene_clocks::sim::watched {

struct Robot {
    double x_px, y_px, heading_x, heading_y;
    float energy, fitness;
    std::shared_ptr<const neat::Genome> genome;  // the active one
    std::vector<neat::Population::Member> members;
    std::size_t tabu;  // entries
    Stamp stamp;       // that it would send

    bool holds(neat::GenomeId id) const { return member(id) != nullptr; }
    const neat::Population::Member* member(neat::GenomeId id) const {
        for (const auto& one : members) {
            if (one.id == id) return &one;
        }
        return nullptr;
    }
};

struct Item {
    double x_px, y_px;
    bool is_present;
};

struct Moment {
    std::int64_t cycle;  // the one that comes next
    std::vector<Robot> robots;
    std::vector<Item> items;
};

struct Event {
    enum class Kind { sent, admitted } kind;
    std::int64_t cycle;
    std::size_t robot;  // from 0
    std::uint64_t message;
};

struct Marking {
    std::int64_t cycle;
    std::size_t robot;
    InnovationNumber mark;
};

class Run final : public RunObserver {
public:
    Run(const Settings& settings, const Arena& arena, std::uint64_t seed = 1)
        : result(simulate_observed(settings, arena, seed, *this).value()) {}

    std::uint64_t messages = 0;   // sent so far
    std::vector<Moment> moments;  // one more than there are cycles
    std::vector<Event> events;    // in their order
    std::vector<Marking> markings;
    RunResult result;  // last: what is above is filled while it comes about

private:
    void gene_marked(RobotId robot, InnovationNumber mark, double now_cycles) override {
        markings.push_back({static_cast<std::int64_t>(now_cycles), index(robot), mark});
    }
    void message_sent(RobotId robot, Stamp, InnovationNumber) override {
        events.push_back({Event::Kind::sent, moments.back().cycle, index(robot), messages++});
    }
    void message_admitted(RobotId robot, std::uint64_t message, Stamp) override {
        events.push_back({Event::Kind::admitted, moments.back().cycle, index(robot), message});
    }
    void between_cycles(const SwarmView& view) override {
        Moment& moment = moments.emplace_back();
        moment.cycle = view.cycle;
        for (std::size_t i = 0; i < view.agents.size(); ++i) {
            const neat::Agent& agent = view.agents[i];
            const auto& members = agent.population().members();
            const auto active = agent.population().find(agent.active().id).value();
            moment.robots.push_back({view.x_px[i], view.y_px[i], view.heading_x[i],
                                     view.heading_y[i], agent.energy(), agent.fitness(),
                                     members[active].genome, members, agent.tabu_list().size(),
                                     agent.source().stamp()});
        }
        for (std::size_t i = 0; i < view.item_x_px.size(); ++i) {
            moment.items.push_back(
                {view.item_x_px[i], view.item_y_px[i], view.item_is_present[i] != 0});
        }
    }
    static std::size_t index(RobotId robot) { return static_cast<std::size_t>(robot) - 1; }
};

}  // namespace gene_clocks::sim::watched
