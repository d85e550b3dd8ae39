#pragma once

#include <array>
#include <string_view>

namespace gene_clocks::report {

/// The measures of Table 2.
inline constexpr std::array<std::string_view, 4> compared_measures = {"f_c", "f_b", "t_f", "f_a"};

/// The measures in which the methods are tested against each other: those of Table 2 and Figure 11.
inline constexpr std::array<std::string_view, 5> tested_measures = {"f_c", "f_b", "t_f", "f_a",
                                                                    "controller_size"};

}  // namespace gene_clocks::report
