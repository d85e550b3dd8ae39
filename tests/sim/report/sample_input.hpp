#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/report/report.hpp"
#include "sim/settings/choice_names.hpp"
#include "sim/settings/profile.hpp"
#include "sim/settings/settings_io.hpp"

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
    run.result.counters.messages_sent = 1000;
    sim::ChronologyMeasures& chronology = run.result.chronology;
    chronology.genes = 100;
    chronology.pairs = 4950;
    chronology.caused_pairs = 2000;
    chronology.timed_pairs = 4900;
    chronology.time_inverted = 50 * seed;
    chronology.alignments = 400;
    chronology.missed_homologies = 3 * seed;
    chronology.bytes_sent = 90000;
    chronology.stamp_bytes = 1500 + seed;
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

inline ArmRuns sample_arm(const SampleArm& sample) {
    ArmRuns arm;
    arm.profile = "gecco15";
    arm.settings = experiment::select({.task = sample.task,
                                       .source = sample.source,
                                       .profile = arm.profile,
                                       .parameters = sample.parameters});
    arm.name = std::string(experiment::name_of(sample.task)) + "-" + sample.parameters + "-" +
               std::string(experiment::name_of(sample.source));
    arm.settings_hash = arm.name;
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

/// An arm of few, short runs with some settings of its own.
inline ArmRuns short_arm(sim::Task task, sim::Source source,
                         const std::vector<std::string>& settings, std::string name = {}) {
    ArmRuns arm;
    arm.profile = "mended";
    arm.settings = experiment::select({.task = task, .source = source});
    arm.settings.run.cycles = 2000;
    arm.name =
        std::string(experiment::name_of(task)) + "-" + std::string(experiment::name_of(source));
    for (const std::string& setting : settings) {
        experiment::assign(arm.settings, setting);
        arm.name += "-" + setting;
    }
    arm.settings_hash = arm.name;
    if (!name.empty()) arm.name = std::move(name);
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        arm.runs.push_back(sample_run(arm.settings, 140.0, seed));
    return arm;
}

/// Every setting of one list with every one of the other.
inline std::vector<std::vector<std::string>> combinations(const std::vector<std::string>& ones,
                                                          const std::vector<std::string>& others) {
    std::vector<std::vector<std::string>> all;
    for (const std::string& one : ones)
        for (const std::string& other : others) all.push_back({one, other});
    return all;
}

/// Made-up runs of a kind of study: "paper", "markings" (every source), "loss" (sources and a
/// number), "drift" (two numbers, and gene clocks once), "operators" (two choices and a number),
/// "readings" (one thing changed at a time), "single" (one arm) or "hostile" (names that are HTML).
inline Input sample_study(std::string_view kind) {
    using enum sim::Task;
    using enum sim::Source;
    if (kind == "paper") return sample_input();
    Input input;
    input.study = input.title = kind;
    const auto add = [&](sim::Source source, const std::vector<std::string>& settings,
                         std::string name = {}) {
        input.arms.push_back(short_arm(navigation, source, settings, std::move(name)));
    };
    if (kind == "markings") {
        for (const sim::Task task : {navigation, collection})
            for (std::size_t i = 0; i < experiment::choice_names<sim::Source>.size(); ++i)
                input.arms.push_back(short_arm(task, static_cast<sim::Source>(i), {}));
    } else if (kind == "loss") {
        for (const char* loss : {"radio.loss=0", "radio.loss=0.5", "radio.loss=0.99"})
            for (const sim::Source source : {gene_clock, gene_clock_no_merge, timestamp})
                add(source, {loss});
    } else if (kind == "drift") {
        add(gene_clock, {});
        for (const auto& settings :
             combinations({"timestamp.offset_cycles=0", "timestamp.offset_cycles=1000"},
                          {"timestamp.drift_ppm=0", "timestamp.drift_ppm=100"}))
            add(timestamp, settings);
    } else if (kind == "operators") {
        for (const char* p_mate : {"odneat.p_mate=0.1", "odneat.p_mate=0.8"})
            for (auto settings :
                 combinations({"odneat.crossover=uniform", "odneat.crossover=one-point"},
                              {"odneat.mismatch=excess-disjoint", "odneat.mismatch=age"})) {
                settings.emplace_back(p_mate);
                add(gene_clock, settings);
            }
    } else if (kind == "readings") {
        for (const char* setting : {"world.item_slip=0", "world.item_slip=0.15",
                                    "world.acceleration_px=4", "odneat.held_reports=acceptable"})
            add(gene_clock, {setting});
    } else if (kind == "single") {
        add(timestamp, {});
    } else if (kind == "hostile") {
        input.study = input.title = "<script>alert('title')</script>";
        input.command = "\"><img src=x onerror=alert(1)>";
        add(gene_clock, {}, "<script>alert('arm')</script>");
        add(timestamp, {}, "'\"><svg onload=alert(2)>");
        add(timestamp, {"world.arena=<b>{{ 7 * 7 }}</b>.toml"}, "{{ 7 * 7 }}&lt;");
        for (ArmRuns& arm : input.arms) arm.profile = "<i>$x^{$ ../../profile</i>.toml";
    }
    return input;
}

}  // namespace gene_clocks::report
