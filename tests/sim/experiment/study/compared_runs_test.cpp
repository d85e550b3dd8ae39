#include "sim/experiment/study/compared_runs.hpp"

#include <gtest/gtest.h>

namespace gene_clocks::experiment {
namespace {

using enum sim::Task;

std::vector<sim::Sample> samples(double best) {
    return {{.cycle = 0, .swarm_fitness = best / 2},
            {.cycle = 100, .swarm_fitness = best},
            {.cycle = 200, .swarm_fitness = best - 1.0}};
}

TEST(BestOfRun, IsItsOwnUnlessTheSettingsFixIt) {
    const BestSwarmFitness own = best_of_run(samples(77.0), {});
    EXPECT_EQ(own.value, 77.0);
    EXPECT_EQ(own.over, "this run alone");
    const BestSwarmFitness fixed = best_of_run(samples(77.0), {.best_fitness = 50.0});
    EXPECT_EQ(fixed.value, 50.0);
    EXPECT_EQ(fixed.over, "no runs (measures.best_fitness fixes it)");
}

TEST(ComparedRuns, AreThoseOfOneTaskAndProfile) {
    ComparedRuns runs;
    runs.add({navigation, "mended"}, {"a", 1}, samples(80.0));
    runs.add({navigation, "mended"}, {"b", 1}, samples(70.0));
    runs.add({navigation, "gecco15"}, {"c", 1}, samples(90.0));
    runs.add({collection, "mended"}, {"d", 1}, samples(100.0));
    EXPECT_EQ(runs.best({navigation, "mended"}, {}).value, 80.0);
    EXPECT_EQ(runs.best({navigation, "mended"}, {}).over,
              "2 runs of navigation under profile mended");
    EXPECT_EQ(runs.best({navigation, "gecco15"}, {}).value, 90.0);
    EXPECT_EQ(runs.best({collection, "mended"}, {}).over,
              "1 run of collection under profile mended");
    EXPECT_EQ(runs.best({collection, "text"}, {}).value, 0.0);
    EXPECT_EQ(runs.best({navigation, "mended"}, {.best_fitness = 5.0}).value, 5.0);
}

TEST(ComparedRuns, CountARunOnce) {
    ComparedRuns runs;
    runs.add({navigation, "mended"}, {"a", 1}, samples(80.0));
    runs.add({navigation, "mended"}, {"a", 1}, samples(80.0));
    runs.add({navigation, "mended"}, {"a", 2}, samples(60.0));
    EXPECT_EQ(runs.best({navigation, "mended"}, {}).over,
              "2 runs of navigation under profile mended");
}

}  // namespace
}  // namespace gene_clocks::experiment
