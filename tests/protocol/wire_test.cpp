// The wire format against its test vectors, in C++ and in C; and every way to damage a frame.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <gene_clocks/wire.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/protocol/wire_in_c.h"
#include "tests/support/allocations.hpp"
#include "tests/support/marks.hpp"
#include "tests/support/property.hpp"
#include "tests/support/wire_messages.hpp"
#include "tests/support/wire_vectors.hpp"

namespace gene_clocks {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;
using kernel::gene_clocks_gene;
using test::from_hex;
using test::message_of;
using test::WireMessage;

const test::WireVectors& vectors() {
    static const test::WireVectors loaded = test::read_wire_vectors(GENE_CLOCKS_WIRE_VECTORS);
    return loaded;
}

std::vector<Bytes> valid_frames() {
    std::vector<Bytes> frames;
    for (const json& vector : vectors().all) {
        if (vector.contains("value"))
            frames.push_back(from_hex(vector["frame"].get<std::string>()));
    }
    return frames;
}

/// What the C header says of a frame, and what it writes if it reads it.
struct InC {
    int error;
    std::size_t offset;
    Bytes written;
};

InC transcode_in_c(const Bytes& frame, const WireLimits& limits) {
    const c_wire_limits c_limits{limits.frame_bytes, limits.genesis_count, limits.neurons,
                                 limits.connections, limits.energy,        limits.weight};
    InC result{0, 0, Bytes(frame.size())};
    std::size_t written = 0;
    result.error = c_transcode(frame.data(), frame.size(), &c_limits, result.written.data(),
                               result.written.size(), &written, &result.offset);
    result.written.resize(written);
    return result;
}

/// Whatever the bytes: C and C++ agree, and what is read is written as the very same bytes.
/// Returns the error, or nothing where the bytes are a frame.
std::optional<WireFault> check(const Bytes& bytes, const WireLimits& limits) {
    const auto message = test::decode_message(bytes, limits);
    const InC in_c = transcode_in_c(bytes, limits);
    if (!message) {
        EXPECT_EQ(static_cast<int>(message.fault().error), in_c.error);
        EXPECT_EQ(message.fault().offset, in_c.offset);
        EXPECT_LE(message.fault().offset, bytes.size());
        return message.fault();
    }
    EXPECT_EQ(in_c.error, 0);
    EXPECT_EQ(in_c.written, bytes);
    const auto again = test::encode_message(*message, limits);
    EXPECT_TRUE(again && *again == bytes);
    return std::nullopt;
}

TEST(Checksum, IsCrc32C) {
    const std::string_view digits = "123456789";
    const std::vector<std::pair<Bytes, std::uint32_t>> known{
        {{}, 0u},
        {Bytes(digits.begin(), digits.end()), 0xe3069283u},
        {Bytes(32, 0x00), 0x8a9136aau},  // the others: RFC 3720, appendix B.4
        {Bytes(32, 0xff), 0x62a8ab43u},
    };
    for (const auto& [bytes, sum] : known) {
        EXPECT_EQ(kernel::gene_clocks_crc32c(bytes.data(), bytes.size()), sum);
        EXPECT_EQ(kernel::gene_clocks_crc32c_by_tables(bytes.data(), bytes.size()), sum);
        EXPECT_EQ(c_crc32c(bytes.data(), bytes.size()), sum);
    }
}

// Which of the three this processor takes is its own affair.
GENE_CLOCKS_PROPERTY(Checksum, IsTheSameByHalfBytesByTablesAndByInstruction, (const Bytes& bytes)) {
    const std::uint32_t sum = c_crc32c(bytes.data(), bytes.size());
    RC_ASSERT(kernel::gene_clocks_crc32c(bytes.data(), bytes.size()) == sum);
    RC_ASSERT(kernel::gene_clocks_crc32c_by_tables(bytes.data(), bytes.size()) == sum);
}

TEST(WireVectors, AreReadAndWritten) {
    std::size_t valid = 0;
    std::set<std::string> errors;
    for (const json& vector : vectors().all) {
        SCOPED_TRACE(vector["name"].get<std::string>());
        const Bytes frame = from_hex(vector["frame"].get<std::string>());
        const auto fault = check(frame, vectors().limits);
        if (vector.contains("value")) {
            ++valid;
            ASSERT_FALSE(fault) << name_of(fault->error) << " at " << fault->offset;
            const WireMessage expected = message_of(vector["value"]);
            EXPECT_TRUE(
                test::same_message(*test::decode_message(frame, vectors().limits), expected));
            const auto written = test::encode_message(expected, vectors().limits);
            ASSERT_TRUE(written);
            EXPECT_EQ(*written, frame);
        } else {
            ASSERT_TRUE(fault);
            EXPECT_EQ(name_of(fault->error), vector["error"].get<std::string>());
            EXPECT_EQ(fault->offset, vector["offset"].get<std::size_t>());
            errors.emplace(name_of(fault->error));
        }
    }
    EXPECT_GE(valid, 15u);
    EXPECT_EQ(errors.size(), 19u) << "all errors but no_room";
}

TEST(WireDamage, ATruncatedFrameIsRefusedWhereverItEnds) {
    for (const Bytes& frame : valid_frames()) {
        for (std::size_t size = 0; size < frame.size(); ++size) {
            const auto fault =
                check(Bytes(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size)),
                      vectors().limits);
            ASSERT_TRUE(fault);
            EXPECT_EQ(fault->error, WireError::truncated) << name_of(fault->error);
        }
    }
}

