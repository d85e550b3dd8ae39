#include "sim/app/trace_file.hpp"

#include "sim/settings/input_error.hpp"

namespace gene_clocks::app {
namespace {

using experiment::InputError;

const std::string& checked(const std::string& name, const sim::Settings& settings) {
    if (settings.source != sim::Source::gene_clock) {
        throw InputError(
            "--trace: only robots with gene clocks leave a trace; use --source gene-clock");
    }
    if (name == "-") {
        throw InputError("--trace: needs a file, for standard output is where the result goes");
    }
    return name;
}

}  // namespace

TraceFile::TraceFile(const std::string& name, const sim::Settings& settings)
    : file_(checked(name, settings)), recorder_(file_.stream(), sim::genesis_count(settings)) {}

experiment::RunFunction TraceFile::recording() {
    return [this](const sim::Settings& settings, const sim::Arena& arena, std::uint64_t seed,
                  sim::RunControl* control) {
        return sim::simulate_observed(settings, arena, seed, recorder_, control);
    };
}

void TraceFile::finish() {
    recorder_.finish();
    file_.finish();
}

}  // namespace gene_clocks::app
