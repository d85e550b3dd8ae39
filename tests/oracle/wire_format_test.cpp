// The shipped decoder and the proved one read the same messages off the same bytes, and refuse the
// same bytes: frames of genomes that have travelled, whole and damaged in up to four places, under
// a checksum of their own or none.
#include <gtest/gtest.h>

#include <gene_clocks/neat/message_codec.hpp>
#include <map>
#include <vector>

#include "tests/oracle/wire_answer.hpp"
#include "tests/support/travelled_genome.hpp"

namespace gene_clocks {
namespace {

using Bytes = std::vector<std::uint8_t>;

class Damage {
public:
    explicit Damage(neat::RandomStream& random) : random_(random) {}

    /// Changes, inserts, takes out or repeats a few bytes.
    void operator()(Bytes& bytes) {
        for (std::uint32_t times = random_.below(5); times > 0 && !bytes.empty(); --times) {
            const auto at = bytes.begin() + random_.below(size(bytes));
            switch (random_.below(5)) {
                case 0:
                    *at ^= static_cast<std::uint8_t>(1u << random_.below(8));
                    break;
                case 1:
                    *at = value();
                    break;
                case 2:
                    bytes.insert(at, value());
                    break;
                case 3:
                    bytes.erase(at);
                    break;
                default:
                    bytes.insert(at, *(bytes.begin() + random_.below(size(bytes))));
                    break;
            }
        }
    }

private:
    static std::uint32_t size(const Bytes& bytes) {
        return static_cast<std::uint32_t>(bytes.size());
    }
    /// Small numbers mean the most.
    std::uint8_t value() {
        return static_cast<std::uint8_t>(random_.below(2) == 0 ? random_.below(256)
                                                               : random_.below(32));
    }
    neat::RandomStream& random_;
};

TEST(WireFormat, ShippedAndProvedDecoderAgree) {
    gene_clocks_oracle_start();
    const auto initial = neat::make_initial_topology(2, 1);
    WireLimits limits = neat::wire_limits(*initial, {});
    limits.frame_bytes = 160;
    limits.neurons = 8;
    limits.connections = 14;
    neat::MessageCodec codec{initial, limits};
    neat::RandomStream random(7, 0);
    Damage damage(random);
    std::map<std::string, int> outcomes;
    constexpr int frames = 6000;
    for (int i = 0; i < frames; ++i) {
        const auto travelled =
            test::travelled_genome(2 + random.below(12), static_cast<std::uint64_t>(i), 2, 1);
        const auto sent = codec.encode(
            RobotId{1 + random.below(300)},
            {std::make_shared<const neat::Genome>(travelled.genome), 50.0f, travelled.stamp});
        ASSERT_TRUE(sent);
        Bytes frame(sent->begin(), sent->end());
        if (random.below(2) == 0) {
            damage(frame);
        } else {  // within the payload, whose length is then told right
            const auto whole = decode_frame(frame, limits);
            Bytes payload(whole->payload.begin(), whole->payload.end());
            damage(payload);
            Frame other = *whole;
            other.payload = payload;
            Bytes buffer(payload.size() + frame_overhead_bytes);
            const auto written = encode_frame(other, buffer);
            frame.assign(written->begin(), written->end());
        }
        if (random.below(10) != 0) test::mend_checksum(frame);
        const std::string shipped = test::shipped_answer(frame, limits);
        ASSERT_EQ(shipped, test::proved_answer(frame, limits)) << "frame " << i;
        const auto message = test::decode_message(frame, limits);
        ++outcomes[message ? "read" : std::string(name_of(message.fault().error))];
    }
    // Frames that no longer reach something would make this a test that cannot fail.
    EXPECT_GT(outcomes["read"], frames / 10);
    EXPECT_GE(outcomes.size(), 18u) << "reasons to refuse";
    for (const auto& [outcome, count] : outcomes) {
        RecordProperty(outcome, count);
    }
}

}  // namespace
}  // namespace gene_clocks
