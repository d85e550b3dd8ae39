// Prints the sizes of general genomes that docs/wire-format.md states: the genes that other NEATs
// keep, in genomes that grew while they travelled.

#include <cstdio>
#include <gene_clocks/general_genome.hpp>
#include <gene_clocks/neat/message_codec.hpp>
#include <string>
#include <vector>

#include "tests/support/travelled_genome.hpp"

namespace {

using namespace gene_clocks;

constexpr int genomes = 100;

std::vector<std::string> values(std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back("v" + std::to_string(i));
    return names;
}

/// A float of either width.
Attribute number(const char* name, bool is_double) {
    return is_double ? Attribute::float64(name) : Attribute::float32(name);
}

/// Classes: neurons, then connections. Sizes depend on types alone.
struct Fields {
    const char* title;
    std::vector<Attribute> genome, neuron, connection;
    bool has_inputs;  ///< genes of inputs have all of a neuron's attributes
};

std::vector<Fields> fields() {
    std::vector<Fields> all{
        {"odNEAT's genes",
         {},
         {Attribute::enumeration("kind", values(4))},
         {Attribute::float32("weight"), Attribute::flag("enabled"), Attribute::flag("recurrent")},
         true}};
    for (const bool is_double : {true, false}) {
        // 18 activation functions and 7 aggregations are in its standard sets.
        all.push_back(
            {is_double ? "neat-python, float64" : "neat-python, float32",
             {number("fitness", is_double), Attribute::flag("has_fitness")},
             {number("bias", is_double), number("response", is_double),
              number("time_constant", is_double), Attribute::enumeration("activation", values(18)),
              Attribute::enumeration("aggregation", values(7))},
             {number("weight", is_double), Attribute::flag("enabled")},
             false});
    }
    for (const bool is_double : {true, false}) {
        all.push_back({is_double ? "MultiNEAT, float64" : "MultiNEAT, float32",
                       {},
                       {number("split_y", is_double), number("a", is_double),
                        number("b", is_double), number("time_constant", is_double),
                        number("bias", is_double), Attribute::enumeration("type", values(5)),
                        Attribute::enumeration("activation", values(16))},
                       {number("weight", is_double), Attribute::flag("recurrent")},
                       true});
    }
    return all;
}

Schema schema_of(const Fields& fields, std::uint64_t genesis_count) {
    return *Schema::make(
        genesis_count,
        {{"input", true, Ends::none, fields.has_inputs ? fields.neuron : std::vector<Attribute>{}},
         {"neuron", true, Ends::none, fields.neuron},
         {"connection", true, Ends::by_index, fields.connection}},
        fields.genome);
}

/// The travelled genome with zeros for attributes: no type's size but an integer's depends on them.
GeneralGenome general_genome(const neat::Genome& genome, const Schema& schema) {
    const neat::Topology& topology = *genome.topology;
    GeneralGenome general{genome.id.robot, genome.id.birth,
                          std::vector<std::uint64_t>(schema.attributes().size()),
                          std::vector<ClassGenes>(3)};
    const auto add = [&](std::size_t gene_class, InnovationNumber mark) {
        ClassGenes& genes = general.classes[gene_class];
        genes.genes.push_back({mark.counter, static_cast<std::uint32_t>(mark.robot), {}, {}});
        genes.values.resize(genes.genes.size() * schema.classes()[gene_class].attributes.size());
    };
    for (std::size_t i = 0; i < topology.neurons.size(); ++i) {
        add(i < topology.inputs ? 0 : 1, topology.neurons[i].mark);
    }
    for (std::size_t i = 0; i < topology.connection_marks.size(); ++i) {
        add(2, topology.connection_marks[i]);
        const auto& ends = topology.connection_ends[i];
        auto& gene = general.classes[2].genes.back();
        gene.source.index = static_cast<std::uint32_t>(*topology.find_neuron(ends.source));
        gene.target.index = static_cast<std::uint32_t>(*topology.find_neuron(ends.target));
    }
    return general;
}

/// Mean bytes of a frame.
double frame_bytes(const Fields& fields, std::size_t connections) {
    const auto initial = neat::make_initial_topology(10, 2);
    const Schema schema = schema_of(fields, initial->size());
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < genomes; ++seed) {
        const auto travelled = test::travelled_genome(connections, seed);
        const auto payload = *encode_general_genome(general_genome(travelled.genome, schema),
                                                    travelled.stamp, schema);
        std::vector<std::uint8_t> buffer(payload.size() + frame_overhead_bytes);
        sum += static_cast<double>(
            encode_frame({RobotId{42}, travelled.stamp, 87.5f, payload}, buffer)->size());
    }
    return sum / genomes;
}

double version_1_bytes(std::size_t connections) {
    const auto initial = neat::make_initial_topology(10, 2);
    neat::MessageCodec codec{initial, neat::wire_limits(*initial, {})};
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < genomes; ++seed) {
        auto travelled = test::travelled_genome(connections, seed);
        sum += static_cast<double>(codec
                                       .encode(RobotId{42}, {std::make_shared<const neat::Genome>(
                                                                 std::move(travelled.genome)),
                                                             87.5f, travelled.stamp})
                                       ->size());
    }
    return sum / genomes;
}

}  // namespace

int main() {
    const std::vector<std::size_t> sizes{20, 40, 200};
    std::printf(
        "| genes | schema | 20 connections | 40 | 200 |\n| --- | --- | --- | --- | --- |\n");
    std::printf("| version 1 | |");
    for (const std::size_t connections : sizes)
        std::printf(" %.0f |", version_1_bytes(connections));
    std::printf("\n");
    for (const Fields& one : fields()) {
        std::printf("| %s | %zu |", one.title, schema_of(one, 32).bytes().size());
        for (const std::size_t connections : sizes) {
            std::printf(" %.0f |", frame_bytes(one, connections));
        }
        std::printf("\n");
    }
}
