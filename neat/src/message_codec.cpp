#include "gene_clocks/neat/message_codec.hpp"

#include <cassert>
#include <utility>

namespace gene_clocks::neat {
namespace {

using namespace kernel;  // the names of the wire format's C header

static_assert(static_cast<int>(NeuronKind::input) == gene_clocks_input &&
              static_cast<int>(NeuronKind::bias) == gene_clocks_bias &&
              static_cast<int>(NeuronKind::output) == gene_clocks_output &&
              static_cast<int>(NeuronKind::hidden) == gene_clocks_hidden);

InnovationNumber mark_of(const gene_clocks_gene& gene) {
    return {gene.mark.counter, RobotId{gene.mark.robot}};
}

gene_clocks_gene wire_gene(const NeuronGene& neuron) {
    gene_clocks_gene gene{};
    gene.mark = neuron.mark.kernel_mark();
    gene.kind = static_cast<gene_clocks_gene_kind>(neuron.kind);
    return gene;
}

/// Index of a neuron by its mark; where there is none, one that no genome has, so that the checks
/// refuse it. Initial neurons usually have the mark index + 1, and a new connection joins the
/// newest neuron as often as not.
std::uint16_t index_of(const Topology& topology, InnovationNumber mark, std::size_t newest) {
    const auto& neurons = topology.neurons;
    if (newest < neurons.size() && neurons[newest].mark == mark) {
        return static_cast<std::uint16_t>(newest);
    }
    const std::uint64_t initial = mark.counter - 1;
    if (initial < neurons.size() && neurons[initial].mark == mark) {
        return static_cast<std::uint16_t>(initial);
    }
    return static_cast<std::uint16_t>(topology.find_neuron(mark).value_or(UINT16_MAX));
}

/// Calls `visit(gene)` for all genes in the order of marks, neurons before connections of the same
/// mark, until it reports a fault. Weights and enabled flags are the genome's.
template <class Visit>
gene_clocks_fault for_each_gene(const Genome& genome, Visit visit) {
    const Topology& topology = *genome.topology;
    std::size_t neuron = 0;
    std::size_t connection = 0;
    gene_clocks_fault fault{};
    while (!fault.error &&
           (neuron < topology.neurons.size() || connection < genome.connections())) {
        if (connection == genome.connections() ||
            (neuron < topology.neurons.size() &&
             !(topology.connection_marks[connection] < topology.neurons[neuron].mark))) {
            fault = visit(wire_gene(topology.neurons[neuron++]));
            continue;
        }
        const ConnectionEnds& ends = topology.connection_ends[connection];
        const std::size_t newest = neuron - 1;
        gene_clocks_gene gene{};
        gene.mark = topology.connection_marks[connection].kernel_mark();
        gene.kind = gene_clocks_connection;
        gene.is_enabled = genome.is_enabled(connection);
        gene.is_recurrent = ends.recurrent;
        gene.ends = {index_of(topology, ends.source, newest),
                     index_of(topology, ends.target, newest)};
        gene.weight = genome.weights[connection];
        fault = visit(gene);
        ++connection;
    }
    return fault;
}

/// What all genomes of a fleet share of an initial gene; its weight and whether it is enabled are
/// each genome's own.
bool is_same_initial_gene(const gene_clocks_gene& a, const gene_clocks_gene& b) {
    // One after the other: compared at once, small fields that were just written would be loaded
    // as one word, for which the processor waits.
    if (!gene_clocks_equal(a.mark, b.mark)) return false;
    if (a.kind != b.kind) return false;
    if (a.is_recurrent != b.is_recurrent) return false;
    if (a.ends.source != b.ends.source) return false;
    return a.ends.target == b.ends.target;
}

}  // namespace

std::size_t payload_bytes(const Genome& genome) {
    // A writer without room counts what it is given.
    gene_clocks_writer bytes{};
    for (const std::uint64_t field :
         {static_cast<std::uint64_t>(genome.id.robot), std::uint64_t{genome.id.birth},
          std::uint64_t{genome.topology->neurons.size()},
          std::uint64_t{genome.topology->connection_marks.size()}}) {
        gene_clocks_put_varint(&bytes, field);
    }
    gene_clocks_mark<std::uint64_t> last{};
    const auto add = [&](const gene_clocks_gene& gene) {
        ++bytes.size;  // the head
        const std::uint64_t leap = gene.mark.counter - last.counter;
        if (leap >= gene_clocks_head_far)
            gene_clocks_put_varint(&bytes, leap - gene_clocks_head_far);
        if (gene.mark.robot != last.robot) gene_clocks_put_varint(&bytes, gene.mark.robot);
        last = gene.mark;
        if (gene.kind != gene_clocks_connection) return gene_clocks_fault{};
        gene_clocks_put_varint(&bytes, gene.ends.source);
        gene_clocks_put_varint(&bytes, gene.ends.target);
        bytes.size += sizeof gene.weight;
        return gene_clocks_fault{};
    };
    for_each_gene(genome, add);
    return bytes.size;
}

WireLimits wire_limits(const Topology& initial, const OdneatSettings& settings) {
    WireLimits limits;
    limits.genesis_count = initial.size();
    limits.energy = static_cast<float>(settings.energy_maximum);
    limits.weight = static_cast<float>(settings.weight_limit);
    return limits;
}

MessageCodec::MessageCodec(std::shared_ptr<const Topology> initial, const WireLimits& limits)
    : initial_(std::move(initial)),
      limits_(limits),
      kernel_limits_(limits.kernel_limits()),
      joined_(GENE_CLOCKS_JOINED_WORDS(limits.connections)) {
    const std::vector<float> any(initial_->connection_marks.size());
    for_each_gene({{}, initial_, any, any}, [&](const gene_clocks_gene& gene) {
        initial_genes_.push_back(gene);
        return gene_clocks_fault{};
    });
}

/// A genome that is being read.
struct MessageCodec::Reading {
    gene_clocks_genome_reader reader;
    std::shared_ptr<Topology> topology;  // null where it is the initial one
    Genome genome;
    std::size_t genes = 0;
};

kernel::gene_clocks_fault MessageCodec::read_gene(Reading& reading) const {
    const std::size_t start = reading.reader.bytes.offset;
    gene_clocks_gene gene{};
    const auto fault = gene_clocks_next_gene(&reading.reader, &gene);
    if (fault.error) return fault;
    const std::size_t index = reading.genes++;
    const bool is_initial = index < initial_genes_.size();
    if (is_initial ? !is_same_initial_gene(gene, initial_genes_[index]) : gene.mark.robot == 0) {
        return {gene_clocks_wire_genesis, start};
    }
    if (gene.kind == gene_clocks_connection) {
        reading.genome.weights.push_back(gene.weight);
        reading.genome.enabled.push_back(gene.is_enabled ? 1.0f : 0.0f);
    }
    if (!reading.topology) return fault;
    Topology& topology = *reading.topology;
    if (gene.kind == gene_clocks_connection) {
        topology.connection_marks.push_back(mark_of(gene));
        topology.connection_ends.push_back({topology.neurons[gene.ends.source].mark,
                                            topology.neurons[gene.ends.target].mark,
                                            gene.is_recurrent});
    } else {
        topology.neurons.push_back({mark_of(gene), static_cast<NeuronKind>(gene.kind)});
    }
    return fault;
}

WireResult<ReceivedMessage> MessageCodec::decode(std::span<const std::uint8_t> bytes) {
    const auto frame = decode_frame(bytes, limits_);
    if (!frame) return frame.fault();
    // Faults within the payload are reported where they lie in the frame.
    const auto payload_start = static_cast<std::size_t>(frame->payload.data() - bytes.data());
    const auto refused = [&](gene_clocks_fault fault) {
        return WireFault::from({fault.error, payload_start + fault.offset});
    };
    Reading reading{};
    auto fault =
        gene_clocks_open_genome(&reading.reader, frame->payload.data(), frame->payload.size(),
                                frame->stamp.value, &kernel_limits_, joined_.data());
    if (fault.error) return refused(fault);
    const gene_clocks_genome counts = reading.reader.checks.genome;
    reading.genome.id = {RobotId{counts.robot}, counts.birth};
    reading.genome.weights.reserve(counts.connections);
    reading.genome.enabled.reserve(counts.connections);
    if (counts.neurons != initial_->neurons.size() ||
        counts.connections != initial_->connection_marks.size()) {
        reading.topology = std::make_shared<Topology>();
        reading.topology->neurons.reserve(counts.neurons);
        reading.topology->connection_marks.reserve(counts.connections);
        reading.topology->connection_ends.reserve(counts.connections);
        reading.topology->inputs = initial_->inputs;
        reading.topology->outputs = initial_->outputs;
        reading.topology->initial_connections = initial_->initial_connections;
    }
    while (gene_clocks_genes_left(&reading.reader) > 0) {
        fault = read_gene(reading);
        if (fault.error) return refused(fault);
    }
    fault = gene_clocks_close_genome(&reading.reader);
    if (fault.error) return refused(fault);
    if (reading.genes < initial_genes_.size()) {
        return refused({gene_clocks_wire_genesis, frame->payload.size()});
    }
    if (reading.topology) {
        reading.genome.topology = std::move(reading.topology);
    } else {
        reading.genome.topology = initial_;
    }
    return ReceivedMessage{
        frame->sender,
        {std::make_shared<const Genome>(std::move(reading.genome)), frame->energy, frame->stamp}};
}

kernel::gene_clocks_fault MessageCodec::write_genes(gene_clocks_genome_writer& writer,
                                                    const Genome& genome) const {
    const Topology& topology = *genome.topology;
    std::size_t genes = 0;
    const auto fault = for_each_gene(genome, [&](const gene_clocks_gene& gene) {
        const std::size_t index = genes++;
        const bool is_initial = index < initial_genes_.size();
        if (is_initial ? !is_same_initial_gene(gene, initial_genes_[index])
                       : gene.mark.robot == 0) {
            return gene_clocks_fault{gene_clocks_wire_genesis, writer.bytes.size};
        }
        return gene_clocks_put_gene(&writer, &gene);
    });
    if (fault.error) return fault;
    if (genes < initial_genes_.size() || topology.inputs != initial_->inputs ||
        topology.outputs != initial_->outputs ||
        topology.initial_connections != initial_->initial_connections) {
        return {gene_clocks_wire_genesis, writer.bytes.size};
    }
    return gene_clocks_end_genome(&writer);
}

WireResult<std::span<const std::uint8_t>> MessageCodec::encode(RobotId sender,
                                                               const Message& message) {
    const Genome& genome = *message.genome;
    const std::size_t neurons = genome.topology->neurons.size();
    const std::size_t connections = genome.connections();
    assert(genome.enabled.size() == connections &&
           genome.topology->connection_marks.size() == connections &&
           genome.topology->connection_ends.size() == connections);
    if (neurons > limits_.neurons || connections > limits_.connections) {
        return WireFault{WireError::too_many_genes, 0};
    }
    const std::size_t room = frame_overhead_bytes + genome_payload_bytes_max(neurons, connections);
    if (buffer_.size() < room) buffer_.resize(room);

    // The payload first, behind the longest header; the frame's writer moves it to its place.
    std::uint8_t* const payload = buffer_.data() + frame_overhead_bytes;
    gene_clocks_genome_writer writer{};
    auto fault = gene_clocks_begin_genome(
        &writer, payload, buffer_.size() - frame_overhead_bytes,
        {static_cast<std::uint32_t>(genome.id.robot), genome.id.birth,
         static_cast<std::uint16_t>(neurons), static_cast<std::uint16_t>(connections)},
        message.stamp.value, &kernel_limits_, joined_.data());
    if (!fault.error) fault = write_genes(writer, genome);
    if (fault.error) return WireFault::from(fault);
    return encode_frame({sender, message.stamp, message.energy, {payload, writer.bytes.size}},
                        buffer_, limits_);
}

}  // namespace gene_clocks::neat
