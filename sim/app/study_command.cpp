#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "choice_names.hpp"
#include "commands.hpp"
#include "conduct.hpp"
#include "document.hpp"
#include "selection_options.hpp"
#include "study.hpp"
#include "study_options.hpp"
#include "suggestion.hpp"

namespace gene_clocks::app {
namespace {

using experiment::Study;

struct Options {
    std::string study;
    std::string store;
    StudyCommandOptions common;
    bool dry_run = false;
};

void print_plan(const Study& study) {
    double steps = 0.0;
    fmt::print("{}: {}\n{}\n", study.name, study.title, study.description);
    for (const experiment::Arm& arm : study.arms) {
        const sim::Settings& settings = arm.settings;
        fmt::print(
            "  {:<28} {}, {}, profile {}, parameters {}: {} robots, {} cycles; settings {}\n",
            arm.name, experiment::name_of(settings.task), experiment::name_of(settings.source),
            arm.profile, arm.parameters.empty() ? "none" : arm.parameters, settings.world.robots,
            settings.run.cycles, arm.settings_hash);
        steps += static_cast<double>(settings.world.robots) *
                 static_cast<double>(settings.run.cycles) * static_cast<double>(study.seeds);
    }
    fmt::print("{} arms x {} seeds = {} runs, {:.1f} M robot-steps\n", study.arms.size(),
               study.seeds, study.arms.size() * static_cast<std::size_t>(study.seeds), steps / 1e6);
}

/// The built-in studies with their titles, for the help.
std::string builtin_studies() {
    std::string text = "Built-in studies:\n";
    for (const std::string& name : experiment::builtin_names(experiment::Builtin::study)) {
        const auto document = experiment::find_document(experiment::Builtin::study, name);
        text += fmt::format("  {:<24} {}\n", name, document.table["title"].value_or(""));
    }
    return text;
}

int run(const Options& options) {
    const auto document = experiment::find_document(experiment::Builtin::study, options.study);
    const Study study = experiment::read_study(document, options.common.study_options());
    if (options.dry_run) {
        experiment::rehearse(study);
        print_plan(study);
        return success;
    }
    return conduct(study, store_file(options.store, study), options.common.threads);
}

}  // namespace

void add_study_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand(
        "study",
        "Make all runs of a study, or those that are still missing, and keep them in a store");
    auto options = std::make_shared<Options>();
    command
        ->add_option("STUDY", options->study,
                     "A built-in study, see below, or a file ending in .toml")
        ->required()
        ->type_name("NAME");
    command
        ->add_option("--store", options->store,
                     "SQLite file for the results; without it results/STUDY.sqlite")
        ->type_name("FILE");
    options->common.add_to(*command);
    command->add_flag("--dry-run", options->dry_run,
                      "Only check the study and show its arms and runs");
    command->footer(
        builtin_studies() +
        "\nA study that was stopped, by Ctrl-C or a power cut, goes on where it was when the same "
        "command\n"
        "is given again; finished runs are never made twice.\n\n"
        "Examples:\n"
        "  gene-clocks study gecco15 --quick\n"
        "  gene-clocks study gecco15 --dry-run\n"
        "  gene-clocks study my-study.toml --store my-results.sqlite --threads 4\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
