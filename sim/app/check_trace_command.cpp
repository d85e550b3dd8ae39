#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "commands.hpp"
#include "input_error.hpp"
#include "trace_reader.hpp"

namespace gene_clocks::app {
namespace {

int check(const std::string& name) {
    trace::Verdict verdict;
    if (name == "-") {
        verdict = trace::check_trace(std::cin);
    } else {
        std::ifstream in(name, std::ios::binary);
        if (!in) throw experiment::InputError(name + ": cannot be read");
        verdict = trace::check_trace(in);
    }
    fmt::print("{}\n", verdict.text());
    if (!verdict.reason.empty()) {
        fmt::print(stderr, "gene-clocks: {}: line {}: {}\n", name, verdict.line, verdict.reason);
    }
    return verdict.exit_status();
}

}  // namespace

void add_check_trace_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand(
        "check-trace", "Check that a recorded run kept the protocol: marks unique, causes first");
    auto name = std::make_shared<std::string>();
    command
        ->add_option("FILE", *name,
                     "Trace that `gene-clocks run --trace` wrote; - for standard input")
        ->required();
    command->footer(
        "Prints `accepted` and the number of entries (status 0), or the first line that breaks a "
        "rule\n(status 1) or is malformed (status 2).\n"
        "Example:\n"
        "  gene-clocks run --task navigation --seed 1 --trace run.trace\n"
        "  gene-clocks check-trace run.trace\n");
    command->callback([name, &status] { status = check(*name); });
}

}  // namespace gene_clocks::app
