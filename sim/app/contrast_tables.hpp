#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "sim/report/contrast.hpp"

namespace gene_clocks::app {

/// A header and a line for each row.
void write_csv(const std::vector<report::Contrast>& rows, const std::string& measure,
               std::ostream& out);
void write_csv(const std::vector<report::PairedContrast>& rows, const std::string& measure,
               std::ostream& out);

/// To standard output, for people to read: arm by arm, a table for each baseline.
void print_table(const std::vector<report::Contrast>& rows, const std::string& measure);
/// Likewise: seed by seed, one table after an empty line; nothing where there are no rows.
void print_table(const std::vector<report::PairedContrast>& rows, const std::string& measure);

}  // namespace gene_clocks::app
