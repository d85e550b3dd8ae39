// Messages through the wire format: what comes out is valid, whatever goes in.
#include <gtest/gtest.h>

#include <gene_clocks/neat/message_codec.hpp>
#include <limits>
#include <set>

#include "tests/neat/sample_genomes.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/wire_messages.hpp"
#include "tests/support/wire_vectors.hpp"

namespace gene_clocks::neat {
namespace {

using Bytes = std::vector<std::uint8_t>;
using samples::genesis;
using samples::mark;

constexpr RobotId sender{7};

class MessageCodecTest : public testing::Test {
protected:
    Message message_of(Genome genome, Stamp stamp = {1000}, float energy = 50.0f) const {
        return {std::make_shared<const Genome>(std::move(genome)), energy, stamp};
    }
    Bytes frame_of(const Message& message) {
        const auto frame = codec_.encode(sender, message);
        if (!frame) {
            ADD_FAILURE() << name_of(frame.fault().error);
            return {};
        }
        return {frame->begin(), frame->end()};
    }
    std::optional<WireError> error_of_writing(const Message& message) {
        const auto frame = codec_.encode(sender, message);
        return frame ? std::nullopt : std::optional(frame.fault().error);
    }
    /// The perceptron, split once by robot 7.
    Genome split() const {
        Genome genome = samples::perceptron(3, 2, {sender, 4});
        samples::add_hidden(genome, mark(12, 7));
        samples::add_gene(genome, mark(13, 7), {genesis(1), mark(12, 7), false}, 1.0f);
        samples::add_gene(genome, mark(14, 7), {mark(12, 7), genesis(4), false}, -2.5f, false);
        return genome;
    }

