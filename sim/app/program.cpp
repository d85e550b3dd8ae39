#include "sim/app/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/experiment/store/store.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/program_version.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::app {
namespace {

/// What CLI11 found wrong, with a suggestion for a word that it does not know.
std::string explain(const CLI::App& application, const CLI::ParseError& error) {
    const CLI::App* command = &application;
    std::vector<std::string> known;
    for (const CLI::App* subcommand : application.get_subcommands({})) {
        known.push_back(subcommand->get_name());
        if (subcommand->parsed()) command = subcommand;
    }
    if (command != &application) known.clear();
    for (const CLI::Option* option : command->get_options()) known.push_back(option->get_name());
    for (const std::string& word : application.remaining(true)) {
        if (word == "--") continue;
        if (command != &application && !word.starts_with('-')) {
            return fmt::format("{}: one argument too many", word);
        }
        return fmt::format("{}: there is no such {}{}", word,
                           word.starts_with('-') ? "option" : "command",
                           experiment::suggestion(word, known));
    }
    return error.what();
}

}  // namespace

int run_program(int argc, char** argv, const StudyExecutor& executor) {
    int status = success;
    CLI::App application(
        "Gene Clocks: robot swarms that evolve neural networks with odNEAT, and the clocks that "
        "mark "
        "their genes. Makes single runs and whole studies, and shows them beside the paper's.");
    application.name("gene-clocks");
    application.set_version_flag("--version", experiment::program_version());
    application.require_subcommand(1);
    application.footer(
        "Start with:\n"
        "  gene-clocks run --task navigation --seed 1    one run of the paper's first task\n"
        "  gene-clocks reproduce --quick                 the paper's experiments, in small\n"
        "  gene-clocks COMMAND --help                    what a command can do\n");
    add_run_command(application, status);
    add_replay_command(application, status);
    add_study_command(application, status, executor);
    add_report_command(application, status);
    add_reproduce_command(application, status);
    add_settings_command(application, status);
    add_contrast_command(application, status);
    add_export_command(application, status);
    add_merge_command(application, status);
    add_check_trace_command(application, status);
    add_schema_command(application, status);
    add_completion_command(application, status);
    add_manual_command(application, status);

    try {
        application.parse(argc, argv);
        if (std::fflush(stdout) != 0) throw std::runtime_error("standard output cannot be written");
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return application.exit(error);  // --help and --version
        fmt::print(stderr, "gene-clocks: {}\n", explain(application, error));
        return bad_input;
    } catch (const experiment::InputError& error) {
        fmt::print(stderr, "gene-clocks: {}\n", error.what());
        return bad_input;
    } catch (const std::exception& error) {
        fmt::print(stderr, "gene-clocks: {}\n", error.what());
        return failure;
    }
    return status;
}

}  // namespace gene_clocks::app
