#pragma once

#include <gene_clocks/sim/settings.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/settings/document.hpp"

namespace gene_clocks::experiment {

/// A starting point for settings: profile, task, source and parameter set.
struct Selection {
    sim::Task task = sim::Task::navigation;
    sim::Source source = sim::Source::gene_clock;
    std::string profile = "mended";  ///< a built-in profile, or a file ending in ".toml"
    /// A set of parameters.toml; where there is none, the profile's.
    std::optional<std::string> parameters = {};
};

/// The names of the parameter sets: "A", "B", "C".
std::vector<std::string> parameter_set_names();

/// The parameter set that `select` uses for that selection.
std::string parameter_set_of(const Selection& selection);

/// Settings in this order, each over the one before: defaults, the profile's settings for all
/// tasks, its settings for the task, the parameter set. Throws InputError where one is unknown or
/// unfit.
sim::Settings select(const Selection& selection);

}  // namespace gene_clocks::experiment
