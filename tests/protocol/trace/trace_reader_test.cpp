#include "protocol/trace/trace_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace gene_clocks::trace {
namespace {

using testing::HasSubstr;

Verdict read(const std::string& text) {
    std::istringstream in(text);
    return check_trace(in);
}

const std::string header = "gene-clocks-trace 1\nlimits 20 8 1\n";

TEST(TraceReader, SaysHowManyEntriesItAccepted) {
    const Verdict verdict = read(header + "m 7 2 3\nw 7 8\ns 7 5 4\nr 3 0 5\nc 7 8\nend 5\n");
    EXPECT_EQ(verdict.text(), "accepted 5");
    EXPECT_EQ(verdict.exit_status(), 0);
    EXPECT_EQ(read(header + "end 0\n").text(), "accepted 0");
}

TEST(TraceReader, SaysWhichLineBreaksWhichRuleFirst) {
    const Verdict verdict = read(header + "m 7 2 3\ns 7 5 4\nm 7 9 1\nend 3\n");
    EXPECT_EQ(verdict.text(), "line 4: sent-before-stored");
    EXPECT_EQ(verdict.exit_status(), 1);
    EXPECT_EQ(verdict.violation, Violation::sent_before_stored);
    EXPECT_EQ(verdict.entry, "s 7 5 4");
    EXPECT_EQ(verdict.reason,
              "a message left while the counter was ahead of storage "
              "(robot 7: next counter 5, stored 2; messages sent: 0)");
}

TEST(TraceReader, ExplainsAnEntryByWhatWasBeforeIt) {
    const std::string sent = "m 7 2 3\nw 7 8\ns 7 5 4\n";
    EXPECT_THAT(read(header + sent + "r 3 0 6\n").reason, HasSubstr("robot 3: next counter 2, "));
    EXPECT_THAT(read(header + sent + "r 3 1 5\n").reason, HasSubstr("messages sent: 1)"));
    EXPECT_THAT(read(header + sent + "c 7 5\n").reason, HasSubstr("next counter 5, stored 8;"));
}

TEST(TraceReader, KeepsUnprintableBytesOutOfItsMessages) {
    EXPECT_EQ(read(header + "m \x1b[31m 2 3\n").reason, "not a number in range: '?[31m'");
    EXPECT_EQ(read(header + "\xff\n").reason, "there is no entry '?' of 1 words");
}

TEST(TraceReader, HasRoomForTheLongestLines) {
    EXPECT_EQ(read("gene-clocks-trace 1\n"
                   "limits 18446744073709551615 18446744073709551615 18446744073709551613\n"
                   "m 4294967295 18446744073709551614 1\n"
                   "w 4294967295 18446744073709551615\n"
                   "s 4294967295 18446744073709551615 18446744073709551614\nend 3\n")
                  .text(),
              "accepted 3");
}

struct Case {
    std::string text;
    std::uint64_t line;
    friend void PrintTo(const Case& fault, std::ostream* out) {
        *out << "fault in line " << fault.line;
    }
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
        Case{one + "end 2\n", 4}, Case{one + "end 1", 4}, Case{header + "m 7 2", 3},
        Case{header + "m 7 3 1", 3}, Case{"gene-clocks-trace 1", 1}, Case{one + "end 1 1\n", 4},
        Case{one + "end 01\n", 4}, Case{one + "end 1\n\n", 5}, Case{one + "end 1\nm 7 5 1\n", 5},
        Case{header + "\n", 3}, Case{header + "x 7 2\n", 3}, Case{header + "m 7 2\n", 3},
        Case{header + "m 7 2 3 4\n", 3}, Case{header + "w 7 2 3\n", 3},
        Case{header + "m  7 2 3\n", 3}, Case{header + " m 7 2 3\n", 3},
        Case{header + "m 0 2 3\n", 3}, Case{header + "m 4294967296 2 3\n", 3},
        Case{header + "m 7 +2 3\n", 3}, Case{header + "m 7 -2 3\n", 3},
        Case{header + "m 7 02 3\n", 3}, Case{header + "m 7 0x2 3\n", 3},
        Case{header + "m 7 2 18446744073709551616\n", 3}, Case{header + "m 7 2.0 3\n", 3},
        Case{header + "a b c d e f\n", 3},
        Case{header + "m 7 2 " + std::string(130, '0') + "3\n", 3},
        Case{header + "m 7 2 3" + std::string(1, '\0') + "\n", 3}));

TEST(TraceReader, ReportsAStreamThatFails) {
    std::istringstream in(header);
    in.setstate(std::ios::badbit);
    EXPECT_THROW(check_trace(in), std::runtime_error);
}

TEST(TraceReader, GivesUpOnALineThatDoesNotEnd) {
    const Verdict verdict = read(header + std::string(1 << 20, '0'));
    EXPECT_EQ(verdict.line, 3u);
    EXPECT_EQ(verdict.reason, "too long a line") << "read as a whole";
}

}  // namespace
}  // namespace gene_clocks::trace
