#include "sim/core/src/radio.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace gene_clocks::sim {
namespace {

using Arrival = std::pair<std::uint32_t, std::uint64_t>;  // receiver, number of the message

class RadioTest : public testing::Test {
protected:
    auto note() {
        return [this](std::uint32_t receiver, const neat::Message&, std::uint64_t number) {
            arrivals_.emplace_back(receiver, number);
        };
    }
    void send(Radio& radio, std::uint64_t number, std::uint32_t receiver) {
        radio.send({}, number, receiver, random_, note());
    }
    std::vector<Arrival> take() { return std::exchange(arrivals_, {}); }

    neat::RandomStream random_{1, 1};
    std::vector<Arrival> arrivals_;
};

TEST_F(RadioTest, DeliversAtOnceWithoutADelay) {
    Radio radio({});
    radio.deliver_delayed(note());
    send(radio, 7, 3);
    EXPECT_EQ(take(), (std::vector<Arrival>{{3, 7}}));
    radio.deliver_delayed(note());
    EXPECT_TRUE(take().empty());
}

TEST_F(RadioTest, ADelayedMessageArrivesOnceAndInOrder) {
    Radio radio({.delay_cycles = 3});
    radio.deliver_delayed(note());
    send(radio, 1, 5);
    send(radio, 2, 4);
    radio.deliver_delayed(note());
    send(radio, 3, 6);
    radio.deliver_delayed(note());
    EXPECT_TRUE(take().empty());
    radio.deliver_delayed(note());
    EXPECT_EQ(take(), (std::vector<Arrival>{{5, 1}, {4, 2}}));
    radio.deliver_delayed(note());
    EXPECT_EQ(take(), (std::vector<Arrival>{{6, 3}}));
    for (int i = 0; i < 10; ++i) radio.deliver_delayed(note());
    EXPECT_TRUE(take().empty());
}

TEST_F(RadioTest, LosesTheShareThatItIsTold) {
    Radio radio({.loss = 0.3});
    for (std::uint64_t number = 0; number < 100'000; ++number) send(radio, number, 0);
    // Five standard deviations of the binomial distribution are 725.
    EXPECT_NEAR(static_cast<double>(take().size()), 70'000.0, 725.0);
}

TEST_F(RadioTest, LosesTheSameShareOfDelayedMessages) {
    Radio radio({.loss = 0.3, .delay_cycles = 2});
    for (std::uint64_t number = 0; number < 100'000; ++number) send(radio, number, 0);
    EXPECT_TRUE(take().empty());
    for (int i = 0; i < 5; ++i) radio.deliver_delayed(note());
    EXPECT_NEAR(static_cast<double>(take().size()), 70'000.0, 725.0);
}

TEST_F(RadioTest, LosesAllOrNothingAtTheEnds) {
    Radio deaf({.loss = 1.0});
    for (std::uint64_t number = 0; number < 1000; ++number) send(deaf, number, 0);
    EXPECT_TRUE(take().empty());
    Radio perfect({.loss = 0.0});
    for (std::uint64_t number = 0; number < 1000; ++number) send(perfect, number, 0);
    EXPECT_EQ(take().size(), 1000u);
}

}  // namespace
}  // namespace gene_clocks::sim
