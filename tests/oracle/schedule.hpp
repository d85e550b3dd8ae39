#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gene_clocks::test {

/// Draws commands in the oracle's language (proofs/oracle/protocol.ml): robots that mint, send,
/// hear what was sent once, twice, late or never, with its genes or without, store what is needed
/// or more, crash at every point, come back with and without a gate, and are sent forgeries.
///
/// `Draws` has below(bound), a number in [0, bound), and word(), any 64 bits.
template <class Draws>
class Schedule {
public:
    /// `largest`: the largest value that a counter can hold.
    Schedule(Draws draws, std::uint64_t largest) : draws_{std::move(draws)}, largest_{largest} {}

    /// Draws the limits of a new fleet; the command that sets them.
    std::string begin() {
        // Mostly so little room that the maximum is met, else the type's own limit.
        maximum_ = chance(60) ? 5 + below(40) : largest_ - (chance(50) ? 0 : below(5));
        genesis_ = below(chance(80) ? 3 : std::min<std::uint64_t>(maximum_, 30));
        const std::uint64_t block = pick({0, 0, 1, 3, 16, maximum_, largest_});
        const std::uint64_t window = pick({0, 2, 5, 10, 100, maximum_, largest_});
        robots_ = {1, 2, 7, std::numeric_limits<std::uint32_t>::max()};
        robots_.resize(1 + below(robots_.size()));
        messages_ = 0;
        return fmt::format("limits {} {} {} {}", maximum_, std::min(block, largest_),
                           std::min(window, largest_), genesis_);
    }

    std::string command() {
        const std::uint32_t robot = pick(robots_);
        const std::uint64_t kind = below(100);
        // Draws are named one by one: the order of arguments' evaluation differs among compilers.
        if (kind < 22) {
            const std::uint64_t count =
                chance(90) ? pick({0, 1, 1, 1, 2, 3, 3, 5}) : pick({maximum_, largest_});
            return fmt::format("mint {} {}", robot, count);
        }
        if (kind < 32) return fmt::format("flush {}", robot);
        if (kind < 47) {
            ++messages_;  // or fewer, where the robot is not allowed to
            return fmt::format("send {}{}", robot, words(genes(5)));
        }
        if (kind < 64) return fmt::format("receive {} {}", robot, below(messages_ + 1));
        if (kind < 68) return fmt::format("overhear {} {}", robot, below(messages_ + 1));
        if (kind < 78) {
            const std::uint64_t stamp = counter();
            return fmt::format("inject {} {}{}", robot, stamp, words(genes(2)));
        }
        if (kind < 83) return fmt::format("persist {} {}", robot, counter());
        if (kind < 88) return fmt::format("elapse {}", robot);
        if (kind < 94) return crash(robot);
        if (kind < 96) {
            const std::uint64_t next = counter();
            return fmt::format("snapshot {} {}", next, counter());
        }
        const std::string first = words(genome());
        return fmt::format("align{} /{}", first, words(genome()));
    }

    /// The commands that show all that every robot knows.
    std::vector<std::string> end() const {
        std::vector<std::string> commands;
        for (const std::uint32_t robot : robots_) {
            commands.push_back(fmt::format("known {}", robot));
        }
        return commands;
    }

private:
    using Mark = std::pair<std::uint64_t, std::uint32_t>;  // counter, robot

    /// A block, and in most lives a gate, of the robot's own.
    std::string crash(std::uint32_t robot) {
        const std::uint64_t block = std::min(largest_, pick({0, 1, 3, 16, maximum_, largest_}));
        if (chance(30)) return fmt::format("crash {} {}", robot, block);
        const std::uint64_t allowance = std::min(largest_, pick({0, 1, 3, 10, largest_}));
        const std::uint64_t per_cycle = std::min(largest_, pick({0, 1, 4, largest_}));
        return fmt::format("crash {} {} {} {} {}", robot, block, allowance, per_cycle, largest_);
    }

    /// Where clocks are soon, around the maximum, or anywhere.
    std::uint64_t counter() {
        const std::uint64_t kind = below(10);
        if (kind < 6) return std::min(largest_, genesis_ + below(20));
        if (kind < 7) return maximum_ - below(std::min<std::uint64_t>(maximum_, 4));
        if (kind < 8) return std::min(largest_ - 4, maximum_) + below(5);
        return largest_ == std::numeric_limits<std::uint64_t>::max() ? draws_.word()
                                                                     : below(largest_ + 1);
    }

    std::vector<Mark> genes(std::size_t most) {
        std::vector<Mark> result(below(most + 1));
        for (auto& [counter, robot] : result) {
            counter = this->counter();
            robot = chance(10) ? 0 : pick(robots_);
        }
        return result;
    }

    std::vector<Mark> genome() {
        std::set<Mark> marks;
        for (const Mark& gene : genes(10)) marks.insert({gene.first % 12, gene.second});
        return {marks.begin(), marks.end()};
    }

    static std::string words(const std::vector<Mark>& marks) {
        std::string text;
        for (const auto& [counter, robot] : marks) text += fmt::format(" {} {}", counter, robot);
        return text;
    }

    std::uint64_t below(std::uint64_t bound) { return draws_.below(bound); }
    bool chance(std::uint64_t percent) { return below(100) < percent; }
    std::uint64_t pick(std::initializer_list<std::uint64_t> options) {
        return options.begin()[below(options.size())];
    }
    std::uint32_t pick(const std::vector<std::uint32_t>& options) {
        return options[below(options.size())];
    }

    Draws draws_;
    std::uint64_t largest_;
    std::uint64_t maximum_{};
    std::uint64_t genesis_{};
    std::vector<std::uint32_t> robots_;
    std::uint64_t messages_{};
};

}  // namespace gene_clocks::test
