#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/model/world.hpp"

namespace gene_clocks::model {

/// The robots, the network and the rules: which worlds follow from a world, and which of them break
/// a promise.
template <class Rules>
class Swarm {
public:
    explicit Swarm(const Scope& scope)
        : scope_{scope},
          counters_{scope.maximum - 1},
          counter_bits_{static_cast<int>(std::bit_width(scope.maximum))},
          mark_bits_{scope.robots * counters_} {
        const int bits = scope.robots * (1 + 3 * counter_bits_ + mark_bits_ +
                                         (scope.gate ? 2 * (counter_bits_ + 2) : 0)) +
                         scope.messages * (counter_bits_ + mark_bits_) + 3 +
                         (scope.budget ? 4 * budget_bits + spent_bits : 0);
        if (scope.robots > most_robots || scope.messages > most_messages || mark_bits_ > 32 ||
            bits > 128) {
            throw std::invalid_argument("the scope does not fit into 128 bits");
        }
        if (scope.budget && !fits(*scope.budget)) {
            throw std::invalid_argument("the scope's budget does not fit into its bits");
        }
    }

    [[nodiscard]] const Scope& scope() const { return scope_; }

    [[nodiscard]] World initial() const {
        World world;
        for (int r = 0; r < scope_.robots; ++r) {
            const auto [next, durable] = Clock{robot_id(r), 0, limits_of(r)}.state();
            world.robots[index(r)] = {true, next, durable, durable, 0};
            open_gate(world.robots[index(r)]);
        }
        return world;
    }

    /// Calls `visit(action)` for everything that can be tried in `world`.
    template <class Visit>
    void for_each_action(const World& world, Visit visit) const {
        using enum Action::Kind;
        const auto& budget = scope_.budget;
        for (int r = 0; r < scope_.robots; ++r) {
            const RobotState& robot = world.robots[index(r)];
            if (!robot.is_up) {
                visit(Action{restart, r});
                continue;
            }
            for (Counter n = 1; n <= scope_.largest_mint; ++n) {
                if (!budget || world.minted + n <= budget->minted) visit(Action{mint, r, 0, n});
            }
            if (world.message_count < scope_.messages &&
                Rules::may_send(clock_of(world, r), robot.stored)) {
                visit(Action{send, r});
            }
            for (int m = 0; m < world.message_count; ++m) visit(Action{deliver, r, m});
            for (int m = 0; scope_.overhears && m < world.message_count; ++m) {
                visit(Action{overhear, r, m});
            }
            // Any write that was begun may be the one that completes.
            const int most = std::min<int>(scope_.maximum, robot.durable + scope_.stored_beyond);
            const int next = robot.stored + 1;
            for (int value = scope_.older_writes ? next : std::max<int>(next, robot.durable);
                 value <= most; ++value) {
                const auto counter = static_cast<Counter>(value);
                if (!budget || world.stored + beyond_need(robot, counter) <= budget->stored) {
                    visit(Action{flush, r, 0, counter});
                }
            }
            // Once every stamp is paid for, more time changes nothing.
            if (scope_.gate && robot.next + robot.allowance < scope_.maximum) {
                visit(Action{elapse, r});
            }
            if (!budget || world.crashes < budget->crashes) visit(Action{crash, r});
            if (budget && world.forged < budget->forged) {
                for (Counter stamp = 1; stamp <= scope_.maximum; ++stamp) {
                    for (int m = no_message; m < world.message_count; ++m) {
                        visit(Action{forge, r, m, stamp});
                    }
                }
            }
        }
        for (int m = 0; m < world.message_count; ++m) {
            visit(Action{lose, 0, m});
            if (world.message_count < scope_.messages) visit(Action{duplicate, 0, m});
        }
    }

