// XOR, the first benchmark of every NEAT (Stanley and Miikkulainen 2002, section 4.1): a population
// must grow a hidden neuron to solve it. The genomes, operators and networks are those of
// GeneClocks::neat, and a gene clock marks the genes; the generational loop is this file.
//
// Usage: xor [RUNS]    seeds 1…RUNS (100). Status 1 where a run finds no solution.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <gene_clocks/neat/controller.hpp>
#include <gene_clocks/neat/crossover.hpp>
#include <gene_clocks/neat/distance.hpp>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <gene_clocks/neat/genome.hpp>
#include <gene_clocks/neat/mutation.hpp>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace {

using namespace gene_clocks;
using namespace gene_clocks::neat;

constexpr std::size_t population_size = 150;
constexpr int generations_max = 200;
constexpr int stagnation_generations = 15;  // a species that long without progress has no offspring
constexpr double survivors = 0.2;           // the share of a species that may be parents
constexpr std::size_t champion_size = 5;    // species of more members keep their best unchanged

OdneatSettings settings_for_xor() {
    OdneatSettings settings;
    settings.p_mate = 0.75;
    settings.p_node = 0.1;
    settings.p_connection = 0.5;
    settings.p_weight = 0.8;
    settings.p_recurrent = 0.0;
    settings.sigma = 1.6;
    settings.c_excess = 1.0;
    settings.c_disjoint = 1.0;
    settings.c_weight = 0.4;
    settings.weight_difference = WeightDifference::mean;
    settings.species_threshold = 1.0;
    return settings;
}

struct Individual {
    Genome genome;
    float fitness = 0.0f;
    bool is_solution = false;
};

/// Members are indices into the population, best first.
struct Species {
    Genome representative;
    std::vector<std::size_t> members;
    float best_fitness = 0.0f;
    int best_generation = 0;
};

/// The outcome of one run.
struct Solution {
    int generation;
    std::size_t evaluations;
    std::size_t hidden_neurons;
    std::size_t enabled_connections;
};

/// Fitness is (4 − Σ|error|)² over the four patterns; a solution has all four on the right side.
void evaluate(Individual& individual, const OdneatSettings& settings) {
    static constexpr std::array<std::array<float, 3>, 4> patterns{
        {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}}};  // the third input is the bias
    static constexpr std::array<float, 4> wanted{0, 1, 1, 0};
    Controller network(individual.genome, settings.activation_slope);
    const Topology& topology = *individual.genome.topology;
    const std::size_t hidden = topology.neurons.size() - topology.inputs - topology.outputs;

    float error = 0.0f;
    individual.is_solution = true;
    for (std::size_t i = 0; i < patterns.size(); ++i) {
        // A signal advances by one neuron an update. The network is feed-forward: after so many,
        // nothing is left in it of the pattern before.
        float output = 0.0f;
        for (std::size_t update = 0; update <= hidden; ++update) {
            output = network.update(patterns[i])[0];
        }
        error += std::abs(wanted[i] - output);
        individual.is_solution &= (output >= 0.5f) == (wanted[i] == 1.0f);
    }
    individual.fitness = (4.0f - error) * (4.0f - error);
}

class Evolution {
public:
    explicit Evolution(std::uint64_t seed) : random_(seed, 0) {
        const auto topology = make_initial_topology(3, 1);
        for (std::size_t i = 0; i < population_size; ++i) {
            population_.push_back(
                {make_initial_genome(next_id(), topology, settings_.weight_limit, random_)});
        }
    }

    std::optional<Solution> run() {
        for (int generation = 1; generation <= generations_max; ++generation) {
            for (std::size_t i = 0; i < population_.size(); ++i) {
                evaluate(population_[i], settings_);
                ++evaluations_;
                if (population_[i].is_solution) return describe(population_[i].genome, generation);
            }
            speciate(generation);
            reproduce(generation);
        }
        return std::nullopt;
    }

private:
    GenomeId next_id() { return {RobotId{1}, births_++}; }

    Solution describe(const Genome& genome, int generation) const {
        const Topology& topology = *genome.topology;
        const auto enabled = std::count(genome.enabled.begin(), genome.enabled.end(), 1.0f);
        return {generation, evaluations_,
                topology.neurons.size() - topology.inputs - topology.outputs,
                static_cast<std::size_t>(enabled)};
    }

