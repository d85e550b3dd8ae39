#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/report/comparison.hpp"
#include "sim/report/published.hpp"
#include "sim/statistics/bootstrap.hpp"

namespace gene_clocks::report {

/// A published range beside our runs. It agrees where our median lies within it.
struct RangeVerdict {
    std::string_view origin;  ///< "paper" or "reference"
    sim::Source source{};
    std::string measure;
    PublishedRange published;
    std::optional<double> ours;          ///< our median; none where there are no such runs
    statistics::Interval ours_interval;  ///< bootstrap interval of our median, where there is one
    std::optional<bool> agrees;          ///< none where our runs are not of the paper's scale
};

/// A published p-value beside ours, of all runs of both methods. They agree where both fall on the
/// same side of the significance level.
///
/// Arms that share seeds are alike by construction. That makes the test conservative, never the
/// reverse: runs that are the same, seed by seed, show no difference for certain.
struct TestVerdict {
    std::string measure;
    double published{};
    bool is_lower_bound{};  ///< the paper says only that its p-value is above `published`
    std::optional<double> ours;
    std::optional<bool> agrees;
};

/// One figure or table of the paper, or the half of it that concerns a task, beside our runs.
struct Exhibit {
    std::string id;  ///< as in "figure-3"
    sim::Task task{};
    std::vector<RangeVerdict> ranges;
    std::vector<TestVerdict> tests;
};

/// How many of an exhibit's verdicts agree, and how many there are.
struct Agreement {
    std::size_t agreeing{};
    std::size_t compared{};
};
Agreement count_agreement(const Exhibit& exhibit);

/// The paper's figures 3 to 11 and Table 2, as far as they concern the comparison's task.
std::vector<Exhibit> judge(const Comparison& comparison);

}  // namespace gene_clocks::report