    /// Carries out `action` in place. Returns what it breaks, or nullptr.
    const char* step(World& world, const Action& action) const {
        RobotState& robot = world.robots[index(action.robot)];
        switch (action.kind) {
            case Action::Kind::mint:
                return mint(world, action);
            case Action::Kind::send:
                add(world, {Rules::stamp_of(clock_of(world, action.robot)).value, robot.known});
                break;
            case Action::Kind::deliver: {
                const Message message = world.messages[index(action.message)];
                remove(world, action.message);
                if (const char* broken = receive(world, action.robot, message)) return broken;
                break;
            }
            case Action::Kind::overhear: {
                const Stamp stamp{world.messages[index(action.message)].stamp};
                remove(world, action.message);
                if (const char* broken = receive_stamp(world, action.robot, stamp)) return broken;
                break;
            }
            case Action::Kind::lose:
                remove(world, action.message);
                break;
            case Action::Kind::duplicate:
                add(world, world.messages[index(action.message)]);
                break;
            case Action::Kind::flush:
                if (scope_.budget) {
                    const int beyond = beyond_need(robot, action.value);
                    world.stored += beyond;
                    world.spent += beyond;
                }
                robot.stored = action.value;
                break;
            case Action::Kind::elapse: {
                Gate gate = gate_of(robot);
                gate.elapse();
                robot.allowance = gate.allowance();
                robot.line = static_cast<Counter>(robot.line + scope_.gate->per_cycle);
                break;
            }
            case Action::Kind::crash:
                if (scope_.budget) {
                    ++world.crashes;
                    world.spent += scope_.blocks[index(action.robot)];
                }
                robot = {false, 0, 0, robot.stored, retained(robot)};
                break;
            case Action::Kind::restart: {
                const auto clock =
                    Rules::resume(robot_id(action.robot), robot.stored, limits_of(action.robot));
                if (!clock) return "a clock does not come back from what it stored";
                robot.is_up = true;
                put(robot, *clock);
                open_gate(robot);
                break;
            }
            case Action::Kind::forge: {
                ++world.forged;
                world.spent +=
                    scope_.gate ? std::min(scope_.window, robot.allowance) : scope_.window;
                const Message forged{action.value, forged_genes(world, action)};
                if (const char* broken = receive(world, action.robot, forged)) return broken;
                break;
            }
        }
        return broken_promise(world);
    }

    [[nodiscard]] Packed pack(const World& world) const {
        Packed bits = 0;
        int at = 0;
        const auto put = [&](std::uint32_t value, int width) {
            bits |= Packed{value} << at;
            at += width;
        };
        for (int r = 0; r < scope_.robots; ++r) {
            const RobotState& robot = world.robots[index(r)];
            put(robot.is_up, 1);
            put(robot.next, counter_bits_);
            put(robot.durable, counter_bits_);
            put(robot.stored, counter_bits_);
            put(robot.known, mark_bits_);
            if (scope_.gate) {
                put(robot.allowance, counter_bits_ + 2);
                put(robot.line, counter_bits_ + 2);
            }
        }
        put(static_cast<std::uint32_t>(world.message_count), 3);
        for (int m = 0; m < scope_.messages; ++m) {
            put(world.messages[index(m)].stamp, counter_bits_);
            put(world.messages[index(m)].genes, mark_bits_);
        }
        if (scope_.budget) {
            for (const int count : {world.minted, world.crashes, world.forged, world.stored}) {
                put(static_cast<std::uint32_t>(count), budget_bits);
            }
            put(static_cast<std::uint32_t>(world.spent), spent_bits);
        }
        return bits;
    }

    [[nodiscard]] World unpack(Packed bits) const {
        const auto take = [&](int width) {
            const auto value = static_cast<std::uint32_t>(bits & ((Packed{1} << width) - 1));
            bits >>= width;
            return value;
        };
        const auto take_counter = [&] { return static_cast<Counter>(take(counter_bits_)); };
        World world;
        for (int r = 0; r < scope_.robots; ++r) {
            RobotState& robot = world.robots[index(r)];
            robot.is_up = take(1) != 0;
            robot.next = take_counter();
            robot.durable = take_counter();
            robot.stored = take_counter();
            robot.known = take(mark_bits_);
            if (scope_.gate) {
                robot.allowance = static_cast<Counter>(take(counter_bits_ + 2));
                robot.line = static_cast<Counter>(take(counter_bits_ + 2));
            }
        }
        world.message_count = static_cast<int>(take(3));
        for (int m = 0; m < scope_.messages; ++m) {
            world.messages[index(m)].stamp = take_counter();
            world.messages[index(m)].genes = take(mark_bits_);
        }
        if (scope_.budget) {
            for (int* const count : {&world.minted, &world.crashes, &world.forged, &world.stored}) {
                *count = static_cast<int>(take(budget_bits));
            }
            world.spent = static_cast<int>(take(spent_bits));
        }
        return world;
    }

