// Writes random commands in the oracle's language: robots that mint, send, hear what was sent once,
// twice, late or never, store, crash at every point, and are sent forgeries.
//
// Usage: schedule 8|64 SEED COMMANDS        (width of a counter in bits)

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "words.hpp"

namespace gene_clocks::test {
namespace {

using Mark = std::pair<std::uint64_t, std::uint32_t>;  // counter, robot

class Schedule {
public:
    Schedule(std::uint64_t seed, std::uint64_t largest) : random_{seed}, largest_{largest} {}

    /// One scenario: limits, commands, and at last what every robot knows. Returns its length.
    std::size_t write() {
        begin();
        const std::size_t commands = 10 + below(110);
        for (std::size_t i = 0; i < commands; ++i) write_command();
        for (const std::uint32_t robot : robots_) fmt::print("known {}\n", robot);
        return commands + robots_.size() + 1;
    }

private:
    void begin() {
        // Mostly so little room that the maximum is met, else the type's own limit.
        maximum_ = chance(60) ? 5 + below(40) : largest_ - (chance(50) ? 0 : below(5));
        genesis_ = below(chance(80) ? 3 : std::min<std::uint64_t>(maximum_, 30));
        const std::uint64_t block = pick({0, 0, 1, 3, 16, maximum_, largest_});
        const std::uint64_t window = pick({0, 2, 5, 10, 100, maximum_, largest_});
        fmt::print("limits {} {} {} {}\n", maximum_, std::min(block, largest_),
                   std::min(window, largest_), genesis_);
        robots_ = {1, 2, 7, std::numeric_limits<std::uint32_t>::max()};
        robots_.resize(1 + below(robots_.size()));
        messages_ = 0;
    }

    void write_command() {
        const std::uint32_t robot = pick(robots_);
        const std::uint64_t kind = below(100);
        if (kind < 24) {
            fmt::print("mint {} {}\n", robot,
                       chance(90) ? pick({0, 1, 1, 1, 2, 3, 3, 5}) : pick({maximum_, largest_}));
        } else if (kind < 36) {
            fmt::print("flush {}\n", robot);
        } else if (kind < 54) {
            fmt::print("send {}{}\n", robot, words(genes(5)));
            ++messages_;  // or fewer, where the robot was not allowed to
        } else if (kind < 76) {
            fmt::print("receive {} {}\n", robot, below(messages_ + 1));
        } else if (kind < 84) {
            fmt::print("inject {} {}{}\n", robot, counter(), words(genes(2)));
        } else if (kind < 90) {
            fmt::print("persist {} {}\n", robot, counter());
        } else if (kind < 96) {
            fmt::print("crash {}\n", robot);
        } else {
            fmt::print("align{} /{}\n", words(genome()), words(genome()));
        }
    }

    /// Where clocks are soon, around the maximum, or anywhere.
    std::uint64_t counter() {
        const std::uint64_t kind = below(10);
        if (kind < 6) return std::min(largest_, genesis_ + below(20));
        if (kind < 7) return maximum_ - below(std::min<std::uint64_t>(maximum_, 4));
        if (kind < 8) return std::min(largest_ - 4, maximum_) + below(5);
        return largest_ == std::numeric_limits<std::uint64_t>::max() ? random_()
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

    std::uint64_t below(std::uint64_t bound) { return random_() % bound; }
    bool chance(std::uint64_t percent) { return below(100) < percent; }
    std::uint64_t pick(std::initializer_list<std::uint64_t> options) {
        return options.begin()[below(options.size())];
    }
    std::uint32_t pick(const std::vector<std::uint32_t>& options) {
        return options[below(options.size())];
    }

    std::mt19937_64 random_;  // its sequence is the same everywhere, unlike the distributions'
    std::uint64_t largest_;   ///< that a counter can hold
    std::uint64_t maximum_{};
    std::uint64_t genesis_{};
    std::vector<std::uint32_t> robots_;
    std::uint64_t messages_{};
};

}  // namespace
}  // namespace gene_clocks::test

int main(int argc, char** argv) {
    using gene_clocks::test::number;
    try {
        if (argc != 4) throw std::invalid_argument("usage: schedule 8|64 SEED COMMANDS");
        const bool narrow = number<unsigned>(argv[1]) == 8;
        gene_clocks::test::Schedule schedule{number<std::uint64_t>(argv[2]),
                                             narrow ? std::numeric_limits<std::uint8_t>::max()
                                                    : std::numeric_limits<std::uint64_t>::max()};
        const auto commands = number<std::size_t>(argv[3]);
        for (std::size_t written = 0; written < commands;) written += schedule.write();
    } catch (const std::exception& error) {
        fmt::print(stderr, "schedule: {}\n", error.what());
        return 2;
    }
}
