// The shipped trace checker behind the oracle's interface (proofs/oracle/trace_main.ml): checks
// each file given, or standard input.

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "protocol/trace/trace_reader.hpp"

namespace {

int check(const std::string& label, std::istream& in) {
    const auto verdict = gene_clocks::trace::check_trace(in);
    fmt::print("{}{}\n", label, verdict.text());
    if (!verdict.reason.empty()) {
        fmt::print(stderr, "{}line {}: {}\n", label, verdict.line, verdict.reason);
    }
    return verdict.exit_status();
}

}  // namespace

int main(int argc, char** argv) {
    std::ios::sync_with_stdio(false);
    try {
        if (argc == 1) return check("", std::cin);
        int status = 0;
        for (int i = 1; i < argc; ++i) {
            const std::string file = argv[i];
            std::ifstream in(file, std::ios::binary);
            if (!in) throw std::runtime_error("cannot open " + file);
            status = std::max(status, check(file + ": ", in));
        }
        return status;
    } catch (const std::exception& error) {
        fmt::print(stderr, "check_traces: {}\n", error.what());
        return 3;
    }
}
