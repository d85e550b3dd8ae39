// No robot speaks as another, none is shut out by another, and nothing is taken twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <gene_clocks/authentication/sealed_frames.hpp>
#include <gene_clocks/authentication/signed_frames.hpp>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "tests/support/property.hpp"

namespace gene_clocks::authentication {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The first key of RFC 8032, section 7.1.
constexpr SigningKey key_of_seven{0x9d, 0x61, 0xb1, 0x9d, 0xef, 0xfd, 0x5a, 0x60, 0xba, 0x84, 0x4a,
                                  0xf4, 0x92, 0xec, 0x2c, 0xc4, 0x44, 0x49, 0xc5, 0x69, 0x7b, 0x32,
                                  0x69, 0x19, 0x70, 0x3b, 0xac, 0x03, 0x1c, 0xae, 0x7f, 0x60};
constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

SigningKey key_of(std::uint8_t seed) {
    SigningKey key{};
    key[0] = seed;
    return key;
}

Bytes frame_of(std::uint32_t sender, Stamp stamp = {6}) {
    const Bytes payload{1, 2, 3};
    Bytes buffer(64);
    const auto frame = encode_frame({RobotId{sender}, stamp, 1.0f, payload}, buffer);
    return {frame->begin(), frame->end()};
}

Bytes sign(Signer& signer, const Bytes& frame) {
    const auto bytes = signer.sign(frame);
    return {bytes->begin(), bytes->end()};
}

std::string outcome(Verifier& verifier, const Bytes& bytes) {
    constexpr const char* names[] = {"forged",  "malformed",        "replayed",
                                     "too old", "too many senders", "unknown sender"};
    const auto opened = verifier.open(bytes);
    if (const auto* refusal = std::get_if<Refusal>(&opened)) {
        return names[static_cast<int>(*refusal)];
    }
    return "opened";
}

/// Robots 7, 8 and 9, the last of whom may do as it likes; 10 is not in the list.
class SignedFrames : public testing::Test {
protected:
    static Signer signer(const SigningKey& key, std::uint64_t last_number = 0) {
        return Signer{key, GeneClock{RobotId{1}, last_number}};
    }
    static Verifier::Directory directory() {
        return {{RobotId{7}, verifying_key(key_of_seven)},
                {RobotId{8}, verifying_key(key_of(8))},
                {RobotId{9}, verifying_key(key_of(9))}};
    }

