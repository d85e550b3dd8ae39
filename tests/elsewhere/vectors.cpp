// The wire format's test vectors on the processor that this runs on, in C++ and in C; and the bytes
// of a stored counter. For processors of another width and byte order than the builder's; so
// without the test framework, which would have to be built for each.
//
// Usage: vectors FILE
#include <cstdio>
#include <gene_clocks/stored_counter.hpp>
#include <string>

#include "tests/protocol/wire_in_c.h"
#include "tests/support/wire_vectors.hpp"

namespace {

using namespace gene_clocks;
using Bytes = std::vector<std::uint8_t>;

struct Outcome {
    WireFault fault{};
    bool is_frame = false;
    friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome in_cpp(const Bytes& bytes, const WireLimits& limits, const test::WireMessage* expected) {
    const auto message = test::decode_message(bytes, limits);
    if (!message) return {message.fault(), false};
    const auto again = test::encode_message(*message, limits);
    return {{}, expected && test::same_message(*message, *expected) && again && *again == bytes};
}

Outcome in_c(const Bytes& bytes, const WireLimits& limits) {
    const c_wire_limits c_limits{limits.frame_bytes, limits.genesis_count, limits.neurons,
                                 limits.connections, limits.energy,        limits.weight};
    Bytes written(bytes.size());
    std::size_t size = 0, offset = 0;
    const int error = c_transcode(bytes.data(), bytes.size(), &c_limits, written.data(),
                                  written.size(), &size, &offset);
    if (error) return {{static_cast<WireError>(error), offset}, false};
    return {{}, size == bytes.size() && written == bytes};
}

/// The bytes of the record that holds this counter of robot 7, as every machine must write them.
std::string record(std::uint64_t counter) {
    std::string text;
    char digits[3];
    for (const std::byte byte : write_record(RobotId{7}, counter)) {
        std::snprintf(digits, sizeof digits, "%02x", std::to_integer<unsigned>(byte));
        text += digits;
    }
    return text;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto vectors = test::read_wire_vectors(argv[1]);
    int wrong = 0, frames = 0;
    for (const auto& vector : vectors.all) {
        const Bytes bytes = test::from_hex(vector["frame"].get<std::string>());
        const bool is_frame = vector.contains("value");
        test::WireMessage expected;
        if (is_frame) expected = test::message_of(vector["value"]);
        const Outcome cpp = in_cpp(bytes, vectors.limits, is_frame ? &expected : nullptr);
        const bool is_right =
            is_frame ? cpp.is_frame
                     : name_of(cpp.fault.error) == vector["error"].get<std::string>() &&
                           cpp.fault.offset == vector["offset"].get<std::size_t>();
        frames += is_frame;
        if (is_right && in_c(bytes, vectors.limits) == cpp) continue;
        std::printf("wrong: %s\n", vector["name"].get<std::string>().c_str());
        ++wrong;
    }
    // From a machine of 64 bits, little endian.
    if (record(0x0102030405060708) != "47434c4b01000000070000000807060504030201456a8d2d") {
        std::printf("wrong: the record of a stored counter\n");
        ++wrong;
    }
    const auto refused = static_cast<int>(vectors.all.size()) - frames;
    if (frames < 10 || refused < 30) {
        std::printf("wrong: vectors are missing\n");
        ++wrong;
    }
    std::printf("%zu bits, %s endian: %d frames, %d refused, %d wrong\n", 8 * sizeof(void*),
                std::endian::native == std::endian::big ? "big" : "little", frames, refused, wrong);
    return wrong == 0 ? 0 : 1;
}
