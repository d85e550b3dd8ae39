#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace gene_clocks::experiment {

/// How far the runs are.
struct ProgressState {
    std::size_t runs_total{};
    std::size_t runs_finished{};
    std::uint64_t robot_steps_total{};
    std::uint64_t robot_steps_done{};  ///< those of unfinished runs included
};

/// "1:02:03" or "2:03".
std::string duration_text(std::chrono::seconds duration);

/// The figures of a progress report, as in "37 of 256 runs, 12.3 M robot-steps/s, 1:23 left".
std::string progress_text(const ProgressState& state, std::chrono::duration<double> elapsed);

/// Shows progress: as a bar that is redrawn in place on a terminal, else as plain lines, one every
/// ten seconds at most.
class Progress {
public:
    using Clock = std::chrono::steady_clock;

    /// `stream` may be null: then nothing is shown.
    explicit Progress(std::FILE* stream);
    ~Progress();  ///< ends the bar's line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(const ProgressState& state, Clock::time_point now = Clock::now());
    /// Shows the final state.
    void finish(const ProgressState& state, Clock::time_point now = Clock::now());

private:
    void show(const ProgressState& state, Clock::time_point now);

    std::FILE* stream_;
    bool is_terminal_;
    bool line_is_open_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_ = start_;
};

}  // namespace gene_clocks::experiment
