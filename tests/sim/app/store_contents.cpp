#include "tests/sim/app/store_contents.hpp"

#include <sstream>
#include <vector>

#include "tests/sim/app/program.hpp"

namespace gene_clocks::test {
namespace {

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) found.push_back(cell);
    return found;
}

std::string without_times(const std::string& csv) {
    std::stringstream stream(csv);
    std::string line;
    std::vector<std::string> header;
    std::string text;
    while (std::getline(stream, line)) {
        const auto values = cells(line);
        if (header.empty()) header = values;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const bool is_time = header[i].ends_with("_seconds") || header[i] == "finished_at";
            if (!is_time) text += values[i] + ",";
        }
        text += '\n';
    }
    return text;
}

}  // namespace

std::string store_contents(const std::filesystem::path& folder, const std::string& store) {
    const auto exported = [&](const char* what) {
        return gene_clocks(folder, {"export", store, what, "-"}).output;
    };
    return without_times(exported("--runs")) + exported("--samples");
}

}  // namespace gene_clocks::test
