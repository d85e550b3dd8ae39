// Writes random commands in the oracle's language.
//
// Usage: schedule 8|64 SEED COMMANDS        (width of a counter in bits)

#include "tests/oracle/schedule.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "tests/oracle/words.hpp"

namespace {

class Draws {
public:
    explicit Draws(std::uint64_t seed) : engine_{seed} {}
    std::uint64_t below(std::uint64_t bound) { return engine_() % bound; }
    std::uint64_t word() { return engine_(); }

private:
    std::mt19937_64 engine_;  // its sequence is the same everywhere, unlike the distributions'
};

/// Fleets with 10 to 119 commands each, until there are `commands`.
void write(std::uint64_t seed, std::uint64_t largest, std::size_t commands) {
    Draws lengths(seed + 1);
    gene_clocks::test::Schedule schedule(Draws(seed), largest);
    for (std::size_t written = 0; written < commands;) {
        fmt::print("{}\n", schedule.begin());
        const std::size_t length = 10 + lengths.below(110);
        for (std::size_t i = 0; i < length; ++i) fmt::print("{}\n", schedule.command());
        const auto end = schedule.end();
        for (const std::string& command : end) fmt::print("{}\n", command);
        written += 1 + length + end.size();
    }
}

}  // namespace

int main(int argc, char** argv) {
    using gene_clocks::test::number;
    try {
        if (argc != 4) throw std::invalid_argument("usage: schedule 8|64 SEED COMMANDS");
        const bool narrow = number<unsigned>(argv[1]) == 8;
        write(number<std::uint64_t>(argv[2]),
              narrow ? std::numeric_limits<std::uint8_t>::max()
                     : std::numeric_limits<std::uint64_t>::max(),
              number<std::size_t>(argv[3]));
    } catch (const std::exception& error) {
        fmt::print(stderr, "schedule: {}\n", error.what());
        return 2;
    }
}
