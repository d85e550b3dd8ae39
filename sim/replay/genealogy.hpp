#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <vector>

#include "sim/replay/gene_history.hpp"

namespace gene_clocks::replay {

/// A gene beyond the genesis ones that a robot of the final swarm carries in its active genome.
struct FinalGene {
    GeneNumber gene{};
    std::uint32_t carriers{};  ///< robots; at least 1
    /// The youngest gene of the final swarm that was in the genome to which this one was added:
    /// what came just before it on its way. None where there were only genesis genes.
    std::optional<GeneNumber> follows;
};

/// The genes of the final swarm: those that most robots carry first, equals in the order of their
/// marks.
std::vector<FinalGene> genealogy(const GeneHistory& history);

/// The same as CSV, with a header; docs/replay.md says what the columns are.
void write_genealogy_csv(const GeneHistory& history, std::ostream& out);

}  // namespace gene_clocks::replay
