#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <gene_clocks/gene_clock.hpp>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/communication_graph.hpp"
#include "tests/support/history.hpp"

namespace gene_clocks::test {

/// A rule of the protocol that a swarm breaks, to see whether anyone notices.
enum class Slip : std::uint8_t {
    none,
    no_merge,           ///< genes are taken over, the stamp is not
    last_used_sent,     ///< the stamp is one too small
    sent_before_flush,  ///< messages leave before the counter is stored
    fresh_restart,      ///< a restart forgets the stored counter
    genes_kept          ///< a restart keeps genes that the stored counter does not cover
};

/// Robots with real gene clocks, storage that survives a crash, and a network in which everything
/// goes wrong that can. A robot takes over all genes that it receives.
class FaultySwarm {
public:
    struct Gene {
        InnovationNumber mark;
        std::size_t origin;  ///< the event of its creation: tells genes apart without their marks
    };

    FaultySwarm(std::size_t robots, std::uint64_t genesis_count, GeneClock::Limits limits,
                Slip slip = Slip::none)
        : genesis_count_{genesis_count}, limits_{limits}, slip_{slip}, is_left_(robots, false) {
        for (std::size_t r = 0; r < robots; ++r) {
            GeneClock clock{id(r), genesis_count, limits};
            const std::uint64_t stored = clock.durable_needed();
            robots_.push_back({std::move(clock), stored, {}});
        }
        rewire(Topology::random, 1);
    }

    [[nodiscard]] std::size_t size() const { return robots_.size(); }
    [[nodiscard]] bool is_up(std::size_t robot) const { return robots_[robot].clock.has_value(); }
    [[nodiscard]] const std::vector<Gene>& genes(std::size_t robot) const {
        return robots_[robot].genes;
    }
    [[nodiscard]] const History& history() const { return history_; }

    void mutate(std::size_t r, std::uint64_t count) {
        Robot& robot = robots_[r];
        const auto before = robot.clock->state();
        const auto marks = robot.clock->mint(count);
        if (!marks) {
            RC_ASSERT(robot.clock->state() == before);
            RC_ASSERT(count > limits_.maximum - before.next);
            return;
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            robot.genes.push_back({(*marks)[i], history_.size()});
            history_.push_back(
                {.robot = r, .counter_after = robot.clock->stamp().value, .minted = (*marks)[i]});
        }
    }

    /// To everyone that `r` can reach at the moment.
    void send(std::size_t r) {
        Robot& robot = robots_[r];
        if (slip_ != Slip::sent_before_flush) flush(r);
        Stamp stamp = robot.clock->stamp();
        if (slip_ == Slip::last_used_sent) --stamp.value;
        const std::size_t sending = history_.size();
        history_.push_back({.robot = r,
                            .counter_after = robot.clock->stamp().value,
                            .minted = {},
                            .is_sending = true});
        const auto [begin, end] = adjacent_vertices(r, graph_);
        for (auto to = begin; to != end; ++to) {
            if (is_left_[r] == is_left_[*to]) {
                in_flight_.push_back({*to, sending, stamp, robot.genes});
            }
        }
    }

    void deliver(std::size_t count) {
        for (; count > 0 && !in_flight_.empty(); --count) {
            const Message message = std::move(in_flight_.front());
            in_flight_.pop_front();
            receive(message);
        }
    }

    void drop(std::size_t pick) {
        if (!in_flight_.empty()) in_flight_.erase(in_flight_.begin() + at(pick));
    }

    void duplicate(std::size_t pick) {
        if (!in_flight_.empty()) in_flight_.push_back(in_flight_[pick % in_flight_.size()]);
    }

    void reorder(std::uint32_t seed) { std::ranges::shuffle(in_flight_, std::mt19937{seed}); }

    void flush(std::size_t r) { robots_[r].stored = robots_[r].clock->durable_needed(); }

    /// Memory is lost, storage is not; nor are stored genes that the stored counter covers.
    void crash(std::size_t r) {
        Robot& robot = robots_[r];
        robot.clock.reset();
        if (slip_ != Slip::genes_kept) {
            std::erase_if(robot.genes,
                          [&](const Gene& gene) { return gene.mark.counter >= robot.stored; });
        }
        for (Event& event : history_) {
            if (event.robot == r && event.counter_after > robot.stored &&
                slip_ != Slip::genes_kept) {
                event.is_undone = true;
            }
        }
    }

    void restart(std::size_t r) {
        robots_[r].clock =
            slip_ == Slip::fresh_restart
                ? GeneClock{id(r), genesis_count_, limits_}
                : GeneClock::restart(id(r), robots_[r].stored, genesis_count_, limits_);
        RC_ASSERT(is_up(r));
    }

    /// A stamp that no robot has sent.
    void forge(std::size_t r, std::uint64_t leap) {
        GeneClock& clock = *robots_[r].clock;
        const auto room = limits_.maximum - clock.stamp().value;
        const Stamp forged{clock.stamp().value + std::min(leap, room)};
        RC_ASSERT(clock.observe(forged) == (std::min(leap, room) <= limits_.window));
    }

    void rewire(Topology topology, std::uint32_t seed) {
        graph_ = make_graph(topology, size(), seed);
    }

    /// Splits the swarm in two halves that do not hear each other.
    void partition(std::uint32_t seed) {
        std::mt19937 random{seed};
        for (std::size_t r = 0; r < size(); ++r) is_left_[r] = random() % 2 == 0;
    }
    void heal() { is_left_.assign(size(), false); }

private:
    struct Robot {
        std::optional<GeneClock> clock;  ///< none while it is down
        std::uint64_t stored;            ///< on stable storage
        std::vector<Gene> genes;         ///< in the order in which it met them
    };
    struct Message {
        std::size_t to;
        std::size_t sending;
        Stamp stamp;
        std::vector<Gene> genes;
    };

    static RobotId id(std::size_t r) { return RobotId{static_cast<std::uint32_t>(r + 1)}; }
    [[nodiscard]] std::ptrdiff_t at(std::size_t pick) const {
        return static_cast<std::ptrdiff_t>(pick % in_flight_.size());
    }

    [[nodiscard]] bool admits(GeneClock& clock, const Message& message) const {
        switch (slip_) {
            case Slip::no_merge:
                return true;
            case Slip::last_used_sent:
                return clock.observe(message.stamp);
            default:
                return clock.observe(message.stamp, message.genes, &Gene::mark);
        }
    }

    void receive(const Message& message) {
        Robot& robot = robots_[message.to];
        if (!robot.clock || !admits(*robot.clock, message)) return;
        for (const Gene& gene : message.genes) {
            if (std::ranges::find(robot.genes, gene.mark, &Gene::mark) == robot.genes.end()) {
                robot.genes.push_back(gene);
            }
        }
        history_.push_back({.robot = message.to,
                            .counter_after = robot.clock->stamp().value,
                            .minted = {},
                            .received_from = message.sending});
    }

    std::uint64_t genesis_count_;
    GeneClock::Limits limits_;
    Slip slip_;
    std::vector<Robot> robots_;
    CommunicationGraph graph_;
    std::vector<bool> is_left_;  ///< the side of the partition that each robot is on
    std::deque<Message> in_flight_;
    History history_;
};

}  // namespace gene_clocks::test
