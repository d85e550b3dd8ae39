#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "sim/app/commands.hpp"
#include "sim/app/execute_study.hpp"
#include "sim/app/study_options.hpp"
#include "sim/app/study_report.hpp"
#include "sim/report/page_program.hpp"
#include "sim/settings/document.hpp"

namespace gene_clocks::app {
namespace {

using experiment::Study;

struct Options {
    StudyCommandOptions common;
    bool as_printed = false;
    std::string output = results_folder;
};

std::vector<Study> read_studies(const Options& options) {
    std::vector<std::string> names{"gecco15"};
    if (options.as_printed) names.emplace_back("gecco15-as-printed");
    std::vector<Study> studies;
    for (const std::string& name : names) {
        studies.push_back(
            experiment::read_study(experiment::find_document(experiment::Builtin::study, name),
                                   options.common.study_options()));
        experiment::rehearse(studies.back());
    }
    return studies;
}

int run(const Options& options) {
    const std::vector<Study> studies = read_studies(options);
    report::find_python();  // or nothing could be shown at the end
    const auto store = std::filesystem::path(options.output) / (studies.front().name + ".sqlite");
    std::vector<std::string> names;
    for (const Study& study : studies) {
        if (const int status = execute_study(study, store, options.common.threads);
            status != success)
            return status;
        names.push_back(study.name);
    }
    report_on(store, names,
              fmt::format("gene-clocks reproduce{}{}", options.common.quick ? " --quick" : "",
                          options.as_printed ? " --as-printed" : ""),
              report_folder(store));
    return success;
}

}  // namespace

void add_reproduce_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand(
        "reproduce",
        "Re-run the paper's experiments at full scale and show them beside the paper's");
    auto options = std::make_shared<Options>();
    options->common.add_to(*command);
    command->add_flag("--as-printed", options->as_printed,
                      "Also with the parameters of Table 1 under the labels printed there");
    command->add_option("--output", options->output, "Folder for the store and the report")
        ->capture_default_str()
        ->type_name("FOLDER");
    command->footer(
        "Two tasks, each with gene clocks and with timestamps, 64 runs of 100 robots each: the "
        "studies\n"
        "gecco15 and, if asked for, gecco15-as-printed. Runs that are finished are not executed "
        "again.\n\n"
        "Examples:\n"
        "  gene-clocks reproduce --quick\n"
        "  gene-clocks reproduce --as-printed --output results\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
