#include "trace_file.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "input_error.hpp"

namespace gene_clocks::app {

TraceFile::TraceFile(const std::string& name, const sim::Settings& settings)
    : name_(name), recorder_(out_, sim::genesis_count(settings)) {
    if (settings.source != sim::Source::gene_clock) {
        throw experiment::InputError("--trace: only robots with gene clocks leave a trace");
    }
    unfinished_ = name + ".part";
    out_.open(unfinished_, std::ios::binary | std::ios::trunc);
    if (!out_) {
        unfinished_.clear();
        throw experiment::InputError(name + ": cannot be written there");
    }
}

TraceFile::~TraceFile() {
    if (unfinished_.empty()) return;
    std::error_code ignored;
    std::filesystem::remove(unfinished_, ignored);
}

experiment::RunFunction TraceFile::recording() {
    return [this](const sim::Settings& settings, const sim::Arena& arena, std::uint64_t seed,
                  sim::RunControl* control) {
        return sim::simulate_observed(settings, arena, seed, recorder_, control);
    };
}

void TraceFile::finish() {
    recorder_.finish();
    out_.close();
    if (!out_) throw std::runtime_error(fmt::format("{}: writing failed", name_.string()));
    std::filesystem::rename(unfinished_, name_);
    unfinished_.clear();
}

}  // namespace gene_clocks::app