    /// Every genome joins the first species whose representative is near enough, or founds one.
    void speciate(int generation) {
        for (Species& species : species_) species.members.clear();
        for (std::size_t i = 0; i < population_.size(); ++i) {
            const Genome& genome = population_[i].genome;
            const auto limit = static_cast<float>(settings_.species_threshold);
            auto home = std::find_if(species_.begin(), species_.end(), [&](const Species& species) {
                return distance(genome, species.representative, measure_, limit) < limit;
            });
            if (home == species_.end()) {
                home = species_.insert(home, {genome, {}, 0.0f, generation});
            }
            home->members.push_back(i);
        }
        std::erase_if(species_, [](const Species& species) { return species.members.empty(); });
        for (Species& species : species_) {
            auto& members = species.members;
            std::stable_sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
                return population_[a].fitness > population_[b].fitness;
            });
            species.representative = population_[members[random_.below(count(members))]].genome;
            const float best = population_[members.front()].fitness;
            if (best > species.best_fitness) {
                species.best_fitness = best;
                species.best_generation = generation;
            }
        }
    }

    /// The mean fitness of a species, which its number of offspring is proportional to; 0 where it
    /// makes no progress, unless it is the best.
    double share(const Species& species, int generation, float best_fitness) const {
        const bool is_best = population_[species.members.front()].fitness == best_fitness;
        if (!is_best && generation - species.best_generation >= stagnation_generations) return 0.0;
        const double sum = std::transform_reduce(
            species.members.begin(), species.members.end(), 0.0, std::plus<>(),
            [&](std::size_t i) { return static_cast<double>(population_[i].fitness); });
        return sum / static_cast<double>(species.members.size());
    }

    void reproduce(int generation) {
        float best_fitness = 0.0f;
        for (const Individual& i : population_) best_fitness = std::max(best_fitness, i.fitness);
        std::vector<double> shares;
        for (const Species& species : species_) {
            shares.push_back(share(species, generation, best_fitness));
        }
        const double total = std::accumulate(shares.begin(), shares.end(), 0.0);

        std::vector<Individual> next;
        next.reserve(population_size);
        double due = 0.0;  // offspring that the species so far should have had
        for (std::size_t s = 0; s < species_.size(); ++s) {
            due += shares[s] / total * static_cast<double>(population_size);
            const auto end = std::min(population_size, static_cast<std::size_t>(due + 0.5));
            if (next.size() < end && species_[s].members.size() > champion_size) {
                next.push_back(population_[species_[s].members.front()]);
            }
            while (next.size() < end) next.push_back({offspring(species_[s], generation)});
        }
        population_ = std::move(next);
    }

    Genome offspring(const Species& species, int generation) {
        const auto size = static_cast<double>(species.members.size());
        const auto parents = std::max(1u, static_cast<std::uint32_t>(survivors * size + 0.5));
        const auto draw = [&]() -> const Individual& {
            return population_[species.members[random_.below(parents)]];
        };
        const auto mate = [&] {
            const Individual& first = draw();
            const Individual& second = draw();
            return crossover({}, {&first.genome, first.fitness}, {&second.genome, second.fitness},
                             settings_, random_);
        };
        Genome child = random_.chance(settings_.p_mate) ? mate() : draw().genome;
        child.id = next_id();
        mutate(child, settings_, source_, generation, random_);
        return child;
    }

    static std::uint32_t count(const std::vector<std::size_t>& members) {
        return static_cast<std::uint32_t>(members.size());
    }

    OdneatSettings settings_ = settings_for_xor();
    DistanceMeasure measure_{settings_};
    RandomStream random_;
    GeneClockSource source_{RobotId{1}, genesis_mark_count(3, 1)};
    std::vector<Individual> population_;
    std::vector<Species> species_;
    std::size_t evaluations_ = 0;
    std::uint32_t births_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
    const int runs = argc > 1 ? std::atoi(argv[1]) : 100;
    if (runs < 1) {
        std::fprintf(stderr, "Usage: %s [RUNS]\n", argv[0]);
        return 2;
    }
    std::vector<Solution> solutions;
    const std::clock_t start = std::clock();
    for (int seed = 1; seed <= runs; ++seed) {
        if (const auto solution = Evolution(static_cast<std::uint64_t>(seed)).run()) {
            solutions.push_back(*solution);
        }
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;

    const auto mean = [&](auto member) {
        double sum = 0.0;
        for (const Solution& s : solutions) sum += static_cast<double>(s.*member);
        return sum / static_cast<double>(solutions.size());
    };
    std::printf("solved               %zu of %d runs\n", solutions.size(), runs);
    std::printf("generations          %.1f a solved run\n", mean(&Solution::generation));
    std::printf("evaluations          %.0f a solved run\n", mean(&Solution::evaluations));
    std::printf("hidden neurons       %.2f\n", mean(&Solution::hidden_neurons));
    std::printf("enabled connections  %.2f\n", mean(&Solution::enabled_connections));
    std::printf("CPU time             %.4f s a run\n", seconds / runs);
    return std::ssize(solutions) == runs ? 0 : 1;
}
