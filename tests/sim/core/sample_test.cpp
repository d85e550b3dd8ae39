#include <gtest/gtest.h>

#include <gene_clocks/sim/sample.hpp>
#include <map>
#include <string>

namespace gene_clocks::sim {
namespace {

TEST(Sample, EachValueIsVisitedUnderItsName) {
    const Sample sample{.cycle = 100,
                        .swarm_fitness = 2.5,
                        .species = 3.5,
                        .added_elements = 4.5,
                        .controller_size = 5.5};
    std::map<std::string, double> seen;
    for_each_value(sample, [&](const char* name, const auto& value) {
        seen[name] = static_cast<double>(value);
    });
    const std::map<std::string, double> expected{{"cycle", 100.0},
                                                 {"swarm_fitness", 2.5},
                                                 {"species", 3.5},
                                                 {"added_elements", 4.5},
                                                 {"controller_size", 5.5}};
    EXPECT_EQ(seen, expected);
    EXPECT_EQ(sample_values, expected.size());
}

}  // namespace
}  // namespace gene_clocks::sim
