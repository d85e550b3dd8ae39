#include "sim/replay/gene_history.hpp"

#include <algorithm>

namespace gene_clocks::replay {
namespace {

using neat::Topology;

/// The connection that a neuron split, in the genome in which it did so: there, the neuron has one
/// connection in and one out, and the old one still joins what these come from and lead to.
const InnovationNumber* find_split(const Topology& topology, InnovationNumber neuron) {
    const auto& all = topology.connection_ends;
    const auto incoming = std::ranges::find(all, neuron, &neat::ConnectionEnds::target);
    const auto outgoing = std::ranges::find(all, neuron, &neat::ConnectionEnds::source);
    if (incoming == all.end() || outgoing == all.end()) return nullptr;
    const auto old = std::ranges::find_if(all, [&](const neat::ConnectionEnds& ends) {
        return ends.source == incoming->source && ends.target == outgoing->target;
    });
    return old == all.end()
               ? nullptr
               : &topology.connection_marks[static_cast<std::size_t>(old - all.begin())];
}

}  // namespace

void GeneHistory::gene_marked(RobotId robot, InnovationNumber mark, double now_cycles) {
    const auto next = static_cast<GeneNumber>(genes_.size());
    const auto [known, is_new] = index_[mark.robot].try_emplace(mark.counter, next);
    if (!is_new) {
        Gene& gene = genes_[known->second];
        ++gene.times_marked;
        const bool is_lost = known->second >= genesis_genes_ && !gene.was_active;
        if (is_lost && std::ranges::find(fresh_, known->second) == fresh_.end()) {
            gene.genome.robot = robot;
            fresh_.push_back(known->second);
        }
        return;
    }
    Gene gene;
    gene.mark = mark;
    gene.created_cycle = now_cycles;
    gene.genome.robot = robot;
    genes_.push_back(std::move(gene));
    fresh_.push_back(next);
}

void GeneHistory::begin(const Topology& initial) {
    for (const neat::NeuronGene& neuron : initial.neurons) {
        index_[neuron.mark.robot][neuron.mark.counter] = static_cast<GeneNumber>(genes_.size());
        genes_.emplace_back().mark = neuron.mark;
    }
    for (std::size_t i = 0; i < initial.connection_marks.size(); ++i) {
        const InnovationNumber mark = initial.connection_marks[i];
        const auto& ends = initial.connection_ends[i];
        index_[mark.robot][mark.counter] = static_cast<GeneNumber>(genes_.size());
        Gene& gene = genes_.emplace_back();
        gene.mark = mark;
        gene.kind = GeneKind::connection;
        for (const InnovationNumber end : {ends.source, ends.target}) {
            gene.builds_upon.push_back(index_.at(end.robot).at(end.counter));
        }
    }
    genesis_genes_ = genes_.size();
}

std::size_t GeneHistory::find_gene_set(const std::shared_ptr<const Topology>& topology) {
    const auto [known, is_new] = known_topologies_.try_emplace(topology, 0);
    if (!is_new) return known->second;
    std::vector<GeneNumber> genes;
    const auto add = [&](InnovationNumber mark) {
        const GeneNumber index = index_.at(mark.robot).at(mark.counter);
        if (index >= genesis_genes_) genes.push_back(index);
    };
    for (const neat::NeuronGene& neuron : topology->neurons) add(neuron.mark);
    for (const InnovationNumber mark : topology->connection_marks) add(mark);
    std::ranges::sort(genes);
    const auto [place, added] = gene_set_index_.try_emplace(std::move(genes), gene_sets_.size());
    if (added) gene_sets_.push_back(place->first);
    known->second = place->second;
    return place->second;
}

void GeneHistory::complete(GeneNumber index, const neat::Genome& genome, std::size_t gene_set) {
    Gene& gene = genes_[index];
    const Topology& topology = *genome.topology;
    const auto& marks = topology.connection_marks;
    const auto found = std::ranges::lower_bound(marks, gene.mark);
    const bool is_connection = found != marks.end() && *found == gene.mark;
    const bool is_neuron = !is_connection && topology.find_neuron(gene.mark);
    if (!is_connection && !is_neuron) return;
    gene.was_active = true;
    gene.genome = genome.id;
    gene.gene_set = gene_set;
    const auto build_upon = [&](InnovationNumber mark) {
        gene.builds_upon.push_back(index_.at(mark.robot).at(mark.counter));
    };
    if (is_neuron) {
        gene.kind = GeneKind::neuron;
        if (const auto* split = find_split(topology, gene.mark)) build_upon(*split);
        return;
    }
    const auto& ends = topology.connection_ends[static_cast<std::size_t>(found - marks.begin())];
    gene.kind = ends.recurrent ? GeneKind::recurrent_connection : GeneKind::connection;
    build_upon(ends.source);
    build_upon(ends.target);
}

void GeneHistory::between_cycles(const sim::SwarmView& swarm) {
    const bool is_first = genomes_.empty();
    if (is_first) {
        begin(*swarm.agents.front().active().topology);
        genomes_.resize(swarm.agents.size());
        active_.resize(swarm.agents.size());
    }
    for (std::size_t i = 0; i < swarm.agents.size(); ++i) {
        const neat::Genome& genome = swarm.agents[i].active();
        if (!is_first && genome.id == genomes_[i]) continue;
        genomes_[i] = genome.id;
        active_[i] = find_gene_set(genome.topology);
        activations_.push_back({swarm.cycle, static_cast<std::uint32_t>(i), active_[i]});
    }
    for (const GeneNumber index : fresh_) {
        const auto robot = static_cast<std::size_t>(genes_[index].genome.robot) - 1;
        complete(index, swarm.agents[robot].active(), active_[robot]);
    }
    fresh_.clear();
}

}  // namespace gene_clocks::replay
