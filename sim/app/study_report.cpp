#include "sim/app/study_report.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "sim/report/report.hpp"

namespace gene_clocks::app {

void report_on(const std::filesystem::path& file, const std::vector<std::string>& names,
               const std::string& command, const std::filesystem::path& folder) {
    report::Input input = report::read_input(file, names);
    input.command = command;
    report::write_report(input, folder);
    fmt::print(stderr, "Report: {}\n", (folder / "index.html").string());
}

std::filesystem::path report_folder(std::filesystem::path store) {
    if (store.has_extension()) return store.replace_extension();
    return store += "-report";
}

}  // namespace gene_clocks::app