    Signer seven_{key_of_seven, GeneClock{RobotId{7}}};
    Signer liar_{key_of(9), GeneClock{RobotId{9}}};
    Verifier verifier_{directory(), {}};
};

TEST_F(SignedFrames, AreOpenedAsTheyWereSigned) {
    const Bytes frame = frame_of(7);
    const Bytes bytes = sign(seven_, frame);
    EXPECT_EQ(bytes.size(), frame.size() + 1 + 1 + 64);
    const auto opened = verifier_.open(bytes);
    ASSERT_TRUE(std::holds_alternative<Frame>(opened));
    EXPECT_EQ(std::get<Frame>(opened).sender, RobotId{7});
    EXPECT_EQ(std::get<Frame>(opened).payload.size(), 3u);
    EXPECT_EQ(verifier_.counts().opened, 1u);
}

TEST_F(SignedFrames, HaveTheSignatureOfRfc8032) {
    const VerifyingKey expected_key{0xd7, 0x5a, 0x98, 0x01, 0x82, 0xb1, 0x0a, 0xb7,
                                    0xd5, 0x4b, 0xfe, 0xd3, 0xc9, 0x64, 0x07, 0x3a,
                                    0x0e, 0xe1, 0x72, 0xf3, 0xda, 0xa6, 0x23, 0x25,
                                    0xaf, 0x02, 0x1a, 0x68, 0xf7, 0x07, 0x51, 0x1a};
    EXPECT_EQ(verifying_key(key_of_seven), expected_key);
    // What the reference code of its section 6 gives for 130, number 1 and three bytes.
    const Bytes expected{0x82, 0x01, 0x61, 0x62, 0x63, 0x4a, 0x05, 0x55, 0x50, 0x91, 0x3b, 0x3a,
                         0x26, 0x38, 0xdf, 0x7d, 0x3c, 0xc3, 0x4a, 0xe5, 0x7d, 0x5c, 0xd3, 0xc6,
                         0x53, 0xcb, 0x30, 0x8d, 0x64, 0xc6, 0x21, 0x49, 0x6d, 0xd7, 0xa1, 0x80,
                         0xd9, 0x78, 0xac, 0x83, 0x23, 0xfa, 0xec, 0x04, 0xb5, 0x63, 0xc9, 0x47,
                         0xe6, 0x56, 0x3f, 0x22, 0xf4, 0x0c, 0x3e, 0xa7, 0x71, 0x25, 0xe7, 0xf2,
                         0x67, 0xb8, 0x3b, 0x27, 0x5f, 0xbd, 0x39, 0x5a, 0x0e};
    EXPECT_EQ(sign(seven_, Bytes{0x61, 0x62, 0x63}), expected);
}

TEST_F(SignedFrames, AreOfNobodyElse) {
    EXPECT_EQ(outcome(verifier_, sign(liar_, frame_of(7))), "forged") << "robot 9 speaks as 7";
    EXPECT_EQ(outcome(verifier_, sign(seven_, frame_of(9))), "forged") << "and 7 not as 9";
    auto stranger = signer(key_of(10));
    EXPECT_EQ(outcome(verifier_, sign(stranger, frame_of(10))), "unknown sender");
    EXPECT_EQ(outcome(verifier_, sign(stranger, frame_of(7))), "forged");
    EXPECT_EQ(outcome(verifier_, sign(liar_, frame_of(9))), "opened");
    EXPECT_EQ(verifier_.counts().refused,
              (std::array<std::uint64_t, refusal_kinds>{3, 0, 0, 0, 0, 1}));
    EXPECT_EQ(verifier_.windows().size(), 1u) << "who is refused takes no room";
}

// With the fleet's key alone both are open to whoever has it.
TEST_F(SignedFrames, ShutNobodyOutButTheirOwnSender) {
    for (const std::uint32_t victim : {7u, 8u}) {
        auto last = signer(key_of(9), most - 2);
        EXPECT_EQ(outcome(verifier_, sign(last, frame_of(victim))), "forged");
    }
    EXPECT_EQ(outcome(verifier_, sign(seven_, frame_of(7))), "opened");
    for (std::uint32_t made_up = 100; made_up < 2'000; ++made_up) {
        EXPECT_EQ(outcome(verifier_, sign(liar_, frame_of(made_up))), "unknown sender");
    }
    auto eight = signer(key_of(8));
    EXPECT_EQ(outcome(verifier_, sign(eight, frame_of(8))), "opened");
    auto own_end = signer(key_of(9), most - 2);
    EXPECT_EQ(outcome(verifier_, sign(own_end, frame_of(9))), "opened");
    EXPECT_EQ(outcome(verifier_, sign(liar_, frame_of(9))), "too old") << "its own fault";
}

TEST_F(SignedFrames, AreTakenOnce) {
    std::vector<Bytes> sent;
    for (int i = 0; i < 70; ++i) sent.push_back(sign(seven_, frame_of(7)));
    EXPECT_EQ(outcome(verifier_, sent[0]), "opened");
    EXPECT_EQ(outcome(verifier_, sent[0]), "replayed");
    EXPECT_EQ(outcome(verifier_, sent[69]), "opened");
    EXPECT_EQ(outcome(verifier_, sent[0]), "too old");
    EXPECT_EQ(outcome(verifier_, sent[5]), "too old");
    EXPECT_EQ(outcome(verifier_, sent[6]), "opened") << "64 numbers up to the largest";
    EXPECT_EQ(outcome(verifier_, sent[6]), "replayed");

    Verifier again{directory(), {}, verifier_.windows()};
    EXPECT_EQ(outcome(again, sent[69]), "replayed");
    Verifier::Directory others = directory();
    others.erase(RobotId{7});
    Verifier without{std::move(others), {}, verifier_.windows()};
    EXPECT_TRUE(without.windows().empty());
    EXPECT_EQ(outcome(without, sign(seven_, frame_of(7))), "unknown sender");
}

TEST_F(SignedFrames, HaveNoBitThatMayBeAnother) {
    const Bytes bytes = sign(seven_, frame_of(7));
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        Bytes flipped = bytes;
        flipped[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
        EXPECT_NE(outcome(verifier_, flipped), "opened") << bit;
    }
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_NE(outcome(verifier_, Bytes(bytes.begin(), bytes.begin() + long(size))), "opened");
    }
    EXPECT_TRUE(verifier_.windows().empty()) << "none of it left a trace";
    EXPECT_EQ(outcome(verifier_, bytes), "opened");
}

