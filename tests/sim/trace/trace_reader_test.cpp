#include "trace_reader.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace gene_clocks::trace {
namespace {

Verdict read(const std::string& text) {
    std::istringstream in(text);
    return check_trace(in);
}

const std::string header = "gene-clocks-trace 1\nlimits 20 8 1\n";

TEST(TraceReader, SaysHowManyEntriesItAccepted) {
    const Verdict verdict = read(header + "m 7 2 3\nw 7 8\ns 7 5 4\nr 3 0 5\nc 7 8\nend 5\n");
    EXPECT_EQ(verdict.text(), "accepted 5");
    EXPECT_EQ(verdict.exit_status(), 0);
    EXPECT_EQ(read(header + "end 0").text(), "accepted 0") << "the last line's end may be missing";
}

TEST(TraceReader, SaysWhichLineBreaksWhichRuleFirst) {
    const Verdict verdict = read(header + "m 7 2 3\ns 7 5 4\nm 7 9 1\nend 3\n");
    EXPECT_EQ(verdict.text(), "line 4: sent-before-stored");
    EXPECT_EQ(verdict.exit_status(), 1);
    EXPECT_EQ(verdict.violation, Violation::sent_before_stored);
}

struct Case {
    std::string text;
    std::uint64_t line;
};

class MalformedTrace : public testing::TestWithParam<Case> {};

TEST_P(MalformedTrace, IsRefusedAtItsLine) {
    const Verdict verdict = read(GetParam().text);
    EXPECT_EQ(verdict.outcome, Verdict::Outcome::malformed) << verdict.text();
    EXPECT_EQ(verdict.line, GetParam().line) << verdict.reason;
    EXPECT_EQ(verdict.exit_status(), 2);
    EXPECT_FALSE(verdict.reason.empty());
}

const std::string one = header + "m 7 2 3\n";

INSTANTIATE_TEST_SUITE_P(
    , MalformedTrace,
    testing::Values(
        Case{"", 1}, Case{"\n", 1}, Case{"gene-clocks-trace 2\n", 1},
        Case{"gene-clocks-trace 1 \n", 1}, Case{"gene-clocks-trace 1\r\nlimits 20 8 1\n", 1},
        Case{"gene-clocks-trace 1\n", 2}, Case{"gene-clocks-trace 1\nlimits 20 8\n", 2},
        Case{"gene-clocks-trace 1\nlimits 20 8 20\nend 0\n", 2},
        Case{"gene-clocks-trace 1\nm 7 2 3\n", 2}, Case{header, 3}, Case{one, 4},
        Case{one + "end 2\n", 4}, Case{one + "end 1 1\n", 4}, Case{one + "end 01\n", 4},
        Case{one + "end 1\n\n", 5}, Case{one + "end 1\nm 7 5 1\n", 5}, Case{header + "\n", 3},
        Case{header + "x 7 2\n", 3}, Case{header + "m 7 2\n", 3}, Case{header + "m 7 2 3 4\n", 3},
        Case{header + "w 7 2 3\n", 3}, Case{header + "m  7 2 3\n", 3},
        Case{header + " m 7 2 3\n", 3}, Case{header + "m 0 2 3\n", 3},
        Case{header + "m 4294967296 2 3\n", 3}, Case{header + "m 7 +2 3\n", 3},
        Case{header + "m 7 -2 3\n", 3}, Case{header + "m 7 02 3\n", 3},
        Case{header + "m 7 0x2 3\n", 3}, Case{header + "m 7 2 18446744073709551616\n", 3},
        Case{header + "m 7 2.0 3\n", 3}, Case{header + "a b c d e f\n", 3}));

TEST(TraceReader, ReportsAStreamThatFails) {
    std::istringstream in(header);
    in.setstate(std::ios::badbit);
    EXPECT_THROW(check_trace(in), std::runtime_error);
}

}  // namespace
}  // namespace gene_clocks::trace
