#pragma once

#include <gene_clocks/sim/arena.hpp>
#include <gene_clocks/sim/settings.hpp>
#include <gene_clocks/sim/simulation.hpp>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "sim/replay/replay_recorder.hpp"

namespace gene_clocks::replay {

/// What the page says about the run in words: names and values, in that order. Any text is fit.
using Facts = std::vector<std::pair<std::string, std::string>>;

/// A run that was recorded. All references must outlive it.
struct RecordedRun {
    const sim::Settings& settings;
    const sim::Arena& arena;
    const sim::RunResult& result;
    const ReplayRecorder& recorder;
    Facts facts;
};

/// Writes the run as one HTML page that needs nothing but a browser: no network, no other file.
void write_replay_page(const RecordedRun& run, std::ostream& out);

}  // namespace gene_clocks::replay
