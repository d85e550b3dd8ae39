// gene-clocks under mpirun: the first process is the program, the others execute the runs of its
// study.
#include <fmt/format.h>

#include <utility>

#include "sim/app/execute_study.hpp"
#include "sim/app/mpi/coordinator.hpp"
#include "sim/app/mpi/messenger.hpp"
#include "sim/app/mpi/worker.hpp"
#include "sim/app/program.hpp"
#include "sim/app/stop_signal.hpp"
#include "sim/settings/input_error.hpp"

namespace {

using namespace gene_clocks::app;
using gene_clocks::experiment::InputError;
using gene_clocks::experiment::Study;

int coordinate(Messenger& messenger, int argc, char** argv) {
    Coordinator coordinator(messenger, watch_stop_signals());
    const int status = run_program(
        argc, argv, [&](const Study& study, const auto& store, auto threads, const auto& shard) {
            if (threads != 0) {
                throw InputError(
                    "--threads: under mpirun each process executes one run at a time; leave the "
                    "option out");
            }
            return execute_study(
                study, store, shard,
                [&](auto planned_runs, const auto&, auto& progress, const auto& keep) {
                    return coordinator.execute_runs(study, std::move(planned_runs), progress, keep);
                });
        });
    // The store is closed. If a worker is gone, MPI itself would wait for it without end.
    if (!coordinator.end()) messenger.abort(status == success ? failure : status);
    return status;
}

int work(Messenger& messenger, int argc, char** argv) {
    const auto& stop = watch_stop_signals();
    if (!wait_for_begin(messenger, stop)) return success;
    bool has_served = false;
    const int status =
        run_program(argc, argv, [&](const Study& study, const auto&, auto, const auto&) {
            has_served = true;
            serve(messenger, study, stop);
            return success;
        });
    if (!has_served || status != success) {
        fail(messenger, status,
             fmt::format("process {} of {} cannot execute the runs of the study", messenger.rank(),
                         messenger.size()),
             stop);
    }
    return success;
}

}  // namespace

int main(int argc, char** argv) {
    Messenger messenger(argc, argv);
    return messenger.rank() == coordinator_rank ? coordinate(messenger, argc, argv)
                                                : work(messenger, argc, argv);
}