TEST(WireDamage, ATruncatedPayloadIsRefusedWhereverItEnds) {
    for (const Bytes& whole : valid_frames()) {
        const auto frame = decode_frame(whole, vectors().limits);
        ASSERT_TRUE(frame);
        for (std::size_t size = 0; size < frame->payload.size(); ++size) {
            Frame shorter = *frame;
            shorter.payload = shorter.payload.first(size);
            Bytes buffer(whole.size());
            const auto written = encode_frame(shorter, buffer, vectors().limits);
            ASSERT_TRUE(written);
            const auto fault = check({written->begin(), written->end()}, vectors().limits);
            ASSERT_TRUE(fault);
            EXPECT_EQ(fault->error, WireError::truncated) << name_of(fault->error);
        }
    }
}

TEST(WireDamage, EveryFlippedBitIsNoticed) {
    std::size_t by_checksum = 0, flips = 0;
    for (const Bytes& frame : valid_frames()) {
        for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
            Bytes damaged = frame;
            damaged[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
            const auto fault = check(damaged, vectors().limits);
            ASSERT_TRUE(fault) << "bit " << bit;
            by_checksum += fault->error == WireError::checksum;
            ++flips;
        }
    }
    EXPECT_GT(by_checksum, flips / 2);
}

TEST(WireDamage, AFlippedBitUnderAMendedChecksumIsRefusedOrMeansSomethingElse) {
    std::set<WireError> errors;
    for (const Bytes& frame : valid_frames()) {
        const auto original = test::decode_message(frame, vectors().limits);
        for (std::size_t bit = 0; bit < 8 * (frame.size() - 4); ++bit) {
            Bytes damaged = frame;
            damaged[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
            test::mend_checksum(damaged);
            if (const auto fault = check(damaged, vectors().limits)) {
                errors.insert(fault->error);
                EXPECT_NE(fault->error, WireError::checksum);
            } else {
                const auto other = test::decode_message(damaged, vectors().limits);
                EXPECT_FALSE(test::same_message(*original, *other));
            }
        }
    }
    EXPECT_GE(errors.size(), 15u) << "the checks behind the checksum are reached";
}

TEST(WireDamage, TenMegabytesAreRefusedWithoutALook) {
    Bytes frame(10'000'000, 0x01);
    kernel::gene_clocks_wire_limits limits = WireLimits{}.kernel_limits();
    kernel::gene_clocks_frame out{1, 2, 3.0f, nullptr, 4};
    const auto fault = kernel::gene_clocks_decode_frame(frame.data(), frame.size(), &limits, &out);
    EXPECT_EQ(fault.error, kernel::gene_clocks_wire_too_long);
    EXPECT_EQ(fault.offset, 65'507u);
    // A null pointer would have been read, had anything been.
    EXPECT_EQ(kernel::gene_clocks_decode_frame(nullptr, 10'000'000, &limits, &out).error,
              kernel::gene_clocks_wire_too_long);
    EXPECT_EQ(out.stamp, 1u);
    EXPECT_EQ(out.sender, 2u);
}

TEST(WireDamage, ARefusedFrameLeavesTheOutputAlone) {
    const auto limits = vectors().limits.kernel_limits();
    for (const json& vector : vectors().all) {
        const Bytes bytes = from_hex(vector["frame"].get<std::string>());
        kernel::gene_clocks_frame frame{1, 2, 3.0f, nullptr, 4};
        if (kernel::gene_clocks_decode_frame(bytes.data(), bytes.size(), &limits, &frame).error) {
            EXPECT_TRUE(frame.stamp == 1 && frame.sender == 2 && frame.energy == 3.0f &&
                        frame.payload == nullptr && frame.payload_size == 4);
            continue;
        }
        kernel::gene_clocks_genome genome{1, 2, 3, 4};
        std::array<gene_clocks_gene, 24> genes{};
        std::array<std::uint32_t, GENE_CLOCKS_JOINED_WORDS(12)> joined{};
        if (kernel::gene_clocks_decode_genome(frame.payload, frame.payload_size, frame.stamp,
                                              &limits, &genome, genes.data(), joined.data())
                .error) {
            EXPECT_TRUE(genome.robot == 1 && genome.birth == 2 && genome.neurons == 3 &&
                        genome.connections == 4);
        }
    }
}

TEST(WireDamage, NothingIsAllocated) {
    const auto limits = vectors().limits.kernel_limits();
    std::array<gene_clocks_gene, 24> genes{};
    std::array<std::uint32_t, GENE_CLOCKS_JOINED_WORDS(12)> joined{};
    std::vector<Bytes> frames;
    for (const json& vector : vectors().all) {
        frames.push_back(from_hex(vector["frame"].get<std::string>()));
    }
    const test::AllocationCount before = test::allocations();
    for (const Bytes& bytes : frames) {
        const auto frame = decode_frame(bytes, vectors().limits);
        if (!frame) continue;
        kernel::gene_clocks_genome genome{};
        (void)kernel::gene_clocks_decode_genome(frame->payload.data(), frame->payload.size(),
                                                frame->stamp.value, &limits, &genome, genes.data(),
                                                joined.data());
    }
    EXPECT_EQ(test::allocations().count, before.count);
}

TEST(WireDamage, PairsThatMeetInOnePlaceAreScatteredByASalt) {
    constexpr std::uint16_t connections = 512;
    const auto checks_with = [](const kernel::gene_clocks_wire_limits& limits) {
        std::array<std::uint32_t, GENE_CLOCKS_JOINED_WORDS(connections)> joined;
        return kernel::gene_clocks_start_checks({0, 0, 0, connections}, 1, &limits, joined.data());
    };
    auto limits = WireLimits{}.kernel_limits();
    const auto unsalted = checks_with(limits);
    std::vector<std::uint32_t> pairs;
    for (std::uint32_t pair = 0; pairs.size() < connections; ++pair) {
        if (kernel::gene_clocks_place_of(&unsalted, pair) == 7) pairs.push_back(pair);
    }
    for (const std::uint32_t salt : {1u, 0x10u, 0x5eedu, 0x80000001u, 0xffffffffu}) {
        limits.salt = salt;
        const auto salted = checks_with(limits);
        std::set<std::uint32_t> places;
        for (const std::uint32_t pair : pairs) {
            places.insert(kernel::gene_clocks_place_of(&salted, pair));
        }
        EXPECT_GT(places.size(), 100u) << "salt " << salt;
        EXPECT_LE(*places.rbegin(), salted.joined_mask) << "salt " << salt;
    }
}

/// Looks that noting `pairs` takes in all, under a salt.
std::size_t looks(const std::vector<std::uint32_t>& pairs, std::uint32_t salt) {
    auto limits = WireLimits{}.kernel_limits();
    limits.salt = salt;
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(pairs.size()));
    const auto checks = kernel::gene_clocks_start_checks(
        {0, 0, 0, static_cast<std::uint16_t>(pairs.size())}, 1, &limits, joined.data());
    std::size_t looks = 0;
    for (const std::uint32_t pair : pairs) {
        std::uint32_t place = kernel::gene_clocks_place_of(&checks, pair);
        for (++looks; joined[place] != GENE_CLOCKS_NOT_JOINED; ++looks) {
            place = (place + 1) & checks.joined_mask;
        }
        joined[place] = pair;
    }
    return looks;
}

TEST(WireDamage, NoSaltIsBadForLayersAndStars) {
    constexpr std::uint32_t connections = 1024;
    std::vector<std::uint32_t> layers, into_one, out_of_one;
    for (std::uint32_t i = 0; i < connections; ++i) {
        layers.push_back(i / 32 << 16 | (i % 32 + 32));
        into_one.push_back(i << 16 | 2000);
        out_of_one.push_back(2u << 16 | i);
    }
    for (std::uint32_t salt = 0; salt < 2000; ++salt) {
        for (const auto* pairs : {&layers, &into_one, &out_of_one}) {
            ASSERT_LT(looks(*pairs, salt), 3 * connections) << "salt " << salt;
        }
    }
}

TEST(WireFrame, IsReadAndWrittenAtCompileTime) {
    constexpr bool is_same = [] {
        const std::array<std::uint8_t, 3> payload{1, 2, 3};
        std::array<std::uint8_t, 64> buffer{};
        const auto written = encode_frame({RobotId{7}, Stamp{300}, 1.5f, payload}, buffer);
        const auto frame = decode_frame(*written);
        return frame && frame->sender == RobotId{7} && frame->stamp == Stamp{300} &&
               frame->energy == 1.5f && frame->payload.size() == 3 && frame->payload[2] == 3;
    }();
    EXPECT_TRUE(is_same);
}

TEST(WireFrame, IsWrittenWhereItFitsAndNowhereElse) {
    const Bytes payload{1, 2, 3};
    const Frame frame{RobotId{7}, Stamp{300}, 1.5f, payload};
    Bytes exact(1 + 1 + 2 + 4 + 1 + 3 + 4, 0xee);
    for (std::size_t size = 0; size < exact.size(); ++size) {
        const auto refused = encode_frame(frame, std::span(exact).first(size));
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.fault().error, WireError::no_room);
        EXPECT_EQ(exact, Bytes(exact.size(), 0xee));
    }
    ASSERT_TRUE(encode_frame(frame, exact));
    EXPECT_EQ(Bytes(exact.begin() + 9, exact.begin() + 12), payload);
}

