#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "sim/app/commands.hpp"
#include "sim/app/study_report.hpp"

namespace gene_clocks::app {
namespace {

struct Options {
    std::string store;
    std::vector<std::string> studies;
    std::string output;
};

int run(const Options& options) {
    report_on(options.store, options.studies, "gene-clocks report " + options.store,
              options.output.empty() ? report_folder(options.store)
                                     : std::filesystem::path(options.output));
    return success;
}

}  // namespace

void add_report_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand(
        "report", "Write a page that shows a store's runs beside the paper's figures");
    auto options = std::make_shared<Options>();
    command->add_option("STORE", options->store, "Store that `gene-clocks study` filled")
        ->required()
        ->type_name("FILE");
    command
        ->add_option("--study", options->studies,
                     "Only this study; may be repeated. Without it all")
        ->allow_extra_args(false)
        ->type_name("NAME");
    command
        ->add_option("--output", options->output,
                     "Folder for index.html, figures/ and report.json; without it the store's "
                     "name, less its ending")
        ->type_name("FOLDER");
    command->footer("Example:\n  gene-clocks report results/gecco15.sqlite\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
