#include "sim/app/mpi/coordinator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/app/commands.hpp"
#include "sim/app/mpi/assigned_run.hpp"
#include "sim/experiment/store/run_message.hpp"
#include "sim/settings/input_error.hpp"

namespace gene_clocks::app {
namespace {

using experiment::FinishedRun;
using experiment::Outcome;
using experiment::PlannedRun;
using experiment::Study;
using Clock = std::chrono::steady_clock;

/// How long workers may take to say goodbye.
constexpr std::chrono::seconds patience{60};
/// Once a signal told to stop: mpirun kills processes one second after it has told them to end.
constexpr std::chrono::milliseconds patience_when_stopped{700};

/// What a worker says that something threw.
std::exception_ptr failure_of(const Message& message) {
    if (message.content.empty()) {
        return std::make_exception_ptr(std::runtime_error("a worker failed"));
    }
    const std::string text(message.content.begin() + 1, message.content.end());
    if (message.content.front() == bad_input) {
        return std::make_exception_ptr(experiment::InputError(text));
    }
    return std::make_exception_ptr(std::runtime_error(text));
}

}  // namespace

/// The runs that are being made.
struct Coordinator::Job {
    const Study& study;
    std::vector<PlannedRun> planned_runs;  ///< longest first
    const std::function<void(const FinishedRun&)>& on_finished;
    std::size_t handed_out = 0;
    bool is_stopped = false;
    std::exception_ptr failure = nullptr;  ///< what is to be thrown once all workers have ended
    experiment::ProgressState state{};
};

Coordinator::Coordinator(Messenger& messenger, const std::atomic<bool>& stop)
    : messenger_(messenger), stop_(stop), workers_(static_cast<std::size_t>(messenger.size())) {
    workers_[coordinator_rank].has_ended = true;
}

Outcome Coordinator::execute_runs(const Study& study, std::vector<PlannedRun> planned_runs,
                                  experiment::Progress& progress,
                                  const std::function<void(const FinishedRun&)>& on_finished) {
    experiment::sort_for_execution(planned_runs);
    Job job{study, std::move(planned_runs), on_finished};
    job.state.runs_total = job.planned_runs.size();
    for (const PlannedRun& planned : job.planned_runs)
        job.state.robot_steps_total += planned.robot_steps();
    tell_all(Topic::begin);
    while (job.state.runs_finished < job.planned_runs.size() && !job.is_stopped) {
        if (stop_) job.is_stopped = true;
        if (const auto message = messenger_.receive()) {
            handle(job, *message);
        } else {
            wait_a_moment();
        }
        progress.update(job.state);
    }
    if (job.is_stopped) end_workers(&job);
    progress.finish(job.state);
    if (job.failure) std::rethrow_exception(job.failure);
    return job.state.runs_finished == job.planned_runs.size() ? Outcome::finished
                                                              : Outcome::stopped;
}

void Coordinator::handle(Job& job, const Message& message) {
    switch (message.topic) {
        case Topic::ready:
            if (std::string(message.content.begin(), message.content.end()) !=
                fingerprint(job.study)) {
                job.is_stopped = true;
                job.failure = std::make_exception_ptr(experiment::InputError(fmt::format(
                    "process {} of {} has another study or another version of gene-clocks; the "
                    "same files must be there on every machine",
                    message.sender, messenger_.size())));
                break;
            }
            hand_out(job, message.sender);
            break;
        case Topic::result:
            keep(job, message);
            hand_out(job, message.sender);
            break;
        case Topic::gave_up:
            job.is_stopped = true;
            break;
        case Topic::failed:
            job.is_stopped = true;
            if (!job.failure) job.failure = failure_of(message);
            break;
        default:
            throw std::runtime_error("a worker sent a message of an unknown kind");
    }
}

void Coordinator::hand_out(Job& job, int rank) {
    if (job.handed_out == job.planned_runs.size()) return;
    const PlannedRun& planned = job.planned_runs[job.handed_out];
    const auto arm = std::ranges::find_if(job.study.arms, [&](const experiment::Arm& each) {
        return &each.settings == planned.settings;
    });
    const AssignedRun run{static_cast<std::uint64_t>(arm - job.study.arms.begin()), planned.seed};
    messenger_.send(rank, Topic::assignment, run.bytes());
    workers_[static_cast<std::size_t>(rank)].assigned = job.handed_out++;
}

void Coordinator::keep(Job& job, const Message& message) {
    Worker& worker = workers_[static_cast<std::size_t>(message.sender)];
    experiment::RunMessage run = experiment::decode(message.content);
    if (!worker.assigned) throw std::runtime_error("a worker sent a run that it was not given");
    const PlannedRun& planned = job.planned_runs[*std::exchange(worker.assigned, std::nullopt)];
    if (run.settings_hash != planned.settings_hash || run.seed != planned.seed) {
        throw std::runtime_error("a worker executed another run than it was given");
    }
    job.on_finished({&planned, std::move(run.result), run.wall_seconds});
    ++job.state.runs_finished;
    job.state.robot_steps_done += planned.robot_steps();
}

void Coordinator::tell_all(Topic topic) {
    for (int rank = 0; rank < messenger_.size(); ++rank) {
        if (!workers_[static_cast<std::size_t>(rank)].has_ended) messenger_.send(rank, topic);
    }
}

bool Coordinator::all_have_ended() const {
    return std::ranges::all_of(workers_, &Worker::has_ended);
}

bool Coordinator::end_workers(Job* job) {
    if (!std::exchange(told_to_end_, true)) tell_all(Topic::end);
    const auto start = Clock::now();
    while (!all_have_ended()) {
        const auto waited = Clock::now() - start;
        if (waited > patience || (stop_ && waited > patience_when_stopped)) return false;
        const auto message = messenger_.receive();
        if (!message) {
            wait_a_moment();
        } else if (message->topic == Topic::bye) {
            workers_[static_cast<std::size_t>(message->sender)].has_ended = true;
        } else if (message->topic == Topic::result && job != nullptr) {
            keep(*job, *message);
        }
    }
    return true;
}

}  // namespace gene_clocks::app
