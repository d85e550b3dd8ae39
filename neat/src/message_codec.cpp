#include <algorithm>
#include <bit>
#include <cassert>
#include <gene_clocks/neat/message_codec.hpp>
#include <random>
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

/// The neurons of a genome by their marks: a hash table with linear probing, at least half empty,
/// in memory that is kept.
class NeuronIndex {
public:
    /// `salt`: a number that strangers, who choose marks, cannot guess; else they could make up a
    /// genome whose marks all fall in one place.
    NeuronIndex(std::vector<std::uint16_t>& places, const std::vector<NeuronGene>& neurons,
                std::uint32_t salt)
        : places_(places), neurons_(neurons), salt_(salt * 0x9e3779b97f4a7c15u) {
        places_.assign(std::bit_ceil(2 * neurons.size() + 1), none);
    }

    void add(std::size_t neuron) {
        places_[place_of(neurons_[neuron].mark)] = static_cast<std::uint16_t>(neuron);
    }
    /// Index of a neuron that was added; where there is none, one that no genome has, so that the
    /// checks refuse it.
    std::uint16_t find(InnovationNumber mark) const { return places_[place_of(mark)]; }

private:
    static constexpr std::uint16_t none = UINT16_MAX;

    std::size_t place_of(InnovationNumber mark) const {
        const std::uint64_t key =
            mark.counter + (std::uint64_t{static_cast<std::uint32_t>(mark.robot)} << 32);
        std::uint64_t hash = (key ^ salt_) * 0xff51afd7ed558ccdu;  // MurmurHash3's
        hash = (hash ^ hash >> 33) * 0xc4ceb9fe1a85ec53u;
        std::size_t place = hash >> 40;
        while (true) {
            place &= places_.size() - 1;
            if (places_[place] == none || neurons_[places_[place]].mark == mark) return place;
            ++place;
        }
    }

    std::vector<std::uint16_t>& places_;
    const std::vector<NeuronGene>& neurons_;
    std::uint64_t salt_;
};

gene_clocks_gene wire_gene(const Genome& genome, std::size_t connection, const NeuronIndex& index) {
    const Topology& topology = *genome.topology;
    const ConnectionEnds& ends = topology.connection_ends[connection];
    gene_clocks_gene gene{};
    gene.mark = topology.connection_marks[connection].kernel_mark();
    gene.kind = gene_clocks_connection;
    gene.is_enabled = genome.is_enabled(connection);
    gene.is_recurrent = ends.recurrent;
    gene.ends = {index.find(ends.source), index.find(ends.target)};
    gene.weight = genome.weights[connection];
    return gene;
}

/// Writes the genes from these on to `genes`, in the order of marks, neurons before connections of
/// the same mark. `places` is scratch memory.
void merge_genes(const Genome& genome, std::size_t neuron, std::size_t connection,
                 gene_clocks_gene* genes, std::vector<std::uint16_t>& places, std::uint32_t salt) {
    const Topology& topology = *genome.topology;
    NeuronIndex index(places, topology.neurons, salt);
    for (std::size_t i = 0; i < neuron; ++i) index.add(i);
    while (neuron < topology.neurons.size() || connection < genome.connections()) {
        if (connection == genome.connections() ||
            (neuron < topology.neurons.size() &&
             !(topology.connection_marks[connection] < topology.neurons[neuron].mark))) {
            index.add(neuron);
            *genes++ = wire_gene(topology.neurons[neuron++]);
        } else {
            *genes++ = wire_gene(genome, connection, index);
            ++connection;
        }
    }
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

/// Limits under which the initial genes have all genesis marks.
WireLimits limits_of_fleet(WireLimits limits, const Topology& initial) {
    limits.genesis_count = initial.size();
    return limits;
}

/// With a salt that no stranger knows; nothing that comes of it can be seen but how long checks
/// take.
WireLimits salted(WireLimits limits) {
    if (limits.salt == 0) limits.salt = std::random_device{}();
    return limits;
}

}  // namespace

