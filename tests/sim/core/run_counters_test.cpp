#include <gtest/gtest.h>

#include <gene_clocks/sim/run_counters.hpp>
#include <map>
#include <string>

namespace gene_clocks::sim {
namespace {

TEST(RunCounters, EachIsVisitedUnderItsName) {
    const RunCounters counters{.births = 1,
                               .matings = 2,
                               .mutations = 3,
                               .genes_created = 4,
                               .messages_sent = 5,
                               .messages_received = 6,
                               .genomes_accepted = 7,
                               .collisions = 8,
                               .reboots = 9};
    std::map<std::string, std::uint64_t> seen;
    for_each_counter(counters, [&](const char* name, std::uint64_t value) { seen[name] = value; });
    const std::map<std::string, std::uint64_t> expected{
        {"births", 1},        {"matings", 2},          {"mutations", 3},
        {"genes_created", 4}, {"messages_sent", 5},    {"messages_received", 6},
        {"collisions", 8},    {"genomes_accepted", 7}, {"reboots", 9}};
    EXPECT_EQ(seen, expected);
    EXPECT_EQ(run_counters, expected.size());
}

TEST(RunCounters, CanBeFilledByTheirNames) {
    RunCounters counters;
    for_each_counter(counters, [](const std::string& name, std::uint64_t& value) {
        value = name == "reboots" ? 3 : 0;
    });
    EXPECT_EQ(counters.reboots, 3U);
    EXPECT_EQ(counters.births, 0U);
}

}  // namespace
}  // namespace gene_clocks::sim
