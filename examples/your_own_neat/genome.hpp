// A NEAT of somebody's own: its genome and its operators. Of Gene Clocks it takes marks, the clock
// that makes them, and the alignment of genomes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <gene_clocks/gene_clock.hpp>
#include <random>
#include <vector>

namespace your_own_neat {

using gene_clocks::GeneClock;
using gene_clocks::InnovationNumber;
using gene_clocks::RobotId;
using Random = std::mt19937;

enum class Kind : std::uint8_t { input, bias, output, hidden };

struct Node {
    InnovationNumber mark;
    Kind kind;
};

struct Link {
    InnovationNumber mark;
    InnovationNumber from;
    InnovationNumber to;
    float weight;
    bool is_enabled;
};

/// Invariant: nodes and links are sorted by mark.
struct Genome {
    RobotId maker{};          ///< who made it
    std::uint32_t birth = 0;  ///< a number that its maker gives to no other
    std::vector<Node> nodes;
    std::vector<Link> links;
    float fitness = 0.0f;
};

/// The genes that everyone starts with: two inputs, bias and output, and a link from each of the
/// three to the output. They have the marks 1…7 of robot 0.
inline constexpr std::uint64_t genesis_count = 7;
Genome initial_genome(Random& random);

/// Splits a link: three new genes. False where no link can be split or the clock is exhausted.
bool add_node(Genome& genome, GeneClock& clock, Random& random);
/// Joins two nodes that were not joined. False where the two drawn cannot be, or as above.
bool add_link(Genome& genome, GeneClock& clock, Random& random);
void mutate_weights(Genome& genome, Random& random);
/// The fitter parent's genes, with half of the weights that it shares with the other from there.
Genome crossover(const Genome& fitter, const Genome& other, Random& random);
/// How far apart two genomes are: genes that only one has, and the mean difference of weights.
float distance(const Genome& a, const Genome& b);

/// What the network gives for two inputs, once all nodes have settled.
float activate(const Genome& genome, float first, float second);

/// The place of the node with this mark; precondition: there is one.
std::size_t place_of(const Genome& genome, InnovationNumber mark);

/// Uniform in [low, high). Not a distribution of the library, whose results differ between
/// machines.
float uniform(Random& random, float low, float high);
std::size_t below(Random& random, std::size_t bound);

}  // namespace your_own_neat
