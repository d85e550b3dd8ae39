#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/experiment/study/contrast_table.hpp"
#include "sim/report/comparison.hpp"
#include "sim/statistics/equivalence.hpp"

namespace gene_clocks::report {

/// Which arms are compared with which, in what.
struct ContrastPlan {
    /// What turns an arm's settings into those of its baseline: "key=value", as the command line
    /// has it. An arm that these leave as it is, is a baseline itself.
    std::vector<std::string> baseline = {"source=gene-clock"};
    /// Names of arms: where there are any, the baseline of every arm is the one of its family.
    std::vector<std::string> against = {};
    std::string measure = "f_c";  ///< an id of experiment::measures
    double margin_share = 0.05;  ///< differences below this share of the baseline's median are none
    double level = 0.05;
    /// Keys of settings that are conditions: arms which differ from their baselines in these and
    /// otherwise in the same way make one paired contrast.
    std::vector<std::string> over = {};
};

/// The same plan with other baselines.
ContrastPlan with_baselines(ContrastPlan plan, const experiment::Baselines& baselines);

/// Throws experiment::InputError for a measure or a key that does not exist and for shares outside
/// (0, 1).
void check(const ContrastPlan& plan);

/// What the tests of a contrast say, each corrected for the number of contrasts.
enum class ContrastVerdict : std::uint8_t {
    equivalent,  ///< shown to differ by less than the margin, and not shown to differ
    small,       ///< shown to differ, and shown to differ by less than the margin
    different,   ///< shown to differ, and not shown to do so by less than the margin
    undecided,   ///< neither is shown
    identical,   ///< there is nothing to test: all runs are the same, seed by seed
};

std::string_view name_of(ContrastVerdict verdict);

/// Of corrected p-values.
ContrastVerdict verdict_of(double difference_p_value, double equivalence_p_value, double level);

/// Two arms, the second of which is the baseline.
struct ContrastPair {
    const ArmNumbers* arm{};
    const ArmNumbers* baseline{};
};

/// Every arm with its baseline, in the order of the arms; points into `all`. To `left_out` is
/// appended which arms have none, and why. Throws experiment::InputError where the plan names arms
/// that have no runs, several of one name, or two of one family.
std::vector<ContrastPair> pair_with_baselines(const std::vector<ArmNumbers>& all,
                                              const ContrastPlan& plan,
                                              std::vector<std::string>& left_out);

/// Whether a share of the baseline's median makes a margin: not of 0.
bool has_margin(const ContrastPair& pair, const ContrastPlan& plan);

/// The values of the plan's measure, in the order of the runs.
/// Throws experiment::InputError where the runs are too short for it.
const std::vector<double>& values_of(const ArmNumbers& numbers, const ContrastPlan& plan);

/// Corrects the p-values of rows by Holm, over those of one family, and judges them.
template <typename Row>
void correct_by_family(std::vector<Row>& rows, double level) {
    std::map<Family, std::vector<Row*>> families;
    for (Row& row : rows) families[family_of(row)].push_back(&row);
    for (auto& [name, family] : families) {
        std::vector<double> difference;
        std::vector<double> equivalence;
        for (const Row* row : family) {
            difference.push_back(row->difference_p_value);
            equivalence.push_back(row->equivalence_p_value);
        }
        difference = statistics::holm(difference);
        equivalence = statistics::holm(equivalence);
        for (std::size_t i = 0; i < family.size(); ++i) {
            family[i]->difference_p_corrected = difference[i];
            family[i]->equivalence_p_corrected = equivalence[i];
            family[i]->verdict = verdict_of(difference[i], equivalence[i], level);
        }
    }
}

}  // namespace gene_clocks::report
