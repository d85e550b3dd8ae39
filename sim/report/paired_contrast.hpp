#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sim/report/comparison.hpp"
#include "sim/report/contrast_plan.hpp"
#include "sim/statistics/paired.hpp"

namespace gene_clocks::report {

/// Arms that differ from their baselines in the same way, compared with them seed by seed and over
/// all conditions together: what a sweep as a whole says of that difference.
///
/// A seed's difference is the mean, over the arms, of the arm's value above its baseline's. Those
/// of two seeds are independent, whatever the runs of one seed have in common: the tests need not
/// take all runs for independent, as those of single arms do.
struct PairedContrast {
    Family family;
    std::vector<std::string> changes;  ///< the settings that differ, as in "source=timestamp"
    const ArmRuns* first_arm{};        ///< the first that differs in that way; never null
    std::size_t arms{};                ///< that differ in that way, each with its baseline
    std::size_t seeds{};               ///< that all of them and their baselines hold
    std::size_t identical{};  ///< of arms × seeds pairs of runs, those with the same trajectory
    double baseline_mean{};   ///< over baselines and seeds
    double margin{};          ///< the plan's share of the mean of the baselines' medians
    statistics::PairedTest test;       ///< of the seeds' differences
    double difference_p_value{};       ///< of `test`
    double difference_p_corrected{};   ///< Holm, over the paired contrasts of the same family
    double equivalence_p_value{};      ///< of `test`
    double equivalence_p_corrected{};  ///< likewise
    statistics::Power power;           ///< of the uncorrected tests, at the margin
    ContrastVerdict verdict{};
    experiment::BestSwarmFitness best;  ///< that t_f and f_a of the first arm refer to
};

Family family_of(const PairedContrast& contrast);

/// In the order in which the pairs first change something that way. What has fewer than two seeds
/// is left out, and named in `left_out` if that is given. A contrast whose runs are all the same
/// has the verdict `identical`: a test needs scatter, and finds nothing without.
/// Throws experiment::InputError where the plan or the runs are unfit.
std::vector<PairedContrast> paired_contrasts(std::span<const ContrastPair> pairs,
                                             const ContrastPlan& plan,
                                             std::vector<std::string>* left_out = nullptr);

}  // namespace gene_clocks::report
