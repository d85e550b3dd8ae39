#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gene_clocks/neat/crossover.hpp>
#include <gene_clocks/neat/distance.hpp>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <gene_clocks/neat/mutation.hpp>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "proofs/oracle/in_process.h"

namespace gene_clocks::test {

/// What the two do not agree on; thrown.
struct Disagreement : std::runtime_error {
    Disagreement(const std::string& command, const std::string& proved, const std::string& shipped)
        : std::runtime_error(
              fmt::format("{}\n  proved:  {}\n  shipped: {}", command, proved, shipped)) {}
};

inline void compare(const std::string& command, const std::string& shipped) {
    const std::string proved = gene_clocks_oracle_answer(command.c_str());
    if (proved != shipped) throw Disagreement(command, proved, shipped);
}

/// The shipped operators on genomes and the proved ones (proofs/theories/Genome.v), on related
/// genomes: alignment as crossover and distance use it, the choice of the fitter parent, both
/// kinds of crossover draw by draw, and Equation 1 with the sum and the mean of weight differences.
///
/// Weights are multiples of 1/unit here, so that the model's integers hold them exactly.
class OperatorComparison {
public:
    static constexpr int unit = 1024;

    explicit OperatorComparison(std::uint64_t seed) : random_(seed, 1) {}

    /// Genomes that three robots grow from one perceptron, hearing each other or not.
    void grow(std::size_t inputs, std::size_t outputs, int steps) {
        genomes_.clear();
        sources_.clear();
        const auto topology = neat::make_initial_topology(inputs, outputs);
        for (std::uint32_t robot = 1; robot <= 3; ++robot) {
            sources_.emplace_back(RobotId{robot}, neat::genesis_mark_count(inputs, outputs));
            genomes_.push_back(neat::make_initial_genome({RobotId{robot}, 0}, topology,
                                                         settings_.weight_limit, random_));
        }
        for (int step = 0; step < steps; ++step) mutate(random_.below(3));
        for (neat::Genome& genome : genomes_) round(genome);
    }

    void compare_all() {
        for (std::size_t first = 0; first < genomes_.size(); ++first) {
            for (std::size_t second = 0; second < genomes_.size(); ++second) {
                const neat::Genome& a = genomes_[first];
                const neat::Genome& b = genomes_[second];
                compare_distances(a, b);
                for (const auto kind :
                     {neat::CrossoverKind::uniform, neat::CrossoverKind::one_point}) {
                    compare_crossover(a, b, kind);
                }
            }
        }
    }

    /// How many genes were matched, disjoint and excess, and left out as reversals.
    struct Reached {
        std::uint64_t matching = 0, disjoint = 0, excess = 0, reversals = 0;
    };
    const Reached& reached() const { return reached_; }

private:
    void mutate(std::size_t robot) {
        neat::Genome& genome = genomes_[robot];
        neat::GeneClockSource& source = sources_[robot];
        switch (random_.below(5)) {
            case 0:
                neat::add_neuron(genome, settings_, source, 0.0, random_);
                break;
            case 1:
                neat::mutate_weights(genome, settings_, random_);
                break;
            case 2: {  // so that connections come to reverse others
                const auto at = random_.below(static_cast<std::uint32_t>(genome.connections()));
                genome.enabled[at] = 1.0f - genome.enabled[at];
                break;
            }
            case 3: {  // a robot takes another's genome up, or only its stamp
                const std::size_t other = random_.below(3);
                if (!source.observe(sources_[other].stamp())) break;
                if (random_.chance(0.3)) genome = genomes_[other];
                break;
            }
            default:
                neat::add_connection(genome, settings_, source, 0.0, random_);
        }
    }

    static void round(neat::Genome& genome) {
        for (float& weight : genome.weights) {
            weight = std::round(weight * static_cast<float>(unit)) / static_cast<float>(unit);
        }
    }

    static std::string words(const neat::Genome& genome) {
        std::string text;
        const neat::Topology& topology = *genome.topology;
        const auto mark = [](InnovationNumber m) {
            return fmt::format("{},{}", m.counter, static_cast<std::uint32_t>(m.robot));
        };
        for (std::size_t i = 0; i < genome.connections(); ++i) {
            const neat::ConnectionEnds& ends = topology.connection_ends[i];
            text += fmt::format(" {},{},{},{:d},{:d},{}", mark(topology.connection_marks[i]),
                                mark(ends.source), mark(ends.target), ends.recurrent,
                                genome.is_enabled(i),
                                std::lround(static_cast<double>(genome.weights[i]) * unit));
        }
        return text;
    }
    static std::string pair(const neat::Genome& a, const neat::Genome& b) {
        return " /" + words(a) + " /" + words(b);
    }

