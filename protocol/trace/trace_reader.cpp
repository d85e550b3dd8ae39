#include "protocol/trace/trace_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <variant>

namespace gene_clocks::trace {
namespace {

/// No well-formed line is as long, so that a file without ends of lines does not fill memory.
constexpr std::size_t line_capacity = 128;

constexpr const char* not_a_trace = "not a trace of version 1 (is it compressed?)";

struct Malformed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A word for a message, whatever bytes it holds.
std::string quoted(std::string_view word) {
    std::string text = "'";
    for (const char c : word) text += c < ' ' || c > '~' ? '?' : c;
    return text + "'";
}

/// The words of a line, which one space parts. No line has more than five.
class Words {
public:
    explicit Words(std::string_view line) {
        while (true) {
            if (count_ == words_.size()) throw Malformed("too many words");
            const auto space = line.find(' ');
            words_[count_++] = line.substr(0, space);
            if (space == std::string_view::npos) return;
            line.remove_prefix(space + 1);
        }
    }

    std::size_t size() const { return count_; }
    std::string_view operator[](std::size_t index) const { return words_[index]; }

    template <std::unsigned_integral Number = std::uint64_t>
    Number number(std::size_t index) const {
        const std::string_view word = words_[index];
        Number value{};
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool padded = word.size() > 1 && word.front() == '0';
        if (error != std::errc{} || end != word.data() + word.size() || padded) {
            throw Malformed("not a number in range: " + quoted(word));
        }
        return value;
    }

    RobotId robot() const {
        const RobotId robot{number<std::uint32_t>(1)};
        if (robot == genesis_robot) throw Malformed("robot 0 is reserved for the initial genes");
        return robot;
    }

private:
    std::array<std::string_view, 5> words_;
    std::size_t count_ = 0;
};

Entry parse_entry(const Words& words) {
    const std::string_view kind = words[0];
    if (words.size() == 4) {
        if (kind == "m") return Mints{words.robot(), words.number(2), words.number(3)};
        if (kind == "s") return Sends{words.robot(), {words.number(2)}, words.number(3)};
        if (kind == "r") return Receives{words.robot(), words.number(2), {words.number(3)}};
    } else if (words.size() == 3) {
        if (kind == "w") return Stores{words.robot(), words.number(2)};
        if (kind == "c") return Restarts{words.robot(), {words.number(2)}};
    }
    throw Malformed(fmt::format("there is no entry {} of {} words", quoted(kind), words.size()));
}

FleetLimits parse_limits(const Words& words) {
    if (words[0] != "limits" || words.size() != 4) throw Malformed("limits expected");
    const FleetLimits limits{words.number(1), words.number(2), words.number(3)};
    if (limits.genesis_count >= limits.maximum) {
        throw Malformed("no room above the genesis marks");
    }
    return limits;
}

RobotId robot_of(const Entry& entry) {
    return std::visit([](const auto& kind) { return kind.robot; }, entry);
}

/// A trace from its first line to its last.
class Reading {
public:
    /// The rule that the line breaks, if any.
    std::optional<Violation> read(std::string_view line) {
        const Words words(line);
        switch (expected_) {
            case Expected::header:
                if (words[0] != "gene-clocks-trace" || words.size() != 2 || words[1] != "1") {
                    throw Malformed(not_a_trace);
                }
                expected_ = Expected::limits;
                return std::nullopt;
            case Expected::limits:
                checker_.emplace(parse_limits(words));
                expected_ = Expected::entry;
                return std::nullopt;
            case Expected::entry:
                if (words[0] == "end") {
                    if (words.size() != 2 || words.number(1) != entries_) {
                        throw Malformed("the trace ends with another number of entries");
                    }
                    expected_ = Expected::nothing;
                    return std::nullopt;
                }
                ++entries_;
                last_ = parse_entry(words);
                return checker_->check(last_);
            case Expected::nothing:
                break;
        }
        throw Malformed("something after the end");
    }

    /// Why the last line breaks that rule.
    std::string explain(Violation violation) {
        const RobotId robot = robot_of(last_);
        const TraceChecker::Standing standing = checker_->standing(robot);
        return fmt::format("{} (robot {}: next counter {}, stored {}; messages sent: {})",
                           meaning(violation), static_cast<std::uint32_t>(robot),
                           standing.next.value, standing.stored, checker_->messages());
    }

    bool ended() const { return expected_ == Expected::nothing; }
    std::uint64_t entries() const { return entries_; }

private:
    enum class Expected : std::uint8_t { header, limits, entry, nothing };

    Expected expected_ = Expected::header;
    std::optional<TraceChecker> checker_;  ///< once the limits are known
    Entry last_;
    std::uint64_t entries_ = 0;
};

/// Reads a line, of which it returns all but its end; nullopt at the stream's end.
std::optional<std::string_view> next_line(std::istream& in,
                                          std::array<char, line_capacity>& buffer) {
    in.getline(buffer.data(), std::ssize(buffer));
    if (in.bad()) throw std::runtime_error("reading failed");
    const auto length = static_cast<std::size_t>(in.gcount());
    if (in.eof()) {
        if (length == 0) return std::nullopt;
        throw Malformed("cut short: the line has no end");
    }
    if (in.fail()) throw Malformed("too long a line");
    return std::string_view{buffer.data(), length - 1};
}

}  // namespace

std::string Verdict::text() const {
    switch (outcome) {
        case Outcome::accepted:
            return fmt::format("accepted {}", entries);
        case Outcome::violated:
            return fmt::format("line {}: {}", line, name(violation));
        case Outcome::malformed:
            break;
    }
    return fmt::format("line {}: malformed", line);
}

Verdict check_trace(std::istream& in) {
    Reading reading;
    Verdict verdict;
    std::array<char, line_capacity> buffer{};
    try {
        for (verdict.line = 1; const auto line = next_line(in, buffer); ++verdict.line) {
            if (const auto violation = reading.read(*line)) {
                verdict.outcome = Verdict::Outcome::violated;
                verdict.violation = *violation;
                verdict.entry = *line;
                verdict.reason = reading.explain(*violation);
                return verdict;
            }
        }
        if (!reading.ended()) throw Malformed("cut short: there is no end");
        verdict.entries = reading.entries();
    } catch (const Malformed& fault) {
        verdict.outcome = Verdict::Outcome::malformed;
        verdict.reason = verdict.line == 1 ? not_a_trace : fault.what();
    }
    return verdict;
}

}  // namespace gene_clocks::trace
