#pragma once

#include <string>

#include "sim/app/output_file.hpp"
#include "sim/app/trace_recorder.hpp"
#include "sim/experiment/study/runner.hpp"

namespace gene_clocks::app {

/// The trace of one run, in a file that is whole or not there.
class TraceFile {
public:
    /// Throws InputError where the run's robots have no gene clocks, or nothing can be written.
    TraceFile(const std::string& name, const sim::Settings& settings);

    /// Makes the run and records it; for one run only. Must not outlive this.
    experiment::RunFunction recording();

    /// Throws std::runtime_error where the trace could not be written as a whole.
    void finish();

private:
    OutputFile file_;
    trace::TraceRecorder recorder_;
};

}  // namespace gene_clocks::app
