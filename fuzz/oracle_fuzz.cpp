// Property, differential: the shipped clock and alignment give the answers of the proved ones,
// which run in this process, to any schedule of commands (tests/oracle/schedule.hpp). At 64 bits,
// or at 8 where the first byte says so.

#include <concepts>
#include <cstdint>
#include <limits>
#include <string>

#include "fuzz/byte_reader.hpp"
#include "fuzz/require.hpp"
#include "proofs/oracle/in_process.h"
#include "tests/oracle/replay.hpp"
#include "tests/oracle/schedule.hpp"

namespace {

using namespace gene_clocks;

/// The proved fleet takes time in proportion to its history for each command: many short schedules
/// find more than few long ones.
constexpr int most_commands = 150;

/// A fuzzer's bytes as draws; bounds beyond a byte take as many as they need.
class ByteDraws {
public:
    explicit ByteDraws(fuzz::ByteReader& bytes) : bytes_(bytes) {}
    std::uint64_t below(std::uint64_t bound) {
        return bound <= 256 ? bytes_.below(bound) : bytes_.word() % bound;
    }
    std::uint64_t word() { return bytes_.word(); }

private:
    fuzz::ByteReader& bytes_;
};

template <std::unsigned_integral Counter>
void compare(fuzz::ByteReader bytes) {
    test::Schedule schedule(ByteDraws(bytes), std::numeric_limits<Counter>::max());
    test::Replay<Counter> shipped;
    const auto both = [&](const std::string& command) {
        const std::string proved = gene_clocks_oracle_answer(command.c_str());
        const std::string answer = shipped.answer(test::words_of(command));
        if (answer != proved) {
            std::fprintf(stderr, "%s\n  proved:  %s\n  shipped: %s\n", command.c_str(),
                         proved.c_str(), answer.c_str());
        }
        GENE_CLOCKS_REQUIRE(answer == proved);
    };
    both(schedule.begin());
    for (int i = 0; i < most_commands && !bytes.empty(); ++i) both(schedule.command());
    for (const std::string& command : schedule.end()) both(command);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    [[maybe_unused]] static const bool started = (gene_clocks_oracle_start(), true);
    gene_clocks::fuzz::ByteReader bytes({data, size});
    if (bytes.byte() % 2 == 1) {
        compare<std::uint8_t>(bytes);
    } else {
        compare<std::uint64_t>(bytes);
    }
    return 0;
}
