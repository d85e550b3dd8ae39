#include "sim/experiment/study/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace gene_clocks::experiment {
namespace {

constexpr auto redraw_period = std::chrono::milliseconds(200);
constexpr auto line_period = std::chrono::seconds(10);
constexpr std::size_t bar_width = 24;

double share_done(const ProgressState& state) {
    if (state.robot_steps_total == 0) return 1.0;
    return static_cast<double>(state.robot_steps_done) /
           static_cast<double>(state.robot_steps_total);
}

std::string bar(double share) {
    const auto filled = std::min(bar_width, static_cast<std::size_t>(share * bar_width));
    return fmt::format("[{:=<{}}{: <{}}] {:3.0f} %", "", filled, "", bar_width - filled,
                       100 * share);
}

std::size_t terminal_width(std::FILE* stream) {
    winsize size{};
    const bool known = ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

}  // namespace

std::string duration_text(std::chrono::seconds duration) {
    const auto seconds = duration.count();
    if (seconds >= 3600) {
        return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
    }
    return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

std::string progress_text(const ProgressState& state, std::chrono::duration<double> elapsed) {
    std::string text = fmt::format("{} of {} runs", state.runs_finished, state.runs_total);
    if (state.robot_steps_done == 0 || elapsed.count() <= 0.0) return text;
    const double rate = static_cast<double>(state.robot_steps_done) / elapsed.count();
    text += fmt::format(", {:.1f} M robot-steps/s", rate / 1e6);
    if (state.runs_finished == state.runs_total) {
        return text + ", " +
               duration_text(std::chrono::duration_cast<std::chrono::seconds>(elapsed));
    }
    const auto steps_left = static_cast<double>(state.robot_steps_total - state.robot_steps_done);
    const std::chrono::seconds left{static_cast<std::int64_t>(steps_left / rate + 0.5)};
    return text + ", " + duration_text(left) + " left";
}

Progress::Progress(std::FILE* stream)
    : stream_(stream), is_terminal_(stream != nullptr && isatty(fileno(stream)) != 0) {}

Progress::~Progress() {
    if (line_is_open_) std::fputc('\n', stream_);
}

void Progress::update(const ProgressState& state, Clock::time_point now) {
    if (stream_ == nullptr) return;
    if (now - last_shown_ < (is_terminal_ ? Clock::duration(redraw_period) : line_period)) return;
    show(state, now);
}

void Progress::finish(const ProgressState& state, Clock::time_point now) {
    if (stream_ != nullptr) show(state, now);
}

void Progress::show(const ProgressState& state, Clock::time_point now) {
    last_shown_ = now;
    const std::string text = progress_text(state, now - start_);
    if (!is_terminal_) {
        fmt::print(stream_, "{}\n", text);
    } else {
        const std::string line = bar(share_done(state)) + "  " + text;
        // Carriage return and "erase to the end of the line"; a longer line would wrap and stay.
        fmt::print(stream_, "\r{}\x1b[K", line.substr(0, terminal_width(stream_) - 1));
        line_is_open_ = true;
    }
    std::fflush(stream_);
}

}  // namespace gene_clocks::experiment
