#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sim/report/comparison.hpp"
#include "sim/report/contrast_plan.hpp"
#include "sim/report/paired_contrast.hpp"
#include "sim/report/report_input.hpp"
#include "sim/statistics/equivalence.hpp"

namespace gene_clocks::report {

/// One arm compared with its baseline in one measure.
///
/// Both sides may share seeds, which makes their runs alike. The tests take all runs as
/// independent: they are then conservative, in what they find different as in what they find
/// equivalent. `PairedContrast` makes use of the pairs.
struct Contrast {
    const ArmRuns* arm{};
    const ArmRuns* baseline{};
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
    experiment::BestSwarmFitness best;  ///< that t_f and f_a refer to
};

Family family_of(const Contrast& contrast);

/// Compares each arm with the baseline it is given, in that order; the plan's own does not count.
/// A family, over which p-values are corrected, are the contrasts of one task and profile.
/// Throws experiment::InputError where the plan or the runs are unfit.
std::vector<Contrast> contrast_pairs(std::span<const ContrastPair> pairs, const ContrastPlan& plan);

/// All that a plan has to say of some arms.
struct Contrasts {
    std::vector<Contrast> arms;          ///< in the order of the arms
    std::vector<PairedContrast> paired;  ///< of the same arms, put together by what they change
    std::vector<std::string> left_out;   ///< arms that are missing in one or both, and why
};

/// Compares every arm with runs with its baseline: arm by arm after `plan`, seed by seed after
/// `paired_plan`. Refers to the arms of `input`. Throws experiment::InputError where a plan or the
/// runs are unfit, or no arm has a baseline.
Contrasts contrast(const Input& input, const ContrastPlan& plan, const ContrastPlan& paired_plan);
inline Contrasts contrast(const Input& input, const ContrastPlan& plan) {
    return contrast(input, plan, plan);
}

}  // namespace gene_clocks::report