// A signature is of a frame with its number, and of nothing else that is like it.
TEST_F(SignedFrames, AreNeitherFramesNorSealed) {
    const Bytes frame = frame_of(7);
    Sealer sealer{Key{}, GeneClock{RobotId{7}}};
    const auto sealed = sealer.seal(frame);
    EXPECT_NE(outcome(verifier_, Bytes(sealed->begin(), sealed->end())), "opened");
    EXPECT_NE(outcome(verifier_, frame), "opened");
    Opener opener{Key{}, {}};
    const Bytes bytes = sign(seven_, frame);
    EXPECT_TRUE(std::holds_alternative<Refusal>(opener.open(bytes)));
    EXPECT_FALSE(decode_frame(bytes, {}));
    Bytes truncated(bytes.begin(), bytes.begin() + 10);
    EXPECT_EQ(outcome(verifier_, truncated), "forged");
    EXPECT_EQ(outcome(verifier_, sign(seven_, Bytes{1, 2, 3})), "malformed");
}

TEST_F(SignedFrames, AreNoLongerThanAFrameMayBe) {
    const auto limits_of = [](std::uint32_t frame_bytes) {
        WireLimits limits;
        limits.frame_bytes = frame_bytes;
        return limits;
    };
    const Bytes frame = frame_of(7);
    const auto size = static_cast<std::uint32_t>(frame.size());
    Verifier exact{directory(), limits_of(size)};
    EXPECT_EQ(outcome(exact, sign(seven_, frame)), "opened");
    Verifier narrow{directory(), limits_of(size - 1)};
    EXPECT_EQ(outcome(narrow, sign(seven_, frame)), "malformed");
    EXPECT_EQ(outcome(narrow, Bytes(size - 1 + signature_bytes_max + 1)), "forged");
    for (const std::uint32_t almost_all : {~0u, ~0u - 10, ~0u - 11}) {
        Verifier open{directory(), limits_of(almost_all)};
        EXPECT_EQ(outcome(open, sign(seven_, frame)), "opened") << "no sum wraps around";
    }
}

TEST_F(SignedFrames, NeverHaveANumberAgainAfterACrash) {
    const GeneClock::Limits limits{.block = 10};
    std::uint64_t stored = 0;
    {
        Signer first{key_of_seven, GeneClock{RobotId{7}, 0, limits}};
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(outcome(verifier_, sign(first, frame_of(7))), "opened");
            stored = first.durable_needed();
        }
    }
    Signer restarted{key_of_seven, *GeneClock::restart(RobotId{7}, stored, 0, limits)};
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(outcome(verifier_, sign(restarted, frame_of(7))), "opened");
    }
    Signer spent{key_of_seven, GeneClock{RobotId{7}, 0, {.maximum = 2}}};
    EXPECT_TRUE(spent.sign(frame_of(7)));
    EXPECT_FALSE(spent.sign(frame_of(7)));
}

TEST(SigningKeys, AreNew) {
    EXPECT_NE(make_signing_key(), make_signing_key());
    EXPECT_NE(make_signing_key(), SigningKey{});
    EXPECT_NE(verifying_key(make_signing_key()), verifying_key(make_signing_key()));
}

}  // namespace
}  // namespace gene_clocks::authentication
