#pragma once

#include "sim/app/commands.hpp"

namespace gene_clocks::app {

/// The whole program: takes the command line apart, does what the command says, and reports what
/// went wrong. Returns an ExitStatus. `executor` executes the runs of `gene-clocks study`.
int run_program(int argc, char** argv, const StudyExecutor& executor);

}  // namespace gene_clocks::app
