#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gene_clocks::app {

/// The processes that mpirun started are numbered from 0; number 0 coordinates.
inline constexpr int coordinator_rank = 0;

/// What a message between the coordinator and a worker means.
enum class Topic : int {
    // From the coordinator.
    begin,       ///< read the study, and say `ready`; empty
    assignment,  ///< execute this run: an AssignedRun
    end,         ///< give up what is under way, and say `bye`; empty

    // From a worker.
    ready,    ///< the fingerprint of the worker's study, which must be the coordinator's
    result,   ///< of the assigned run: encode(RunMessage)
    gave_up,  ///< the worker was told by a signal to stop, and so must all; empty
    failed,   ///< something threw: an ExitStatus in one byte, then the message
    bye,      ///< the worker's last message; empty
};

/// A message that came in.
struct Message {
    Topic topic{};
    int sender{};
    std::vector<std::uint8_t> content;
};

/// MPI, from its start to its end in this process. Used by one thread only.
class Messenger {
public:
    Messenger(int& argc, char**& argv);
    ~Messenger();  ///< ends MPI, once all processes come here
    Messenger(const Messenger&) = delete;
    Messenger& operator=(const Messenger&) = delete;

    [[nodiscard]] int rank() const { return rank_; }
    [[nodiscard]] int size() const { return size_; }

    void send(int receiver, Topic topic, std::span<const std::uint8_t> content = {});
    void send(int receiver, Topic topic, const std::string& content);

    /// A message that is there, if there is one. Does not wait: MPI itself would keep a processor
    /// busy with waiting.
    std::optional<Message> receive();

    /// Ends all processes at once, also where some of them no longer answer.
    [[noreturn]] void abort(int status);

private:
    int rank_ = 0;
    int size_ = 1;
};

/// Waits for a moment, for something to come in.
void wait_a_moment();

}  // namespace gene_clocks::app
