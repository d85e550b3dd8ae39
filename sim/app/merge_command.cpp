#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/app/commands.hpp"
#include "sim/experiment/store/store_merge.hpp"

namespace gene_clocks::app {
namespace {

struct Options {
    std::string out;
    std::vector<std::string> in;
};

int run(const Options& options) {
    const auto result =
        experiment::merge_stores(options.out, {options.in.begin(), options.in.end()});
    fmt::print(stderr, "{}: {} runs were added; it holds {} now\n", options.out, result.runs_added,
               result.runs_in_all);
    if (result.runs_of_other_versions > 0) {
        fmt::print(stderr, "{}: {} runs were executed by another version of gene-clocks\n",
                   options.out, result.runs_of_other_versions);
    }
    return success;
}

}  // namespace

void add_merge_command(CLI::App& app, int& status) {
    auto* command =
        app.add_subcommand("merge", "Put stores together, as those of a study's shards, into one");
    auto options = std::make_shared<Options>();
    command->add_option("OUT", options->out, "Store to merge into; made where it does not exist")
        ->required()
        ->type_name("FILE");
    command->add_option("IN", options->in, "Stores to merge, which are left as they are")
        ->required()
        ->type_name("FILE");
    command->footer(
        "Studies of the same name must be the same, and runs with the same settings and seed must "
        "have "
        "the\n"
        "same trajectory hash; else nothing is changed. A merge that was stopped has changed "
        "nothing, "
        "either.\n\n"
        "Example:\n"
        "  gene-clocks merge results/gecco15.sqlite results/gecco15-shard-*.sqlite\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
