#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "sim/experiment/store/store.hpp"
#include "sim/experiment/study/study.hpp"
#include "sim/settings/document.hpp"
#include "sim/settings/program_version.hpp"

namespace gene_clocks::test {

/// Two arms, "one" and "two", that differ in source; five seeds from 3 on.
inline experiment::Study example_study() {
    return experiment::read_study(experiment::parse_document(R"(
name = "example"
title = "An example"
description = "It's about \"quotes\", too."
seeds = 5
first_seed = 3
[[arm]]
name = "one"
task = "navigation"
source = "gene-clock"
[[arm]]
name = "two"
task = "navigation"
source = "timestamp"
parameters = "A"
settings.measures.target_share = 0.5
)",
                                                             "example.toml"));
}

/// A run of an arm with made-up results that depend on the seed.
inline experiment::RunRecord example_run(const experiment::Arm& arm, std::uint64_t seed) {
    experiment::RunRecord record;
    record.settings_hash = arm.settings_hash;
    record.seed = seed;
    for (int i = 0; i < 20; ++i) {
        const double value = 0.1 * static_cast<double>(seed) + i;
        record.result.samples.push_back({100 * i, value, value + 1, value + 2, value + 3});
    }
    // Each field its own value, so that none can pass for another.
    sim::for_each_counter(
        record.result.counters,
        [next = seed](const char*, std::uint64_t& value) mutable { value = next++; });
    sim::for_each_measure(record.result.chronology,
                          [next = seed](const char*, auto& value) mutable {
                              value = static_cast<std::remove_reference_t<decltype(value)>>(++next);
                          });
    record.result.creations = {{{seed, RobotId{7}}, RobotId{7}, 0.5},
                               {{~seed, RobotId{0xffff'fffe}}, RobotId{2}, 1.5}};
    record.result.trajectory_hash = 0xf000'0000'0000'0000 + seed;
    record.result.robot_steps = 123;
    record.result.cpu_seconds = 0.25;
    record.wall_seconds = 0.5;
    record.finished_at = "2015-07-11T12:00:00Z";
    record.program_version = experiment::program_version();
    return record;
}

}  // namespace gene_clocks::test
