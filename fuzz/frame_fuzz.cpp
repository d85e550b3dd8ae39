// Property: whatever bytes arrive, decoding ends with a frame or with a fault that lies within
// them; a frame is written again as the very same bytes, and its payload lies within them. The same
// with the checksum mended, so that what is behind it is reached.

#include <gene_clocks/wire.hpp>
#include <vector>

#include "fuzz/require.hpp"
#include "tests/support/wire_messages.hpp"

namespace {

using namespace gene_clocks;

void check(const std::vector<std::uint8_t>& bytes, const WireLimits& limits) {
    const auto frame = decode_frame(bytes, limits);
    if (!frame) {
        GENE_CLOCKS_REQUIRE(frame.fault().offset <= bytes.size());
        return;
    }
    GENE_CLOCKS_REQUIRE(bytes.size() <= limits.frame_bytes);
    GENE_CLOCKS_REQUIRE(frame->payload.data() >= bytes.data());
    GENE_CLOCKS_REQUIRE(frame->payload.data() + frame->payload.size() + 4 ==
                        bytes.data() + bytes.size());
    GENE_CLOCKS_REQUIRE(frame->sender != genesis_robot);
    GENE_CLOCKS_REQUIRE(frame->stamp.value > limits.genesis_count);
    GENE_CLOCKS_REQUIRE(frame->energy >= -limits.energy && frame->energy <= limits.energy);
    std::vector<std::uint8_t> buffer(bytes.size());
    const auto written = encode_frame(*frame, buffer, limits);
    GENE_CLOCKS_REQUIRE(written && written->size() == bytes.size() && buffer == bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // A copy of exactly this size, so that AddressSanitizer sees a byte too far.
    std::vector<std::uint8_t> bytes(data, data + size);
    bytes.shrink_to_fit();
    const WireLimits limits{.frame_bytes = 256, .genesis_count = 5, .energy = 200.0f};
    check(bytes, limits);
    test::mend_checksum(bytes);
    check(bytes, limits);
    return 0;
}
