#include "sim/settings/settings_help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "sim/settings/input_error.hpp"
#include "sim/settings/settings_table.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::experiment {
namespace {

std::string default_text(const Setting& setting) {
    return to_text(setting.default_value());
}

/// "[0, 1]", "sum or mean", "true or false" or "text".
std::string values_text(const Setting& setting) {
    if (!setting.choices.empty()) return one_of(setting.choices);
    switch (setting.default_value().index()) {
        case 0:
            return "true or false";
        case 1:
            return "whole, " + setting.range.text();
        case 2:
            return "real, " + setting.range.text();
        default:
            return "text";
    }
}

std::vector<std::string> table_names() {
    std::vector<std::string> names;
    for (const Setting& setting : settings_table()) {
        if (names.empty() || names.back() != setting.table()) names.emplace_back(setting.table());
    }
    return names;
}

/// A text as a cell of a Markdown table.
std::string cell(std::string_view text) {
    std::string escaped;
    for (const char c : text) escaped += c == '|' ? "\\|" : std::string(1, c);
    return escaped;
}

/// What the tables are about, in the table's order.
std::string_view table_title(std::string_view table) {
    if (table.empty()) return "Outside all tables";
    if (table == "odneat") return "The parameters of odNEAT";
    if (table == "world") return "Arena, robots and items";
    if (table == "radio") return "Messages";
    if (table == "energy") return "What a robot's energy depends on";
    if (table == "timestamp") return "Clocks of the source timestamp";
    if (table == "reboot") return "Robots that lose their memory";
    if (table == "join") return "Robots that are switched on late";
    if (table == "run") return "Length and samples of a run";
    if (table == "measures") return "The paper's four measures";
    return "";
}

}  // namespace

std::string settings_listing(const std::vector<std::string>& wanted) {
    for (const std::string& word : wanted) {
        const bool known = std::ranges::any_of(settings_table(), [&](const Setting& setting) {
            return setting.key == word || setting.table() == word;
        });
        if (known) continue;
        std::string near = suggest_setting(word);
        if (near.empty()) near = suggestion(word, table_names());
        throw InputError(word + ": there is no such key or table" + near);
    }
    std::string text;
    for (const Setting& setting : settings_table()) {
        const bool listed = wanted.empty() || std::ranges::count(wanted, setting.key) > 0 ||
                            std::ranges::count(wanted, setting.table()) > 0;
        if (!listed) continue;
        text += fmt::format("{} = {}{}{}\n    {}\n    {}{}\n", setting.key, default_text(setting),
                            setting.unit.empty() ? "" : " ", setting.unit, setting.description,
                            values_text(setting),
                            setting.paper.empty() ? "" : "; paper: " + setting.paper);
    }
    return text;
}

std::string settings_markdown() {
    std::string text =
        "# Settings\n\n"
        "Every key that settings files, studies, profiles and `--set` know. Written by\n"
        "`gene-clocks settings --format markdown`; a test holds it to the program.\n\n"
        "The defaults are those before a profile is applied; `gene-clocks settings --task "
        "navigation\n"
        "--profile gecco15 --format toml` shows what a run would use. Sections, equations and "
        "tables are\n"
        "the paper's; where that column is empty, the paper is silent.\n";
    std::optional<std::string_view> table;
    for (const Setting& setting : settings_table()) {
        if (setting.table() != table) {
            table = setting.table();
            text += fmt::format(
                "\n## {}{}\n\n| key | default | unit | values | meaning | paper |\n"
                "| --- | --- | --- | --- | --- | --- |\n",
                table->empty() ? "" : fmt::format("`[{}]` ", *table), table_title(*table));
        }
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", setting.key,
                            default_text(setting), setting.unit, values_text(setting),
                            cell(setting.description), cell(setting.paper));
    }
    return text;
}

}  // namespace gene_clocks::experiment
