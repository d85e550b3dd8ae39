#include "sim/app/selection_options.hpp"

#include <fmt/format.h>

#include "sim/settings/choice_names.hpp"
#include "sim/settings/document.hpp"
#include "sim/settings/settings_io.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::app {
namespace {

using experiment::Builtin;
using experiment::InputError;

template <typename Choice>
std::vector<std::string> names() {
    const auto& all = experiment::choice_names<Choice>;
    return {all.begin(), all.end()};
}

template <typename Choice>
Choice choose(const std::string& option, const std::string& text) {
    if (const auto choice = experiment::choice_of<Choice>(text)) return *choice;
    throw InputError(fmt::format("{}: \"{}\" is not {}{}", option, text,
                                 experiment::one_of(names<Choice>()),
                                 experiment::suggestion(text, names<Choice>())));
}

}  // namespace

void SelectionOptions::add_to(CLI::App& command) {
    command.add_option("--task", task, experiment::one_of(names<sim::Task>()))
        ->required()
        ->type_name("NAME");
    command
        .add_option("--source", source,
                    "What marks new genes: " + experiment::one_of(names<sim::Source>()))
        ->capture_default_str()
        ->type_name("NAME");
    command
        .add_option("--profile", profile,
                    fmt::format("Where the settings start: {}, or a file ending in .toml",
                                experiment::one_of(experiment::builtin_names(Builtin::profile))))
        ->capture_default_str()
        ->type_name("NAME");
    command
        .add_option("--parameters", parameters,
                    fmt::format("Set of odNEAT's parameters: {}; without it the task's own, as the "
                                "published runs had it",
                                experiment::one_of(experiment::parameter_set_names())))
        ->type_name("NAME");
    command
        .add_option("--settings", settings_file,
                    "TOML file of settings, over profile and parameters")
        ->type_name("FILE");
    add_assignments(command, assignments);
}

experiment::Selection SelectionOptions::selection() const {
    experiment::Selection selection;
    selection.task = choose<sim::Task>("--task", task);
    selection.source = choose<sim::Source>("--source", source);
    selection.profile = profile;
    if (!parameters.empty()) selection.parameters = parameters;
    return selection;
}

sim::Settings SelectionOptions::settings() const {
    sim::Settings settings = experiment::select(selection());
    if (!settings_file.empty()) {
        const auto document = experiment::load_document(settings_file);
        experiment::read_settings(document, document.table, settings);
    }
    for (const std::string& assignment : assignments) experiment::assign(settings, assignment);
    experiment::check_together(settings, {});
    return settings;
}

void add_assignments(CLI::App& command, std::vector<std::string>& assignments) {
    command
        .add_option("--set", assignments,
                    "Changes one setting; may be repeated. `gene-clocks settings` lists "
                    "the keys")
        ->type_name("KEY=VALUE");
}

}  // namespace gene_clocks::app
