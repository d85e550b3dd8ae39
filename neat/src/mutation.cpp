#include <algorithm>
#include <cassert>
#include <gene_clocks/neat/mutation.hpp>
#include <vector>

namespace gene_clocks::neat {
namespace {

/// Adds a connection to a topology that `genome` does not use yet, and to the genome's arrays.
void insert_connection(Genome& genome, Topology& topology, InnovationNumber mark,
                       const ConnectionEnds& ends, float weight) {
    const auto index = static_cast<std::ptrdiff_t>(topology.insert(mark, ends));
    genome.weights.insert(genome.weights.begin() + index, weight);
    genome.enabled.insert(genome.enabled.begin() + index, 1.0f);
}

std::uint32_t count(std::size_t size) {
    return static_cast<std::uint32_t>(size);
}

}  // namespace

Mutation mutate(Genome& genome, const OdneatSettings& settings, InnovationSource& source,
                double now_cycles, RandomStream& random) {
    if (random.chance(settings.p_node)) {
        return add_neuron(genome, settings, source, now_cycles, random) ? Mutation::add_neuron
                                                                        : Mutation::none;
    }
    if (random.chance(settings.p_connection)) {
        return add_connection(genome, settings, source, now_cycles, random)
                   ? Mutation::add_connection
                   : Mutation::none;
    }
    if (random.chance(settings.p_weight)) {
        mutate_weights(genome, settings, random);
        return Mutation::weights;
    }
    return Mutation::none;
}

bool add_neuron(Genome& genome, const OdneatSettings& settings, InnovationSource& source,
                double now_cycles, RandomStream& random) {
    const Topology& before = *genome.topology;
    const InnovationNumber bias = before.neurons[before.inputs - 1].mark;
    for (std::int64_t attempt = 0; attempt < settings.structural_tries; ++attempt) {
        const std::size_t split = random.below(count(genome.connections()));
        const ConnectionEnds old = before.connection_ends[split];
        if (!genome.is_enabled(split) || old.source == bias) continue;

        const auto marks = source.mark_split(genome, split, now_cycles);
        if (!marks) return false;
        const float old_weight = genome.weights[split];
        genome.enabled[split] = 0.0f;
        auto topology = std::make_shared<Topology>(before);
        topology->insert(NeuronGene{marks->neuron, NeuronKind::hidden});
        insert_connection(genome, *topology, marks->incoming,
                          {old.source, marks->neuron, old.recurrent}, 1.0f);
        insert_connection(genome, *topology, marks->outgoing, {marks->neuron, old.target, false},
                          old_weight);
        genome.topology = std::move(topology);
        assert(is_valid(genome, settings.weight_limit));
        return true;
    }
    return false;
}

bool is_recurrent(const Genome& genome, InnovationNumber source, InnovationNumber target) {
    if (source == target) return true;
    const Topology& topology = *genome.topology;
    const auto start = topology.find_neuron(source);
    if (start && topology.neurons[*start].kind == NeuronKind::output) return true;

    std::vector<InnovationNumber> reached{target};
    for (std::size_t next = 0; next < reached.size(); ++next) {
        for (std::size_t i = 0; i < genome.connections(); ++i) {
            const auto& ends = topology.connection_ends[i];
            if (ends.source != reached[next] || ends.recurrent || !genome.is_enabled(i)) continue;
            if (ends.target == source) return true;
            if (std::find(reached.begin(), reached.end(), ends.target) == reached.end()) {
                reached.push_back(ends.target);
            }
        }
    }
    return false;
}

bool add_connection(Genome& genome, const OdneatSettings& settings, InnovationSource& source,
                    double now_cycles, RandomStream& random) {
    const Topology& before = *genome.topology;
    const std::uint32_t neurons = count(before.neurons.size());
    const std::uint32_t targets = neurons - count(before.inputs);
    const auto draw_target = [&] { return before.inputs + random.below(targets); };
    const bool recurrent = random.chance(settings.p_recurrent);
    for (std::int64_t attempt = 0; attempt < settings.structural_tries; ++attempt) {
        const std::size_t target = draw_target();
        const bool self_loop = recurrent && random.chance(0.5);
        const std::size_t start = self_loop   ? target
                                  : recurrent ? draw_target()
                                              : random.below(neurons);
        const ConnectionEnds ends{before.neurons[start].mark, before.neurons[target].mark,
                                  recurrent};
        if (before.joined(ends.source, ends.target)) continue;
        if (is_recurrent(genome, ends.source, ends.target) != recurrent) continue;

        const auto mark = source.mark_connection(genome, ends, now_cycles);
        if (!mark) return false;
        auto topology = std::make_shared<Topology>(before);
        insert_connection(genome, *topology, *mark, ends,
                          static_cast<float>(random.uniform(-1.0, 1.0)));
        genome.topology = std::move(topology);
        assert(is_valid(genome, settings.weight_limit));
        return true;
    }
    return false;
}

void mutate_weights(Genome& genome, const OdneatSettings& settings, RandomStream& random) {
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        if (!genome.is_enabled(i)) continue;
        const double mutated = genome.weights[i] + settings.sigma * random.normal();
        genome.weights[i] =
            static_cast<float>(std::clamp(mutated, -settings.weight_limit, settings.weight_limit));
    }
    assert(is_valid(genome, settings.weight_limit));
}

}  // namespace gene_clocks::neat
