#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "sim/report/comparison.hpp"

namespace gene_clocks::report {

/// What the page shows of a study beyond the paper's exhibits: for each group of arms what varies,
/// where each arm stands, and the contrasts of arms with their baselines. Arms and contrasts refer
/// by position: to the comparisons, which hold the numbers of the arms, and to the group's arms.
/// Throws experiment::InputError as `contrast` does.
nlohmann::ordered_json groups_json(const std::vector<Comparison>& comparisons);

}  // namespace gene_clocks::report