TEST(WireFrame, APayloadMayLieInTheBufferAtOrBehindItsPlace) {
    Bytes expected(40);
    const Bytes payload{1, 2, 3, 4, 5, 6, 7, 8, 9};
    const std::size_t size = encode_frame({RobotId{7}, Stamp{6}, 0.0f, payload}, expected)->size();
    constexpr std::size_t place = 8;
    for (std::size_t at = place; at <= frame_overhead_bytes; ++at) {
        Bytes buffer(40);
        std::copy(payload.begin(), payload.end(), buffer.begin() + static_cast<std::ptrdiff_t>(at));
        const auto written = encode_frame(
            {RobotId{7}, Stamp{6}, 0.0f, std::span(buffer).subspan(at, payload.size())}, buffer);
        ASSERT_TRUE(written);
        EXPECT_TRUE(std::equal(written->begin(), written->end(), expected.begin(),
                               expected.begin() + static_cast<std::ptrdiff_t>(size)));
    }
}

TEST(WireFrame, WhatWouldBeRefusedIsNotWritten) {
    const Bytes payload(10);
    const WireLimits limits{.frame_bytes = 30, .genesis_count = 5, .energy = 2.0f};
    const auto error_of = [&](Frame frame) {
        Bytes buffer(100);
        return encode_frame(frame, buffer, limits).fault().error;
    };
    EXPECT_EQ(error_of({genesis_robot, Stamp{6}, 0.0f, payload}), WireError::robot);
    EXPECT_EQ(error_of({RobotId{1}, Stamp{5}, 0.0f, payload}), WireError::stamp);
    EXPECT_EQ(error_of({RobotId{1}, Stamp{6}, 2.5f, payload}), WireError::energy);
    EXPECT_EQ(error_of({RobotId{1}, Stamp{6}, std::numeric_limits<float>::quiet_NaN(), payload}),
              WireError::energy);
    EXPECT_EQ(error_of({RobotId{1}, Stamp{6}, 0.0f, Bytes(19)}), WireError::too_long);
}

