#include "sim/app/mpi/worker.hpp"

#include <chrono>
#include <exception>
#include <future>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/app/commands.hpp"
#include "sim/app/mpi/assigned_run.hpp"
#include "sim/experiment/store/run_message.hpp"
#include "sim/experiment/study/run_plan.hpp"
#include "sim/experiment/study/runner.hpp"
#include "sim/settings/input_error.hpp"

namespace gene_clocks::app {
namespace {

using experiment::RunMessage;
using experiment::Study;

/// The worker's side of the conversation.
class Worker {
public:
    Worker(Messenger& messenger, const std::atomic<bool>& stop)
        : messenger_(messenger), stop_(stop) {}

    /// What the coordinator says next.
    Message wait() {
        for (;;) {
            if (auto message = look()) return *std::move(message);
            wait_a_moment();
        }
    }

    /// The same, if it has said something. Passes on that a signal told to stop.
    std::optional<Message> look() {
        if (stop_ && !std::exchange(has_given_up_, true)) {
            messenger_.send(coordinator_rank, Topic::gave_up);
        }
        return messenger_.receive();
    }

    void say(Topic topic) { messenger_.send(coordinator_rank, topic); }
    template <typename Content>
    void say(Topic topic, const Content& content) {
        messenger_.send(coordinator_rank, topic, content);
    }

    void say_failure(int status, const std::string& message) {
        say(Topic::failed, static_cast<char>(status) + message);
    }

    void wait_for_end() {
        while (wait().topic != Topic::end) {
        }
        say(Topic::bye);
    }

private:
    Messenger& messenger_;
    const std::atomic<bool>& stop_;
    bool has_given_up_ = false;
};

/// Makes one run. None where `stop` was set before its end.
std::optional<RunMessage> execute(const Study& study, const AssignedRun& assigned,
                                  const std::atomic<bool>& stop) {
    if (assigned.arm >= study.arms.size())
        throw std::runtime_error("a message that assigns no run");
    const experiment::Arm& arm = study.arms[assigned.arm];
    experiment::RunnerOptions options;
    options.threads = 1;
    options.stop = &stop;
    experiment::Progress silent(nullptr);
    std::optional<RunMessage> made;
    execute_runs(
        {experiment::planned_run(arm, assigned.seed)}, options, silent,
        [&](const experiment::FinishedRun& run) {
            made = {run.planned->settings_hash, run.planned->seed, run.result, run.wall_seconds};
        });
    return made;
}

/// Executes an assigned run, meanwhile listening to the coordinator. False where that says to end.
bool make_and_send(Worker& worker, const Study& study, const AssignedRun& assigned) {
    std::atomic<bool> stop{false};
    auto made = std::async(std::launch::async, [&] { return execute(study, assigned, stop); });
    while (made.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
        const auto message = worker.look();
        if (message && message->topic == Topic::end) {
            stop = true;
            made.wait();
            return false;
        }
    }
    try {
        if (const auto run = made.get()) worker.say(Topic::result, encode(*run));
    } catch (const experiment::InputError& error) {
        worker.say_failure(bad_input, error.what());
    } catch (const std::exception& error) {
        worker.say_failure(failure, error.what());
    }
    return true;
}

}  // namespace

bool wait_for_begin(Messenger& messenger, const std::atomic<bool>& stop) {
    Worker worker(messenger, stop);
    if (worker.wait().topic == Topic::begin) return true;
    worker.say(Topic::bye);
    return false;
}

void serve(Messenger& messenger, const Study& study, const std::atomic<bool>& stop) {
    Worker worker(messenger, stop);
    worker.say(Topic::ready, fingerprint(study));
    for (;;) {
        const Message message = worker.wait();
        if (message.topic == Topic::end) break;
        if (message.topic != Topic::assignment) continue;
        if (!make_and_send(worker, study, AssignedRun::of(message.content))) break;
    }
    worker.say(Topic::bye);
}

void fail(Messenger& messenger, int status, const std::string& message,
          const std::atomic<bool>& stop) {
    Worker worker(messenger, stop);
    worker.say_failure(status, message);
    worker.wait_for_end();
}

}  // namespace gene_clocks::app
