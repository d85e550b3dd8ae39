#pragma once

#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/neat/innovation_source.hpp>
#include <gene_clocks/neat/random.hpp>
#include <gene_clocks/neat/settings.hpp>

namespace gene_clocks::neat {

enum class Mutation : std::uint8_t { none, add_neuron, add_connection, weights };

/// At most one mutation (paper, section 3.2): add a neuron with p_node; else a connection with
/// p_connection; else all weights with p_weight. Returns what was done; `none` also where a
/// structural mutation found no place or no mark.
Mutation mutate(Genome& genome, const OdneatSettings& settings, InnovationSource& source,
                double now_cycles, RandomStream& random);

/// Splits a random enabled connection that does not come from the bias: it is disabled, a new
/// neuron takes its place, with weight 1 in and the old weight out. False where none was found.
bool add_neuron(Genome& genome, const OdneatSettings& settings, InnovationSource& source,
                double now_cycles, RandomStream& random);

/// Joins two neurons that are not joined yet, with a weight from U(−1, 1); with p_recurrent by a
/// recurrent connection. False where no such pair was found.
bool add_connection(Genome& genome, const OdneatSettings& settings, InnovationSource& source,
                    double now_cycles, RandomStream& random);

/// Adds N(0, sigma) to every enabled weight, clipped to ±weight_limit.
void mutate_weights(Genome& genome, const OdneatSettings& settings, RandomStream& random);

/// Whether a connection between these neurons would close a cycle: a self-loop, one out of an
/// output, or one whose source its target already reaches over enabled feed-forward connections.
bool is_recurrent(const Genome& genome, InnovationNumber source, InnovationNumber target);

}  // namespace gene_clocks::neat