TEST(WireFrame, InfinityIsRefusedEvenUnderAnInfiniteLimit) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Bytes buffer(64);
    const WireLimits limits{.energy = infinity};
    EXPECT_TRUE(encode_frame({RobotId{1}, Stamp{6}, 1e38f, {}}, buffer, limits));
    const auto refused = encode_frame({RobotId{1}, Stamp{6}, infinity, {}}, buffer, limits);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.fault().error, WireError::energy);
}

TEST(WireGenome, NoMoreAndNoFewerGenesAreWrittenThanAnnounced) {
    for (const Bytes& frame : valid_frames()) {
        const WireMessage whole = *test::decode_message(frame, vectors().limits);
        for (const auto count :
             {&kernel::gene_clocks_genome::neurons, &kernel::gene_clocks_genome::connections}) {
            WireMessage message = whole;
            if (++(message.genome.*count) <= vectors().limits.neurons) {
                EXPECT_EQ(test::encode_message(message, vectors().limits).fault().error,
                          WireError::gene_count);
            }
            message = whole;
            if (message.genome.*count == 0) continue;
            --(message.genome.*count);
            EXPECT_EQ(test::encode_message(message, vectors().limits).fault().error,
                      WireError::gene_count);
        }
    }
}

TEST(WireGenome, AWriterWithoutRoomTellsHowMuchIsNeeded) {
    for (const Bytes& frame_bytes : valid_frames()) {
        const auto message = test::decode_message(frame_bytes, vectors().limits);
        const auto limits = vectors().limits.kernel_limits();
        std::array<std::uint32_t, GENE_CLOCKS_JOINED_WORDS(12)> joined{};
        kernel::gene_clocks_genome_writer writer{};
        ASSERT_FALSE(kernel::gene_clocks_begin_genome(&writer, nullptr, 0, message->genome,
                                                      message->stamp.value, &limits, joined.data())
                         .error);
        for (const auto& gene : message->genes) {
            ASSERT_FALSE(kernel::gene_clocks_put_gene(&writer, &gene).error);
        }
        EXPECT_EQ(kernel::gene_clocks_end_genome(&writer).error, kernel::gene_clocks_wire_no_room);
        EXPECT_EQ(writer.bytes.size, decode_frame(frame_bytes, vectors().limits)->payload.size());
    }
}