    std::shared_ptr<const Topology> initial_ = make_initial_topology(3, 2);
    OdneatSettings settings_;
    MessageCodec codec_{initial_, wire_limits(*initial_, settings_)};
};

TEST_F(MessageCodecTest, TheInitialGenomeComesBackWithTheSharedTopology) {
    Genome genome = samples::perceptron(3, 2, {sender, 4});
    genome.weights[2] = -0.0f;
    genome.enabled[3] = 0.0f;
    const Bytes frame = frame_of(message_of(genome, {12}, 0.0f));
    const auto received = codec_.decode(frame);
    ASSERT_TRUE(received);
    EXPECT_EQ(received->sender, sender);
    EXPECT_EQ(received->message.stamp, Stamp{12});
    EXPECT_EQ(received->message.energy, 0.0f);
    EXPECT_EQ(received->message.genome->id, genome.id);
    EXPECT_EQ(received->message.genome->topology, initial_) << "one address, not a copy";
    EXPECT_TRUE(samples::same_genes(*received->message.genome, genome));
    EXPECT_TRUE(std::signbit(received->message.genome->weights[2]));
}

TEST_F(MessageCodecTest, GenomesOfAnEvolvingSwarmComeBackAsTheyWere) {
    RandomStream random(5, 0);
    GeneClockSource clock_1(RobotId{1}, initial_->size());
    GeneClockSource clock_2(RobotId{70'000}, initial_->size());
    Genome genome = make_initial_genome({RobotId{1}, 0}, initial_, settings_.weight_limit, random);
    for (int i = 0; i < 60; ++i) {
        GeneClockSource& clock = random.chance(0.5) ? clock_1 : clock_2;
        samples::grow(genome, 1, clock, random);
        genome.id.birth += 1;
        ASSERT_TRUE(clock_1.observe(clock_2.stamp()));
        ASSERT_TRUE(clock_2.observe(clock_1.stamp()));
        const auto received = codec_.decode(frame_of(message_of(genome, clock.stamp())));
        ASSERT_TRUE(received);
        EXPECT_TRUE(samples::same_genes(*received->message.genome, genome));
        EXPECT_EQ(samples::fault_of(*received->message.genome), "valid");
        const auto frame = frame_of(message_of(genome, clock.stamp()));
        EXPECT_EQ(frame_of(received->message), frame);
        const std::size_t payload = payload_bytes(genome);
        EXPECT_EQ(frame_bytes(received->sender, clock.stamp(), payload), frame.size());
    }
    EXPECT_GT(genome.connections(), 60u);
}

TEST_F(MessageCodecTest, AnAgentTakesWhatTheCodecGives) {
    Agent agent(RobotId{1}, settings_, initial_,
                std::make_unique<GeneClockSource>(RobotId{1}, initial_->size()),
                RandomStream(1, 1));
    const auto received = codec_.decode(frame_of(message_of(split(), {15})));
    ASSERT_TRUE(received);
    EXPECT_EQ(agent.receive(received->sender, received->message), Reception::accepted);
    EXPECT_EQ(agent.source().stamp(), Stamp{15});
}

/// Why the bytes are refused, which takes no memory.
WireFault fault_without_allocation(MessageCodec& codec, const Bytes& bytes) {
    const auto before = test::allocations();
    const auto received = codec.decode(bytes);
    EXPECT_EQ(test::allocations().count, before.count);
    EXPECT_FALSE(received);
    return received ? WireFault{} : received.fault();
}

TEST_F(MessageCodecTest, TheTestVectorsAreTakenOrRefusedAsTheirFileSays) {
    const test::WireVectors vectors = test::read_wire_vectors(GENE_CLOCKS_WIRE_VECTORS);
    MessageCodec codec{make_initial_topology(2, 1), vectors.limits};
    std::size_t decoded = 0, foreign = 0;
    for (const auto& vector : vectors.all) {
        SCOPED_TRACE(vector["name"].get<std::string>());
        const Bytes frame = test::from_hex(vector["frame"].get<std::string>());
        if (!vector.contains("value")) {
            const WireFault fault = fault_without_allocation(codec, frame);
            EXPECT_EQ(name_of(fault.error), vector["error"].get<std::string>());
            EXPECT_EQ(fault.offset, vector["offset"].get<std::size_t>());
            continue;
        }
        const auto received = codec.decode(frame);
        if (!received) {  // a genome, but not of this fleet
            EXPECT_EQ(fault_without_allocation(codec, frame).error, WireError::genesis);
            ++foreign;
            continue;
        }
        ++decoded;
        EXPECT_EQ(samples::fault_of(*received->message.genome), "valid");
        const auto again = codec.encode(received->sender, received->message);
        ASSERT_TRUE(again);
        EXPECT_TRUE(std::equal(again->begin(), again->end(), frame.begin(), frame.end()));
    }
    EXPECT_GE(decoded, 14u);
    EXPECT_GE(foreign, 1u);
}

TEST_F(MessageCodecTest, AFrameThatIsCutShortIsTruncated) {
    const Bytes frame = frame_of(message_of(split(), {15}));
    for (std::size_t size = 0; size < frame.size(); ++size) {
        const Bytes shorter(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_EQ(fault_without_allocation(codec_, shorter).error, WireError::truncated) << size;
    }
}

TEST_F(MessageCodecTest, TenMegabytesAreRefusedWithoutALook) {
    const Bytes frame(10'000'000, 1);
    EXPECT_EQ(fault_without_allocation(codec_, frame), (WireFault{WireError::too_long, 65'507}));

    // Under limits that are as wide as they can be, with all counts that a frame can announce.
    const WireLimits limits{.frame_bytes = UINT32_MAX,
                            .genesis_count = initial_->size(),
                            .neurons = UINT16_MAX,
                            .connections = UINT16_MAX};
    MessageCodec wide{initial_, limits};
    EXPECT_EQ(fault_without_allocation(wide, frame).error, WireError::stamp);
    // The payload: 10'000'004 bytes.
    Bytes zeros{1,    7, 100, 0,    0,    0,    0,    0x84, 0xad, 0xe2,
                0x04, 7, 0,   0xff, 0xff, 0x03, 0xff, 0xff, 0x03};
    zeros.resize(11 + 10'000'004 + 4);
    test::mend_checksum(zeros);
    EXPECT_EQ(fault_without_allocation(wide, zeros), (WireFault{WireError::not_ascending, 19}));
}

TEST_F(MessageCodecTest, EveryDamagedFrameIsRefusedOrDecodesToAValidGenome) {
    const Message sent = message_of(split(), {15});
    const Bytes frame = frame_of(sent);
    const WireLimits limits = wire_limits(*initial_, settings_);
    std::set<WireError> errors;
    std::size_t decoded = 0;
    for (std::size_t bit = 0; bit < 8 * (frame.size() - 4); ++bit) {
        Bytes damaged = frame;
        damaged[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
        EXPECT_EQ(fault_without_allocation(codec_, damaged),
                  test::decode_message(damaged, limits).fault());
        test::mend_checksum(damaged);
        const auto received = codec_.decode(damaged);
        if (!received) {
            const WireFault fault = fault_without_allocation(codec_, damaged);
            const auto in_c = test::decode_message(damaged, limits);
            EXPECT_EQ(fault, in_c ? WireFault({WireError::genesis, fault.offset}) : in_c.fault());
            errors.insert(fault.error);
            continue;
        }
        ++decoded;
        EXPECT_EQ(samples::fault_of(*received->message.genome), "valid");
        const auto again = codec_.encode(received->sender, received->message);
        ASSERT_TRUE(again);
        EXPECT_TRUE(std::equal(again->begin(), again->end(), damaged.begin(), damaged.end()));
    }
    EXPECT_GE(errors.size(), 12u);
    EXPECT_GT(decoded, 100u);
}

TEST_F(MessageCodecTest, ForeignInitialGenesAreRefused) {
    // By a fleet with other sensors, whose frames are fine in themselves.
    const auto foreign = make_initial_topology(2, 2);
    WireLimits limits = wire_limits(*initial_, settings_);
    MessageCodec theirs{make_initial_topology(2, 2), wire_limits(*foreign, settings_)};
    Genome genome = samples::perceptron(2, 2, {sender, 0});
    const auto frame = theirs.encode(sender, message_of(genome));
    ASSERT_TRUE(frame);
    const auto received = codec_.decode(*frame);
    ASSERT_FALSE(received);
    EXPECT_EQ(received.fault().error, WireError::genesis);
    EXPECT_EQ(error_of_writing(message_of(genome)), WireError::genesis);

    // The same marks, with other ends: what the receiver knows by its mark would not be it.
    auto twisted = std::make_shared<Topology>(*initial_);
    std::swap(twisted->connection_ends[0], twisted->connection_ends[1]);
    Genome twin = samples::perceptron(3, 2, {sender, 0});
    twin.topology = twisted;
    MessageCodec twisted_codec{twisted, limits};
    const auto twin_frame = twisted_codec.encode(sender, message_of(twin));
    ASSERT_TRUE(twin_frame);
    ASSERT_FALSE(codec_.decode(*twin_frame));
    EXPECT_EQ(codec_.decode(*twin_frame).fault().error, WireError::genesis);
    EXPECT_EQ(error_of_writing(message_of(twin)), WireError::genesis);
}

TEST_F(MessageCodecTest, EachFieldOfAnInitialGeneIsLookedAt) {
    // Genomes that are fine in themselves, each with one initial gene that is another.
    const WireLimits limits = wire_limits(*initial_, settings_);
    const auto perceptron =
        *test::decode_message(frame_of(message_of(samples::perceptron(3, 2, {sender, 0}))), limits);
    const auto expect_foreign = [&](std::size_t index, auto change) {
        test::WireMessage message = perceptron;
        change(message.genes[index]);
        const auto frame = test::encode_message(message, limits);
        ASSERT_TRUE(frame) << name_of(frame.fault().error);
        const WireFault fault = fault_without_allocation(codec_, *frame);
        EXPECT_EQ(fault.error, WireError::genesis);
        const bool has_robot = message.genes[index].mark.robot != 0;
        const std::size_t connections_from_here =
            message.genes.size() - std::max<std::size_t>(index, 5);
        EXPECT_EQ(fault.offset, frame->size() - 4 - 7 * connections_from_here -
                                    (index < 5 ? 5 - index : 0) - (has_robot ? 1 : 0));
    };
    expect_foreign(10, [](auto& gene) { gene.mark = {12, 7}; });
    expect_foreign(7, [](auto& gene) { gene.is_recurrent = true; });
    expect_foreign(8, [](auto& gene) { gene.ends.source = 3; });
    expect_foreign(8, [](auto& gene) { gene.ends = {4, 3}; });
    expect_foreign(5, [](auto& gene) { gene.ends.target = 3, gene.ends.source = 4; });
    expect_foreign(10, [](auto& gene) { gene.ends.target = 3, gene.ends.source = 3; });
    // Two inputs, the bias among them, and three outputs, joined as three and two would be.
    test::WireMessage message = perceptron;
    message.genes[1].kind = kernel::gene_clocks_bias;
    message.genes[2].kind = kernel::gene_clocks_output;
    const auto frame = test::encode_message(message, limits);
    ASSERT_TRUE(frame) << name_of(frame.fault().error);
    EXPECT_EQ(fault_without_allocation(codec_, *frame).error, WireError::genesis);
}

TEST_F(MessageCodecTest, NoGenomeWithoutTheInitialGenesIsWritten) {
    const auto expect_foreign = [&](auto change) {
        Genome genome = split();
        auto topology = std::make_shared<Topology>(*genome.topology);
        change(*topology);
        genome.topology = topology;
        EXPECT_EQ(error_of_writing(message_of(genome)), WireError::genesis);
    };
    expect_foreign([](Topology& topology) { ++topology.inputs; });
    expect_foreign([](Topology& topology) { ++topology.outputs; });
    expect_foreign([](Topology& topology) { ++topology.initial_connections; });
    expect_foreign([](Topology& topology) { topology.neurons[4].kind = NeuronKind::hidden; });
    expect_foreign([](Topology& topology) { topology.connection_marks[5] = mark(11, 3); });
    expect_foreign([](Topology& topology) { topology.connection_ends[5].recurrent = true; });
}

TEST_F(MessageCodecTest, TheInitialGenesSayHowManyGenesisMarksThereAre) {
    WireLimits limits = wire_limits(*initial_, settings_);
    limits.genesis_count = 100;
    MessageCodec codec{initial_, limits};
    const Bytes frame = frame_of(message_of(split(), {15}));
    EXPECT_TRUE(codec.decode(frame)) << "marks above 11 are robots', and so are stamps";
    const auto written = codec.encode(sender, message_of(split(), {15}));
    ASSERT_TRUE(written);
    EXPECT_TRUE(std::equal(written->begin(), written->end(), frame.begin(), frame.end()));
}

TEST_F(MessageCodecTest, NeuronsOfManyRobotsMayHaveOneCounter) {
    Genome genome = split();
    for (std::uint32_t robot = 8; robot < 108; ++robot) {
        samples::add_hidden(genome, mark(20, robot));
        samples::add_gene(genome, mark(20 + robot, robot), {mark(20, robot), genesis(4), false});
    }
    const auto received = codec_.decode(frame_of(message_of(genome)));
    ASSERT_TRUE(received);
    EXPECT_TRUE(samples::same_genes(*received->message.genome, genome));
}

TEST_F(MessageCodecTest, MissingInitialGenesAreRefused) {
    // All but the last initial gene, announced and sent.
    test::WireMessage message =
        *test::decode_message(frame_of(message_of(samples::perceptron(3, 2, {sender, 0}))),
                              wire_limits(*initial_, settings_));
    message.genes.pop_back();
    --message.genome.connections;
    const auto frame = test::encode_message(message, wire_limits(*initial_, settings_));
    ASSERT_TRUE(frame);
    ASSERT_FALSE(codec_.decode(*frame));
    EXPECT_EQ(codec_.decode(*frame).fault(), (WireFault{WireError::genesis, frame->size() - 4}));
}

TEST_F(MessageCodecTest, WhatNoReceiverTakesIsNotWritten) {
    EXPECT_EQ(error_of_writing(message_of(split(), {14})), WireError::not_below);
    EXPECT_EQ(error_of_writing(message_of(split(), {15}, 201.0f)), WireError::energy);
    EXPECT_EQ(error_of_writing(message_of(split(), {15}, std::numeric_limits<float>::quiet_NaN())),
              WireError::energy);
    Genome heavy = split();
    heavy.weights.back() = 10.5f;
    EXPECT_EQ(error_of_writing(message_of(heavy)), WireError::weight);
    Genome loose = split();
    samples::add_gene(loose, mark(20), {genesis(1), mark(19), false});
    EXPECT_EQ(error_of_writing(message_of(loose)), WireError::ends);
    Genome twice = split();
    samples::add_gene(twice, mark(20), {genesis(1), mark(12, 7), false});
    EXPECT_EQ(error_of_writing(message_of(twice)), WireError::repeated_ends);
    Genome shared_mark = split();
    samples::add_gene(shared_mark, mark(12, 7), {genesis(2), genesis(4), false});
    EXPECT_EQ(error_of_writing(message_of(shared_mark)), WireError::not_ascending)
        << "a neuron and a connection of one mark";
    Genome backwards = split();
    samples::add_hidden(backwards, mark(30));
    samples::add_gene(backwards, mark(29), {mark(30), genesis(4), false});
    EXPECT_EQ(error_of_writing(message_of(backwards)), WireError::ends)
        << "a connection older than its neuron";
    Genome nobody = split();
    nobody.id.robot = genesis_robot;
    EXPECT_EQ(error_of_writing(message_of(nobody)), WireError::robot);
    EXPECT_EQ(codec_.encode(genesis_robot, message_of(split())).fault().error, WireError::robot);
}

TEST_F(MessageCodecTest, GenesBeyondTheLimitsAreRefusedBothWays) {
    WireLimits limits = wire_limits(*initial_, settings_);
    const Bytes frame = frame_of(message_of(split(), {15}));
    for (const auto shrink : {0, 1, 2}) {
        WireLimits small = limits;
        if (shrink == 0) small.neurons = 5;
        if (shrink == 1) small.connections = 7;
        if (shrink == 2) small.frame_bytes = static_cast<std::uint32_t>(frame.size() - 1);
        MessageCodec codec{initial_, small};
        const WireError error = shrink == 2 ? WireError::too_long : WireError::too_many_genes;
        EXPECT_EQ(codec.decode(frame).fault().error, error);
        EXPECT_EQ(codec.encode(sender, message_of(split(), {15})).fault().error, error);
    }
}

TEST_F(MessageCodecTest, AllocatesNothingForAFrameThatLies) {
    // The largest counts that the limits allow, in a frame that is otherwise in order.
    Bytes lie{1, 7, 100, 0, 0, 0, 0, 6, 7, 0, 0x80, 0x08, 0x80, 0x08, 0, 0, 0, 0};
    test::mend_checksum(lie);
    EXPECT_EQ(fault_without_allocation(codec_, lie), (WireFault{WireError::truncated, 14}));
    // The same counts, with the bytes to hold them: zeros, of which not one gene can be read.
    Bytes frame{1, 7, 100, 0, 0, 0, 0, 0x86, 0x40, 7, 0, 0x80, 0x08, 0x80, 0x08};
    frame.resize(frame.size() + 8192 + 4);
    test::mend_checksum(frame);
    EXPECT_EQ(fault_without_allocation(codec_, frame), (WireFault{WireError::not_ascending, 15}));
}

TEST_F(MessageCodecTest, MemoryIsBoundedByTheFrame) {
    // As much genome as the limits allow, in as few bytes as it can be: hidden neurons, of which
    // most take one byte.
    Genome genome = split();
    auto topology = std::make_shared<Topology>(*genome.topology);
    while (topology->neurons.size() < 1024) {
        topology->neurons.push_back({mark(topology->neurons.size() + 14, 7), NeuronKind::hidden});
    }
    genome.topology = topology;
    const Bytes frame = frame_of(message_of(genome, {5000}));
    const auto before = test::allocations();
    const auto received = codec_.decode(frame);
    const auto after = test::allocations();
    ASSERT_TRUE(received);
    EXPECT_EQ(received->message.genome->topology->neurons.size(), 1024u);
    EXPECT_LE(after.bytes - before.bytes, 32 * frame.size());
    EXPECT_LE(after.count - before.count, 8u);
}

}  // namespace
}  // namespace gene_clocks::neat
