#pragma once

#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/neat/random.hpp>
#include <gene_clocks/neat/settings.hpp>

namespace gene_clocks::neat {

/// A genome with the fitness by which parents are compared.
struct Parent {
    const Genome* genome{};
    float fitness{};
};

/// Recombines two genomes (paper, section 3.2): matching genes from either parent, disjoint and
/// excess ones from the fitter (tie: the smaller, then the second).
///
/// The child's marks are therefore those of the fitter parent, less the connections that reverse a
/// feed-forward one of a smaller mark. (None can repeat another, since a genome joins two neurons
/// only once in each direction.) That is all that the theorems about genomes ask of a crossover
/// (proofs/theories/Genome.v: any choice of matching genes), so that they hold for both kinds.
///
/// CrossoverKind::uniform: every matching weight is drawn from one parent or the other. A matching
/// gene disabled in one parent is disabled with disable_probability; disabled in both it stays so.
///
/// CrossoverKind::one_point: the matching genes, in the order of their marks, are cut in two at a
/// place drawn from all that leave a gene on either side. The older ones come from one parent and
/// the younger ones from the other, either way round by chance, each with its weight and its
/// enabled flag. The initial genes are the oldest, in the order that all robots share. Genes that
/// arose one after the other thus mostly stay together, as long as the order of marks is one of
/// creation.
///
/// Precondition: both genomes are valid and descend from the same initial topology.
Genome crossover(GenomeId id, Parent first, Parent second, const OdneatSettings& settings,
                 RandomStream& random);

}  // namespace gene_clocks::neat
