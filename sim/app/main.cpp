#include "sim/app/execute_study.hpp"
#include "sim/app/mpi_launch.hpp"
#include "sim/app/program.hpp"

int main(int argc, char** argv) {
    using namespace gene_clocks::app;
    if (is_study_under_mpirun(argc, argv)) return become_mpi_program(argv);
    return run_program(argc, argv,
                       [](const auto& study, const auto& store, auto threads, const auto& shard) {
                           return execute_study(study, store, threads, shard);
                       });
}
