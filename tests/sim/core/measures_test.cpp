#include <gtest/gtest.h>

#include <gene_clocks/sim/simulation.hpp>
#include <stdexcept>

namespace gene_clocks::sim {
namespace {

std::vector<Sample> samples(const std::vector<double>& fitness) {
    std::vector<Sample> samples;
    for (const double value : fitness) {
        samples.push_back(
            {.cycle = 100 * static_cast<std::int64_t>(samples.size()), .swarm_fitness = value});
    }
    return samples;
}

TEST(Measures, OfOneSampleAreItsOwn) {
    const Measures measures = measure(samples({50.0}), {});
    EXPECT_EQ(measures.f_c, 50.0);
    EXPECT_EQ(measures.f_b, 50.0);
    EXPECT_EQ(measures.t_f, 0.0);
    EXPECT_DOUBLE_EQ(measures.f_a, 5.0);
}

TEST(Measures, TheTargetBelongsToTheBestOfAllRunsWhereThatIsGiven) {
    const auto run = samples({10.0, 60.0, 80.0, 90.0});
    EXPECT_EQ(measure(run, {.target_share = 0.5}).t_f, 100.0);
    EXPECT_EQ(measure(run, {.target_share = 0.5, .best_fitness = 160.0}).t_f, 200.0);
    EXPECT_DOUBLE_EQ(measure(run, {.target_share = 0.5, .best_fitness = 160.0}).f_a, 10.0);
}

TEST(Measures, ATargetThatIsNotReachedTakesTheWholeRun) {
    const Measures measures =
        measure(samples({10.0, 20.0, 30.0}), {.target_share = 0.9, .best_fitness = 100.0});
    EXPECT_EQ(measures.t_f, 200.0);
    EXPECT_EQ(measures.f_a, 0.0);
}

TEST(Measures, TheAccumulatedShareIsOfTheLastSamples) {
    const auto run = samples({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 10.0, 20.0});
    EXPECT_EQ(measure(run, {.accumulated_share = 0.1}).f_c, 20.0);
    EXPECT_EQ(measure(run, {.accumulated_share = 0.2}).f_c, 15.0);
    EXPECT_EQ(measure(run, {.accumulated_share = 1.0}).f_c, 3.0);
    EXPECT_EQ(measure(run, {.accumulated_share = 0.0}).f_c, 20.0);  // one sample at least
    EXPECT_EQ(measure(run, {.budget_share = 0.8}).f_b, 10.0);
    EXPECT_EQ(measure(run, {.budget_share = 1.0}).f_b, 20.0);
}

TEST(Measures, NoSamplesAreAnError) {
    EXPECT_THROW(measure({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace gene_clocks::sim
