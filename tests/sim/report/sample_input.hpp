#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "choice_names.hpp"
#include "profile.hpp"
#include "report.hpp"

namespace gene_clocks::report {

/// What decides the made-up runs of an arm.
struct SampleArm {
    sim::Task task = sim::Task::navigation;
    sim::Source source = sim::Source::gene_clock;
    std::string parameters = "B";
    double level = 160.0;  ///< F_s at the end, give or take
    std::uint64_t first_seed = 1;
    std::size_t runs = 6;
};

inline double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11U) * 0x1p-53;
}

/// A run that rises from 100 to about `level`, sampled as the simulator does. The same seed gives
/// the same run.
inline Run sample_run(const sim::Settings& settings, double level, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const double height = level + 20.0 * (uniform(random) - 0.5);
    Run run;
    run.seed = seed;
    run.program_version = "1.2.3";
    run.result.trajectory_hash = random();
    run.result.robot_steps =
        static_cast<std::uint64_t>(settings.world.robots * settings.run.cycles);
    run.result.cpu_seconds = 0.5;
    run.result.counters.births = 1000 + seed;
    const double initial_size = settings.task == sim::Task::navigation ? 32.0 : 56.0;
    for (std::int64_t cycle = 0; cycle < settings.run.cycles;
         cycle += settings.run.sample_period_cycles) {
        const double progress = 1.0 - std::exp(-static_cast<double>(cycle) / 8000.0);
        sim::Sample& sample = run.result.samples.emplace_back();
        sample.cycle = cycle;
        sample.swarm_fitness = 100.0 + (height - 100.0) * progress + uniform(random);
        sample.species = 1.0 + progress + 0.2 * uniform(random);
        sample.added_elements = 3.0 * progress;
        sample.controller_size = initial_size + sample.added_elements;
    }
    return run;
}

inline Arm sample_arm(const SampleArm& sample) {
    Arm arm;
    arm.profile = "gecco15";
    arm.settings = experiment::select({.task = sample.task,
                                       .source = sample.source,
                                       .profile = arm.profile,
                                       .parameters = sample.parameters});
    arm.name = std::string(experiment::name_of(sample.task)) + "-" + sample.parameters + "-" +
               std::string(experiment::name_of(sample.source));
    for (std::size_t i = 0; i < sample.runs; ++i)
        arm.runs.push_back(sample_run(arm.settings, sample.level, sample.first_seed + i));
    return arm;
}

/// The paper's four experiments, with made-up runs; both methods with the same seeds.
inline Input sample_input() {
    using enum sim::Task;
    using enum sim::Source;
    Input input;
    input.study = "sample";
    input.title = "Made-up runs";
    input.command = "gene-clocks study sample";
    input.program_version = "1.2.3";
    for (const SampleArm& sample :
         {SampleArm{.level = 160.0}, SampleArm{.source = timestamp, .level = 160.0},
          SampleArm{.task = collection, .parameters = "C", .level = 150.0},
          SampleArm{.task = collection, .source = timestamp, .parameters = "C", .level = 155.0},
          SampleArm{.parameters = "A", .level = 158.0},
          SampleArm{.source = timestamp, .parameters = "A", .level = 159.0}})
        input.arms.push_back(sample_arm(sample));
    return input;
}

}  // namespace gene_clocks::report