TEST(WireGenome, AKindThatThereIsNotIsNotWritten) {
    const auto limits = vectors().limits.kernel_limits();
    std::array<std::uint32_t, GENE_CLOCKS_JOINED_WORDS(12)> joined{};
    kernel::gene_clocks_genome_writer writer{};
    ASSERT_FALSE(kernel::gene_clocks_begin_genome(&writer, nullptr, 0, {1, 0, 3, 2}, 100, &limits,
                                                  joined.data())
                     .error);
    for (const int kind : {5, 7}) {
        const gene_clocks_gene gene{
            {1, 0}, static_cast<kernel::gene_clocks_gene_kind>(kind), false, false, {0, 0}, 0.0f};
        EXPECT_EQ(kernel::gene_clocks_put_gene(&writer, &gene).error,
                  kernel::gene_clocks_wire_kind);
    }
}

/// A valid message, of any size within the default limits that matters.
WireMessage draw_message(const WireLimits& limits) {
    WireMessage message;
    message.sender = RobotId{*rc::gen::inRange<std::uint32_t>(1, 200)};
    message.energy = std::bit_cast<float>(
        *rc::gen::suchThat(rc::gen::arbitrary<std::uint32_t>(),
                           [](std::uint32_t bits) { return (bits & 0x7f800000u) != 0x7f800000u; }));
    message.genome.robot = *rc::gen::nonZero<std::uint32_t>();
    message.genome.birth = *rc::gen::arbitrary<std::uint32_t>();

    kernel::gene_clocks_mark<std::uint64_t> mark{0, 0};
    std::set<std::pair<std::size_t, std::size_t>> joined;
    const auto inputs = *rc::gen::inRange<std::size_t>(0, 4);
    const auto outputs = *rc::gen::inRange<std::size_t>(1, 4);
    const auto add = [&](kernel::gene_clocks_gene_kind kind) {
        gene_clocks_gene gene{};
        gene.mark = mark;
        gene.kind = kind;
        message.genes.push_back(gene);
        ++message.genome.neurons;
    };
    const auto add_connection = [&] {
        const std::size_t neurons = message.genome.neurons;
        const auto source = *rc::gen::inRange<std::size_t>(0, neurons);
        const auto target = *rc::gen::inRange<std::size_t>(inputs + 1, neurons);
        if (!joined.insert({source, target}).second) return false;
        gene_clocks_gene gene{};
        gene.mark = mark;
        gene.kind = kernel::gene_clocks_connection;
        gene.is_enabled = *rc::gen::arbitrary<bool>();
        gene.is_recurrent = *rc::gen::arbitrary<bool>();
        gene.ends = {static_cast<std::uint16_t>(source), static_cast<std::uint16_t>(target)};
        gene.weight = *rc::gen::map(rc::gen::inRange(-1000, 1000),
                                    [](int number) { return static_cast<float>(number) / 97.0f; });
        message.genes.push_back(gene);
        ++message.genome.connections;
        return true;
    };
    for (std::size_t i = 0; i < inputs + 1 + outputs; ++i) {
        ++mark.counter;
        add(i < inputs    ? kernel::gene_clocks_input
            : i == inputs ? kernel::gene_clocks_bias
                          : kernel::gene_clocks_output);
    }
    while (mark.counter < limits.genesis_count && *rc::gen::arbitrary<bool>()) {
        ++mark.counter;
        add_connection();
    }
    mark.counter = limits.genesis_count;
    const auto others = *rc::gen::inRange<std::size_t>(0, 200);
    for (std::size_t i = 0; i < others; ++i) {
        const auto before = mark;
        mark.robot = *rc::gen::element<std::uint32_t>(1, 2, 127, 128, 4294967295u);
        const auto leap = *rc::gen::element<std::uint64_t>(0, 1, 1, 1, 2, 14, 15, 16, 142, 143,
                                                           std::uint64_t{1} << 50);
        mark.counter += leap;
        if (before.counter == limits.genesis_count && leap == 0) mark.counter += 1;
        if (!kernel::gene_clocks_less(before, mark)) ++mark.counter;
        if (*rc::gen::inRange(0, 3) == 0) {
            add(kernel::gene_clocks_hidden);
        } else if (!add_connection()) {
            mark = before;
        }
    }
    message.stamp = {mark.counter + 1 + *rc::gen::inRange<std::uint64_t>(0, 3)};
    return message;
}

