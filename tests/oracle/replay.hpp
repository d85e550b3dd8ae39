#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/admission_gate.hpp>
#include <gene_clocks/align.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/oracle/words.hpp"

namespace gene_clocks::test {

/// Robots, their storage and the network, around shipped clocks.
template <std::unsigned_integral Counter>
class Fleet {
public:
    using Clock = BasicGeneClock<Counter>;
    using Gate = BasicAdmissionGate<Counter>;
    using Mark = typename Clock::Mark;
    using Words = std::span<const std::string_view>;

    Fleet(typename Clock::Limits limits, Counter genesis_count)
        : limits_{limits}, genesis_count_{genesis_count} {}

    std::string mint(RobotId id, Counter count) {
        Robot& robot = find(id);
        const auto marks = robot.clock.mint(count);
        if (!marks) return "exhausted";
        for (Counter i = 0; i < count; ++i) robot.known.push_back((*marks)[i]);
        return fmt::format("marks {} {}", marks->first.counter, marks->count);
    }

    std::string send(RobotId id, const std::vector<Mark>& selection) {
        const Robot& robot = find(id);
        if (robot.stored < robot.clock.durable_needed()) return "not durable";
        Message message{robot.clock.stamp(), {}};
        std::ranges::copy_if(selection, std::back_inserter(message.genes), [&](Mark gene) {
            return std::ranges::find(robot.known, gene) != robot.known.end();
        });
        const std::string answer =
            fmt::format("sent {} {};{}", network_.size(), message.stamp.value, list(message.genes));
        network_.push_back(std::move(message));
        return answer;
    }

    std::string receive(RobotId id, std::size_t message) {
        if (message >= network_.size()) return "no message";
        return learn(id, network_[message].stamp, network_[message].genes);
    }

    /// Takes the stamp alone.
    std::string overhear(RobotId id, std::size_t message) {
        if (message >= network_.size()) return "no message";
        const auto stamp = network_[message].stamp;
        Robot& robot = find(id);
        if (robot.gate) return outcome(robot.gate->admit(robot.clock, stamp, std::vector<Mark>{}));
        return robot.clock.observe(stamp) ? "accepted" : "refused";
    }

    std::string inject(RobotId id, Counter stamp, const std::vector<Mark>& genes) {
        return learn(id, {stamp}, genes);
    }

    std::string persist(RobotId id, Counter value) {
        Robot& robot = find(id);
        if (value > limits_.maximum) return "out of range";
        robot.stored = std::max(robot.stored, value);
        return "persisted";
    }

    std::string flush(RobotId id) { return persist(id, find(id).clock.durable_needed()); }

    std::string elapse(RobotId id) {
        if (Robot& robot = find(id); robot.gate) robot.gate->elapse();
        return "elapsed";
    }

    std::string crash(RobotId id, Counter block, std::optional<typename Gate::Policy> policy) {
        Robot& robot = find(id);
        auto clock = Clock::restart(id, robot.stored, genesis_count_,
                                    {limits_.maximum, block, limits_.window});
        if (!clock) return "not resumed";
        robot.clock = *std::move(clock);
        robot.gate.reset();
        if (policy) robot.gate.emplace(*policy);
        std::erase_if(robot.known, [&](Mark gene) { return gene.counter >= robot.stored; });
        return "resumed";
    }

    std::string snapshot(Counter next, Counter durable) const {
        const auto clock = Clock::from_state(RobotId{1}, {next, durable}, limits_);
        if (!clock) return "no clock";
        return fmt::format("clock {} {}", clock->state().next, clock->state().durable);
    }

    std::string known(RobotId id) { return "known" + list(find(id).known); }

    /// What the oracle prints of a robot after each command.
    std::string state(RobotId id) {
        const Robot& robot = find(id);
        const auto [next, durable] = robot.clock.state();
        return fmt::format(" | {} {} {} {} {}", next, durable, robot.stored, robot.known.size(),
                           robot.gate ? fmt::to_string(robot.gate->allowance()) : "-");
    }

    static std::string list(const std::vector<Mark>& marks) {
        std::string text;
        for (const Mark& mark : marks) text += show(mark);
        return text;
    }

    static std::string show(Mark mark) {
        return fmt::format(" {},{}", mark.counter, static_cast<std::uint32_t>(mark.robot));
    }

private:
    struct Robot {
        Clock clock;
        std::optional<Gate> gate;
        Counter stored;  ///< on stable storage
        std::vector<Mark> known;
    };
    struct Message {
        typename Clock::StampType stamp;
        std::vector<Mark> genes;
    };

    Robot& find(RobotId id) {
        const auto place = robots_.find(id);
        if (place != robots_.end()) return place->second;
        Clock clock{id, genesis_count_, limits_};
        const Counter stored = clock.durable_needed();
        Robot robot{std::move(clock), std::nullopt, stored, {}};
        for (Counter i = 1; i <= genesis_count_; ++i) robot.known.push_back({i, genesis_robot});
        return robots_.emplace(id, std::move(robot)).first->second;
    }

