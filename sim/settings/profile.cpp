#include "sim/settings/profile.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/settings/choice_names.hpp"
#include "sim/settings/embedded_files.hpp"
#include "sim/settings/settings_io.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::experiment {
namespace {

const Document& parameter_sets() {
    static const Document document = parse_document(
        std::string(embedded_text("profiles/parameters.toml")), "built-in parameter sets");
    return document;
}

void apply_parameter_set(const std::string& name, sim::Settings& settings) {
    const Document& document = parameter_sets();
    const toml::table* set = document.table.get_as<toml::table>(name);
    if (set == nullptr) {
        throw InputError(
            fmt::format("parameter set \"{}\": there is none of that name; there are {}", name,
                        one_of(parameter_set_names())));
    }
    toml::table odneat = *set;
    odneat.erase("description");
    toml::table wrapped;
    wrapped.insert("odneat", std::move(odneat));
    read_settings(document, wrapped, settings);
}

/// The sections of a profile's file that concern one task.
struct Sections {
    std::optional<std::string> parameters;
    const toml::table* all_tasks = nullptr;
    const toml::table* task = nullptr;
};

Sections read_sections(const Document& document, sim::Task task) {
    TableReader reader(document, document.table);
    reader.text("description");
    Sections sections;
    sections.all_tasks = reader.table("settings");
    for (const std::string_view name : choice_names<sim::Task>) {
        const toml::table* section = reader.table(std::string(name));
        if (name == name_of(task)) sections.task = section;
    }
    if (const toml::table* table = reader.table("parameters")) {
        TableReader parameters(document, *table, "parameters");
        for (const std::string_view name : choice_names<sim::Task>) {
            const auto set = parameters.text(std::string(name));
            if (name == name_of(task)) sections.parameters = set;
        }
        parameters.refuse_other_keys();
    }
    reader.refuse_other_keys();
    return sections;
}

}  // namespace

std::vector<std::string> parameter_set_names() {
    std::vector<std::string> names;
    for (const auto& [key, node] : parameter_sets().table) names.emplace_back(key.str());
    return names;
}

std::string parameter_set_of(const Selection& selection) {
    if (selection.parameters) return *selection.parameters;
    const Document document = find_document(Builtin::profile, selection.profile);
    return read_sections(document, selection.task).parameters.value_or("");
}

sim::Settings select(const Selection& selection) {
    const Document document = find_document(Builtin::profile, selection.profile);
    const Sections sections = read_sections(document, selection.task);
    sim::Settings settings;
    if (sections.all_tasks != nullptr) read_settings(document, *sections.all_tasks, settings);
    if (sections.task != nullptr) read_settings(document, *sections.task, settings);
    settings.task = selection.task;
    settings.source = selection.source;
    const auto parameters = selection.parameters ? selection.parameters : sections.parameters;
    if (parameters) apply_parameter_set(*parameters, settings);
    return settings;
}

}  // namespace gene_clocks::experiment
