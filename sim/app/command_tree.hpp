#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace gene_clocks::app {

/// What may follow an option, or stand as an argument: for completion by a shell.
enum class Completion {
    nothing,   ///< a flag: no value follows
    anything,  ///< a number, say, that no list holds
    file,
    folder,
    words,          ///< one of OptionNode::words
    words_or_file,  ///< a built-in name, or a file of the user's
    assignment,     ///< KEY=VALUE with one of OptionNode::words as the key
};

/// An option or a positional argument of a command.
struct OptionNode {
    std::vector<std::string> names;  ///< as typed: "--task", "-h"; one without dashes if positional
    std::string value;               ///< what help texts call it, as in "FILE"; empty for a flag
    std::string default_value;       ///< empty where there is none
    std::string description;
    bool is_positional{};
    bool is_required{};
    bool may_repeat{};
    Completion completion{};
    std::vector<std::string> words;
};

/// A command, as the command line itself knows it.
struct CommandNode {
    std::string name;
    std::string description;
    std::string footer;  ///< examples and the like, as `--help` ends in
    std::vector<OptionNode> options;
    std::vector<CommandNode> commands;
};

/// All that the program's own parser knows of its commands: completion and manual pages are made
/// from it, so that they cannot say anything else.
CommandNode command_tree(const CLI::App& app);

}  // namespace gene_clocks::app
