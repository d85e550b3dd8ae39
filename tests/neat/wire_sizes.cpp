// Prints the sizes that docs/wire-format.md states: genomes as frames, and the same genomes in
// other formats.

#include <cstdio>
#include <gene_clocks/neat/message_codec.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/travelled_genome.hpp"

namespace {

using namespace gene_clocks;

// With floats as floats, so that the others write no more digits than it takes.
using Json = nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t,
                                  std::uint64_t, float>;

Json as_json(InnovationNumber mark) {
    return Json::array({mark.counter, static_cast<std::uint32_t>(mark.robot)});
}

/// The message with its fields by name.
Json as_json(const neat::Message& message) {
    constexpr const char* kinds[] = {"input", "bias", "output", "hidden"};
    const neat::Genome& genome = *message.genome;
    Json neurons = Json::array();
    for (const auto& neuron : genome.topology->neurons) {
        neurons.push_back(
            {{"mark", as_json(neuron.mark)}, {"kind", kinds[static_cast<int>(neuron.kind)]}});
    }
    Json connections = Json::array();
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        const auto& ends = genome.topology->connection_ends[i];
        connections.push_back({{"mark", as_json(genome.topology->connection_marks[i])},
                               {"source", as_json(ends.source)},
                               {"target", as_json(ends.target)},
                               {"recurrent", ends.recurrent},
                               {"enabled", genome.is_enabled(i)},
                               {"weight", genome.weights[i]}});
    }
    return {{"version", 1},
            {"sender", 42},
            {"stamp", message.stamp.value},
            {"energy", message.energy},
            {"genome",
             {{"robot", static_cast<std::uint32_t>(genome.id.robot)},
              {"birth", genome.id.birth},
              {"neurons", neurons},
              {"connections", connections}}}};
}

/// The same without names: what a schema known to both sides saves.
Json without_names(const Json& value) {
    if (!value.is_structured()) return value;
    Json values = Json::array();
    for (const Json& inner : value) values.push_back(without_names(inner));
    return values;
}

struct Sizes {
    double neurons = 0, connections = 0, frame = 0, json = 0, cbor = 0, cbor_arrays = 0;
};

/// Means over 100 genomes with so many connections.
Sizes measure(std::size_t connections) {
    constexpr int genomes = 100;
    const auto initial = neat::make_initial_topology(10, 2);
    neat::MessageCodec codec{initial, neat::wire_limits(*initial, {})};
    Sizes sum;
    for (std::uint64_t seed = 0; seed < genomes; ++seed) {
        auto travelled = test::travelled_genome(connections, seed);
        const neat::Message message{
            std::make_shared<const neat::Genome>(std::move(travelled.genome)), 87.5f,
            travelled.stamp};
        const Json json = as_json(message);
        sum.neurons += static_cast<double>(message.genome->topology->neurons.size());
        sum.connections += static_cast<double>(message.genome->connections());
        sum.frame += static_cast<double>(codec.encode(RobotId{42}, message)->size());
        sum.json += static_cast<double>(json.dump().size());
        sum.cbor += static_cast<double>(Json::to_cbor(json).size());
        sum.cbor_arrays += static_cast<double>(Json::to_cbor(without_names(json)).size());
    }
    for (double* value :
         {&sum.neurons, &sum.connections, &sum.frame, &sum.json, &sum.cbor, &sum.cbor_arrays}) {
        *value /= genomes;
    }
    return sum;
}

std::size_t stamp_bytes(std::uint64_t stamp) {
    std::vector<std::uint8_t> buffer(frame_overhead_bytes);
    const auto with = [&](std::uint64_t value) {
        return encode_frame({RobotId{42}, Stamp{value}, 0.0f, {}}, buffer)->size();
    };
    return with(stamp) - with(1) + 1;
}

}  // namespace

int main() {
    std::printf("| stamp up to | bytes of the stamp |\n| --- | --- |\n");
    for (const unsigned bits : {7u, 14u, 21u, 28u, 35u, 63u}) {
        const std::uint64_t largest = (std::uint64_t{1} << bits) - 1;
        std::printf("| 2^%u - 1 | %zu |\n", bits, stamp_bytes(largest));
    }
    std::printf("\n| connections | neurons | frame | JSON | CBOR | CBOR without names |\n");
    std::printf("| --- | --- | --- | --- | --- | --- |\n");
    Sizes before;
    for (const std::size_t connections : {20u, 40u, 200u}) {
        const Sizes sizes = measure(connections);
        std::printf("| %.0f | %.1f | %.0f | %.0f | %.0f | %.0f |\n", sizes.connections,
                    sizes.neurons, sizes.frame, sizes.json, sizes.cbor, sizes.cbor_arrays);
        if (connections == 40) {
            const double genes =
                sizes.connections - before.connections + sizes.neurons - before.neurons;
            std::printf("| each gene beyond the initial ones | | %.1f | %.1f | %.1f | %.1f |\n",
                        (sizes.frame - before.frame) / genes, (sizes.json - before.json) / genes,
                        (sizes.cbor - before.cbor) / genes,
                        (sizes.cbor_arrays - before.cbor_arrays) / genes);
        }
        before = sizes;
    }
}
