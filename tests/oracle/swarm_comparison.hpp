#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <gene_clocks/neat/crossover.hpp>
#include <gene_clocks/neat/durable_gene_clock_source.hpp>
#include <gene_clocks/neat/mutation.hpp>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "tests/oracle/operators.hpp"

namespace gene_clocks::test {

/// A random stream as draws.
class StreamDraws {
public:
    explicit StreamDraws(std::uint64_t seed) : random_(seed, 0) {}
    std::uint64_t below(std::uint64_t bound) {
        return random_.below(static_cast<std::uint32_t>(bound));
    }
    std::uint64_t word() { return random_.bits(); }

private:
    neat::RandomStream random_;
};

/// Storage that keeps what it is given, where it works.
class FlakyStorage {
public:
    explicit FlakyStorage(std::uint64_t stored) : stored_{stored} {}
    StorageStatus store(std::uint64_t counter) {
        if (counter <= stored_) return {};
        if (!works) return {StorageError::device, 5};
        stored_ = counter;
        return {};
    }
    std::uint64_t stored() const { return stored_; }

    bool works = true;

private:
    std::uint64_t stored_;
};

/// Robots with the shipped DurableGeneClockSource, storage and gate that mutate, mate, send, hear
/// and crash; and the proved swarm (`operate` in proofs/theories/Genome.v) that does the same.
/// After each step they must agree on the robot's clock, storage and allowance, on what is on its
/// way, and on the marks of the newest genome. `Draws` has below(bound) and word().
template <class Draws>
class SwarmComparison {
public:
    explicit SwarmComparison(Draws draws) : draws_{std::move(draws)} {}

    /// One swarm of at most `steps` steps.
    void run(int steps) {
        begin();
        for (int step = 0; step < steps && !is_over(); ++step) act(draws_.below(robots_.size()));
    }

    /// How often each kind of thing happened.
    struct Reached {
        std::uint64_t grown = 0, exhausted = 0, mated = 0, sent = 0, held_back = 0;
        std::uint64_t admitted = 0, refused = 0, stored_beyond = 0, lost = 0;
    };
    const Reached& reached() const { return reached_; }

private:
    using Source = neat::DurableGeneClockSource<FlakyStorage>;

    struct Robot {
        RobotId id;
        std::unique_ptr<FlakyStorage> storage;
        std::unique_ptr<Source> source;
        std::vector<neat::Genome> held;
        std::uint32_t next_birth = 0;
    };
    struct Sent {
        Stamp stamp;
        neat::Genome genome;
    };

    bool is_over() const {
        if constexpr (requires { draws_.empty(); }) return draws_.empty();
        return false;
    }

    void begin() {
        robots_.clear();
        network_.clear();
        const std::size_t inputs = 1 + draws_.below(3);
        const std::size_t outputs = 1 + draws_.below(2);
        genesis_ = neat::genesis_mark_count(inputs, outputs);
        random_ = neat::RandomStream(draws_.word(), 0);
        limits_.maximum = draws_.below(2) == 0 ? genesis_ + 10 + draws_.below(60)
                                               : std::numeric_limits<std::uint64_t>::max();
        limits_.window = pick({3, 20, std::numeric_limits<std::uint64_t>::max()});
        compare_plain(fmt::format("swarm {} {} {}", limits_.maximum, limits_.window, genesis_),
                      "swarm");
        const auto topology = neat::make_initial_topology(inputs, outputs);
        for (const std::uint32_t id : {1u, 2u, 7u}) {
            robots_.push_back({RobotId{id}, std::make_unique<FlakyStorage>(genesis_ + 1), {}, {}});
            robots_.back().held.push_back(
                neat::make_initial_genome({RobotId{id}, 0}, topology, 10.0, random_));
            fail(robots_.back());
        }
    }

    void act(std::size_t index) {
        Robot& robot = robots_[index];
        const std::uint64_t kind = draws_.below(100);
        if (kind < 30) {
            grow(robot);
        } else if (kind < 40) {
            mate(robot);
        } else if (kind < 58) {
            tell(robot);
        } else if (kind < 84) {
            hear(robot, kind < 78);
        } else if (kind < 92) {
            robot.source->elapse();
            check(robot, fmt::format("wait {}", number(robot)));
        } else if (kind < 95) {
            robot.storage->works = !robot.storage->works;
        } else {
            fail(robot);
        }
    }

    void grow(Robot& robot) {
        const std::size_t parent = draws_.below(robot.held.size());
        const int genes = draws_.below(3) == 0 ? 3 : 1;
        neat::Genome genome = robot.held[parent];
        const bool has_room =
            limits_.maximum - robot.source->stamp().value >= static_cast<std::uint64_t>(genes);
        const bool grew =
            genes == 3 ? neat::add_neuron(genome, settings_, *robot.source, 0.0, random_)
                       : neat::add_connection(genome, settings_, *robot.source, 0.0, random_);
        if (!grew && has_room) return;  // the genome has no place for it
        if (grew) hold(robot, std::move(genome));
        ++(grew ? reached_.grown : reached_.exhausted);
        check(robot, fmt::format("grow {} {} {}", number(robot), parent, genes));
    }

