#pragma once

#include <gene_clocks/neat/distance_measure.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <limits>

namespace gene_clocks::neat {

/// Genotypic distance: a term for the genes that only one genome has, and c3·W.
///
/// Over connection genes; N counts those of the larger genome, disabled ones included; W is the
/// sum or the mean of |Δw| over matching genes that are enabled in both. The first term is, for
///
/// Mismatch::excess_disjoint: c1·E/N + c2·D/N (paper, Equation 1).
///
/// Mismatch::age: (c1 + c2)/2 · A/N, where A adds up the ages of unmatched genes. Of the k genes
/// that a genome has beyond the initial ones, the r-th in the order of marks (r = 1 is the oldest)
/// has the age (2·(k − r) + 1)/k: from nearly 2 for the oldest down to 1/k for the youngest, 1 on
/// average. An old gene that the other lacks says that the genomes parted long ago. Ages are ranks,
/// so that they mean the same for marks of every kind, be they counters or times. A is at most the
/// number of genes beyond the initial ones in both genomes. Where that is all of them, or any of
/// them alike, it is Equation 1 with c1 = c2, so that thresholds keep their meaning; where genomes
/// differ in their youngest genes only, it is less.
///
/// Mismatch::since_common: c1·E/N + c2·D/N, but with E as the unmatched genes above the last
/// matching one, whichever genome ends first, and D as those below. Genomes that parted for good
/// then differ by excess genes alone, whatever the other's marks are meanwhile.
///
/// Under markings that extend cause and effect, which sort every genome alike, the last two are the
/// same for each of them, and Equation 1 only if c1 = c2 (`order_is_creation_order`,
/// `markings_differ_in_excess_only` and `distance_marking_invariant` in the proofs).
///
/// May stop early: a result at or above `limit` only says that the distance is at or above it.
float distance(const Genome& first, const Genome& second, const DistanceMeasure& measure,
               float limit = std::numeric_limits<float>::infinity());

}  // namespace gene_clocks::neat
