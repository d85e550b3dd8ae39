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

#include "tests/model/rules.hpp"

namespace gene_clocks::model {

inline constexpr int most_robots = 4;
inline constexpr int most_messages = 4;

/// How much of the world is explored. Everything else is unbounded: a run may have any length.
struct Scope {
    int robots = 2;
    Counter maximum = 4;       ///< counters run from 1 to maximum
    Counter block = 0;         ///< counters that a flush reserves ahead
    Counter window = 255;      ///< largest admitted leap
    int messages = 2;          ///< in the air at the same time
    Counter largest_mint = 1;  ///< genes that one mutation adds, all or none
    /// With it, what happened is counted, and counters are held against the budget
    /// 1 + minted + block · crashes + window · forged. Then runs are bounded by these three.
    struct Budget {
        int minted = 0;
        int crashes = 0;
        int forged = 0;
    };
    std::optional<Budget> budget = std::nullopt;
    /// Also checks what the proof of the outcomes rests on, in every state.
    bool check_invariants = true;
};

/// Marks as bits: `robot · counters + counter - 1`.
using MarkSet = std::uint32_t;

struct RobotState {
    bool is_up = true;
    Counter next = 1;     ///< of its clock; 0 while it is down
    Counter durable = 1;  ///< of its clock; 0 while it is down
    Counter stored = 1;   ///< on stable storage
    MarkSet known = 0;    ///< every gene that it made or received, and did not lose in a crash
};

struct Message {
    Counter stamp = 0;
    MarkSet genes = 0;
    friend auto operator<=>(Message, Message) = default;
};

/// Invariant: messages[0 … message_count) are sorted, the others default, so equal worlds are equal
/// values.
struct World {
    std::array<RobotState, most_robots> robots;
    std::array<Message, most_messages> messages;
    int message_count = 0;
    int minted = 0;
    int crashes = 0;
    int forged = 0;
};

/// A forged message has no genes, or those of a message in flight.
inline constexpr int no_message = -1;

/// What can happen next.
struct Action {
    enum class Kind { mint, send, deliver, lose, duplicate, flush, crash, restart, forge };
    Kind kind;
    int robot = 0;      ///< where it happens; of no meaning for lose and duplicate
    int message = 0;    ///< in flight, for deliver, lose, duplicate; for forge whose genes it has
    Counter value = 0;  ///< number of genes to mint, or stamp to forge
};

/// A world in 128 bits.
using Packed = unsigned __int128;

/// The robots, the network and the rules: which worlds follow from a world, and which of them break
/// a promise.
template <class Rules>
class Swarm {
public:
    explicit Swarm(const Scope& scope)
        : scope_{scope},
          limits_{scope.maximum, scope.block, Rules::window(scope.window)},
          counters_{scope.maximum - 1},
          counter_bits_{static_cast<int>(std::bit_width(scope.maximum))},
          mark_bits_{scope.robots * counters_} {
        const int bits = scope.robots * (1 + 3 * counter_bits_ + mark_bits_) +
                         scope.messages * (counter_bits_ + mark_bits_) + 3 +
                         (scope.budget ? 3 * budget_bits : 0);
        if (scope.robots > most_robots || scope.messages > most_messages || mark_bits_ > 32 ||
            bits > 128) {
            throw std::invalid_argument("the scope does not fit into 128 bits");
        }
    }

    [[nodiscard]] const Scope& scope() const { return scope_; }

    [[nodiscard]] World initial() const {
        World world;
        for (int r = 0; r < scope_.robots; ++r) {
            const auto [next, durable] = Clock{robot_id(r), 0, limits_}.state();
            world.robots[index(r)] = {true, next, durable, durable, 0};
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
            if (robot.stored != robot.durable) visit(Action{flush, r});
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
                receive(world, action.robot, message);
                break;
            }
            case Action::Kind::lose:
                remove(world, action.message);
                break;
            case Action::Kind::duplicate:
                add(world, world.messages[index(action.message)]);
                break;
            case Action::Kind::flush:
                robot.stored = robot.durable;
                break;
            case Action::Kind::crash:
                if (scope_.budget) ++world.crashes;
                robot = {false, 0, 0, robot.stored, retained(robot)};
                break;
            case Action::Kind::restart: {
                const auto clock = Rules::resume(robot_id(action.robot), robot.stored, limits_);
                if (!clock) return "a clock does not come back from what it stored";
                robot.is_up = true;
                put(robot, *clock);
                break;
            }
            case Action::Kind::forge:
                ++world.forged;
                receive(world, action.robot, {action.value, forged_genes(world, action)});
                break;
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
        }
        put(static_cast<std::uint32_t>(world.message_count), 3);
        for (int m = 0; m < scope_.messages; ++m) {
            put(world.messages[index(m)].stamp, counter_bits_);
            put(world.messages[index(m)].genes, mark_bits_);
        }
        if (scope_.budget) {
            for (const int spent : {world.minted, world.crashes, world.forged}) {
                put(static_cast<std::uint32_t>(spent), budget_bits);
            }
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
        }
        world.message_count = static_cast<int>(take(3));
        for (int m = 0; m < scope_.messages; ++m) {
            world.messages[index(m)].stamp = take_counter();
            world.messages[index(m)].genes = take(mark_bits_);
        }
        if (scope_.budget) {
            for (int* const spent : {&world.minted, &world.crashes, &world.forged}) {
                *spent = static_cast<int>(take(budget_bits));
            }
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
                out << " stores counter " << int{world.robots[index(action.robot)].durable};
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

    /// The shipped clock, as `robot` has it.
    [[nodiscard]] Clock clock_of(const World& world, int robot) const {
        const RobotState& state = world.robots[index(robot)];
        return Clock::from_state(robot_id(robot), {state.next, state.durable}, limits_).value();
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
        if (scope_.budget) world.minted += action.value;
        return broken_promise(world);
    }

    void receive(World& world, int r, Message message) const {
        std::array<Mark, 32> genes;
        std::size_t size = 0;
        for_each_mark(message.genes, [&](Mark mark) { genes[size++] = mark; });
        Clock clock = clock_of(world, r);
        if (!Rules::merge(clock, {message.stamp}, {genes.data(), size})) return;
        put(world.robots[index(r)], clock);
        world.robots[index(r)].known |= message.genes;
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
            const int budget =
                1 + world.minted + scope_.block * world.crashes + scope_.window * world.forged;
            for (int r = 0; r < scope_.robots; ++r) {
                if (world.robots[index(r)].next > budget) return "a counter exceeds its budget";
            }
        }
        if (!scope_.check_invariants) return nullptr;
        for (int r = 0; r < scope_.robots; ++r) {
            const RobotState& robot = world.robots[index(r)];
            if (!robot.is_up) continue;
            if (robot.next < 1 || robot.next > robot.durable || robot.durable > scope_.maximum ||
                robot.stored > robot.durable) {
                return "a counter is out of its range";
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
    Clock::Limits limits_;
    int counters_;
    int counter_bits_;
    int mark_bits_;
};

}  // namespace gene_clocks::model
