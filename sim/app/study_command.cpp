#include <fmt/format.h>

#include <memory>
#include <utility>

#include "sim/app/commands.hpp"
#include "sim/app/dry_run.hpp"
#include "sim/app/study_options.hpp"
#include "sim/experiment/study/run_plan.hpp"
#include "sim/experiment/study/study.hpp"
#include "sim/settings/document.hpp"

namespace gene_clocks::app {
namespace {

using experiment::Study;

struct Options {
    std::string study;
    std::string store;
    StudyCommandOptions common;
    std::string shard = "1/1";
    bool dry_run = false;
};

/// The built-in studies with their titles, for the help.
std::string builtin_studies() {
    std::string text = "Built-in studies:\n";
    for (const std::string& name : experiment::builtin_names(experiment::Builtin::study)) {
        const auto document = experiment::find_document(experiment::Builtin::study, name);
        text += fmt::format("  {:<24} {}\n", name, document.table["title"].value_or(""));
    }
    return text;
}

int run(const Options& options, const StudyExecutor& executor) {
    const auto document = experiment::find_document(experiment::Builtin::study, options.study);
    const Study study = experiment::read_study(document, options.common.study_options());
    const experiment::Shard shard = experiment::parse_shard(options.shard);
    const auto store = store_file(options.store, study, shard);
    if (options.dry_run) return dry_run(study, store, options.common.threads, shard);
    return executor(study, store, options.common.threads, shard);
}

}  // namespace

void add_study_command(CLI::App& app, int& status, StudyExecutor executor) {
    auto* command =
        app.add_subcommand("study", "Execute the runs of a study that its store does not hold yet");
    auto options = std::make_shared<Options>();
    command
        ->add_option("STUDY", options->study,
                     "A built-in study, see below, or a file ending in .toml")
        ->required()
        ->type_name("NAME");
    command
        ->add_option("--store", options->store,
                     "SQLite file for the results; without it results/STUDY.sqlite, or "
                     "results/STUDY-shard-I-of-N.sqlite")
        ->type_name("FILE");
    options->common.add_to(*command);
    command
        ->add_option(
            "--shard", options->shard,
            "Only the I-th of N equal parts of the runs, as in 2/4; `gene-clocks merge` puts "
            "their stores together")
        ->type_name("I/N");
    command->add_flag("--dry-run", options->dry_run,
                      "Only check the study and show its arms and runs, how many of them are still "
                      "missing, and how long they may take on this machine");
    command->footer(
        builtin_studies() +
        "\nA study that was stopped, by Ctrl-C or a power cut, goes on where it was when the same "
        "command\n"
        "is given again; finished runs are never executed twice.\n\n"
        "Examples:\n"
        "  gene-clocks study gecco15 --quick\n"
        "  gene-clocks study gecco15 --dry-run\n"
        "  gene-clocks study my-study.toml --store my-results.sqlite --threads 4\n"
        "  gene-clocks study my-study.toml --shard 2/4\n"
        "  mpirun -n 17 gene-clocks study my-study.toml    (16 runs at a time: where it was built "
        "with MPI)\n");
    command->callback(
        [options, &status, executor = std::move(executor)] { status = run(*options, executor); });
}

}  // namespace gene_clocks::app
