// Prints what a fixed set of short runs computes, bit for bit. Two builds of this program agree if
// and only if compiler, optimisation and processor make no difference to a run.
//
// Usage: trajectories [THREADS]    one run after the other, or on that many threads
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <gene_clocks/sim/simulation.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace gene_clocks;

/// Bars at the paper's ±45°, and one at an angle at which nothing can be computed exactly.
sim::Arena make_arena() {
    return {"determinism",
            300.0,
            300.0,
            5.0,
            6.0,
            5.0,
            5.0,
            {{40.0, 40.0, 110.0, 110.0, 8.0},
             {260.0, 40.0, 190.0, 110.0, 7.0},
             {60.0, 250.0, 240.0, 201.7, 7.5}}};
}

struct Run {
    sim::Settings settings;
    std::uint64_t seed{};
    std::string outcome;
};

/// The paper's sets B and C, as published.
sim::Settings published(sim::Task task, sim::Source source) {
    sim::Settings settings;
    settings.task = task;
    settings.source = source;
    settings.world.robots = 60;
    settings.world.items = 30;
    settings.run.cycles = 3000;
    if (task == sim::Task::collection) {
        settings.odneat = {.p_mate = 0.085,
                           .p_mutate = 0.784,
                           .p_weight = 0.864,
                           .p_node = 0.162,
                           .p_connection = 0.583,
                           .p_recurrent = 0.541,
                           .sigma = 0.62,
                           .maturation_cycles = 5,
                           .population = 6};
        settings.world.item_slip = 0.21;
    }
    return settings;
}

/// Every setting on the other side of its switch, and no perfect radio or clock.
sim::Settings unpublished(sim::Task task, sim::Source source) {
    sim::Settings settings = published(task, source);
    settings.world.actuation = sim::Actuation::wheels;
    settings.energy.navigation = sim::NavigationEnergy::equation_2;
    settings.odneat.weight_difference = neat::WeightDifference::mean;
    settings.odneat.held_energy = neat::HeldEnergy::overwrite;
    settings.odneat.species_threshold = 0.6;
    settings.odneat.tabu_threshold = 0.2;
    settings.odneat.p_mate = 0.9;
    settings.radio = {.range_px = 20.0, .loss = 0.3, .delay_cycles = 2};
    settings.timestamp = {.offset_cycles = 50.0, .drift_ppm = 200.0};
    return settings;
}

std::vector<Run> all_runs() {
    std::vector<Run> runs;
    for (const auto task : {sim::Task::navigation, sim::Task::collection}) {
        for (const auto source : {sim::Source::gene_clock, sim::Source::timestamp}) {
            runs.push_back({published(task, source), 1, {}});
            runs.push_back({unpublished(task, source), 2, {}});
        }
    }
    return runs;
}

std::string describe(const sim::RunResult& result) {
    const sim::Sample& last = result.samples.back();
    const sim::RunCounters& counters = result.counters;
    std::ostringstream text;
    text << std::hex << result.trajectory_hash << std::dec << std::hexfloat;
    for (const double mean : {last.swarm_fitness, last.species, last.added_elements}) {
        text << ' ' << mean;
    }
    for (const std::uint64_t count :
         {counters.births, counters.matings, counters.genes_created, counters.messages_received,
          counters.genomes_accepted, counters.collisions}) {
        text << ' ' << count;
    }
    return text.str();
}

/// Runs that never mutate or mate would agree for want of anything to differ in.
bool is_eventful(const sim::RunCounters& counters) {
    return counters.genes_created > 0 && counters.genomes_accepted > 0 && counters.collisions > 0;
}

}  // namespace

int main(int argc, char** argv) {
    const int threads = argc > 1 ? std::atoi(argv[1]) : 1;
    const sim::Arena arena = make_arena();
    std::vector<Run> runs = all_runs();
    std::atomic<std::size_t> next{0};
    std::atomic<bool> eventful{true};
    std::atomic<std::uint64_t> matings{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < runs.size(); i = next++) {
            const auto result = sim::simulate(runs[i].settings, arena, runs[i].seed);
            runs[i].outcome = describe(*result);
            matings += result->counters.matings;
            if (!is_eventful(result->counters)) eventful = false;
        }
    };
    {
        std::vector<std::jthread> workers;
        for (int i = 0; i < threads; ++i) workers.emplace_back(work);
    }
    for (const Run& run : runs) {
        std::printf("%s %s seed %d: %s\n",
                    run.settings.task == sim::Task::navigation ? "navigation" : "collection",
                    run.settings.source == sim::Source::gene_clock ? "gene-clock" : "timestamp",
                    static_cast<int>(run.seed), run.outcome.c_str());
    }
    if (!eventful || matings == 0) {
        std::fprintf(stderr, "a run without mutations, accepted genomes, collisions or matings\n");
        return 1;
    }
    return 0;
}