    std::string learn(RobotId id, typename Clock::StampType stamp, const std::vector<Mark>& genes) {
        Robot& robot = find(id);
        const std::string answer =
            robot.gate ? outcome(robot.gate->admit(robot.clock, stamp, genes))
                       : std::string{robot.clock.observe(stamp, genes) ? "accepted" : "refused"};
        if (answer != "accepted") return answer;
        robot.known.insert(robot.known.end(), genes.begin(), genes.end());
        return answer;
    }

    static std::string outcome(Admission admission) {
        switch (admission) {
            case Admission::admitted:
                return "accepted";
            case Admission::beyond_maximum:
                return "refused: beyond maximum";
            case Admission::beyond_window:
                return "refused: beyond window";
            case Admission::beyond_allowance:
                return "refused: beyond allowance";
            case Admission::gene_not_covered:
                return "refused: gene not covered";
            case Admission::identity_conflict:
                return "refused: identity conflict";
        }
        throw std::logic_error("an outcome that the model does not have");
    }

    typename Clock::Limits limits_;
    Counter genesis_count_;
    std::map<RobotId, Robot> robots_;
    std::vector<Message> network_;
};

/// The oracle's language (proofs/oracle/protocol.ml) over such a fleet.
template <std::unsigned_integral Counter>
class Replay {
public:
    using Mark = BasicInnovationNumber<Counter>;
    using Words = std::span<const std::string_view>;

    /// The answer to one command. Throws std::invalid_argument where it is malformed.
    std::string answer(Words words) {
        const std::string_view verb = words.front();
        if (verb == "limits" && words.size() == 5) {
            fleet_.emplace(typename BasicGeneClock<Counter>::Limits{number<Counter>(words[1]),
                                                                    number<Counter>(words[2]),
                                                                    number<Counter>(words[3])},
                           number<Counter>(words[4]));
            return "limits";
        }
        if (verb == "align") return align_genomes(words.subspan(1));
        if (verb == "snapshot" && words.size() == 3) {
            return fleet_.value().snapshot(number<Counter>(words[1]), number<Counter>(words[2]));
        }
        if (words.size() < 2) throw std::invalid_argument("no such command");
        const RobotId id{number<std::uint32_t>(words[1])};
        if (verb == "known") return fleet_.value().known(id);
        const std::string answer = perform(verb, id, words.subspan(2));
        return answer + fleet_->state(id);
    }

private:
    std::string perform(std::string_view verb, RobotId id, Words rest) {
        Fleet<Counter>& fleet = fleet_.value();
        if (verb == "mint") return fleet.mint(id, number<Counter>(rest[0]));
        if (verb == "send") return fleet.send(id, marks(rest));
        if (verb == "receive") return fleet.receive(id, number<std::size_t>(rest[0]));
        if (verb == "overhear") return fleet.overhear(id, number<std::size_t>(rest[0]));
        if (verb == "elapse") return fleet.elapse(id);
        if (verb == "inject") {
            return fleet.inject(id, number<Counter>(rest[0]), marks(rest.subspan(1)));
        }
        if (verb == "persist") return fleet.persist(id, number<Counter>(rest[0]));
        if (verb == "flush") return fleet.flush(id);
        if (verb == "crash" && rest.size() == 1) {
            return fleet.crash(id, number<Counter>(rest[0]), std::nullopt);
        }
        if (verb == "crash" && rest.size() == 4) {
            if (number<Counter>(rest[3]) != std::numeric_limits<Counter>::max()) {
                throw std::invalid_argument("the shipped gate saturates at the largest counter");
            }
            return fleet.crash(id, number<Counter>(rest[0]),
                               typename Fleet<Counter>::Gate::Policy{number<Counter>(rest[1]),
                                                                     number<Counter>(rest[2])});
        }
        throw std::invalid_argument("no such command");
    }

    static std::vector<Mark> marks(Words words) {
        if (words.size() % 2 != 0) throw std::invalid_argument("a mark is two numbers");
        std::vector<Mark> result;
        for (std::size_t i = 0; i < words.size(); i += 2) {
            result.push_back(
                {number<Counter>(words[i]), RobotId{number<std::uint32_t>(words[i + 1])}});
        }
        return result;
    }

    static std::string align_genomes(Words words) {
        const auto bar = std::ranges::find(words, "/");
        if (bar == words.end()) throw std::invalid_argument("align needs two genomes");
        const auto first = marks({words.begin(), bar});
        const auto second = marks({bar + 1, words.end()});
        std::string text = "aligned";
        align(first, second, [&](GeneMatch match, std::size_t i, std::size_t j) {
            static constexpr std::string_view signs[] = {" =", " <", " >", " <<", " >>"};
            const bool on_second =
                match == GeneMatch::disjoint_second || match == GeneMatch::excess_second;
            text += signs[static_cast<std::size_t>(match)];
            text += Fleet<Counter>::show(on_second ? second[j] : first[i]);
        });
        return text;
    }

    std::optional<Fleet<Counter>> fleet_;
};

}  // namespace gene_clocks::test