    /// One line for people: what `action` does in `world`.
    [[nodiscard]] std::string describe(const World& world, const Action& action) const {
        std::ostringstream out;
        const auto robot = [&] { out << "robot " << action.robot + 1; };
        const auto message = [&](const Message& sent) {
            out << "stamp " << int{sent.stamp} << " with ";
            write_genes(out, sent.genes);
        };
        switch (action.kind) {
            case Action::Kind::mint: {
                robot();
                const int first = world.robots[index(action.robot)].next;
                out << " mints";
                for (int n = 0; n < action.value; ++n) {
                    out << " <" << first + n << ", robot " << action.robot + 1 << '>';
                }
                break;
            }
            case Action::Kind::send:
                robot();
                out << " sends ";
                message({Rules::stamp_of(clock_of(world, action.robot)).value,
                         world.robots[index(action.robot)].known});
                break;
            case Action::Kind::deliver:
                robot();
                out << " receives ";
                message(world.messages[index(action.message)]);
                break;
            case Action::Kind::overhear:
                robot();
                out << " hears stamp " << int{world.messages[index(action.message)].stamp};
                break;
            case Action::Kind::lose:
                out << "lost: ";
                message(world.messages[index(action.message)]);
                break;
            case Action::Kind::duplicate:
                out << "duplicated: ";
                message(world.messages[index(action.message)]);
                break;
            case Action::Kind::flush:
                robot();
                out << " stores counter " << int{action.value};
                break;
            case Action::Kind::elapse:
                out << "a cycle goes by for ";
                robot();
                break;
            case Action::Kind::crash:
                robot();
                out << " crashes";
                break;
            case Action::Kind::restart:
                robot();
                out << " restarts from counter " << int{world.robots[index(action.robot)].stored};
                break;
            case Action::Kind::forge:
                robot();
                out << " receives a forged ";
                message({action.value, forged_genes(world, action)});
                break;
        }
        return out.str();
    }

private:
    static constexpr int budget_bits = 4;
    static constexpr int spent_bits = 6;

    static std::size_t index(int i) { return static_cast<std::size_t>(i); }
    static RobotId robot_id(int r) { return RobotId{static_cast<std::uint32_t>(r + 1)}; }

    [[nodiscard]] MarkSet bit_of(Mark mark) const {
        return MarkSet{1} << ((static_cast<int>(mark.robot) - 1) * counters_ + mark.counter - 1);
    }
    [[nodiscard]] Mark mark_of(int bit) const {
        return {static_cast<Counter>(bit % counters_ + 1), robot_id(bit / counters_)};
    }
    template <class Visit>
    void for_each_mark(MarkSet marks, Visit visit) const {
        for (; marks != 0; marks &= marks - 1) visit(mark_of(std::countr_zero(marks)));
    }
    void write_genes(std::ostream& out, MarkSet genes) const {
        out << '{';
        const char* separator = "";
        for_each_mark(genes, [&](Mark mark) {
            out << separator << '<' << int{mark.counter} << ", robot "
                << static_cast<std::uint32_t>(mark.robot) << '>';
            separator = ", ";
        });
        out << '}';
    }

    [[nodiscard]] Clock::Limits limits_of(int robot) const {
        return {scope_.maximum, scope_.blocks[index(robot)], Rules::window(scope_.window)};
    }

    [[nodiscard]] bool fits(const Scope::Budget& budget) const {
        const int reach = scope_.gate ? 2 * scope_.maximum : scope_.window;
        const int most = budget.minted + budget.crashes * std::ranges::max(scope_.blocks) +
                         budget.forged * reach + budget.stored;
        const int counts[] = {budget.minted, budget.crashes, budget.forged, budget.stored};
        return std::ranges::max(counts) < 1 << budget_bits && most < 1 << spent_bits;
    }

    /// How far a stored counter lies beyond all that is needed or stored.
    static int beyond_need(const RobotState& robot, Counter counter) {
        return std::max(0, counter - std::max(robot.durable, robot.stored));
    }

    void open_gate(RobotState& robot) const {
        if (!scope_.gate) return;
        robot.allowance = scope_.gate->allowance;
        robot.line = static_cast<Counter>(robot.next + robot.allowance);
    }
    /// The shipped gate, as `robot` has it.
    [[nodiscard]] Gate gate_of(const RobotState& robot) const {
        Gate::Policy policy = *scope_.gate;
        policy.allowance = robot.allowance;
        return Gate{policy};
    }

    /// The shipped clock, as `robot` has it.
    [[nodiscard]] Clock clock_of(const World& world, int robot) const {
        const RobotState& state = world.robots[index(robot)];
        return Clock::from_state(robot_id(robot), {state.next, state.durable}, limits_of(robot))
            .value();
    }
    static void put(RobotState& robot, const Clock& clock) {
        robot.next = clock.state().next;
        robot.durable = clock.state().durable;
    }

