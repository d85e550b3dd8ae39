// Speed of the odNEAT layer's operators. All inputs come from the project's own operators and fixed
// seeds.
//
// Pairs of genomes ("siblings"): the perceptron of the navigation task (10 inputs, 2 outputs, 20
// connections) grows by structural mutations alone. A common ancestor gains half of the genes
// beyond the initial ones; then two robots grow a copy of it each, one to four connections at a
// time, in random turns, and hear each other's stamp now and then, so that their new marks
// interleave. The two thus share the initial genes and half of the others; the rest is disjoint
// or excess (the counters give means). Two in three new connections come from splits. A benchmark
// walks over 16 different pairs, so that the processor cannot learn one pair's branches by heart.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <gene_clocks/align.hpp>
#include <gene_clocks/neat/agent.hpp>
#include <gene_clocks/neat/controller.hpp>
#include <gene_clocks/neat/crossover.hpp>
#include <gene_clocks/neat/distance.hpp>
#include <gene_clocks/neat/gene_clock_source.hpp>
#include <gene_clocks/neat/mutation.hpp>
#include <memory>
#include <utility>
#include <vector>

namespace {

using namespace gene_clocks;
using namespace gene_clocks::neat;

constexpr std::size_t inputs = 10;
constexpr std::size_t outputs = 2;
constexpr std::size_t pairs = 16;

struct Siblings {
    Genome first;
    Genome second;
};

/// Adds one structural element; every third connection is one of its own, the others come from a
/// split, which adds two.
void grow(Genome& genome, std::size_t connections, InnovationSource& source, RandomStream& random) {
    const OdneatSettings settings;
    while (genome.connections() < connections) {
        if (genome.connections() % 3 != 0 && genome.connections() + 2 <= connections) {
            add_neuron(genome, settings, source, 0.0, random);
        } else {
            add_connection(genome, settings, source, 0.0, random);
        }
    }
}

Siblings make_siblings(std::size_t connections, std::uint64_t seed) {
    const OdneatSettings settings;
    RandomStream random(seed, 0);
    const auto topology = make_initial_topology(inputs, outputs);
    const std::size_t initial = topology->initial_connections;
    const std::uint64_t genesis = genesis_mark_count(inputs, outputs);
    GeneClockSource clock_1(RobotId{1}, genesis);
    GeneClockSource clock_2(RobotId{2}, genesis);

    Genome ancestor = make_initial_genome({RobotId{1}, 0}, topology, settings.weight_limit, random);
    grow(ancestor, initial + (connections - initial) / 2, clock_1, random);
    benchmark::DoNotOptimize(clock_2.observe(clock_1.stamp()));
    Siblings siblings{ancestor, ancestor};
    siblings.first.id = {RobotId{1}, 1};
    siblings.second.id = {RobotId{2}, 1};
    while (siblings.first.connections() + siblings.second.connections() < 2 * connections) {
        Genome& grown = random.chance(0.5) ? siblings.first : siblings.second;
        GeneClockSource& clock = &grown == &siblings.first ? clock_1 : clock_2;
        grow(grown, std::min(connections, grown.connections() + 1 + random.below(4)), clock,
             random);
        if (random.chance(0.25)) benchmark::DoNotOptimize(clock_1.observe(clock_2.stamp()));
        if (random.chance(0.25)) benchmark::DoNotOptimize(clock_2.observe(clock_1.stamp()));
    }
    mutate_weights(siblings.first, settings, random);
    mutate_weights(siblings.second, settings, random);
    return siblings;
}

std::vector<Siblings> make_all_siblings(std::size_t connections) {
    std::vector<Siblings> all;
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        all.push_back(make_siblings(connections, seed));
    }
    return all;
}

/// A weight mutant of the first sibling: it shares the topology.
std::vector<Siblings> make_all_weight_mutants(std::size_t connections) {
    auto all = make_all_siblings(connections);
    RandomStream random(1, 1);
    for (Siblings& siblings : all) {
        siblings.second = siblings.first;
        siblings.second.id.birth += 1;
        mutate_weights(siblings.second, OdneatSettings{}, random);
    }
    return all;
}

