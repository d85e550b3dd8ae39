#pragma once

namespace gene_clocks::app {

// MPI lives in a program of its own, gene-clocks-mpi, beside gene-clocks: so gene-clocks starts as
// fast as ever, and runs on machines without MPI. It becomes the other one where mpirun starts it
// with a study.

/// Whether OpenMPI's mpirun started this process as one of several, and with the command `study`.
bool is_study_under_mpirun(int argc, char** argv);

/// Goes on as gene-clocks-mpi, with the same arguments. Returns an ExitStatus, and only where there
/// is no such program: the first of the processes then says so.
int become_mpi_program(char** argv);

}  // namespace gene_clocks::app
