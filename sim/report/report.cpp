#include "sim/report/report.hpp"

#include <nlohmann/json.hpp>

#include "sim/report/page_program.hpp"
#include "sim/report/report_data.hpp"
#include "sim/settings/input_error.hpp"

namespace gene_clocks::report {

void write_report(const Input& input, const std::filesystem::path& folder) {
    if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
        throw experiment::InputError(folder.string() + ": is not a folder");
    const std::string python = find_python();
    draw_page(python, report_data(input).dump() + "\n", folder);
}

}  // namespace gene_clocks::report