/// Means over the pairs, so that a reader sees what was aligned.
void count_genes(benchmark::State& state, const std::vector<Siblings>& all) {
    double matching = 0.0, disjoint = 0.0, excess = 0.0;
    for (const Siblings& siblings : all) {
        align(siblings.first.topology->connection_marks, siblings.second.topology->connection_marks,
              [&](GeneMatch match, std::size_t, std::size_t) {
                  switch (match) {
                      case GeneMatch::matching:
                          matching += 1.0;
                          break;
                      case GeneMatch::disjoint_first:
                      case GeneMatch::disjoint_second:
                          disjoint += 1.0;
                          break;
                      default:
                          excess += 1.0;
                          break;
                  }
              });
    }
    const auto mean = [](double sum) { return sum / static_cast<double>(pairs); };
    state.counters["matching"] = mean(matching);
    state.counters["disjoint"] = mean(disjoint);
    state.counters["excess"] = mean(excess);
}

void measure_distance(benchmark::State& state, const std::vector<Siblings>& all) {
    const DistanceMeasure measure{OdneatSettings{}};
    std::size_t next = 0;
    for (auto _ : state) {
        const Siblings& siblings = all[next++ % pairs];
        benchmark::DoNotOptimize(distance(siblings.first, siblings.second, measure));
    }
    count_genes(state, all);
}

void distance_of_siblings(benchmark::State& state) {
    measure_distance(state, make_all_siblings(static_cast<std::size_t>(state.range(0))));
}
BENCHMARK(distance_of_siblings)->Arg(40)->Arg(200);

void distance_of_weight_mutants(benchmark::State& state) {
    measure_distance(state, make_all_weight_mutants(static_cast<std::size_t>(state.range(0))));
}
BENCHMARK(distance_of_weight_mutants)->Arg(40)->Arg(200);

/// The usual way to store genes, for comparison: each an object of its own on the heap, which holds
/// its number, as a double, and a pointer to its connection.
struct HeapGene {
    double innovation;
    double weight;
    std::unique_ptr<ConnectionEnds> connection;
};
using HeapGenome = std::vector<std::unique_ptr<HeapGene>>;

HeapGenome make_heap_genome(const Genome& genome) {
    HeapGenome genes;
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        const InnovationNumber mark = genome.topology->connection_marks[i];
        const double innovation =
            4.0 * static_cast<double>(mark.counter) + static_cast<double>(mark.robot);
        genes.push_back(std::make_unique<HeapGene>(
            HeapGene{innovation, genome.weights[i],
                     std::make_unique<ConnectionEnds>(genome.topology->connection_ends[i])}));
    }
    return genes;
}

double heap_distance(const HeapGenome& first, const HeapGenome& second) {
    double disjoint = 0.0, excess = 0.0, matching = 0.0, weights = 0.0;
    auto a = first.begin();
    auto b = second.begin();
    while (a != first.end() || b != second.end()) {
        if (a == first.end()) {
            ++b, ++excess;
        } else if (b == second.end()) {
            ++a, ++excess;
        } else if ((*a)->innovation == (*b)->innovation) {
            weights += std::abs((*a)->weight - (*b)->weight);
            ++a, ++b, ++matching;
        } else if ((*a)->innovation < (*b)->innovation) {
            ++a, ++disjoint;
        } else {
            ++b, ++disjoint;
        }
    }
    return 0.5 * excess + 1.5 * disjoint + 0.4 * weights / matching;
}

void measure_heap_distance(benchmark::State& state, const std::vector<Siblings>& all) {
    std::vector<std::pair<HeapGenome, HeapGenome>> genomes;
    for (const Siblings& siblings : all) {
        genomes.emplace_back(make_heap_genome(siblings.first), make_heap_genome(siblings.second));
    }
    std::size_t next = 0;
    for (auto _ : state) {
        const auto& [first, second] = genomes[next++ % pairs];
        benchmark::DoNotOptimize(heap_distance(first, second));
    }
}

void heap_distance_of_siblings(benchmark::State& state) {
    measure_heap_distance(state, make_all_siblings(static_cast<std::size_t>(state.range(0))));
}
BENCHMARK(heap_distance_of_siblings)->Arg(40)->Arg(200);

void heap_distance_of_weight_mutants(benchmark::State& state) {
    measure_heap_distance(state, make_all_weight_mutants(static_cast<std::size_t>(state.range(0))));
}
BENCHMARK(heap_distance_of_weight_mutants)->Arg(40)->Arg(200);