    void mate(Robot& robot) {
        const std::size_t fitter = draws_.below(robot.held.size());
        const std::size_t weaker = draws_.below(robot.held.size());
        const neat::Genome& parent = robot.held[fitter];
        settings_.crossover =
            draws_.below(2) == 0 ? neat::CrossoverKind::uniform : neat::CrossoverKind::one_point;
        neat::Genome child =
            neat::crossover({}, {&parent, 2.0f}, {&robot.held[weaker], 1.0f}, settings_, random_);
        std::string left_out;
        for (const InnovationNumber mark : parent.topology->connection_marks) {
            if (!std::ranges::binary_search(child.topology->connection_marks, mark)) {
                left_out += fmt::format(" {} {}", mark.counter, number(mark.robot));
            }
        }
        hold(robot, std::move(child));
        ++reached_.mated;
        check(robot, fmt::format("mate {} {} {}{}", number(robot), fitter, weaker, left_out));
    }

    void tell(Robot& robot) {
        const std::size_t index = draws_.below(robot.held.size());
        const neat::Genome& genome = robot.held[index];
        const std::uint64_t needed = robot.source->stamp().value;
        // Genomes of others and of earlier lives have numbers that are stored already.
        const bool is_new =
            genome.id.robot == robot.id && genome.id.birth >= robot.source->first_birth();
        const std::uint32_t birth = is_new ? genome.id.birth : robot.source->first_birth();
        const auto stamp = robot.source->stamp_to_send(birth);
        compare_store(robot);
        if (!stamp) {
            ++reached_.held_back;
            return;
        }
        if (robot.storage->stored() > needed) ++reached_.stored_beyond;
        network_.push_back({*stamp, genome});
        ++reached_.sent;
        check(robot, fmt::format("tell {} {}", number(robot), index));
    }

    /// The write that the source has made, or none.
    void compare_store(Robot& robot) {
        check(robot, fmt::format("store {} {}", number(robot), robot.storage->stored()));
    }

    void hear(Robot& robot, bool with_genes) {
        if (network_.empty()) return;
        const std::size_t message = draws_.below(network_.size());
        const Sent& sent = network_[message];
        bool admitted = false;
        if (with_genes) {
            admitted = robot.source->admit(sent.stamp, sent.genome) == Admission::admitted;
            if (admitted) robot.held.push_back(sent.genome);
        } else {
            admitted = robot.source->observe(sent.stamp);
        }
        ++(admitted ? reached_.admitted : reached_.refused);
        check(robot,
              fmt::format("{} {} {}", with_genes ? "take" : "listen", number(robot), message));
    }

    /// A crash, after which the robot keeps the genomes that lie wholly below what was stored.
    void fail(Robot& robot) {
        limits_.block = pick({0, 1, 9});
        const AdmissionGate::Policy policy{.allowance = pick({2, 10, limits_.maximum}),
                                           .per_cycle = pick({0, 1, 5})};
        robot.source = Source::restart(robot.id, *robot.storage, genesis_, limits_, policy);
        if (!robot.source) throw std::logic_error("a source does not come back");
        robot.next_birth = robot.source->first_birth();
        reached_.lost += std::erase_if(robot.held, [&](const neat::Genome& genome) {
            return std::ranges::any_of(marks_of(genome), [&](InnovationNumber mark) {
                return mark.counter >= robot.storage->stored();
            });
        });
        check(robot,
              fmt::format("fail {} {} {} {} {}", number(robot), limits_.block, policy.allowance,
                          policy.per_cycle, std::numeric_limits<std::uint64_t>::max()));
    }

    void hold(Robot& robot, neat::Genome genome) {
        genome.id = {robot.id, robot.next_birth++};
        robot.held.push_back(std::move(genome));
    }

    void check(const Robot& robot, const std::string& command) {
        std::string shipped =
            fmt::format("{} {} {} | {} messages", robot.source->stamp().value,
                        robot.storage->stored(), robot.source->gate().allowance(), network_.size());
        if (!network_.empty()) shipped += fmt::format(", the last {}", network_.back().stamp.value);
        shipped += fmt::format(" | {} genomes, the last", robot.held.size());
        for (const InnovationNumber mark : marks_of(robot.held.back())) {
            shipped += fmt::format(" {},{}", mark.counter, number(mark.robot));
        }
        compare_plain(command, shipped);
    }
    static void compare_plain(const std::string& command, const std::string& shipped) {
        test::compare(command, shipped);
    }

    static std::vector<InnovationNumber> marks_of(const neat::Genome& genome) {
        std::vector<InnovationNumber> marks = genome.topology->connection_marks;
        for (const neat::NeuronGene& neuron : genome.topology->neurons) {
            marks.push_back(neuron.mark);
        }
        std::ranges::sort(marks);
        return marks;
    }
    static std::uint32_t number(RobotId id) { return static_cast<std::uint32_t>(id); }
    static std::uint32_t number(const Robot& robot) { return number(robot.id); }
    std::uint64_t pick(std::initializer_list<std::uint64_t> options) {
        return options.begin()[draws_.below(options.size())];
    }

    Draws draws_;
    neat::RandomStream random_{0, 0};
    neat::OdneatSettings settings_;
    GeneClock::Limits limits_;
    std::uint64_t genesis_ = 0;
    std::vector<Robot> robots_;
    std::vector<Sent> network_;
    Reached reached_;
};

}  // namespace gene_clocks::test
