#include "protocol/trace/trace_writer.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <stdexcept>

namespace gene_clocks::trace {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 16;

}  // namespace

TraceWriter::TraceWriter(std::ostream& out, FleetLimits limits) : out_{out} {
    fmt::format_to(std::back_inserter(buffer_), "gene-clocks-trace 1\nlimits {} {} {}\n",
                   limits.maximum, limits.window, limits.genesis_count);
}

template <class... Numbers>
void TraceWriter::write(char kind, RobotId robot, Numbers... numbers) {
    const auto end = std::back_inserter(buffer_);
    fmt::format_to(end, "{} {}", kind, static_cast<std::uint32_t>(robot));
    (fmt::format_to(end, " {}", numbers), ...);
    buffer_ += '\n';
    ++entries_;
    if (buffer_.size() >= buffer_bytes) {
        out_ << buffer_;
        buffer_.clear();
    }
}

void TraceWriter::minted(const GeneClock::Marks& marks) {
    write('m', marks.first.robot, marks.first.counter, marks.count);
}

std::uint64_t TraceWriter::sent(RobotId robot, Stamp stamp, std::uint64_t newest) {
    write('s', robot, stamp.value, newest);
    return messages_++;
}

void TraceWriter::received(RobotId robot, std::uint64_t message, Stamp next) {
    write('r', robot, message, next.value);
}

void TraceWriter::stored(RobotId robot, std::uint64_t value) {
    write('w', robot, value);
}

void TraceWriter::restarted(RobotId robot, Stamp next) {
    write('c', robot, next.value);
}

void TraceWriter::finish() {
    fmt::format_to(std::back_inserter(buffer_), "end {}\n", entries_);
    out_ << buffer_;
    buffer_.clear();
    out_.flush();
    if (!out_) throw std::runtime_error("the trace cannot be written");
}

}  // namespace gene_clocks::trace
