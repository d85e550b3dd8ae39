// Property: whatever payload arrives in a frame, decoding ends with a genome or with a fault within
// it. What is read is written again as the very same bytes; what odNEAT's codec reads is a valid
// genome, and what it refuses beyond that is only a genome with other initial genes.

#include <algorithm>
#include <gene_clocks/neat/message_codec.hpp>
#include <vector>

#include "fuzz/byte_reader.hpp"
#include "fuzz/require.hpp"
#include "tests/support/wire_messages.hpp"

namespace {

using namespace gene_clocks;

const std::shared_ptr<const neat::Topology>& initial() {
    static const auto topology = neat::make_initial_topology(2, 1);
    return topology;
}

constexpr std::uint16_t gene_limit = 24;

WireLimits limits() {
    WireLimits limits = neat::wire_limits(*initial(), {});
    limits.neurons = limits.connections = gene_limit;
    return limits;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::ByteReader bytes({data, size});
    // The first byte picks a stamp: few genes below it, many, or all.
    const std::uint8_t choice = bytes.byte();
    const Stamp stamp{choice < 200 ? 6u + choice : UINT64_MAX};
    const std::vector<std::uint8_t> payload(data + std::min<std::size_t>(size, 1), data + size);
    std::vector<std::uint8_t> frame(payload.size() + frame_overhead_bytes);
    const auto written = encode_frame({RobotId{1}, stamp, 1.0f, payload}, frame, limits());
    if (!written) return 0;  // longer than a frame may be
    frame.resize(written->size());
    frame.shrink_to_fit();

    const auto message = test::decode_message(frame, limits());
    static neat::MessageCodec codec{initial(), limits()};
    const auto received = codec.decode(frame);
    if (!message) {
        GENE_CLOCKS_REQUIRE(message.fault().offset <= frame.size());
        // The codec refuses no later. It may refuse earlier, for initial genes of another fleet.
        GENE_CLOCKS_REQUIRE(!received);
        GENE_CLOCKS_REQUIRE(received.fault() == message.fault() ||
                            received.fault().error == WireError::genesis);
        return 0;
    }
    const auto again = test::encode_message(*message, limits());
    GENE_CLOCKS_REQUIRE(again && *again == frame);
    if (!received) {
        GENE_CLOCKS_REQUIRE(received.fault().error == WireError::genesis);
        return 0;
    }
    GENE_CLOCKS_REQUIRE(!neat::find_fault(*received->message.genome, 10.0));
    const auto sent = codec.encode(received->sender, received->message);
    GENE_CLOCKS_REQUIRE(sent && std::equal(sent->begin(), sent->end(), frame.begin(), frame.end()));
    return 0;
}
