#pragma once

#include "gene_clocks/neat/genome.hpp"
#include "gene_clocks/neat/random.hpp"
#include "gene_clocks/neat/settings.hpp"

namespace gene_clocks::neat {

/// A genome with the fitness by which parents are compared.
struct Parent {
    const Genome* genome{};
    float fitness{};
};

/// Recombines two genomes (paper, section 3.2): matching genes from either parent at random,
/// disjoint and excess ones from the fitter (tie: the smaller, then the second).
///
/// The child's marks are therefore those of the fitter parent, less the connections that reverse a
/// feed-forward one of a smaller mark. (None can repeat another, since a genome joins two neurons
/// only once in each direction.) A matching gene disabled in one parent is disabled with
/// disable_probability; disabled in both it stays so.
///
/// Precondition: both genomes are valid and descend from the same initial topology.
Genome crossover(GenomeId id, Parent first, Parent second, const OdneatSettings& settings,
                 RandomStream& random);

}  // namespace gene_clocks::neat
