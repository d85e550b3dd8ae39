#include "sim/experiment/store/run_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xxhash.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/experiment/store/store.hpp"
#include "tests/sim/experiment/example_study.hpp"

namespace gene_clocks::experiment {
namespace {

using nlohmann::json;

/// Every field of a message has a value of its own, other than that of an empty message.
RunMessage example_message() {
    const Study study = test::example_study();
    RunRecord record = test::example_run(study.arms[0], 4);
    std::uint64_t next = 1000;
    for_each_measure(record.result.chronology, [&](const char*, auto& measure) {
        measure = static_cast<std::remove_cvref_t<decltype(measure)>>(++next);
    });
    record.result.samples[1].swarm_fitness = 0.1 + 0.2;
    record.result.samples[2].swarm_fitness = -0.0;
    record.result.samples[3].swarm_fitness = std::numeric_limits<double>::infinity();
    record.result.samples[4].cycle = -7;
    return {study.arms[0].settings_hash, 0xffff'ffff'ffff'fffe, record.result, 0.125};
}

std::vector<std::uint8_t> with_hash(const json& value) {
    std::vector<std::uint8_t> bytes(8);
    json::to_cbor(value, bytes);
    const std::uint64_t hash = XXH3_64bits(bytes.data() + 8, bytes.size() - 8);
    std::memcpy(bytes.data(), &hash, sizeof hash);
    return bytes;
}

json value_of(const RunMessage& message) {
    const auto bytes = encode(message);
    return json::from_cbor(bytes.begin() + 8, bytes.end());
}

TEST(RunMessage, ArrivesAsItWasSent) {
    const RunMessage sent = example_message();
    const RunMessage received = decode(encode(sent));
    EXPECT_EQ(received.settings_hash, sent.settings_hash);
    EXPECT_EQ(received.seed, sent.seed);
    EXPECT_EQ(received.wall_seconds, sent.wall_seconds);
    EXPECT_EQ(received.result.trajectory_hash, sent.result.trajectory_hash);
    ASSERT_EQ(received.result.samples.size(), 20U);
    EXPECT_EQ(received.result.samples[1].swarm_fitness, 0.1 + 0.2);
    EXPECT_TRUE(std::signbit(received.result.samples[2].swarm_fitness));
    EXPECT_TRUE(std::isinf(received.result.samples[3].swarm_fitness));
    EXPECT_EQ(received.result.samples[4].cycle, -7);
    EXPECT_EQ(received.result.counters.births, sent.result.counters.births);
    EXPECT_EQ(received.result.creations[1].mark.counter, ~std::uint64_t{4});
    EXPECT_EQ(received.result.chronology.bytes_sent, sent.result.chronology.bytes_sent);
    // All of it: whatever is sent arrives as it was sent.
    EXPECT_EQ(encode(received), encode(sent));
}

// Were a field of the measures left out of for_each_measure, it would not be sent.
TEST(RunMessage, HasAllMeasuresOfChronology) {
    std::size_t bytes = 0;
    for_each_measure(sim::ChronologyMeasures{},
                     [&](const char*, const auto& measure) { bytes += sizeof measure; });
    EXPECT_EQ(bytes, sizeof(sim::ChronologyMeasures));
}

TEST(RunMessage, IsRefusedWhereverItIsCutOrChanged) {
    const auto bytes = encode(example_message());
    EXPECT_LT(bytes.size(), 2500U);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        ASSERT_THROW(decode(std::span(bytes).first(size)), std::runtime_error) << size;
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        auto changed = bytes;
        changed[i] ^= 0x10;
        ASSERT_THROW(decode(changed), std::runtime_error) << i;
    }
    auto longer = bytes;
    longer.push_back(0);
    EXPECT_THROW(decode(longer), std::runtime_error);
}

TEST(RunMessage, IsRefusedWhereItIsNoRun) {
    const json good = value_of(example_message());
    EXPECT_NO_THROW(decode(with_hash(good)));
    const auto refused = [&](const std::string& pointer, const json& value) {
        json changed = good;
        changed[json::json_pointer(pointer)] = value;
        EXPECT_THROW(decode(with_hash(changed)), std::runtime_error) << pointer << " " << value;
    };
    refused("/0", 2);                          // another format
    refused("/1", "0.0.0");                    // another program
    refused("/3", 0);                          // one too many
    refused("/2/0", 3);                        // text
    refused("/2/1", -1);                       // unsigned
    refused("/2/1", 1.0);                      // integer
    refused("/2/3", 1);                        // real
    refused("/2/4", 1);                        // one too many
    refused("/2/2/0", json::object());         // samples
    refused("/2/2/0/0/0", ~std::uint64_t{0});  // signed
    refused("/2/2/0/0", json::array({1}));
    refused("/2/2/1/0", nullptr);
    refused("/2/2/2/0", 0.5);
    refused("/2/2/3/0/1", std::uint64_t{1} << 32U);  // a robot's number has 32 bits
    EXPECT_THROW(decode(with_hash(json::object())), std::runtime_error);
    EXPECT_THROW(decode(with_hash(json::array())), std::runtime_error);
}

}  // namespace
}  // namespace gene_clocks::experiment
