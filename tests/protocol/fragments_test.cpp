// Messages in fragments: against the test vectors, and whatever a link does to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <gene_clocks/fragments.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/allocations.hpp"
#include "tests/support/property.hpp"
#include "tests/support/wire_vectors.hpp"

namespace gene_clocks {
namespace {

using Bytes = std::vector<std::uint8_t>;
using test::from_hex;

const nlohmann::json& vectors() {
    static const nlohmann::json loaded = [] {
        std::ifstream file(GENE_CLOCKS_FRAGMENT_VECTORS);
        return nlohmann::json::parse(file);
    }();
    return loaded;
}

TEST(FragmentVectors, AreSplitSo) {
    ASSERT_GE(vectors()["splits"].size(), 10u);
    for (const auto& vector : vectors()["splits"]) {
        const Bytes message = from_hex(vector["message"].get<std::string>());
        const auto fragments =
            split_message(message, RobotId{vector["sender"].get<std::uint32_t>()}, vector["number"],
                          vector["fragment_bytes"]);
        if (vector["fragments"].is_null()) {
            ASSERT_FALSE(fragments);
            EXPECT_EQ(fragments.fault().error, WireError::too_long);
            continue;
        }
        ASSERT_TRUE(fragments);
        std::vector<Bytes> expected;
        for (const auto& one : vector["fragments"])
            expected.push_back(from_hex(one.get<std::string>()));
        EXPECT_EQ(*fragments, expected);
    }
}

TEST(FragmentVectors, ArePutTogetherSo) {
    ASSERT_GE(vectors()["exchanges"].size(), 40u);
    std::map<std::string, std::size_t> outcomes;
    for (const auto& exchange : vectors()["exchanges"]) {
        MessageAssembler assembler(exchange["messages"], exchange["message_bytes"]);
        for (const auto& step : exchange["steps"]) {
            const Bytes data = from_hex(step[0].get<std::string>());
            const auto [outcome, message] = assembler.take(data);
            ASSERT_EQ(name_of(outcome), step[1].get<std::string>());
            ++outcomes[step[1]];
            if (step.size() > 2) {
                ASSERT_EQ(Bytes(message.begin(), message.end()),
                          from_hex(step[2].get<std::string>()));
            }
        }
    }
    EXPECT_EQ(outcomes.size(), 6u);
}

Bytes message_of(std::size_t size) {
    Bytes message(size, 1);
    for (std::size_t i = 1; i < size; ++i) message[i] = static_cast<std::uint8_t>(i * 31 + size);
    return message;
}

TEST(Fragments, OfEveryLengthFitTheirLinkAndComeTogether) {
    for (const std::size_t limit : {6u, 7u, 9u, 20u, 100u, 250u, 382u}) {
        MessageAssembler assembler(1, 2000);
        std::uint8_t number = 0;
        for (std::size_t size = 1; size <= 2000; size += size < 300 ? 1 : 53) {
            const Bytes message = message_of(size);
            const auto fragments = split_message(message, RobotId{9}, number, limit);
            const std::size_t room = limit - 5;
            if (size > limit && size > 256 * room) {
                EXPECT_FALSE(fragments);
                continue;
            }
            ++number;
            ASSERT_TRUE(fragments);
            EXPECT_EQ(fragments->size(), size <= limit ? 1 : (size + room - 1) / room)
                << "as few as can be, " << size << " bytes by " << limit;
            for (std::size_t i = 0; i < fragments->size(); ++i) {
                ASSERT_LE((*fragments)[i].size(), limit);
                const auto [outcome, whole] = assembler.take((*fragments)[i]);
                if (i + 1 < fragments->size()) {
                    ASSERT_EQ(outcome, FragmentOutcome::kept);
                } else {
                    ASSERT_EQ(outcome, FragmentOutcome::completes);
                    ASSERT_TRUE(
                        std::equal(whole.begin(), whole.end(), message.begin(), message.end()));
                }
            }
        }
    }
}

TEST(Fragments, WhatCannotBeSplitIsRefused) {
    const auto error_of = [](const Bytes& message, std::uint32_t sender, std::size_t limit) {
        const auto fragments = split_message(message, RobotId{sender}, 0, limit);
        return fragments ? "" : std::string(name_of(fragments.fault().error));
    };
    EXPECT_EQ(error_of(message_of(30), 0, 20), "robot");
    EXPECT_EQ(error_of({}, 1, 20), "truncated");
    EXPECT_EQ(error_of({64, 1}, 1, 20), "form");
    EXPECT_EQ(error_of(message_of(30), 1, 5), "too_long");
    EXPECT_EQ(error_of(message_of(30), 128, 6), "too_long");
    EXPECT_EQ(error_of(message_of(30), 1, 0), "too_long");
    EXPECT_EQ(error_of(message_of(257), 1, 6), "too_long");
    EXPECT_EQ(error_of(message_of(256), 1, 6), "");
}

TEST(Fragments, AMessageWithoutOneOfItsFragmentsIsLostAndNoOther) {
    const auto first = *split_message(message_of(100), RobotId{9}, 255, 20);
    const auto second = *split_message(message_of(90), RobotId{9}, 0, 20);
    for (std::size_t lost = 0; lost < first.size(); ++lost) {
        MessageAssembler assembler(1, 100);
        for (std::size_t i = 0; i < first.size(); ++i) {
            if (i == lost) continue;
            EXPECT_EQ(assembler.take(first[i]).outcome, FragmentOutcome::kept);
        }
        for (std::size_t i = 0; i < second.size(); ++i) {
            EXPECT_EQ(assembler.take(second[i]).outcome,
                      i + 1 < second.size() ? FragmentOutcome::kept : FragmentOutcome::completes);
        }
        EXPECT_EQ(assembler.take(first[lost]).outcome, FragmentOutcome::late);
    }
}

/// With a checksum, which alone tells what damage the link did.
Bytes frame_of(std::size_t payload) {
    const Bytes content = message_of(payload);
    Bytes buffer(payload + frame_overhead_bytes);
    const auto frame = encode_frame({RobotId{9}, Stamp{300}, 1.0f, content}, buffer);
    return {frame->begin(), frame->end()};
}

TEST(Fragments, EveryFlippedBitAndEveryLengthGiveTheFrameOrNone) {
    const Bytes frame = frame_of(50);
    const auto fragments = *split_message(frame, RobotId{9}, 7, 20);
    ASSERT_EQ(fragments.size(), 5u);
    std::size_t refused = 0, whole = 0;
    const auto try_with = [&](std::size_t damaged, const Bytes& instead) {
        MessageAssembler assembler(2, 100);
        for (std::size_t i = 0; i < fragments.size(); ++i) {
            const auto [outcome, message] = assembler.take(i == damaged ? instead : fragments[i]);
            if (outcome != FragmentOutcome::completes) continue;
            const auto read = decode_frame(message);
            if (!read) {
                ++refused;
                continue;
            }
            ++whole;
            EXPECT_TRUE(std::equal(message.begin(), message.end(), frame.begin(), frame.end()));
        }
    };
    for (std::size_t damaged = 0; damaged < fragments.size(); ++damaged) {
        const Bytes& fragment = fragments[damaged];
        for (std::size_t bit = 0; bit < 8 * fragment.size(); ++bit) {
            Bytes flipped = fragment;
            flipped[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
            try_with(damaged, flipped);
        }
        for (std::size_t size = 0; size < fragment.size(); ++size) {
            try_with(damaged,
                     Bytes(fragment.begin(), fragment.begin() + static_cast<std::ptrdiff_t>(size)));
        }
    }
    EXPECT_GT(refused, 100u) << "by the checksum";
    EXPECT_EQ(whole, 0u) << "no damage goes unnoticed";
}

TEST(Fragments, AMessageIsPutTogetherOfTheRestWhenDamageIsRepaired) {
    const Bytes frame = frame_of(50);
    const auto fragments = *split_message(frame, RobotId{9}, 7, 20);
    for (std::size_t at = 0; at < fragments[2].size(); ++at) {
        MessageAssembler assembler(2, 100);
        Bytes damaged = fragments[2];
        damaged[at] ^= 0x10;
        assembler.take(damaged);
        std::size_t whole = 0;
        for (int round = 0; round < 2; ++round) {
            for (const Bytes& fragment : fragments) {
                const auto taken = assembler.take(fragment);
                whole += taken.outcome == FragmentOutcome::completes && decode_frame(taken.message);
            }
        }
        EXPECT_GE(whole, at == 2 ? 0u : 1u) << "byte " << at;
    }
}

TEST(Fragments, NothingIsAllocatedForThem) {
    MessageAssembler assembler(4, 400);
    const auto fragments = *split_message(message_of(300), RobotId{9}, 7, 20);
    const auto before = test::allocations();
    for (const Bytes& fragment : fragments) assembler.take(fragment);
    EXPECT_EQ(test::allocations().count, before.count);
}

TEST(Fragments, AreSplitAndPutTogetherAtCompileTime) {
    constexpr bool is_whole = [] {
        const std::array<std::uint8_t, 9> message{1, 2, 3, 4, 5, 6, 7, 8, 9};
        gene_clocks_split split{};
        if (gene_clocks_split_message(&split, message.data(), 9, 5, 0, 8)) return false;
        std::array<std::uint8_t, 9> memory{};
        gene_clocks_assembly assembly{};
        gene_clocks_assembler assembler{&assembly, memory.data(), 9, 1, 0};
        const std::uint8_t* whole = nullptr;
        std::size_t size = 0;
        for (int i = split.last; i >= 0; --i) {
            std::array<std::uint8_t, 8> buffer{};
            const auto bytes =
                gene_clocks_put_fragment(&split, static_cast<std::uint8_t>(i), buffer.data());
            gene_clocks_take_fragment(&assembler, buffer.data(), bytes, &whole, &size);
        }
        return size == 9 && whole[0] == 1 && whole[8] == 9;
    }();
    EXPECT_TRUE(is_whole);
}

GENE_CLOCKS_PROPERTY(FragmentProperty, MessagesOfManySendersInAnyOrderComeTogether, ()) {
    const auto senders = *rc::gen::inRange<std::uint32_t>(1, 6);
    MessageAssembler assembler(senders, 300);
    std::vector<std::pair<std::uint32_t, Bytes>> link;
    std::map<std::uint32_t, Bytes> sent;
    for (std::uint32_t sender = 1; sender <= senders; ++sender) {
        sent[sender] = message_of(*rc::gen::inRange<std::size_t>(60, 300));
        const auto fragments = *split_message(sent[sender], RobotId{sender}, 0,
                                              *rc::gen::inRange<std::size_t>(12, 60));
        for (const Bytes& fragment : fragments) {
            link.emplace_back(sender, fragment);
            if (*rc::gen::inRange(0, 4) == 0) link.emplace_back(sender, fragment);
        }
    }
    // Fisher and Yates, with draws that shrink.
    for (std::size_t i = link.size(); i > 1; --i) {
        std::swap(link[i - 1], link[*rc::gen::inRange<std::size_t>(0, i)]);
    }
    std::size_t whole = 0;
    for (const auto& [sender, fragment] : link) {
        const auto [outcome, message] = assembler.take(fragment);
        RC_ASSERT(outcome != FragmentOutcome::malformed && outcome != FragmentOutcome::late &&
                  outcome != FragmentOutcome::too_long);
        if (outcome != FragmentOutcome::completes) continue;
        ++whole;
        RC_ASSERT(Bytes(message.begin(), message.end()) == sent[sender]);
    }
    RC_ASSERT(whole == senders);
}

}  // namespace
}  // namespace gene_clocks
