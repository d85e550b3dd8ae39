// Without the key nothing gets in, and nothing gets in twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <gene_clocks/authentication/sealed_frames.hpp>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "tests/support/property.hpp"
#include "tests/support/wire_vectors.hpp"

namespace gene_clocks::authentication {
namespace {

using Bytes = std::vector<std::uint8_t>;

Key key_of(std::uint8_t seed) {
    Key key;
    for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::uint8_t>(seed + i);
    return key;
}

Bytes frame_of(RobotId sender, Stamp stamp = {6}) {
    const Bytes payload{1, 2, 3};
    Bytes buffer(64);
    const auto frame = encode_frame({sender, stamp, 1.0f, payload}, buffer);
    return {frame->begin(), frame->end()};
}

Bytes seal(Sealer& sealer, const Bytes& frame) {
    const auto sealed = sealer.seal(frame);
    return {sealed->begin(), sealed->end()};
}

std::string outcome(Opener& opener, const Bytes& sealed) {
    constexpr const char* names[] = {"forged", "malformed", "replayed", "too old",
                                     "too many senders"};
    const auto opened = opener.open(sealed);
    if (const auto* refusal = std::get_if<Refusal>(&opened)) {
        return names[static_cast<int>(*refusal)];
    }
    return "opened";
}

class SealedFrames : public testing::Test {
protected:
    Sealer sealer_{key_of(1), GeneClock{RobotId{7}}};
    Opener opener_{key_of(1), {}};
};

TEST_F(SealedFrames, AreOpenedAsTheyWereSealed) {
    const Bytes frame = frame_of(RobotId{7});
    const Bytes sealed = seal(sealer_, frame);
    EXPECT_EQ(sealed.size(), frame.size() + 1 + 1 + 16);
    const auto opened = opener_.open(sealed);
    ASSERT_TRUE(std::holds_alternative<Frame>(opened));
    EXPECT_EQ(std::get<Frame>(opened).sender, RobotId{7});
    EXPECT_EQ(std::get<Frame>(opened).payload.size(), 3u);
    EXPECT_EQ(opener_.counts().opened, 1u);
}

// RFC 7693 describes BLAKE2b; the tag is what Python's hashlib.blake2b(bytes, digest_size=16,
// key=key) gives for it.
TEST_F(SealedFrames, HaveTheTagOfBlake2b) {
    const Bytes sealed = seal(sealer_, Bytes{0x61, 0x62, 0x63});
    const Bytes expected{0x81, 0x01, 0x61, 0x62, 0x63, 0x2a, 0x06, 0x7d, 0xc5, 0xef, 0x6b,
                         0x63, 0x4e, 0x5f, 0xcc, 0xf7, 0xd1, 0x63, 0x79, 0xc5, 0xa9};
    EXPECT_EQ(sealed, expected);
}

TEST(SealedFramesVectors, AreOpenedRefusedAndSealedAsTheFileSays) {
    const test::WireVectors vectors = test::read_wire_vectors(GENE_CLOCKS_WIRE_VECTORS);
    Key key;
    ASSERT_EQ(vectors.key.size(), key.size());
    std::copy(vectors.key.begin(), vectors.key.end(), key.begin());
    std::size_t opened = 0;
    for (const auto& vector : vectors.sealed) {
        SCOPED_TRACE(vector["name"]);
        const Bytes sealed = test::from_hex(vector["sealed"].get<std::string>());
        Opener opener{key, vectors.limits};
        if (vector.contains("refusal")) {
            EXPECT_EQ(outcome(opener, sealed), vector["refusal"].get<std::string>());
            EXPECT_TRUE(opener.windows().empty());
            continue;
        }
        ++opened;
        const auto number = vector["number"].get<std::uint64_t>();
        const Bytes frame = test::from_hex(vector["frame"].get<std::string>());
        EXPECT_EQ(outcome(opener, sealed), "opened");
        ASSERT_EQ(opener.windows().size(), 1u);
        EXPECT_EQ(opener.windows().begin()->second.highest, number);
        if (number == std::numeric_limits<std::uint64_t>::max()) continue;  // no clock gets there
        Sealer sealer{key, GeneClock{RobotId{1}, number - 1}};
        EXPECT_EQ(seal(sealer, frame), sealed);
    }
    EXPECT_GE(opened, 4u);
    EXPECT_GE(vectors.sealed.size() - opened, 15u);
}

TEST_F(SealedFrames, AreForgedWithoutTheKey) {
    Sealer stranger{key_of(2), GeneClock{RobotId{7}}};
    EXPECT_EQ(outcome(opener_, seal(stranger, frame_of(RobotId{7}))), "forged");
    EXPECT_EQ(outcome(opener_, frame_of(RobotId{7})), "forged") << "a bare frame";
    EXPECT_EQ(outcome(opener_, {}), "forged");
    EXPECT_EQ(outcome(opener_, Bytes(1'000'000)), "forged");
    EXPECT_EQ(opener_.counts().refused[static_cast<std::size_t>(Refusal::forged)], 4u);
    EXPECT_TRUE(opener_.windows().empty());
}

TEST_F(SealedFrames, AreForgedWithAnyBitFlippedAndAnyEndCutOff) {
    const Bytes sealed = seal(sealer_, frame_of(RobotId{7}));
    for (std::size_t bit = 0; bit < 8 * sealed.size(); ++bit) {
        Bytes altered = sealed;
        altered[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
        EXPECT_EQ(outcome(opener_, altered), "forged") << "bit " << bit;
    }
    for (std::size_t size = 0; size < sealed.size(); ++size) {
        EXPECT_EQ(
            outcome(opener_, {sealed.begin(), sealed.begin() + static_cast<std::ptrdiff_t>(size)}),
            "forged");
    }
    EXPECT_EQ(outcome(opener_, sealed), "opened") << "none of these has left a trace";
}

TEST_F(SealedFrames, AreOpenedOnce) {
    const Bytes first = seal(sealer_, frame_of(RobotId{7}));
    const Bytes second = seal(sealer_, frame_of(RobotId{7}));
    EXPECT_EQ(outcome(opener_, second), "opened");
    EXPECT_EQ(outcome(opener_, first), "opened") << "late, but new";
    EXPECT_EQ(outcome(opener_, first), "replayed");
    EXPECT_EQ(outcome(opener_, second), "replayed");
    EXPECT_EQ(opener_.counts().refused[static_cast<std::size_t>(Refusal::replayed)], 2u);
}

TEST_F(SealedFrames, AreTooOldBehindTheWindow) {
    std::vector<Bytes> sealed;
    for (int i = 0; i < 66; ++i) sealed.push_back(seal(sealer_, frame_of(RobotId{7})));
    EXPECT_EQ(outcome(opener_, sealed[64]), "opened");
    EXPECT_EQ(outcome(opener_, sealed[1]), "opened") << "63 behind";
    EXPECT_EQ(outcome(opener_, sealed[0]), "too old") << "64 behind";
    EXPECT_EQ(outcome(opener_, sealed[65]), "opened");
    EXPECT_EQ(outcome(opener_, sealed[1]), "too old");
    EXPECT_EQ(outcome(opener_, sealed[2]), "opened");
}

TEST_F(SealedFrames, AreNewHoweverFarTheNumbersLeap) {
    std::vector<Bytes> sealed;
    for (int i = 0; i < 200; ++i) sealed.push_back(seal(sealer_, frame_of(RobotId{7})));
    EXPECT_EQ(outcome(opener_, sealed[0]), "opened");
    EXPECT_EQ(outcome(opener_, sealed[65]), "opened") << "a leap of more than the window";
    EXPECT_EQ(outcome(opener_, sealed[64]), "opened");
    EXPECT_EQ(outcome(opener_, sealed[128]), "opened") << "a leap of 63";
    EXPECT_EQ(outcome(opener_, sealed[65]), "replayed");
    EXPECT_EQ(outcome(opener_, sealed[66]), "opened");
    EXPECT_EQ(outcome(opener_, sealed[64]), "too old");
}

TEST_F(SealedFrames, AreMalformedWhereTheKeysHolderErrs) {
    EXPECT_EQ(outcome(opener_, seal(sealer_, Bytes{1, 2, 3})), "malformed");
    EXPECT_EQ(outcome(opener_, seal(sealer_, {})), "malformed");
    EXPECT_TRUE(opener_.windows().empty());
}

TEST_F(SealedFrames, AreTakenFromAsManySendersAsThereIsRoomFor) {
    Opener opener{key_of(1), {}, 2};
    const Bytes first = seal(sealer_, frame_of(RobotId{1}));
    EXPECT_EQ(outcome(opener, first), "opened");
    EXPECT_EQ(outcome(opener, seal(sealer_, frame_of(RobotId{2}))), "opened");
    EXPECT_EQ(outcome(opener, seal(sealer_, frame_of(RobotId{3}))), "too many senders");
    EXPECT_EQ(outcome(opener, seal(sealer_, frame_of(RobotId{1}))), "opened");
    EXPECT_EQ(outcome(opener, first), "replayed");
}

TEST_F(SealedFrames, StayOpenedAcrossARestartWithTheWindows) {
    const Bytes sealed = seal(sealer_, frame_of(RobotId{7}));
    EXPECT_EQ(outcome(opener_, sealed), "opened");
    Opener again{key_of(1), {}, 1024, opener_.windows()};
    EXPECT_EQ(outcome(again, sealed), "replayed");
    Opener forgetful{key_of(1), {}};
    EXPECT_EQ(outcome(forgetful, sealed), "opened") << "what the windows are stored for";
}

TEST_F(SealedFrames, NeverHaveANumberAgainAfterACrash) {
    const GeneClock::Limits limits{.block = 10};
    std::uint64_t stored = 0;
    {
        Sealer sealer{key_of(1), GeneClock{RobotId{7}, 0, limits}};
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(outcome(opener_, seal(sealer, frame_of(RobotId{7}))), "opened");
            stored = sealer.durable_needed();
        }
    }
    Sealer restarted{key_of(1), *GeneClock::restart(RobotId{7}, stored, 0, limits)};
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(outcome(opener_, seal(restarted, frame_of(RobotId{7}))), "opened");
    }
}

TEST_F(SealedFrames, AreOpenedUnderAnyLimit) {
    const Bytes sealed = seal(sealer_, frame_of(RobotId{7}));
    for (const std::uint32_t almost_all : {~0u, ~0u - 10, ~0u - 11}) {
        WireLimits limits;
        limits.frame_bytes = almost_all;
        Opener open{key_of(1), limits};
        EXPECT_EQ(outcome(open, sealed), "opened") << "no sum wraps around";
    }
}

TEST_F(SealedFrames, EndWithTheNumbers) {
    Sealer sealer{key_of(1), GeneClock{RobotId{7}, 0, {.maximum = 2}}};
    EXPECT_TRUE(sealer.seal(frame_of(RobotId{7})));
    EXPECT_FALSE(sealer.seal(frame_of(RobotId{7})));
}

/// Against a set that forgets nothing: in any order, each frame is opened at most once, and every
/// new one of the last 64 numbers is.
GENE_CLOCKS_PROPERTY(SealedFramesProperty, AgreeWithASetOfNumbers, ()) {
    Sealer sealer{key_of(1), GeneClock{RobotId{7}}};
    Opener opener{key_of(1), {}};
    std::vector<Bytes> sealed;
    for (int i = 0; i < 200; ++i) sealed.push_back(seal(sealer, frame_of(RobotId{7})));
    std::set<std::size_t> seen;
    std::size_t highest = 0;
    std::size_t place = 0;
    for (int i = 0; i < 150; ++i) {
        place = std::min<std::size_t>(
            199, *rc::gen::inRange<std::size_t>(place > 70 ? place - 70 : 0, place + 30));
        const std::string expected = seen.empty() || place > highest ? "opened"
                                     : highest - place >= 64         ? "too old"
                                     : seen.contains(place)          ? "replayed"
                                                                     : "opened";
        RC_ASSERT(outcome(opener, sealed[place]) == expected);
        if (expected == "opened") {
            seen.insert(place);
            highest = std::max(highest, place);
        }
    }
}

}  // namespace
}  // namespace gene_clocks::authentication
