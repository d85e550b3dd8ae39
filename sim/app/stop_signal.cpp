#include "sim/app/stop_signal.hpp"

#include <csignal>

namespace gene_clocks::app {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may take no lock");

}  // namespace

const std::atomic<bool>& watch_stop_signals() {
    struct sigaction action {};
    action.sa_handler = [](int) { stop_requested = true; };
    action.sa_flags =
        static_cast<int>(SA_RESETHAND) | SA_RESTART;  // the second one has its usual effect
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    return stop_requested;
}

}  // namespace gene_clocks::app
