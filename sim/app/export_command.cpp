#include <fmt/format.h>

#include <memory>
#include <optional>

#include "sim/app/commands.hpp"
#include "sim/app/output_file.hpp"
#include "sim/experiment/store/csv_export.hpp"
#include "sim/experiment/store/store.hpp"
#include "sim/settings/input_error.hpp"

namespace gene_clocks::app {
namespace {

using experiment::InputError;
using experiment::Store;
using experiment::StoredStudy;

struct Options {
    std::string store;
    std::string study;
    std::string runs;
    std::string samples;
};

int run(const Options& options) {
    if (options.runs.empty() && options.samples.empty()) {
        throw InputError("nothing to export: give --runs FILE, --samples FILE, or both");
    }
    require_different({{"--runs", options.runs}, {"--samples", options.samples}});
    const Store store = Store::open_for_reading(options.store);
    std::vector<StoredStudy> studies;
    if (options.study.empty()) {
        studies = store.studies();
    } else {
        studies.push_back(store.study(options.study));
    }
    std::optional<Output> runs;
    std::optional<Output> samples;
    if (!options.runs.empty()) runs.emplace(options.runs);
    if (!options.samples.empty()) samples.emplace(options.samples);
    if (runs) write_runs_csv(store, studies, runs->stream());
    if (samples) write_samples_csv(store, studies, samples->stream());
    if (runs) runs->finish();
    if (samples) samples->finish();
    return success;
}

}  // namespace

void add_export_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand("export", "Write a store's runs as CSV");
    auto options = std::make_shared<Options>();
    command->add_option("STORE", options->store, "Store that `gene-clocks study` filled")
        ->required()
        ->type_name("FILE");
    command->add_option("--study", options->study, "Only this study's runs")->type_name("NAME");
    command
        ->add_option("--runs", options->runs,
                     "CSV file, a line for each run; - for standard output")
        ->type_name("FILE");
    command
        ->add_option("--samples", options->samples,
                     "CSV file, a line for each sample of each run; - likewise")
        ->type_name("FILE");
    command->footer(
        "Example:\n  gene-clocks export results/gecco15.sqlite --runs runs.csv --samples "
        "samples.csv\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
