// Whole runs of the simulator: robot-steps (robots × cycles) per CPU-second, everything on.

#include <benchmark/benchmark.h>

#include <gene_clocks/sim/simulation.hpp>

#include "sim/settings/arena_file.hpp"
#include "sim/settings/profile.hpp"

namespace {

using namespace gene_clocks;

/// Full runs of the paper's length, one seed after the other: runs differ in speed, since swarms
/// that gather talk more.
void run_task(benchmark::State& state, sim::Task task, const char* profile) {
    experiment::Selection selection;
    selection.task = task;
    selection.profile = profile;
    const sim::Settings settings = experiment::select(selection);
    const sim::Arena arena = experiment::find_arena(settings.world.arena);
    std::uint64_t seed = 0;
    double robot_steps = 0.0;
    for (auto _ : state) {
        const auto result = sim::simulate(settings, arena, ++seed);
        robot_steps += static_cast<double>(result->robot_steps);
    }
    state.counters["robot_steps_per_cpu_second"] =
        benchmark::Counter(robot_steps, benchmark::Counter::kIsRate);
}

constexpr auto runs = 8;
BENCHMARK_CAPTURE(run_task, navigation_B, sim::Task::navigation, "gecco15")
    ->Iterations(runs)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_task, collection_C, sim::Task::collection, "gecco15")
    ->Iterations(runs)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_task, navigation_mean_distance, sim::Task::navigation, "text")
    ->Iterations(runs)
    ->Unit(benchmark::kMillisecond);

}  // namespace