GENE_CLOCKS_PROPERTY(WireProperty, TheSizeOfAFrameIsThatOfItsBytes, ()) {
    const auto of_any_length = [] {
        return *rc::gen::arbitrary<std::uint64_t>() >> *rc::gen::inRange(0, 64);
    };
    const std::vector<std::uint8_t> payload(*rc::gen::inRange<std::size_t>(0, 40'000));
    const Frame frame{RobotId{static_cast<std::uint32_t>(of_any_length() | 1)},
                      Stamp{of_any_length() | 1}, 1.0f, payload};
    std::vector<std::uint8_t> buffer(payload.size() + frame_overhead_bytes);
    const auto written = encode_frame(frame, buffer);
    RC_ASSERT(static_cast<bool>(written));
    RC_ASSERT(frame_bytes(frame.sender, frame.stamp, payload.size()) == written->size());
    kernel::gene_clocks_writer counting{};
    kernel::gene_clocks_put_varint(&counting, frame.stamp.value);
    RC_ASSERT(varint_bytes(frame.stamp.value) == counting.size);
}

GENE_CLOCKS_PROPERTY(WireProperty, WhatIsWrittenIsRead, ()) {
    const WireLimits limits{.genesis_count = 30};
    const WireMessage message = draw_message(limits);
    const auto frame = test::encode_message(message, limits);
    RC_ASSERT(static_cast<bool>(frame));
    const auto again = test::decode_message(*frame, limits);
    RC_ASSERT(static_cast<bool>(again));
    RC_ASSERT(test::same_message(*again, message));
    RC_TAG(message.genes.size() / 50 * 50);
}

GENE_CLOCKS_PROPERTY(WireProperty, WhatIsReadIsWrittenAsTheSameBytes, ()) {
    const WireLimits limits{.genesis_count = 30};
    auto frame = *test::encode_message(draw_message(limits), limits);
    const auto damages = *rc::gen::inRange(1, 4);
    for (int i = 0; i < damages; ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, frame.size() - 4);
        frame[at] = *rc::gen::arbitrary<std::uint8_t>();
    }
    test::mend_checksum(frame);
    const auto fault = check(frame, limits);
    RC_CLASSIFY(!fault, "still a frame");
    RC_ASSERT(!testing::Test::HasFailure());
}

}  // namespace
}  // namespace gene_clocks
