#pragma once

#include <cstdint>
#include <memory>

namespace gene_clocks::neat {

/// How W, the weight term of the genotypic distance, is formed.
enum class WeightDifference : std::uint8_t {
    sum,   ///< the sum of |Δw| over matching genes, as the published runs had it
    mean,  ///< the mean, as Equation 1 has it
};

/// What the energy in a message does to a genome that the receiver already holds.
enum class HeldEnergy : std::uint8_t {
    overwrite,     ///< replaces the recorded fitness, as the published runs had it
    running_mean,  ///< is averaged in (paper, section 3.2)
};

/// Which messages about a genome that the receiver already holds count.
enum class HeldReports : std::uint8_t {
    all,         ///< every one that the tabu list lets pass (paper, section 3.2)
    acceptable,  ///< only one whose energy would gain a new genome admission (paper, Algorithm 1)
};

/// How a child gets the genes that both parents have.
enum class CrossoverKind : std::uint8_t {
    uniform,    ///< each from either parent, by chance (paper, section 3.2)
    one_point,  ///< the older ones from one parent, the younger ones from the other
};

/// What a gene that only one of two genomes has adds to their distance; see `distance`.
enum class Mismatch : std::uint8_t {
    excess_disjoint,  ///< c1 or c2, as it is excess or disjoint (paper, Equation 1)
    age,              ///< the more, the older it is
    since_common,     ///< c1 or c2, as it is younger or older than the last common gene
};

/// From whom the second parent of an offspring is drawn, by tournament of two.
enum class SecondParent : std::uint8_t {
    tournament,  ///< the first one's species; may be the first again, and then nobody mates
    other,       ///< the same without the first, wherever the species has another member
    population,  ///< all species, without the first
};

/// The parameters of odNEAT (paper, Table 1 and section 3.2). Defaults: set B, as run.
struct OdneatSettings {
    double p_mate = 0.212;        ///< probability that an offspring has two parents
    double p_mutate = 0.244;      ///< probability that an offspring is mutated
    double p_weight = 0.559;      ///< p_w: mutate all weights, if no structural mutation struck
    double p_node = 0.422;        ///< add a neuron
    double p_connection = 0.275;  ///< add a connection, if no neuron was added
    double p_recurrent = 0.526;   ///< the new connection is recurrent
    double sigma = 0.114;         ///< standard deviation of a weight mutation
    std::int64_t maturation_cycles = 27;  ///< T_m: no replacement before this age
    std::int64_t population = 7;  ///< |P|: genomes that a robot holds, the active one included

    double c_excess = 0.5;              ///< c1 of Equation 1
    double c_disjoint = 1.5;            ///< c2 of Equation 1
    double c_weight = 0.4;              ///< c3 of Equation 1
    double species_threshold = 3.0;     ///< a genome belongs to a species if it is nearer
    double tabu_threshold = 1.0;        ///< a genome resembles a tabu entry if it is nearer
    std::int64_t tabu_receptions = 50;  ///< receptions that a tabu entry lasts
    WeightDifference weight_difference = WeightDifference::sum;
    HeldEnergy held_energy = HeldEnergy::running_mean;
    HeldReports held_reports = HeldReports::all;
    CrossoverKind crossover = CrossoverKind::uniform;
    Mismatch mismatch = Mismatch::excess_disjoint;
    SecondParent second_parent = SecondParent::tournament;

    double weight_limit = 10.0;          ///< weights stay within ±weight_limit
    double activation_slope = 4.924273;  ///< k in 1 / (1 + exp(−k x))
    double energy_initial = 100.0;       ///< energy of a new genome; also its first fitness sample
    double energy_maximum = 200.0;       ///< energy is kept within [0, energy_maximum]
    std::int64_t fitness_period_cycles = 10;  ///< fitness samples the energy this often
    std::int64_t structural_tries = 20;       ///< draws before a structural mutation gives up
    double disable_probability = 0.875;  ///< of a matching gene disabled in one parent (uniform)
};

/// Settings that any number of agents have in common and none can change. Copies share one object,
/// which lives as long as any of them.
class SharedSettings {
public:
    SharedSettings(const OdneatSettings& settings = {})  // NOLINT(google-explicit-constructor)
        : settings_(std::make_shared<const OdneatSettings>(settings)) {}

    const OdneatSettings& operator*() const { return *settings_; }
    const OdneatSettings* operator->() const { return settings_.get(); }

private:
    std::shared_ptr<const OdneatSettings> settings_;
};

}  // namespace gene_clocks::neat
