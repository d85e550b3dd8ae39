// Completion for the shells that people have, from the program's own parser.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <memory>

#include "sim/app/command_tree.hpp"
#include "sim/app/commands.hpp"

namespace gene_clocks::app {
namespace {

using Text = fmt::memory_buffer;

template <typename... Arguments>
void put(Text& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

/// Within single quotes, for any of the three shells.
std::string in_quotes(std::string_view words) {
    std::string text = "'";
    for (const char character : words) {
        if (character == '\'') {
            text += "'\\''";
        } else {
            text += character;
        }
    }
    return text + "'";
}

std::string first_sentence(const std::string& description) {
    return description.substr(0, description.find_first_of(";\n"));
}

std::vector<std::string> names_of(const std::vector<CommandNode>& commands) {
    std::vector<std::string> names;
    for (const CommandNode& command : commands) names.push_back(command.name);
    return names;
}

std::vector<std::string> flags_of(const CommandNode& command) {
    std::vector<std::string> names;
    for (const OptionNode& option : command.options) {
        if (!option.is_positional) {
            names.insert(names.end(), option.names.begin(), option.names.end());
        }
    }
    return names;
}

// ---- bash

std::string bash_reply(const OptionNode& option) {
    const std::string words = in_quotes(fmt::format("{}", fmt::join(option.words, " ")));
    switch (option.completion) {
        case Completion::nothing:
        case Completion::anything:
            return "return";
        case Completion::file:
            return "COMPREPLY=($(compgen -f -- \"$word\"))";
        case Completion::folder:
            return "COMPREPLY=($(compgen -d -- \"$word\"))";
        case Completion::words:
            return fmt::format("COMPREPLY=($(compgen -W {} -- \"$word\"))", words);
        case Completion::words_or_file:
            return fmt::format(
                "COMPREPLY=($(compgen -W {} -- \"$word\") $(compgen -f -- \"$word\"))", words);
        case Completion::assignment:
            return fmt::format("compopt -o nospace; COMPREPLY=($(compgen -W {} -- \"$word\"))",
                               words);
    }
    return "return";
}

std::string bash(const CommandNode& program) {
    Text text;
    put(text,
        "# Completion of gene-clocks for bash: source it, or put it where bash-completion looks.\n"
        "_gene_clocks() {{\n"
        "    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}\n"
        "    COMPREPLY=()\n"
        "    if [[ $COMP_CWORD -eq 1 ]]; then\n"
        "        COMPREPLY=($(compgen -W {} -- \"$word\"))\n"
        "        return\n"
        "    fi\n"
        "    compopt -o filenames 2>/dev/null\n"
        "    case \"${{COMP_WORDS[1]}} $before\" in\n",
        in_quotes(fmt::format("{} {}", fmt::join(names_of(program.commands), " "),
                              fmt::join(flags_of(program), " "))));
    for (const CommandNode& command : program.commands) {
        for (const OptionNode& option : command.options) {
            if (option.is_positional || option.completion == Completion::nothing) continue;
            for (const std::string& name : option.names) {
                put(text, "        {}) {}; return ;;\n", in_quotes(command.name + " " + name),
                    bash_reply(option));
            }
        }
    }
    put(text, "    esac\n    case \"${{COMP_WORDS[1]}} $word\" in\n");
    for (const CommandNode& command : program.commands) {
        put(text, "        {}*) COMPREPLY=($(compgen -W {} -- \"$word\")); return ;;\n",
            in_quotes(command.name + " -"),
            in_quotes(fmt::format("{}", fmt::join(flags_of(command), " "))));
    }
    put(text, "    esac\n    case \"${{COMP_WORDS[1]}}\" in\n");
    for (const CommandNode& command : program.commands) {
        for (const OptionNode& option : command.options) {
            if (!option.is_positional) continue;
            put(text, "        {}) {} ;;\n", in_quotes(command.name), bash_reply(option));
            break;
        }
    }
    put(text, "    esac\n}}\ncomplete -F _gene_clocks gene-clocks\n");
    return fmt::to_string(text);
}

// ---- zsh

/// For _arguments: a colon, a bracket and a quote mean something there.
std::string zsh_words(std::string_view words) {
    std::string text;
    for (const char character : words) {
        if (character == ':' || character == '[' || character == ']' || character == '\\') {
            text += '\\';
        }
        if (character == '\'') {
            text += "'\\''";
        } else {
            text += character;
        }
    }
    return text;
}

std::string zsh_action(const OptionNode& option) {
    const std::string words = zsh_words(fmt::format("{}", fmt::join(option.words, " ")));
    switch (option.completion) {
        case Completion::file:
            return "_files";
        case Completion::folder:
            return "_files -/";
        case Completion::words:
            return "(" + words + ")";
        case Completion::words_or_file:
            return "{compadd " + words + "; _files}";
        case Completion::assignment:
            return "{compadd -S \"\" -- " + words + "}";
        case Completion::nothing:
        case Completion::anything:
            break;
    }
    return " ";
}

std::string zsh(const CommandNode& program) {
    Text text;
    put(text,
        "#compdef gene-clocks\n"
        "# Completion of gene-clocks for zsh: put it into a folder of $fpath as _gene-clocks.\n"
        "_gene-clocks() {{\n"
        "    if (( CURRENT == 2 )); then\n"
        "        local -a commands=(\n");
    for (const CommandNode& command : program.commands) {
        put(text, "            '{}:{}'\n", command.name,
            zsh_words(first_sentence(command.description)));
    }
    put(text,
        "        )\n"
        "        _describe command commands\n"
        "        return\n"
        "    fi\n"
        "    local command=$words[2]\n"
        "    shift words; (( CURRENT-- ))\n"
        "    case $command in\n");
    for (const CommandNode& command : program.commands) {
        put(text, "        {})\n            _arguments", command.name);
        for (const OptionNode& option : command.options) {
            if (option.is_positional) {
                put(text, " \\\n                '{}{}:{}'", option.may_repeat ? "*:" : ":",
                    zsh_words(option.names.front()), zsh_action(option));
                continue;
            }
            for (const std::string& name : option.names) {
                put(text, " \\\n                '{}{}[{}]", option.may_repeat ? "*" : "", name,
                    zsh_words(first_sentence(option.description)));
                if (option.completion != Completion::nothing) {
                    put(text, ":{}:{}", zsh_words(option.value), zsh_action(option));
                }
                put(text, "'");
            }
        }
        put(text, "\n            ;;\n");
    }
    put(text, "    esac\n}}\n_gene-clocks \"$@\"\n");
    return fmt::to_string(text);
}

// ---- fish

void put_fish_option(Text& text, const CommandNode& command, const OptionNode& option) {
    put(text, "complete -c gene-clocks -n '__fish_seen_subcommand_from {}'", command.name);
    for (const std::string& name : option.names) {
        if (name.starts_with("--")) {
            put(text, " -l {}", name.substr(2));
        } else if (name.starts_with('-')) {
            put(text, " -s {}", name.substr(1));
        }
    }
    const bool wants_files = option.completion == Completion::file ||
                             option.completion == Completion::folder ||
                             option.completion == Completion::words_or_file;
    if (option.completion != Completion::nothing) {
        put(text, " {}",
            wants_files ? (option.is_positional ? "-F" : "-r -F")
                        : (option.is_positional ? "-f" : "-x"));
    }
    if (!option.words.empty()) {
        put(text, " -a {}", in_quotes(fmt::format("{}", fmt::join(option.words, " "))));
    }
    put(text, " -d {}\n", in_quotes(first_sentence(option.description)));
}

std::string fish(const CommandNode& program) {
    Text text;
    put(text,
        "# Completion of gene-clocks for fish: put it into ~/.config/fish/completions.\n"
        "complete -c gene-clocks -f\n");
    for (const CommandNode& command : program.commands) {
        put(text, "complete -c gene-clocks -n __fish_use_subcommand -a {} -d {}\n", command.name,
            in_quotes(first_sentence(command.description)));
        for (const OptionNode& option : command.options) put_fish_option(text, command, option);
    }
    return fmt::to_string(text);
}

}  // namespace

void add_completion_command(CLI::App& app, int& status) {
    auto* command =
        app.add_subcommand("completion", "Print what makes a shell complete gene-clocks' commands");
    auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    command->footer(
        "Examples:\n"
        "  source <(gene-clocks completion bash)\n"
        "  gene-clocks completion zsh > ~/.zfunc/_gene-clocks\n"
        "  gene-clocks completion fish > ~/.config/fish/completions/gene-clocks.fish\n");
    command->callback([&app, shell, &status] {
        const CommandNode program = command_tree(app);
        fmt::print("{}", *shell == "bash"  ? bash(program)
                         : *shell == "zsh" ? zsh(program)
                                           : fish(program));
        status = success;
    });
}

}  // namespace gene_clocks::app
