#pragma once

#include <nlohmann/json.hpp>

#include "sim/statistics/bootstrap.hpp"

namespace gene_clocks::report {

/// Lower and upper end, as an array of two.
inline nlohmann::ordered_json to_json(const statistics::Interval& interval) {
    return {interval.lower, interval.upper};
}

}  // namespace gene_clocks::report
