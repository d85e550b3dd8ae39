#pragma once

#include <atomic>

#include "sim/app/mpi/messenger.hpp"
#include "sim/experiment/study/study.hpp"

namespace gene_clocks::app {

/// Waits until the coordinator begins a study or ends. True where it begins one. A signal that
/// tells to stop is passed on to the coordinator.
bool wait_for_begin(Messenger& messenger, const std::atomic<bool>& stop);

/// Makes the runs that the coordinator asks for, one at a time, until it ends. What a run throws
/// goes to the coordinator.
void serve(Messenger& messenger, const experiment::Study& study, const std::atomic<bool>& stop);

/// Tells the coordinator that this worker cannot go on, and waits for the end.
void fail(Messenger& messenger, int status, const std::string& message,
          const std::atomic<bool>& stop);

}  // namespace gene_clocks::app
