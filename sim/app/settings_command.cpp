#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "sim/app/commands.hpp"
#include "sim/app/selection_options.hpp"
#include "sim/settings/embedded_files.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/settings_help.hpp"
#include "sim/settings/settings_io.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::app {
namespace {

using experiment::InputError;

struct Options {
    std::vector<std::string> keys;
    SelectionOptions selection;
    std::string format = "text";
    std::string builtin;
};

void print_builtin(const std::string& path) {
    std::vector<std::string> paths;
    for (const auto& file : experiment::embedded_files()) {
        if (file.path == path) {
            fmt::print("{}", file.text);
            return;
        }
        paths.emplace_back(file.path);
    }
    throw InputError(fmt::format("--builtin {}: there is no such file{}; there are {}", path,
                                 experiment::suggestion(path, paths), experiment::list_of(paths)));
}

/// A list of all keys has their defaults, whatever was selected, and a run's settings are all.
void refuse_what_has_no_effect(const Options& options, bool is_list) {
    if (is_list && !options.selection.is_untouched()) {
        throw InputError("--format " + options.format +
                         ": lists all keys with their defaults; a run's settings are shown by "
                         "--format toml or json");
    }
    if (!options.keys.empty() && (!is_list || options.format == "markdown")) {
        throw InputError(options.keys.front() + ": --format " + options.format +
                         " shows all settings; only text can be of some");
    }
}

int run(const Options& options) {
    const bool is_list = options.format == "text" || options.format == "markdown";
    if (options.builtin.empty()) refuse_what_has_no_effect(options, is_list);
    if (!options.builtin.empty()) {
        print_builtin(options.builtin);
    } else if (options.format == "text") {
        fmt::print("{}", experiment::settings_listing(options.keys));
    } else if (options.format == "markdown") {
        fmt::print("{}", experiment::settings_markdown());
    } else {
        if (options.selection.task.empty()) {
            throw InputError("--format " + options.format + ": needs --task");
        }
        const sim::Settings settings = options.selection.settings();
        fmt::print("{}", options.format == "toml" ? experiment::to_toml(settings)
                                                  : experiment::to_json(settings).dump(2) + "\n");
    }
    return success;
}

}  // namespace

void add_settings_command(CLI::App& app, int& status) {
    auto* command =
        app.add_subcommand("settings", "List the settings, or show those that a run would have");
    auto options = std::make_shared<Options>();
    command
        ->add_option("KEY", options->keys,
                     "Only these keys or tables, as in odneat.p_mate or world")
        ->type_name("");
    options->selection.add_to(*command);
    command->get_option("--task")->required(false);
    command
        ->add_option(
            "--format", options->format,
            "text or markdown list all keys; toml or json show a run's settings, and need --task")
        ->capture_default_str()
        ->check(CLI::IsMember({"text", "markdown", "toml", "json"}));
    command
        ->add_option(
            "--builtin", options->builtin,
            "Print a built-in file to start one of your own from, as in studies/gecco15.toml")
        ->type_name("PATH");
    command->footer(
        "Examples:\n"
        "  gene-clocks settings\n"
        "  gene-clocks settings odneat\n"
        "  gene-clocks settings --task navigation --profile gecco15 --format toml > mine.toml\n"
        "  gene-clocks settings --builtin studies/gecco15.toml > my-study.toml\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