std::size_t payload_bytes(const Genome& genome) {
    const Topology& topology = *genome.topology;
    const auto& neurons = topology.neurons;
    gene_clocks_writer bytes{};  // without room: it counts what it is given
    const gene_clocks_genome header{static_cast<std::uint32_t>(genome.id.robot), genome.id.birth,
                                    static_cast<std::uint16_t>(neurons.size()),
                                    static_cast<std::uint16_t>(genome.connections())};
    gene_clocks_put_genome_header_unchecked(&bytes, &header);
    gene_clocks_mark<std::uint64_t> last{};
    const auto add = [&](const gene_clocks_gene& gene) {
        gene_clocks_put_gene_unchecked(&bytes, last, &gene);
        last = gene.mark;
    };
    // In whole genomes: with other sources than clocks, a neuron may come after its connection.
    const auto place_of = [&](InnovationNumber mark) {
        // Initial neurons usually have the mark index + 1.
        const std::uint64_t guess = mark.counter - 1;
        const bool is_initial = guess < neurons.size() && neurons[guess].mark == mark;
        return static_cast<std::uint16_t>(is_initial ? guess : topology.find_neuron(mark).value());
    };
    std::size_t neuron = 0;
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        const InnovationNumber mark = topology.connection_marks[i];
        while (neuron < neurons.size() && !(mark < neurons[neuron].mark)) {
            add(wire_gene(neurons[neuron++]));
        }
        gene_clocks_gene gene{};
        gene.mark = mark.kernel_mark();
        gene.kind = gene_clocks_connection;
        gene.ends = {place_of(topology.connection_ends[i].source),
                     place_of(topology.connection_ends[i].target)};
        add(gene);
    }
    while (neuron < neurons.size()) add(wire_gene(neurons[neuron++]));
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
      initial_genes_(initial_->size()),
      limits_(salted(limits_of_fleet(limits, *initial_))),
      kernel_limits_(limits_.kernel_limits()),
      genes_(std::size_t{limits.neurons} + limits.connections),
      joined_(GENE_CLOCKS_JOINED_WORDS(limits.connections)) {
    const std::vector<float> any(initial_->connection_marks.size());
    merge_genes({{}, initial_, any, any}, 0, 0, initial_genes_.data(), places_, limits_.salt);
}

// ---- Reading ------------------------------------------------------------------------------------

/// The first of so many genes in `genes_` that is no initial gene where one must be; `genes` where
/// initial genes are missing. Behind them comes none, since their marks are all genesis marks.
std::optional<std::size_t> MessageCodec::first_foreign_gene(std::size_t genes) const {
    const std::size_t initial = std::min(genes, initial_genes_.size());
    for (std::size_t i = 0; i < initial; ++i) {
        if (!is_same_initial_gene(genes_[i], initial_genes_[i])) return i;
    }
    return genes < initial_genes_.size() ? std::optional(genes) : std::nullopt;
}

/// Where a gene begins in a payload that is a genome. Only for what is refused: reads it again.
std::size_t MessageCodec::offset_of_gene(const Frame& frame, std::size_t index) {
    gene_clocks_genome_reader reader{};
    gene_clocks_open_genome(&reader, frame.payload.data(), frame.payload.size(), frame.stamp.value,
                            &kernel_limits_, joined_.data());
    gene_clocks_gene gene{};
    while (index-- > 0) gene_clocks_next_gene(&reader, &gene);
    return reader.bytes.offset;
}

/// The topology of the genes in `genes_`, which are valid and begin with the initial ones.
std::shared_ptr<const Topology> MessageCodec::topology_of(const gene_clocks_genome& counts) const {
    const std::size_t genes = std::size_t{counts.neurons} + counts.connections;
    if (genes == initial_genes_.size()) return initial_;
    const auto topology = std::make_shared<Topology>();
    const auto begin_with = [](auto& list, const auto& initial, std::size_t size) {
        list.reserve(size);
        list.insert(list.end(), initial.begin(), initial.end());
    };
    begin_with(topology->neurons, initial_->neurons, counts.neurons);
    begin_with(topology->connection_marks, initial_->connection_marks, counts.connections);
    begin_with(topology->connection_ends, initial_->connection_ends, counts.connections);
    topology->inputs = initial_->inputs;
    topology->outputs = initial_->outputs;
    topology->initial_connections = initial_->initial_connections;
    for (std::size_t i = initial_genes_.size(); i < genes; ++i) {
        const gene_clocks_gene& gene = genes_[i];
        if (gene.kind != gene_clocks_connection) {
            topology->neurons.push_back({mark_of(gene), static_cast<NeuronKind>(gene.kind)});
            continue;
        }
        topology->connection_marks.push_back(mark_of(gene));
        topology->connection_ends.push_back({topology->neurons[gene.ends.source].mark,
                                             topology->neurons[gene.ends.target].mark,
                                             gene.is_recurrent});
    }
    return topology;
}