void measure_crossover(benchmark::State& state, const std::vector<Siblings>& all) {
    const OdneatSettings settings;
    RandomStream random(2, 2);
    std::size_t next = 0;
    for (auto _ : state) {
        const Siblings& siblings = all[next % pairs];
        const float fitness = static_cast<float>(next++ / pairs % 2);  // either is the fitter
        benchmark::DoNotOptimize(
            crossover({}, {&siblings.first, fitness}, {&siblings.second, 0.5f}, settings, random));
    }
    count_genes(state, all);
}

void crossover_of_siblings(benchmark::State& state) {
    measure_crossover(state, make_all_siblings(static_cast<std::size_t>(state.range(0))));
}
BENCHMARK(crossover_of_siblings)->Arg(40)->Arg(200);

void crossover_of_weight_mutants(benchmark::State& state) {
    measure_crossover(state, make_all_weight_mutants(static_cast<std::size_t>(state.range(0))));
}
BENCHMARK(crossover_of_weight_mutants)->Arg(40)->Arg(200);

/// The perceptron of either task (20 and 36 connections), and grown networks.
void controller_update(benchmark::State& state) {
    const auto input_count = static_cast<std::size_t>(state.range(0));
    const OdneatSettings settings;
    RandomStream random(3, 3);
    GeneClockSource clock(RobotId{1}, genesis_mark_count(input_count, outputs));
    Genome genome = make_initial_genome({}, make_initial_topology(input_count, outputs),
                                        settings.weight_limit, random);
    for (std::int64_t hidden = 0; hidden < state.range(1); ++hidden) {
        add_neuron(genome, settings, clock, 0.0, random);
    }
    Controller controller(genome, settings.activation_slope);
    std::vector<float> readings(input_count, 0.5f);
    for (auto _ : state) {
        benchmark::DoNotOptimize(readings.data());
        benchmark::DoNotOptimize(controller.update(readings).data());
    }
}
BENCHMARK(controller_update)
    ->ArgNames({"inputs", "hidden"})
    ->Args({10, 0})
    ->Args({10, 2})
    ->Args({10, 10})
    ->Args({18, 0})
    ->Args({18, 2})
    ->Args({18, 10});

/// A robot hears eight others by turns, each four times in a row. Their energies differ, so that
/// genomes are accepted, updated, refused and dropped; the robot's own genome is replaced every
/// 4096 receptions, the cost of which is included. The counter is the mean length of its tabu list.
void agent_receive(benchmark::State& state) {
    const OdneatSettings settings;
    const auto topology = make_initial_topology(inputs, outputs);
    const auto make_agent = [&](std::uint32_t robot) {
        return Agent(
            RobotId{robot}, settings, topology,
            std::make_unique<GeneClockSource>(RobotId{robot}, genesis_mark_count(inputs, outputs)),
            RandomStream(4, robot));
    };
    Agent receiver = make_agent(1);
    RandomStream random(4, 0);
    std::vector<Message> messages;
    for (std::uint32_t robot = 2; robot < 10; ++robot) {
        Agent sender = make_agent(robot);
        for (int birth = 0; birth < 8; ++birth) {
            sender.replace(0.0);
            sender.gain(static_cast<float>(random.uniform(-100.0, 100.0)));
            messages.push_back(sender.message());
        }
    }
    constexpr std::size_t repeats = 4;
    std::size_t next = 0;
    std::size_t tabu = 0;
    for (auto _ : state) {
        // All robots' first genomes, then all robots' second ones, and so on.
        const std::size_t turn = next++ / repeats % messages.size();
        benchmark::DoNotOptimize(receiver.receive(RobotId{static_cast<std::uint32_t>(2 + turn % 8)},
                                                  messages[turn % 8 * 8 + turn / 8]));
        tabu += receiver.tabu_list().size();
        if (next % 4096 == 0) receiver.replace(0.0);
    }
    state.counters["tabu"] = static_cast<double>(tabu) / static_cast<double>(next);
}
BENCHMARK(agent_receive);

void random_bits(benchmark::State& state) {
    RandomStream random(5, 5);
    for (auto _ : state) benchmark::DoNotOptimize(random.bits());
}
BENCHMARK(random_bits);

void random_uniform(benchmark::State& state) {
    RandomStream random(6, 6);
    for (auto _ : state) benchmark::DoNotOptimize(random.uniform());
}
BENCHMARK(random_uniform);

void random_normal(benchmark::State& state) {
    RandomStream random(7, 7);
    for (auto _ : state) benchmark::DoNotOptimize(random.normal());
}
BENCHMARK(random_normal);

}  // namespace
