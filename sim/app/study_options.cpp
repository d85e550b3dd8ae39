#include "sim/app/study_options.hpp"

#include <fmt/format.h>

#include "sim/app/selection_options.hpp"

namespace gene_clocks::app {

void StudyCommandOptions::add_to(CLI::App& command) {
    command.add_flag("--quick", quick,
                     "Few seeds and short runs: shows that all works, too little to conclude from");
    command.add_option("--seeds", seeds, "Number of seeds, instead of the study's")
        ->type_name("N")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000}));
    add_assignments(command, assignments);
    command
        .add_option("--threads", threads,
                    "Runs executed at a time; without it one for each processor")
        ->type_name("N")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1024}));
}

experiment::StudyOptions StudyCommandOptions::study_options() const {
    experiment::StudyOptions options;
    options.quick = quick;
    if (seeds > 0) options.seeds = seeds;
    options.assignments = assignments;
    return options;
}

std::filesystem::path store_file(const std::string& named, const experiment::Study& study,
                                 const experiment::Shard& shard) {
    if (!named.empty()) return named;
    const std::string part =
        shard.is_all() ? "" : fmt::format("-shard-{}-of-{}", shard.index, shard.count);
    return std::filesystem::path(results_folder) / (study.name + part + ".sqlite");
}

}  // namespace gene_clocks::app
