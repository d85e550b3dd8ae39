#include <algorithm>
#include <cassert>
#include <cmath>
#include <gene_clocks/neat/genome.hpp>

namespace gene_clocks::neat {
namespace {

bool has_sorted_unique_marks(const Topology& topology) {
    const auto increasing = [](const auto& marks, auto mark_of) {
        return std::adjacent_find(marks.begin(), marks.end(), [&](const auto& a, const auto& b) {
                   return !(mark_of(a) < mark_of(b));
               }) == marks.end();
    };
    return increasing(topology.neurons, [](const NeuronGene& gene) { return gene.mark; }) &&
           increasing(topology.connection_marks, [](InnovationNumber mark) { return mark; });
}

std::optional<std::string_view> find_fault_in_ends(const Topology& topology) {
    for (std::size_t i = 0; i < topology.connection_ends.size(); ++i) {
        const auto& ends = topology.connection_ends[i];
        const auto target = topology.find_neuron(ends.target);
        if (!topology.find_neuron(ends.source) || !target)
            return "a connection's neuron is missing";
        if (*target < topology.inputs) return "a connection ends in an input";
        for (std::size_t j = 0; j < i; ++j) {
            const auto& other = topology.connection_ends[j];
            if (other.source == ends.source && other.target == ends.target) {
                return "two connections join the same neurons";
            }
        }
    }
    return std::nullopt;
}

bool has_initial_genes_first(const Topology& topology) {
    if (topology.inputs == 0 || topology.outputs == 0) return false;
    if (topology.neurons.size() < topology.inputs + topology.outputs) return false;
    if (topology.connection_marks.size() < topology.initial_connections) return false;
    for (std::size_t i = 0; i < topology.neurons.size(); ++i) {
        const auto expected = i + 1 < topology.inputs                  ? NeuronKind::input
                              : i < topology.inputs                    ? NeuronKind::bias
                              : i < topology.inputs + topology.outputs ? NeuronKind::output
                                                                       : NeuronKind::hidden;
        if (topology.neurons[i].kind != expected) return false;
    }
    return std::all_of(topology.connection_marks.begin(),
                       topology.connection_marks.begin() +
                           static_cast<std::ptrdiff_t>(topology.initial_connections),
                       [](InnovationNumber mark) { return mark.robot == genesis_robot; });
}

}  // namespace

std::optional<std::size_t> Topology::find_neuron(InnovationNumber mark) const {
    const auto found = std::lower_bound(
        neurons.begin(), neurons.end(), mark,
        [](const NeuronGene& gene, InnovationNumber wanted) { return gene.mark < wanted; });
    if (found == neurons.end() || found->mark != mark) return std::nullopt;
    return static_cast<std::size_t>(found - neurons.begin());
}

bool Topology::joined(InnovationNumber source, InnovationNumber target) const {
    return std::any_of(
        connection_ends.begin(), connection_ends.end(),
        [&](const ConnectionEnds& ends) { return ends.source == source && ends.target == target; });
}

std::uint64_t genesis_mark_count(std::size_t inputs, std::size_t outputs) {
    return inputs + outputs + inputs * outputs;
}

std::shared_ptr<const Topology> make_initial_topology(std::size_t inputs, std::size_t outputs) {
    assert(inputs >= 1 && outputs >= 1);
    auto topology = std::make_shared<Topology>();
    topology->inputs = inputs;
    topology->outputs = outputs;
    topology->initial_connections = inputs * outputs;
    std::uint64_t counter = 1;
    for (std::size_t i = 0; i < inputs + outputs; ++i) {
        const auto kind = i + 1 < inputs ? NeuronKind::input
                          : i < inputs   ? NeuronKind::bias
                                         : NeuronKind::output;
        topology->neurons.push_back({{counter++, genesis_robot}, kind});
    }
    for (std::size_t i = 0; i < inputs; ++i) {
        for (std::size_t o = 0; o < outputs; ++o) {
            topology->connection_marks.push_back({counter++, genesis_robot});
            topology->connection_ends.push_back(
                {topology->neurons[i].mark, topology->neurons[inputs + o].mark, false});
        }
    }
    return topology;
}

std::size_t Topology::insert(NeuronGene neuron) {
    const auto place = std::upper_bound(
        neurons.begin(), neurons.end(), neuron.mark,
        [](InnovationNumber mark, const NeuronGene& gene) { return mark < gene.mark; });
    const auto index = static_cast<std::size_t>(place - neurons.begin());
    neurons.insert(place, neuron);
    return index;
}

std::size_t Topology::insert(InnovationNumber mark, ConnectionEnds ends) {
    const auto place = std::upper_bound(connection_marks.begin(), connection_marks.end(), mark);
    const auto index = place - connection_marks.begin();
    connection_marks.insert(place, mark);
    connection_ends.insert(connection_ends.begin() + index, ends);
    return static_cast<std::size_t>(index);
}

Genome make_initial_genome(GenomeId id, std::shared_ptr<const Topology> topology,
                           double weight_limit, RandomStream& random) {
    Genome genome{id, std::move(topology), {}, {}};
    const std::size_t connections = genome.topology->connection_marks.size();
    genome.weights.reserve(connections);
    for (std::size_t i = 0; i < connections; ++i) {
        genome.weights.push_back(
            static_cast<float>(std::clamp(random.normal(), -weight_limit, weight_limit)));
    }
    genome.enabled.assign(connections, 1.0f);
    return genome;
}

std::optional<std::string_view> find_fault(const Genome& genome, double weight_limit) {
    if (!genome.topology) return "there is no topology";
    const auto& topology = *genome.topology;
    if (topology.connection_ends.size() != topology.connection_marks.size() ||
        genome.weights.size() != topology.connection_marks.size() ||
        genome.enabled.size() != topology.connection_marks.size()) {
        return "the gene arrays differ in length";
    }
    if (!has_sorted_unique_marks(topology)) return "marks are not sorted and unique";
    if (!has_initial_genes_first(topology)) return "the initial genes do not come first";
    if (const auto fault = find_fault_in_ends(topology)) return fault;
    for (std::size_t i = 0; i < genome.weights.size(); ++i) {
        if (!(std::abs(genome.weights[i]) <= static_cast<float>(weight_limit))) {
            return "a weight is out of range";
        }
        if (genome.enabled[i] != 0.0f && genome.enabled[i] != 1.0f) {
            return "a gene is neither enabled nor disabled";
        }
    }
    return std::nullopt;
}

}  // namespace gene_clocks::neat
