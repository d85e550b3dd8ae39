#include "message.hpp"

#include <array>

namespace your_own_neat {

using namespace gene_clocks;

namespace {

constexpr kernel::gene_clocks_wire_limits kernel_limits = limits.kernel_limits();
using Joined = std::array<std::uint32_t, GENE_CLOCKS_JOINED_WORDS(limits.connections)>;

kernel::gene_clocks_gene to_wire(const Node& node) {
    // The kinds of nodes have the same order there.
    return {node.mark.kernel_mark(),
            static_cast<kernel::gene_clocks_gene_kind>(node.kind),
            false,
            false,
            {},
            0.0f};
}

kernel::gene_clocks_gene to_wire(const Link& link, const Genome& genome) {
    return {link.mark.kernel_mark(),
            kernel::gene_clocks_connection,
            link.is_enabled,
            false,
            {static_cast<std::uint16_t>(place_of(genome, link.from)),
             static_cast<std::uint16_t>(place_of(genome, link.to))},
            link.weight};
}

InnovationNumber mark_of(const kernel::gene_clocks_gene& gene) {
    return {gene.mark.counter, RobotId{gene.mark.robot}};
}

/// Whether a genome has the genes that everyone starts with, where everyone has them. The limits
/// already hold robot 0 to the genesis marks.
bool has_genesis(const Genome& genome) {
    Random random;
    const Genome initial = initial_genome(random);
    if (genome.nodes.size() < initial.nodes.size()) return false;
    if (genome.links.size() < initial.links.size()) return false;
    for (std::size_t i = 0; i < initial.nodes.size(); ++i) {
        if (genome.nodes[i].mark != initial.nodes[i].mark) return false;
        if (genome.nodes[i].kind != initial.nodes[i].kind) return false;
    }
    for (std::size_t i = 0; i < initial.links.size(); ++i) {
        if (genome.links[i].mark != initial.links[i].mark) return false;
        if (genome.links[i].from != initial.links[i].from) return false;
        if (genome.links[i].to != initial.links[i].to) return false;
    }
    return true;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> encode(const Genome& genome, const GeneClock& clock) {
    const Stamp stamp = clock.stamp();
    std::vector<std::uint8_t> payload(limits.frame_bytes);
    Joined joined;
    kernel::gene_clocks_genome_writer writer;
    auto fault =
        kernel::gene_clocks_begin_genome(&writer, payload.data(), payload.size(),
                                         {static_cast<std::uint32_t>(genome.maker), genome.birth,
                                          static_cast<std::uint16_t>(genome.nodes.size()),
                                          static_cast<std::uint16_t>(genome.links.size())},
                                         stamp.value, &kernel_limits, joined.data());
    // Nodes and links go as one list in the order of their marks.
    auto node = genome.nodes.begin();
    auto link = genome.links.begin();
    while (!fault.error && (node != genome.nodes.end() || link != genome.links.end())) {
        const bool is_node =
            link == genome.links.end() || (node != genome.nodes.end() && node->mark < link->mark);
        const auto gene = is_node ? to_wire(*node++) : to_wire(*link++, genome);
        fault = kernel::gene_clocks_put_gene(&writer, &gene);
    }
    if (!fault.error) fault = kernel::gene_clocks_end_genome(&writer);
    if (fault.error) return std::nullopt;

    payload.resize(writer.bytes.size);
    std::vector<std::uint8_t> bytes(payload.size() + frame_overhead_bytes);
    const auto frame = encode_frame({clock.robot(), stamp, genome.fitness, payload}, bytes, limits);
    if (!frame) return std::nullopt;
    bytes.resize(frame->size());
    return bytes;
}

std::optional<Genome> decode(std::span<const std::uint8_t> bytes, GeneClock& clock) {
    const auto frame = decode_frame(bytes, limits);
    if (!frame) return std::nullopt;
    Joined joined;
    kernel::gene_clocks_genome_reader reader;
    auto fault =
        kernel::gene_clocks_open_genome(&reader, frame->payload.data(), frame->payload.size(),
                                        frame->stamp.value, &kernel_limits, joined.data());
    Genome genome;
    genome.maker = RobotId{reader.checks.genome.robot};
    genome.birth = reader.checks.genome.birth;
    genome.fitness = frame->energy;
    while (!fault.error && kernel::gene_clocks_genes_left(&reader) > 0) {
        kernel::gene_clocks_gene gene;
        fault = kernel::gene_clocks_next_gene(&reader, &gene);
        if (fault.error) break;
        if (gene.kind == kernel::gene_clocks_connection) {
            genome.links.push_back({mark_of(gene), genome.nodes[gene.ends.source].mark,
                                    genome.nodes[gene.ends.target].mark, gene.weight,
                                    gene.is_enabled});
        } else {
            genome.nodes.push_back({mark_of(gene), static_cast<Kind>(gene.kind)});
        }
    }
    if (!fault.error) fault = kernel::gene_clocks_close_genome(&reader);
    if (fault.error || !has_genesis(genome)) return std::nullopt;
    // Before any gene is used, and only once the message is known to be whole.
    if (!clock.observe(frame->stamp)) return std::nullopt;
    return genome;
}

}  // namespace your_own_neat
