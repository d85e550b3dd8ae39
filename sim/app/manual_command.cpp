// Manual pages for man(1), from the program's own parser.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>

#include "sim/app/command_tree.hpp"
#include "sim/app/commands.hpp"
#include "sim/app/output_file.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/program_version.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::app {
namespace {

using Text = fmt::memory_buffer;

template <typename... Arguments>
void put(Text& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

/// Text as roff takes it: backslashes and hyphens are literal, no line begins with a control.
std::string roff(std::string_view words) {
    std::string text;
    bool is_start = true;
    for (const char character : words) {
        if (is_start && (character == '.' || character == '\'')) text += "\\&";
        if (character == '\\') {
            text += "\\e";
        } else if (character == '-') {
            text += "\\-";
        } else {
            text += character;
        }
        is_start = character == '\n';
    }
    return text;
}

void put_option(Text& text, const OptionNode& option) {
    put(text, ".TP\n");
    std::string names;
    for (const std::string& name : option.names) {
        names += (names.empty() ? "" : ", ") + ("\\fB" + roff(name) + "\\fR");
    }
    put(text, "{}", names);
    if (!option.is_positional && !option.value.empty())
        put(text, " \\fI{}\\fR", roff(option.value));
    if (option.may_repeat) put(text, " ...");
    put(text, "\n{}.", roff(option.description));
    const bool lists_them =
        !option.words.empty() && option.description.find(option.words.front()) != std::string::npos;
    if (option.completion == Completion::words && option.words.size() < 12 && !lists_them) {
        put(text, " One of:");
        for (const std::string& word : option.words) put(text, " {}", roff(word));
        put(text, ".");
    }
    if (!option.default_value.empty()) put(text, " Without it: {}.", roff(option.default_value));
    put(text, "\n");
}

std::string synopsis(const CommandNode& command) {
    std::string words = "[\\fIOPTION\\fR]...";
    for (const OptionNode& option : command.options) {
        if (!option.is_positional) continue;
        const std::string name = "\\fI" + roff(option.names.front()) + "\\fR";
        words += option.is_required ? " " + name : " [" + name + "]";
        if (option.may_repeat) words += "...";
    }
    return words;
}

std::string page_head(const std::string& title, const std::string& description) {
    return fmt::format(".TH {} 1 \"\" \"Gene Clocks {}\" \"Gene Clocks\"\n.SH NAME\n{} \\- {}\n",
                       roff(title), experiment::program_version(), roff(title), roff(description));
}

void put_footer(Text& text, const std::string& footer) {
    if (footer.empty()) return;
    put(text, ".SH NOTES AND EXAMPLES\n.nf\n{}\n.fi\n", roff(footer));
}

std::string page_of(const CommandNode& program, const CommandNode& command) {
    Text text;
    put(text, "{}", page_head(program.name + "-" + command.name, command.description));
    put(text, ".SH SYNOPSIS\n.B {} {}\n{}\n.SH OPTIONS\n", roff(program.name), roff(command.name),
        synopsis(command));
    for (const OptionNode& option : command.options) put_option(text, option);
    put_footer(text, command.footer);
    put(text, ".SH SEE ALSO\n.BR {} (1)\n", roff(program.name));
    return fmt::to_string(text);
}

std::string page_of(const CommandNode& program) {
    Text text;
    put(text, "{}",
        page_head(program.name, "robot swarms that evolve neural networks with odNEAT"));
    put(text, ".SH SYNOPSIS\n.B {}\n\\fICOMMAND\\fR [\\fIOPTION\\fR]...\n.SH DESCRIPTION\n{}\n",
        roff(program.name), roff(program.description));
    put(text, ".SH COMMANDS\n");
    for (const CommandNode& command : program.commands) {
        put(text, ".TP\n\\fB{}\\fR\n{}\n", roff(command.name), roff(command.description));
    }
    put(text, ".SH OPTIONS\n");
    for (const OptionNode& option : program.options) put_option(text, option);
    put(text,
        ".SH EXIT STATUS\n.TP\n0\nAll went well.\n.TP\n1\nSomething broke on the way.\n"
        ".TP\n2\nThe input was refused; nothing was written.\n"
        ".TP\n130\nStopped by Ctrl\\-C or SIGTERM; finished runs are kept.\n");
    put_footer(text, program.footer);
    return fmt::to_string(text);
}

void write_page(const std::filesystem::path& folder, const std::string& name,
                const std::string& page) {
    OutputFile file(folder / (name + ".1"));
    file.stream() << page;
    file.finish();
}

void write_all(const CommandNode& program, const std::filesystem::path& folder) {
    write_page(folder, program.name, page_of(program));
    for (const CommandNode& command : program.commands) {
        write_page(folder, program.name + "-" + command.name, page_of(program, command));
    }
}

}  // namespace

void add_manual_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand("manual", "Print the manual page of a command, for man");
    auto name = std::make_shared<std::string>();
    command->add_option("COMMAND", *name, "The command; without it, the page of gene-clocks itself")
        ->type_name("");
    auto folder = std::make_shared<std::string>();
    command->add_option("--all", *folder, "Write all pages into a folder that is there, instead")
        ->type_name("FOLDER");
    command->footer(
        "Examples:\n"
        "  gene-clocks manual | man -l -\n"
        "  gene-clocks manual run > gene-clocks-run.1\n"
        "  gene-clocks manual --all ~/.local/share/man/man1\n");
    command->callback([&app, name, folder, &status] {
        const CommandNode program = command_tree(app);
        if (!folder->empty()) {
            write_all(program, *folder);
        } else if (name->empty()) {
            fmt::print("{}", page_of(program));
        } else {
            const auto found = std::ranges::find(program.commands, *name, &CommandNode::name);
            if (found == program.commands.end()) {
                std::vector<std::string> names;
                for (const CommandNode& each : program.commands) names.push_back(each.name);
                throw experiment::InputError(fmt::format("{}: there is no such command{}", *name,
                                                         experiment::suggestion(*name, names)));
            }
            fmt::print("{}", page_of(program, *found));
        }
        status = success;
    });
}

}  // namespace gene_clocks::app
