// Property, differential: crossover, distance and a swarm of durable sources, gates and storage
// give what the proved ones give, which run in this process (tests/oracle). The first byte tells
// which.

#include <cstdint>
#include <cstdio>

#include "fuzz/byte_reader.hpp"
#include "fuzz/require.hpp"
#include "tests/oracle/operators.hpp"
#include "tests/oracle/swarm_comparison.hpp"

namespace {

using namespace gene_clocks;

/// The proved swarm takes time in proportion to its history for each step.
constexpr int most_steps = 150;

class ByteDraws {
public:
    explicit ByteDraws(fuzz::ByteReader& bytes) : bytes_(bytes) {}
    std::uint64_t below(std::uint64_t bound) {
        return bound <= 256 ? bytes_.below(bound) : bytes_.word() % bound;
    }
    std::uint64_t word() { return bytes_.word(); }
    bool empty() const { return bytes_.empty(); }

private:
    fuzz::ByteReader& bytes_;
};

void compare(fuzz::ByteReader& bytes) {
    if (bytes.byte() % 2 == 0) {
        test::SwarmComparison<ByteDraws>(ByteDraws(bytes)).run(most_steps);
        return;
    }
    test::OperatorComparison comparison(bytes.word());
    const std::size_t inputs = 1 + bytes.below(4);
    const std::size_t outputs = 1 + bytes.below(3);
    comparison.grow(inputs, outputs, bytes.byte());
    comparison.compare_all();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    [[maybe_unused]] static const bool started = (gene_clocks_oracle_start(), true);
    fuzz::ByteReader bytes({data, size});
    try {
        compare(bytes);
    } catch (const test::Disagreement& disagreement) {
        std::fprintf(stderr, "%s\n", disagreement.what());
        constexpr bool proved_and_shipped_agree = false;
        GENE_CLOCKS_REQUIRE(proved_and_shipped_agree);
    }
    return 0;
}
