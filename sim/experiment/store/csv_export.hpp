#pragma once

#include <iosfwd>
#include <string>

#include "sim/experiment/store/store.hpp"

namespace gene_clocks::experiment {

/// A text as a field of CSV: in quotes where it has a comma, a quote or a line break (RFC 4180).
std::string csv_field(const std::string& text);

/// Writes one line for each finished run of the studies: what it is, its measures, counters,
/// measures of chronology and identity. The best swarm fitness that t_f and f_a refer to is taken
/// over all runs that are written (ComparedRuns). Numbers are written so that reading them back
/// gives the same numbers.
void write_runs_csv(const Store& store, const std::vector<StoredStudy>& studies, std::ostream& out);

/// Writes one line for each sample of each finished run.
void write_samples_csv(const Store& store, const std::vector<StoredStudy>& studies,
                       std::ostream& out);

}  // namespace gene_clocks::experiment
