#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/app/mpi/messenger.hpp"
#include "sim/experiment/study/runner.hpp"
#include "sim/experiment/study/study.hpp"

namespace gene_clocks::app {

/// Hands out runs to the workers, one at a time, and gathers the results.
class Coordinator {
public:
    /// When `stop` is set, runs under way are given up.
    Coordinator(Messenger& messenger, const std::atomic<bool>& stop);
    Coordinator(const Coordinator&) = delete;
    Coordinator& operator=(const Coordinator&) = delete;

    /// As experiment::execute_runs, but by the workers. They must be the study's.
    experiment::Outcome execute_runs(
        const experiment::Study& study, std::vector<experiment::PlannedRun> planned_runs,
        experiment::Progress& progress,
        const std::function<void(const experiment::FinishedRun&)>& on_finished);

    /// Tells all workers to end, and waits until they have. False where some do not answer: then
    /// MPI cannot end in good order.
    bool end() { return end_workers(nullptr); }

private:
    /// Invariant: `assigned` is set only while the worker is ready or executes that run.
    struct Worker {
        bool has_ended = false;
        std::optional<std::size_t> assigned;  ///< position of its run in the order of all
    };
    struct Job;

    /// Keeps the results that still come in, where they are of a job.
    bool end_workers(Job* job);
    void tell_all(Topic topic);
    void hand_out(Job& job, int rank);
    void handle(Job& job, const Message& message);
    void keep(Job& job, const Message& message);
    [[nodiscard]] bool all_have_ended() const;

    Messenger& messenger_;
    const std::atomic<bool>& stop_;
    std::vector<Worker> workers_;  ///< by rank, the coordinator's own included, which has ended
    bool told_to_end_ = false;
};

}  // namespace gene_clocks::app
