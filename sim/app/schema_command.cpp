#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "sim/app/commands.hpp"
#include "sim/experiment/study/study_schema.hpp"
#include "sim/settings/schema.hpp"

namespace gene_clocks::app {

void add_schema_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand(
        "schema", "Print the JSON schema of a file that you write, for an editor that reads it");
    auto kind = std::make_shared<std::string>();
    command->add_option("KIND", *kind, "study, arena or settings")
        ->required()
        ->check(CLI::IsMember({"study", "arena", "settings"}));
    command->footer(
        "Example: gene-clocks schema study > study.schema.json, and as the first line of a study:\n"
        "  #:schema ./study.schema.json\n");
    command->callback([kind, &status] {
        const nlohmann::ordered_json schema = *kind == "study"   ? experiment::study_schema()
                                              : *kind == "arena" ? experiment::arena_schema()
                                                                 : experiment::settings_schema();
        fmt::print("{}\n", schema.dump(2));
        status = success;
    });
}

}  // namespace gene_clocks::app
