// Property, differential: the shipped decoder of the wire format reads what the proved one reads,
// which runs in this process, and refuses what it refuses. The checksum is mended, or nothing
// behind it would be reached.

#include <cstdint>
#include <vector>

#include "fuzz/require.hpp"
#include "tests/oracle/wire_answer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gene_clocks;
    [[maybe_unused]] static const bool started = (gene_clocks_oracle_start(), true);
    std::vector<std::uint8_t> frame(data, data + size);
    test::mend_checksum(frame);
    const WireLimits limits{.frame_bytes = 400,
                            .genesis_count = 5,
                            .neurons = 12,
                            .connections = 12,
                            .energy = 200.0f,
                            .weight = 10.0f};
    const std::string shipped = test::shipped_answer(frame, limits);
    const std::string proved = test::proved_answer(frame, limits);
    if (shipped != proved) {
        std::fprintf(stderr, "proved:  %s\nshipped: %s\n", proved.c_str(), shipped.c_str());
    }
    GENE_CLOCKS_REQUIRE(shipped == proved);
    return 0;
}