    const char* mint(World& world, const Action& action) const {
        RobotState& robot = world.robots[index(action.robot)];
        Clock clock = clock_of(world, action.robot);
        const auto marks = clock.mint(action.value);
        const bool fits = robot.next + action.value <= scope_.maximum;
        if (marks.has_value() != fits) return "exhaustion is not what is reported";
        if (!marks) return nullptr;

        MarkSet alive = 0;
        for (const auto& other : world.robots) alive |= other.known;
        for (const auto& message : world.messages) alive |= message.genes;
        const char* broken = nullptr;
        for (Counter i = 0; i < marks->count; ++i) {
            const Mark mark = (*marks)[i];
            if (bit_of(mark) & alive) return "two genes have the same mark";
            for_each_mark(robot.known, [&](Mark known) {
                if (!Rules::before(known, mark)) {
                    broken = "a gene does not sort after a gene that its robot knew";
                }
            });
            robot.known |= bit_of(mark);
        }
        if (broken) return broken;
        put(robot, clock);
        if (scope_.budget) {
            world.minted += action.value;
            world.spent += action.value;
        }
        if (scope_.gate) robot.line = static_cast<Counter>(robot.line + action.value);
        return broken_promise(world);
    }

    const char* receive(World& world, int r, Message message) const {
        std::array<Mark, 32> genes;
        std::size_t size = 0;
        for_each_mark(message.genes, [&](Mark mark) { genes[size++] = mark; });
        RobotState& robot = world.robots[index(r)];
        Clock clock = clock_of(world, r);
        if (scope_.gate) {
            Gate gate = gate_of(robot);
            const bool passed = Rules::pass(gate, clock, {message.stamp}, {genes.data(), size});
            if (gate.conflicting_mark()) return "a gene is taken for another robot's";
            if (!passed) return nullptr;
            robot.allowance = gate.allowance();
        } else if (!Rules::merge(clock, {message.stamp}, {genes.data(), size})) {
            return nullptr;
        }
        put(robot, clock);
        robot.known |= message.genes;
        return nullptr;
    }

    const char* receive_stamp(World& world, int r, Stamp stamp) const {
        if (scope_.gate) return receive(world, r, {stamp.value, 0});
        Clock clock = clock_of(world, r);
        if (Rules::merge_stamp(clock, stamp)) put(world.robots[index(r)], clock);
        return nullptr;
    }

    static MarkSet forged_genes(const World& world, const Action& action) {
        return action.message == no_message ? 0 : world.messages[index(action.message)].genes;
    }

    [[nodiscard]] MarkSet retained(const RobotState& robot) const {
        MarkSet kept = 0;
        for_each_mark(robot.known, [&](Mark mark) {
            if (Rules::retains(mark, robot.stored)) kept |= bit_of(mark);
        });
        return kept;
    }

    static void add(World& world, Message message) {
        const auto end = world.messages.begin() + world.message_count++;
        const auto place = std::upper_bound(world.messages.begin(), end, message);
        std::move_backward(place, end, end + 1);
        *place = message;
    }
    static void remove(World& world, int m) {
        const auto end = world.messages.begin() + world.message_count--;
        std::move(world.messages.begin() + m + 1, end, world.messages.begin() + m);
        *(end - 1) = {};
    }

    const char* broken_promise(const World& world) const {
        if (scope_.budget) {
            for (int r = 0; r < scope_.robots; ++r) {
                if (world.robots[index(r)].next > 1 + world.spent) {
                    return "a counter exceeds its budget";
                }
            }
        }
        for (int r = 0; scope_.gate && r < scope_.robots; ++r) {
            const RobotState& robot = world.robots[index(r)];
            if (robot.is_up && robot.next > robot.line) {
                return "receptions move a clock further than has been earned";
            }
        }
        if (!scope_.check_invariants) return nullptr;
        for (int r = 0; r < scope_.robots; ++r) {
            const RobotState& robot = world.robots[index(r)];
            if (!robot.is_up) continue;
            if (robot.next < 1 || robot.next > robot.durable || robot.durable > scope_.maximum ||
                robot.stored < 1 || robot.stored > scope_.maximum) {
                return "a counter is out of its range";
            }
            if (scope_.gate && robot.next + robot.allowance != robot.line) {
                return "a gate pays more or less than a clock moves";
            }
            bool is_covered = true;
            for_each_mark(robot.known, [&](Mark mark) { is_covered &= mark.counter < robot.next; });
            if (!is_covered) return "a robot knows a gene that its counter does not cover";
        }
        for (int m = 0; m < world.message_count; ++m) {
            bool is_credible = true;
            for_each_mark(world.messages[index(m)].genes, [&](Mark mark) {
                is_credible &= mark.counter < world.messages[index(m)].stamp;
            });
            if (!is_credible) return "a message has a gene that its stamp does not cover";
        }
        return nullptr;
    }

    Scope scope_;
    int counters_;
    int counter_bits_;
    int mark_bits_;
};

}  // namespace gene_clocks::model