WireResult<ReceivedMessage> MessageCodec::decode(std::span<const std::uint8_t> bytes) {
    const auto frame = decode_frame(bytes, limits_);
    if (!frame) return frame.fault();
    gene_clocks_genome counts{};
    auto fault =
        gene_clocks_decode_genome(frame->payload.data(), frame->payload.size(), frame->stamp.value,
                                  &kernel_limits_, &counts, genes_.data(), joined_.data());
    const std::size_t genes = std::size_t{counts.neurons} + counts.connections;
    if (!fault.error) {
        if (const auto foreign = first_foreign_gene(genes)) {
            fault = {gene_clocks_wire_genesis, offset_of_gene(*frame, *foreign)};
        }
    }
    if (fault.error) {  // where it lies in the frame
        const auto payload = static_cast<std::size_t>(frame->payload.data() - bytes.data());
        return WireFault::from({fault.error, payload + fault.offset});
    }
    auto genome = std::make_shared<Genome>();
    genome->id = {RobotId{counts.robot}, counts.birth};
    genome->topology = topology_of(counts);
    std::vector<float> weights(counts.connections);
    std::vector<float> enabled(counts.connections);
    std::size_t connection = 0;
    for (const gene_clocks_gene& gene : std::span(genes_).first(genes)) {
        if (gene.kind != gene_clocks_connection) continue;
        weights[connection] = gene.weight;
        enabled[connection] = static_cast<float>(gene.is_enabled);
        ++connection;
    }
    genome->weights = std::move(weights);
    genome->enabled = std::move(enabled);
    return ReceivedMessage{frame->sender, {std::move(genome), frame->energy, frame->stamp}};
}

// ---- Writing ------------------------------------------------------------------------------------

bool MessageCodec::has_initial_genes(const Topology& topology) const {
    if (&topology == initial_.get()) return true;
    const auto begins_with = [](const auto& list, const auto& initial) {
        return list.size() >= initial.size() &&
               std::equal(initial.begin(), initial.end(), list.begin());
    };
    return topology.inputs == initial_->inputs && topology.outputs == initial_->outputs &&
           topology.initial_connections == initial_->initial_connections &&
           begins_with(topology.neurons, initial_->neurons) &&
           begins_with(topology.connection_marks, initial_->connection_marks) &&
           begins_with(topology.connection_ends, initial_->connection_ends);
}

/// Puts a genome's genes into `genes_`, which has room for them; false where it does not begin with
/// the initial ones.
bool MessageCodec::take_genes(const Genome& genome) {
    if (!has_initial_genes(*genome.topology)) return false;
    std::copy(initial_genes_.begin(), initial_genes_.end(), genes_.begin());
    std::size_t connection = 0;
    for (std::size_t i = 0; i < initial_genes_.size(); ++i) {
        if (genes_[i].kind != gene_clocks_connection) continue;
        genes_[i].is_enabled = genome.is_enabled(connection);
        genes_[i].weight = genome.weights[connection];
        ++connection;
    }
    merge_genes(genome, initial_->neurons.size(), initial_->connection_marks.size(),
                genes_.data() + initial_genes_.size(), places_, limits_.salt);
    return true;
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
    if (!take_genes(genome)) return WireFault{WireError::genesis, 0};
    const std::size_t room = frame_overhead_bytes + genome_payload_bytes_max(neurons, connections);
    if (buffer_.size() < room) buffer_.resize(room);

    // The payload first, behind the longest header; the frame's writer moves it to its place.
    const auto payload = std::span(buffer_).subspan(frame_overhead_bytes);
    gene_clocks_genome_writer writer{};
    auto fault = gene_clocks_begin_genome(
        &writer, payload.data(), payload.size(),
        {static_cast<std::uint32_t>(genome.id.robot), genome.id.birth,
         static_cast<std::uint16_t>(neurons), static_cast<std::uint16_t>(connections)},
        message.stamp.value, &kernel_limits_, joined_.data());
    for (std::size_t i = 0; !fault.error && i < neurons + connections; ++i) {
        fault = gene_clocks_put_gene(&writer, &genes_[i]);
    }
    if (!fault.error) fault = gene_clocks_end_genome(&writer);
    if (fault.error) return WireFault::from(fault);
    return encode_frame({sender, message.stamp, message.energy, payload.first(writer.bytes.size)},
                        buffer_, limits_);
}

}  // namespace gene_clocks::neat
