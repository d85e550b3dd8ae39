#include "sim/experiment/study/summary.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace gene_clocks::experiment {
namespace {

/// A sample every 100 cycles whose values are all that number of the sample.
std::vector<sim::Sample> ramp(int count) {
    std::vector<sim::Sample> samples;
    for (int i = 0; i < count; ++i) {
        samples.push_back({.cycle = 100 * i,
                           .swarm_fitness = double(i),
                           .species = double(2 * i),
                           .added_elements = double(3 * i),
                           .controller_size = double(4 * i)});
    }
    return samples;
}

RunSummary summarise(const std::vector<sim::Sample>& samples,
                     const sim::MeasureSettings& settings) {
    return experiment::summarise(samples, settings, best_of_run(samples, settings));
}

TEST(Summary, TakesMeansOverTheLastShare) {
    const RunSummary summary = summarise(ramp(40), {.accumulated_share = 0.1});
    EXPECT_EQ(summary.measures.f_c, (36 + 37 + 38 + 39) / 4.0);
    EXPECT_EQ(summary.species, 2 * (36 + 37 + 38 + 39) / 4.0);
    EXPECT_EQ(summary.added_elements, 3 * (36 + 37 + 38 + 39) / 4.0);
    EXPECT_EQ(summary.controller_size, 4 * (36 + 37 + 38 + 39) / 4.0);
    EXPECT_EQ(summary.final_swarm_fitness, 39.0);
    EXPECT_EQ(summarise(ramp(40), {.accumulated_share = 1.0}).species, 39.0);
    EXPECT_EQ(summarise(ramp(3), {.accumulated_share = 0.01}).species, 4.0);  // one sample at least
}

TEST(Summary, ReadsTheFitnessAtCycle10000) {
    EXPECT_EQ(summarise(ramp(400), {}).swarm_fitness_at_10000, 100.0);
    EXPECT_EQ(summarise(ramp(101), {}).swarm_fitness_at_10000, 100.0);
    EXPECT_EQ(summarise(ramp(100), {}).swarm_fitness_at_10000, std::nullopt);
    auto between = ramp(400);
    between.erase(between.begin() + 100);
    EXPECT_EQ(summarise(between, {}).swarm_fitness_at_10000, 99.0);
}

TEST(Summary, NeedsASample) {
    EXPECT_THROW(summarise({}, {}), std::invalid_argument);
}

TEST(Summary, SaysWhatTimeToTargetRefersTo) {
    const RunSummary summary =
        experiment::summarise(ramp(40), {.target_share = 0.5}, {20.0, "some runs"});
    EXPECT_EQ(summary.measures.t_f, 1000.0);
    EXPECT_EQ(summary.best.value, 20.0);
    EXPECT_EQ(summary.best.over, "some runs");
}

}  // namespace
}  // namespace gene_clocks::experiment
