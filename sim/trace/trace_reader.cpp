#include "trace_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace gene_clocks::trace {
namespace {

struct Malformed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

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
            throw Malformed(fmt::format("not a number in range: '{}'", word));
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
    throw Malformed(fmt::format("no such entry: '{}' with {} words", kind, words.size()));
}

FleetLimits parse_limits(const Words& words) {
    if (words[0] != "limits" || words.size() != 4) throw Malformed("limits expected");
    const FleetLimits limits{words.number(1), words.number(2), words.number(3)};
    if (limits.genesis_count >= limits.maximum) {
        throw Malformed("no room above the genesis marks");
    }
    return limits;
}

/// A trace from its first line to its last.
class Reading {
public:
    std::optional<Violation> read(std::string_view line) {
        const Words words(line);
        switch (expected_) {
            case Expected::header:
                if (words[0] != "gene-clocks-trace" || words.size() != 2 || words[1] != "1") {
                    throw Malformed("not a trace of version 1");
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
                return checker_->check(parse_entry(words));
            case Expected::nothing:
                break;
        }
        throw Malformed("something after the end");
    }

    bool ended() const { return expected_ == Expected::nothing; }
    std::uint64_t entries() const { return entries_; }

private:
    enum class Expected : std::uint8_t { header, limits, entry, nothing };

    Expected expected_ = Expected::header;
    std::optional<TraceChecker> checker_;  ///< once the limits are known
    std::uint64_t entries_ = 0;
};

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
    std::string line;
    try {
        for (verdict.line = 1; std::getline(in, line); ++verdict.line) {
            if (const auto violation = reading.read(line)) {
                verdict.outcome = Verdict::Outcome::violated;
                verdict.violation = *violation;
                return verdict;
            }
        }
        if (in.bad()) throw std::runtime_error("the trace cannot be read");
        if (!reading.ended()) throw Malformed("cut short: there is no end");
        verdict.entries = reading.entries();
    } catch (const Malformed& fault) {
        verdict.outcome = Verdict::Outcome::malformed;
        verdict.reason = fault.what();
    }
    return verdict;
}

}  // namespace gene_clocks::trace
