#include "protocol/trace/trace_writer.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "protocol/trace/trace_reader.hpp"

namespace gene_clocks::trace {
namespace {

constexpr FleetLimits small{.maximum = 20, .window = 8, .genesis_count = 1};

TEST(TraceWriter, WritesTheFormat) {
    std::ostringstream out;
    TraceWriter writer(out, small);
    GeneClock clock(RobotId{7}, 1, {.maximum = 20, .block = 3, .window = 8});
    writer.minted(clock.mint(3).value());
    writer.stored(RobotId{7}, clock.durable_needed());
    EXPECT_EQ(writer.sent(RobotId{7}, clock.stamp(), 4), 0u);
    writer.received(RobotId{3}, 0, Stamp{5});
    writer.restarted(RobotId{7}, Stamp{8});
    writer.stored(RobotId{3}, 5);
    EXPECT_EQ(writer.sent(RobotId{3}, Stamp{5}, 4), 1u);
    writer.finish();
    EXPECT_EQ(out.str(),
              "gene-clocks-trace 1\nlimits 20 8 1\nm 7 2 3\nw 7 8\ns 7 5 4\nr 3 0 5\nc 7 8\nw 3 5\n"
              "s 3 5 4\nend 7\n");
    std::istringstream in(out.str());
    EXPECT_EQ(check_trace(in).text(), "accepted 7");
}

TEST(TraceWriter, WritesMoreThanItBuffers) {
    std::ostringstream out;
    TraceWriter writer(out, {.maximum = 1'000'000, .window = 8, .genesis_count = 1});
    GeneClock clock(RobotId{7}, 1);
    for (int i = 0; i < 20'000; ++i) writer.minted(clock.mint(1).value());
    writer.finish();
    std::istringstream in(out.str());
    EXPECT_EQ(check_trace(in).text(), "accepted 20000");
}

TEST(TraceWriter, ReportsWhatCouldNotBeWritten) {
    std::ostringstream out;
    TraceWriter writer(out, small);
    out.setstate(std::ios::badbit);
    EXPECT_THROW(writer.finish(), std::runtime_error);
}

}  // namespace
}  // namespace gene_clocks::trace
