// Writes random traces: runs of real clocks with losses, delays and crashes, every other one then
// damaged in one place.
//
// Usage: random_traces FOLDER SEED COUNT        writes FOLDER/0.trace, FOLDER/1.trace, ...

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <gene_clocks/gene_clock.hpp>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "protocol/trace/trace_writer.hpp"
#include "tests/oracle/words.hpp"

namespace gene_clocks::test {
namespace {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_{seed} {}
    std::uint64_t below(std::uint64_t bound) { return engine_() % bound; }
    bool chance(std::uint64_t percent) { return below(100) < percent; }
    template <class Choice>
    const Choice& pick(const std::vector<Choice>& options) {
        return options[below(options.size())];
    }

private:
    std::mt19937_64 engine_;  // its sequence is the same everywhere, unlike the distributions'
};

/// A fleet that keeps the protocol, and records what it does.
class Fleet {
public:
    explicit Fleet(Random& random)
        : random_{random},
          genesis_{random.below(5)},
          limits_{.maximum = random.chance(70) ? genesis_ + 5 + random.below(30)
                                               : std::numeric_limits<std::uint64_t>::max(),
                  .block = random.below(4),
                  .window = 2 + random.below(20)},
          writer_{out_, {limits_.maximum, limits_.window, genesis_}} {}

    std::string record() {
        const std::size_t steps = random_.below(60);
        for (std::size_t i = 0; i < steps; ++i) step();
        writer_.finish();
        return out_.str();
    }

private:
    struct Robot {
        GeneClock clock;
        std::uint64_t stored{};
    };

    void step() {
        const RobotId id = random_.pick(ids_);
        GeneClock fresh{id, genesis_, limits_};
        const std::uint64_t stored = fresh.durable_needed();
        Robot& robot = robots_.try_emplace(id, Robot{std::move(fresh), stored}).first->second;
        switch (random_.below(6)) {
            case 0:
                if (const auto marks = robot.clock.mint(random_.below(4))) writer_.minted(*marks);
                break;
            case 1:
            case 2:
                if (robot.stored < robot.clock.durable_needed()) {
                    robot.stored = robot.clock.durable_needed();
                    writer_.stored(id, robot.stored);
                }
                writer_.sent(id, robot.clock.stamp(), random_.below(robot.clock.stamp().value));
                messages_.push_back(robot.clock.stamp());
                break;
            case 3:
            case 4:
                if (!messages_.empty()) {
                    const std::uint64_t message = random_.below(messages_.size());
                    if (robot.clock.observe(messages_[message])) {
                        writer_.received(id, message, robot.clock.stamp());
                    }
                }
                break;
            default:
                robot.clock = GeneClock::restart(id, robot.stored, genesis_, limits_).value();
                writer_.restarted(id, robot.clock.stamp());
        }
    }

    Random& random_;
    std::uint64_t genesis_;
    GeneClock::Limits limits_;
    std::ostringstream out_;
    trace::TraceWriter writer_;
    const std::vector<RobotId> ids_{RobotId{1}, RobotId{2}, RobotId{7}, RobotId{0xffff'ffff}};
    std::map<RobotId, Robot> robots_;
    std::vector<Stamp> messages_;
};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// Mostly a change that leaves a line well formed, so that the rules are what finds it.
void damage_line(std::string& line, Random& random) {
    const auto words = words_of(line);
    const std::size_t which = random.below(words.size());
    const std::string word(words[which]);
    std::string other;
    if (word.find_first_not_of("0123456789") == std::string::npos && random.chance(90)) {
        const auto value = number<std::uint64_t>(word);
        other = random.chance(50)   ? std::to_string(value + 1)
                : random.chance(80) ? std::to_string(value - 1)
                                    : random.pick<std::string>({"0", "18446744073709551615"});
    } else {
        other = random.pick<std::string>(
            {"", "m", "s", "r", "w", "c", "end", "-1", "01", "x", "18446744073709551616", "7 7"});
    }
    const auto at = static_cast<std::size_t>(words[which].data() - line.data());
    line.replace(at, word.size(), other);
}

std::string damaged(const std::string& text, Random& random) {
    if (random.chance(5)) return text.substr(0, random.below(text.size()));
    auto lines = lines_of(text);
    const std::size_t which = random.below(lines.size());
    const auto place = lines.begin() + static_cast<std::ptrdiff_t>(which);
    switch (random.below(8)) {
        case 0:
            lines.erase(place);
            break;
        case 1:
            lines.insert(place, std::string(*place));
            break;
        case 2:
            std::swap(*place, lines[random.below(lines.size())]);
            break;
        case 3:
            lines.resize(which);
            break;
        default:
            damage_line(*place, random);
    }
    // Rarely does the count of entries stay the cause.
    if (!lines.empty() && lines.back().starts_with("end ") && random.chance(80)) {
        lines.back() = fmt::format("end {}", lines.size() < 3 ? 0 : lines.size() - 3);
    }
    std::string result;
    for (const std::string& line : lines) result += line + '\n';
    return result;
}

void write(const std::filesystem::path& folder, std::uint64_t seed, std::size_t count) {
    Random random(seed);
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < count; ++i) {
        std::string text = Fleet(random).record();
        if (i % 2 == 1) text = damaged(text, random);
        std::ofstream out(folder / fmt::format("{}.trace", i), std::ios::binary);
        if (!(out << text).flush()) throw std::runtime_error("cannot write to the folder");
    }
}

}  // namespace
}  // namespace gene_clocks::test

int main(int argc, char** argv) {
    using gene_clocks::test::number;
    try {
        if (argc != 4) throw std::invalid_argument("usage: random_traces FOLDER SEED COUNT");
        gene_clocks::test::write(argv[1], number<std::uint64_t>(argv[2]),
                                 number<std::size_t>(argv[3]));
    } catch (const std::exception& error) {
        fmt::print(stderr, "random_traces: {}\n", error.what());
        return 2;
    }
}
