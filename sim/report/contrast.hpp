#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "comparison.hpp"
#include "report.hpp"
#include "statistics/equivalence.hpp"

namespace gene_clocks::report {

/// Which arms are set against which, in what.
struct ContrastPlan {
    /// What turns an arm's settings into those of the arm it is held against: "key=value", as the
    /// command line has it. An arm that these leave as it is, is a baseline itself.
    std::vector<std::string> baseline = {"source=gene-clock"};
    std::string measure = "f_c";  ///< an id of `measures`
    double margin_share = 0.05;  ///< differences below this share of the baseline's median are none
    double level = 0.05;
};

/// What the tests of a contrast say, each corrected for the number of contrasts.
enum class ContrastVerdict : std::uint8_t {
    equivalent,  ///< shown to differ by less than the margin, and not shown to differ
    small,       ///< shown to differ, and shown to differ by less than the margin
    different,   ///< shown to differ, and not shown to do so by less than the margin
    undecided,   ///< neither is shown
};

std::string_view name_of(ContrastVerdict verdict);

/// One arm held against its baseline in one measure.
///
/// Both sides may share seeds, which makes their runs alike. The tests take all runs as
/// independent: they are then conservative, in what they find different as in what they find
/// equivalent.
struct Contrast {
    const Arm* arm{};
    const Arm* baseline{};
    std::size_t runs{};
    std::size_t baseline_runs{};
    std::size_t pairs{};      ///< seeds that both hold
    std::size_t identical{};  ///< of these, with the same trajectory
    double median{};
    double baseline_median{};
    double margin{};                       ///< in the measure's unit
    statistics::Shift shift;               ///< of the arm above its baseline; 95 %
    double effect{};                       ///< Vargha and Delaney's A: P(arm > baseline)
    statistics::Interval effect_interval;  ///< 95 %, bootstrap
    double difference_p_value{};           ///< two-sided Mann–Whitney
    double difference_p_corrected{};       ///< Holm, over the contrasts of the same family
    double equivalence_p_value{};          ///< two one-sided Mann–Whitney, at the margin
    double equivalence_p_corrected{};      ///< likewise
    statistics::Power power;               ///< of the uncorrected tests, at the margin
    ContrastVerdict verdict{};
};

/// Holds every arm with runs against its baseline, in the order of the arms. A family, over which
/// p-values are corrected, are the contrasts of one task and profile.
/// Arms whose baseline has no runs are left out, and named in `without_baseline` if that is given.
/// Throws experiment::InputError where the plan or the runs are unfit, or no arm has a baseline.
std::vector<Contrast> contrast(const Input& input, const ContrastPlan& plan,
                               std::vector<std::string>* without_baseline = nullptr);

/// Two arms, the second of which is the baseline.
struct ContrastPair {
    const ArmNumbers* arm{};
    const ArmNumbers* baseline{};
};

/// Holds each arm against the baseline it is given; the plan's baseline does not count.
/// Throws as `contrast` does, but not where there are no pairs.
std::vector<Contrast> contrast_pairs(std::span<const ContrastPair> pairs, const ContrastPlan& plan);

}  // namespace gene_clocks::report
