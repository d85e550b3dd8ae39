// What messages cost on their way: a genome to a frame and back, by the codec of the odNEAT layer
// (which allocates the genome that it returns) and by the C header alone (which allocates nothing).
// Genomes have travelled among a hundred robots (tests/support/travelled_genome.hpp); a benchmark
// walks over 16 of them, so that the processor cannot learn one by heart. The argument is the
// number of connections; 26 of them make a genome of 40 genes.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <gene_clocks/neat/message_codec.hpp>
#include <memory>
#include <vector>

#include "tests/support/travelled_genome.hpp"
#include "tests/support/wire_messages.hpp"

namespace {

using namespace gene_clocks;

constexpr std::size_t genomes = 16;

struct Sample {
    neat::Message message;
    std::vector<std::uint8_t> frame;
};

struct Samples {
    std::shared_ptr<const neat::Topology> initial = neat::make_initial_topology(10, 2);
    WireLimits limits = neat::wire_limits(*initial, {});
    neat::MessageCodec codec{initial, limits};
    std::vector<Sample> all;

    explicit Samples(benchmark::State& state) {
        double bytes = 0.0;
        double genes = 0.0;
        for (std::uint64_t seed = 0; seed < genomes; ++seed) {
            const auto connections = static_cast<std::size_t>(state.range(0));
            auto travelled = test::travelled_genome(connections, seed);
            neat::Message message{std::make_shared<const neat::Genome>(std::move(travelled.genome)),
                                  100.0f, travelled.stamp};
            const auto frame = codec.encode(RobotId{42}, message);
            all.push_back({std::move(message), {frame->begin(), frame->end()}});
            bytes += static_cast<double>(frame->size());
            const neat::Topology& topology = *all.back().message.genome->topology;
            genes += static_cast<double>(topology.neurons.size() + connections);
        }
        state.counters["frame_bytes"] = bytes / static_cast<double>(genomes);
        state.counters["genes"] = genes / static_cast<double>(genomes);
    }
};

void encode(benchmark::State& state) {
    Samples samples(state);
    std::size_t next = 0;
    for (auto _ : state) {
        auto frame = samples.codec.encode(RobotId{42}, samples.all[next++ % genomes].message);
        benchmark::DoNotOptimize(frame);
    }
}
BENCHMARK(encode)->Arg(26)->Arg(40)->Arg(200);

void decode(benchmark::State& state) {
    Samples samples(state);
    std::size_t next = 0;
    for (auto _ : state) {
        auto received = samples.codec.decode(samples.all[next++ % genomes].frame);
        benchmark::DoNotOptimize(received);
    }
}
BENCHMARK(decode)->Arg(26)->Arg(40)->Arg(200);

/// Into arrays that are there already.
void decode_in_place(benchmark::State& state) {
    Samples samples(state);
    const auto limits = samples.limits.kernel_limits();
    std::vector<kernel::gene_clocks_gene> genes(limits.neurons + limits.connections);
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(limits.connections));
    std::size_t next = 0;
    for (auto _ : state) {
        const auto frame = decode_frame(samples.all[next++ % genomes].frame, samples.limits);
        kernel::gene_clocks_genome genome{};
        auto fault = kernel::gene_clocks_decode_genome(frame->payload.data(), frame->payload.size(),
                                                       frame->stamp.value, &limits, &genome,
                                                       genes.data(), joined.data());
        benchmark::DoNotOptimize(fault);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(decode_in_place)->Arg(26)->Arg(40)->Arg(200);

void encode_in_place(benchmark::State& state) {
    Samples samples(state);
    const auto limits = samples.limits.kernel_limits();
    std::vector<test::WireMessage> messages;
    for (const Sample& sample : samples.all) {
        messages.push_back(*test::decode_message(sample.frame, samples.limits));
    }
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(limits.connections));
    std::vector<std::uint8_t> buffer(samples.limits.frame_bytes);
    const auto payload = std::span(buffer).subspan(frame_overhead_bytes);
    std::size_t next = 0;
    for (auto _ : state) {
        const test::WireMessage& message = messages[next++ % genomes];
        kernel::gene_clocks_genome_writer writer{};
        kernel::gene_clocks_begin_genome(&writer, payload.data(), payload.size(), message.genome,
                                         message.stamp.value, &limits, joined.data());
        for (const auto& gene : message.genes) kernel::gene_clocks_put_gene(&writer, &gene);
        auto frame = encode_frame(
            {message.sender, message.stamp, message.energy, payload.first(writer.bytes.size)},
            buffer, samples.limits);
        benchmark::DoNotOptimize(frame);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(encode_in_place)->Arg(26)->Arg(40)->Arg(200);

/// Noting which neurons are joined, in a genome that someone made up for a table without salt: all
/// its pairs come from one place in 512. Arguments: connections, salt.
void join_made_up(benchmark::State& state) {
    const auto connections = static_cast<std::uint16_t>(state.range(0));
    auto limits = WireLimits{}.kernel_limits();
    std::vector<std::uint32_t> joined(GENE_CLOCKS_JOINED_WORDS(connections));
    const auto start = [&] {
        return kernel::gene_clocks_start_checks({0, 0, 0, connections}, 1, &limits, joined.data());
    };
    const auto unsalted = start();
    std::vector<kernel::gene_clocks_ends> made_up;
    for (std::uint32_t pair = 0; made_up.size() < connections; ++pair) {
        if (kernel::gene_clocks_place_of(&unsalted, pair) > unsalted.joined_mask / 512) continue;
        made_up.push_back(
            {static_cast<std::uint16_t>(pair >> 16), static_cast<std::uint16_t>(pair)});
    }
    limits.salt = static_cast<std::uint32_t>(state.range(1));
    for (auto _ : state) {
        const auto checks = start();
        for (const auto ends : made_up) {
            benchmark::DoNotOptimize(kernel::gene_clocks_join(&checks, ends));
        }
    }
}
BENCHMARK(join_made_up)
    ->ArgsProduct({{40, 1024, 65535}, {0, 0x5eed}})
    ->Unit(benchmark::kMicrosecond);

void checksum(benchmark::State& state) {
    const std::vector<std::uint8_t> bytes(static_cast<std::size_t>(state.range(0)), 0x5a);
    for (auto _ : state) {
        benchmark::DoNotOptimize(kernel::gene_clocks_crc32c(bytes.data(), bytes.size()));
        benchmark::ClobberMemory();
    }
    state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(checksum)->Arg(350)->Arg(65536);

}  // namespace
