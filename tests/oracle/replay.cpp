// The shipped clock behind the oracle's language: commands from standard input, answers to standard
// output.
//
// Usage: replay 8|64        (width of a counter in bits)

#include "tests/oracle/replay.hpp"

#include <fmt/core.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

template <std::unsigned_integral Counter>
void replay() {
    gene_clocks::test::Replay<Counter> replay;
    std::string line;
    for (std::size_t at = 1; std::getline(std::cin, line); ++at) {
        try {
            fmt::print("{}\n", replay.answer(gene_clocks::test::words_of(line)));
        } catch (const std::exception& error) {
            throw std::runtime_error(fmt::format("line {}: {}", at, error.what()));
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::ios::sync_with_stdio(false);
    const std::string_view bits = argc == 2 ? argv[1] : "";
    try {
        if (bits == "8") {
            replay<std::uint8_t>();
        } else if (bits == "64") {
            replay<std::uint64_t>();
        } else {
            throw std::invalid_argument("usage: replay 8|64");
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "replay: {}\n", error.what());
        return 2;
    }
}