    /// Counts exactly, by coefficients that leave one of them; the whole up to rounding.
    void compare_distances(const neat::Genome& a, const neat::Genome& b) {
        const auto size = static_cast<float>(std::max(a.connections(), b.connections()));
        neat::OdneatSettings settings;
        const auto shipped = [&](double c_excess, double c_disjoint, double c_weight) {
            settings.c_excess = c_excess;
            settings.c_disjoint = c_disjoint;
            settings.c_weight = c_weight;
            return neat::distance(a, b, neat::DistanceMeasure(settings));
        };
        const auto excess = std::lround(shipped(1, 0, 0) * size);
        const auto disjoint = std::lround(shipped(0, 1, 0) * size);
        const auto matching =
            (static_cast<long>(a.connections() + b.connections()) - excess - disjoint) / 2;
        reached_.excess += static_cast<std::uint64_t>(excess);
        reached_.disjoint += static_cast<std::uint64_t>(disjoint);
        reached_.matching += static_cast<std::uint64_t>(matching);
        for (const auto kind : {neat::WeightDifference::sum, neat::WeightDifference::mean}) {
            settings.weight_difference = kind;
            const std::string command =
                fmt::format("distance 1/2 3/2 3/8 {} {}{}", unit,
                            kind == neat::WeightDifference::sum ? "sum" : "mean", pair(a, b));
            const std::string proved = gene_clocks_oracle_answer(command.c_str());
            const float distance = shipped(0.5, 1.5, 0.375);
            const std::string counts =
                fmt::format("distance {} {} {} ", excess, disjoint, matching);
            double numerator = 0;
            double denominator = 0;
            if (!proved.starts_with(counts) ||
                std::sscanf(proved.c_str() + counts.size(), "%lf/%lf", &numerator, &denominator) !=
                    2 ||
                std::abs(distance - numerator / denominator) > 1e-5 * (1.0 + distance)) {
                throw Disagreement(command, proved, fmt::format("{}{}", counts, distance));
            }
        }
    }

    void compare_crossover(const neat::Genome& a, const neat::Genome& b, neat::CrossoverKind kind) {
        neat::OdneatSettings settings;
        settings.crossover = kind;
        const auto fitness_a = random_.below(3);
        const auto fitness_b = random_.below(3);
        neat::RandomStream twin = random_;  // draws what crossover() is going to draw
        const neat::Genome child =
            neat::crossover({RobotId{9}, 0}, {&a, static_cast<float>(fitness_a)},
                            {&b, static_cast<float>(fitness_b)}, settings, random_);
        const std::string fitter_command = fmt::format("fitter {} {} {} {}", fitness_a, fitness_b,
                                                       a.connections(), b.connections());
        const bool is_first =
            std::string(gene_clocks_oracle_answer(fitter_command.c_str())) == "first";
        const neat::Genome& fitter = is_first ? a : b;
        const neat::Genome& other = is_first ? b : a;
        const std::string command =
            kind == neat::CrossoverKind::uniform
                ? "crossover uniform x" + uniform_draws(twin, settings, 2 * fitter.connections())
                : "crossover listed x" + listed_draws(twin, matches_of(a, b));
        compare(command + pair(fitter, other), "child" + words(child));
        if (child.topology->neurons != fitter.topology->neurons) {
            throw Disagreement(fitter_command, "the fitter parent's neurons", "others");
        }
        reached_.reversals += fitter.connections() - child.connections();
    }

    static std::string uniform_draws(neat::RandomStream& random,
                                     const neat::OdneatSettings& settings, std::size_t most) {
        std::string digits;
        for (std::size_t i = 0; i < most; ++i) {
            neat::RandomStream same = random;
            const int half = same.chance(0.5);
            const int disable = random.chance(settings.disable_probability);
            digits += static_cast<char>('0' + half + 2 * disable);
        }
        return digits;
    }

    static std::string listed_draws(neat::RandomStream& random, std::size_t matches) {
        const std::size_t cut =
            1 + random.below(static_cast<std::uint32_t>(std::max<std::size_t>(matches - 1, 1)));
        const bool older_from_other = random.chance(0.5);
        std::string digits;
        for (std::size_t place = 0; place < matches; ++place) {
            digits += (place < cut) == older_from_other ? '1' : '0';
        }
        return digits;
    }

    static std::size_t matches_of(const neat::Genome& a, const neat::Genome& b) {
        std::vector<InnovationNumber> both;
        std::ranges::set_intersection(a.topology->connection_marks, b.topology->connection_marks,
                                      std::back_inserter(both));
        return both.size();
    }

    neat::RandomStream random_;
    neat::OdneatSettings settings_;
    std::vector<neat::GeneClockSource> sources_;
    std::vector<neat::Genome> genomes_;
    Reached reached_;
};

}  // namespace gene_clocks::test
