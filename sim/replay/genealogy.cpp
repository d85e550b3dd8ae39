#include "sim/replay/genealogy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <gene_clocks/neat/innovation_source.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace gene_clocks::replay {
namespace {

std::string robot_of(InnovationNumber mark) {
    return mark.robot == neat::no_robot ? std::string()
                                        : fmt::format("{}", static_cast<std::uint32_t>(mark.robot));
}

/// Not with a point: programs that read tables would take 12.10 for a number, and for 12.1.
std::string text_of(InnovationNumber mark) {
    return fmt::format("{}@{}", mark.counter, robot_of(mark));
}

std::string_view text_of(GeneKind kind) {
    constexpr std::array<std::string_view, 3> names{"neuron", "connection", "recurrent connection"};
    return names.at(static_cast<std::size_t>(kind));
}

}  // namespace

std::vector<FinalGene> genealogy(const GeneHistory& history) {
    const auto& genes = history.genes();
    std::vector<std::uint32_t> carriers(genes.size(), 0);
    for (const std::size_t set : history.active()) {
        for (const GeneNumber gene : history.gene_sets()[set]) ++carriers[gene];
    }
    std::vector<FinalGene> result;
    for (GeneNumber index = 0; index < genes.size(); ++index) {
        if (carriers[index] == 0) continue;
        FinalGene final_gene{index, carriers[index], {}};
        for (const GeneNumber other : history.gene_sets()[genes[index].gene_set]) {
            // A split adds three genes to one genome; none of them came before the others.
            if (carriers[other] > 0 && genes[other].genome != genes[index].genome) {
                if (other < index) final_gene.follows = other;  // ascending: the last is youngest
            }
        }
        result.push_back(final_gene);
    }
    std::ranges::sort(result, [&](const FinalGene& a, const FinalGene& b) {
        if (a.carriers != b.carriers) return a.carriers > b.carriers;
        return genes[a.gene].mark < genes[b.gene].mark;
    });
    return result;
}

void write_genealogy_csv(const GeneHistory& history, std::ostream& out) {
    out << "mark,counter,robot,kind,created_cycle,created_by,birth,times_marked,builds_upon,"
           "follows,"
           "carriers,share\n";
    const auto robots = static_cast<double>(history.active().size());
    const auto& genes = history.genes();
    for (const FinalGene& final_gene : genealogy(history)) {
        const Gene& gene = genes[final_gene.gene];
        std::vector<std::string> builds_upon;
        for (const GeneNumber base : gene.builds_upon) {
            builds_upon.push_back(text_of(genes[base].mark));
        }
        out << fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{}\n", text_of(gene.mark), gene.mark.counter,
            robot_of(gene.mark), text_of(gene.kind), gene.created_cycle,
            static_cast<std::uint32_t>(gene.genome.robot), gene.genome.birth, gene.times_marked,
            fmt::join(builds_upon, " "),
            final_gene.follows ? text_of(genes[*final_gene.follows].mark) : std::string(),
            final_gene.carriers, final_gene.carriers / robots);
    }
}

}  // namespace gene_clocks::replay
