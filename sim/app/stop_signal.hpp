#pragma once

#include <atomic>

namespace gene_clocks::app {

/// From now on Ctrl-C (SIGINT) and SIGTERM no longer end the program but set the flag returned.
/// A second one ends it at once.
const std::atomic<bool>& watch_stop_signals();

}  // namespace gene_clocks::app
