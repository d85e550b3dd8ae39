#pragma once

#include <CLI/App.hpp>
#include <gene_clocks/sim/settings.hpp>
#include <string>
#include <vector>

#include "sim/settings/profile.hpp"

namespace gene_clocks::app {

/// The options that choose settings: --task --source --profile --parameters --settings --set.
struct SelectionOptions {
    std::string task;
    std::string source = "gene-clock";
    std::string profile = "mended";
    std::string parameters;     ///< empty: the task's own set
    std::string settings_file;  ///< empty: none
    std::vector<std::string> assignments;

    /// Adds the options to a command; `this` must live as long as it.
    void add_to(CLI::App& command);

    /// Whether all of them are as they were.
    [[nodiscard]] bool is_untouched() const { return *this == SelectionOptions{}; }
    bool operator==(const SelectionOptions&) const = default;

    /// Throws InputError where one is unknown.
    [[nodiscard]] experiment::Selection selection() const;

    /// Profile, parameter set, file and assignments, each over the ones before.
    /// Throws InputError where one is unfit or two contradict each other.
    [[nodiscard]] sim::Settings settings() const;
};

/// Adds `--set key=value ...` to a command.
void add_assignments(CLI::App& command, std::vector<std::string>& assignments);

}  // namespace gene_clocks::app
