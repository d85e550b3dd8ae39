#include "sim/app/command_tree.hpp"

#include <algorithm>
#include <string_view>

#include "sim/settings/document.hpp"
#include "sim/settings/profile.hpp"
#include "sim/settings/settings_table.hpp"

namespace gene_clocks::app {
namespace {

using experiment::Builtin;

/// The names in "TEXT:{a,b}", as CLI11 writes a choice; empty where there are none.
std::vector<std::string> listed_choices(const std::string& type) {
    const auto open = type.find('{');
    const auto close = type.find('}', open);
    std::vector<std::string> words;
    if (open == std::string::npos || close == std::string::npos) return words;
    std::size_t begin = open + 1;
    for (std::size_t i = begin; i <= close; ++i) {
        if (type[i] != ',' && i != close) continue;
        words.push_back(type.substr(begin, i - begin));
        begin = i + 1;
    }
    return words;
}

std::vector<std::string> setting_keys(std::string_view end) {
    std::vector<std::string> keys;
    for (const experiment::Setting& setting : experiment::settings_table()) {
        keys.push_back(setting.key + std::string(end));
    }
    return keys;
}

/// What may follow, by the option's name where a table of the program's holds the words.
void complete(OptionNode& option) {
    const std::string& name = option.names.back();
    const auto words = [&](Completion completion, std::vector<std::string> list) {
        option.completion = completion;
        option.words = std::move(list);
    };
    if (name == "--task" || name == "--source") {
        words(Completion::words, experiment::find_setting(name.substr(2))->choices);
    } else if (name == "--profile") {
        words(Completion::words_or_file, experiment::builtin_names(Builtin::profile));
    } else if (name == "--parameters") {
        words(Completion::words, experiment::parameter_set_names());
    } else if (name == "STUDY") {
        words(Completion::words_or_file, experiment::builtin_names(Builtin::study));
    } else if (name == "KEY") {
        words(Completion::words, setting_keys(""));
    } else if (option.value == "KEY=VALUE") {
        words(Completion::assignment, setting_keys("="));
    } else if (option.value == "FILE") {
        option.completion = Completion::file;
    } else if (option.value == "FOLDER") {
        option.completion = Completion::folder;
    }
}

OptionNode option_node(const CLI::Option& option) {
    OptionNode node;
    node.is_positional = option.get_positional();
    if (node.is_positional) {
        node.names = {option.get_name(true, false)};
    } else {
        for (const std::string& name : option.get_snames()) node.names.push_back("-" + name);
        for (const std::string& name : option.get_lnames()) node.names.push_back("--" + name);
    }
    node.description = option.get_description();
    node.is_required = option.get_required();
    node.may_repeat = option.get_items_expected_max() > 1;
    if (option.get_items_expected_max() == 0) return node;  // a flag
    const std::string type = option.get_type_name();
    const std::vector<std::string> choices = listed_choices(type);
    node.default_value = option.get_default_str();
    node.value = choices.empty() ? type : "WORD";
    if (node.value.empty() || node.is_positional) node.value = node.names.front();
    if (node.is_positional && type == "FILE") node.value = "FILE";
    node.completion = choices.empty() ? Completion::anything : Completion::words;
    node.words = choices;
    complete(node);
    return node;
}

}  // namespace

CommandNode command_tree(const CLI::App& app) {
    CommandNode node{app.get_name(), app.get_description(), app.get_footer(), {}, {}};
    for (const CLI::Option* option : app.get_options())
        node.options.push_back(option_node(*option));
    for (const CLI::App* command : app.get_subcommands({})) {
        node.commands.push_back(command_tree(*command));
    }
    return node;
}

}  // namespace gene_clocks::app
