#include "contrast.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "comparison.hpp"
#include "input_error.hpp"
#include "measures.hpp"
#include "settings_io.hpp"
#include "settings_table.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/mann_whitney.hpp"
#include "statistics/quantiles.hpp"
#include "suggestion.hpp"

namespace gene_clocks::report {
namespace {

using experiment::InputError;

bool equal(const sim::Settings& one, const sim::Settings& other) {
    return experiment::differing_keys(one, other).empty();
}

void check(const ContrastPlan& plan) {
    std::vector<std::string> names;
    for (const Measure& measure : measures) names.emplace_back(measure.id);
    if (std::ranges::find(names, plan.measure) == names.end()) {
        throw InputError(fmt::format("there is no measure \"{}\"{}; there are {}", plan.measure,
                                     experiment::suggestion(plan.measure, names),
                                     fmt::join(names, ", ")));
    }
    const auto is_share = [](double value) { return value > 0.0 && value < 1.0; };
    if (!is_share(plan.margin_share)) throw InputError("the margin is not between 0 and 1");
    if (!is_share(plan.level)) throw InputError("the level is not between 0 and 1");
}

sim::Settings baseline_settings(const ContrastPlan& plan, sim::Settings settings) {
    for (const std::string& assignment : plan.baseline) {
        experiment::assign(settings, assignment, "--baseline");
    }
    return settings;
}

/// The values of the plan's measure.
const std::vector<double>& values_of(const ArmNumbers& numbers, const ContrastPlan& plan) {
    const auto found = numbers.values.find(plan.measure);
    if (found == numbers.values.end() || found->second.size() != numbers.runs.size()) {
        throw InputError(fmt::format("arm \"{}\": its runs are too short for {}", numbers.arm->name,
                                     plan.measure));
    }
    return found->second;
}

Contrast contrast_of(const ArmNumbers& arm, const ArmNumbers& baseline, const ContrastPlan& plan) {
    const std::vector<double>& x = values_of(arm, plan);
    const std::vector<double>& y = values_of(baseline, plan);
    const SharedTrajectories shared = share_trajectories(arm, baseline);
    Contrast contrast;
    contrast.arm = arm.arm;
    contrast.baseline = baseline.arm;
    contrast.runs = x.size();
    contrast.baseline_runs = y.size();
    contrast.pairs = shared.pairs;
    contrast.identical = shared.identical;
    contrast.median = statistics::median(x);
    contrast.baseline_median = statistics::median(y);
    contrast.margin = plan.margin_share * std::fabs(contrast.baseline_median);
    if (!(contrast.margin > 0.0)) {
        throw InputError(
            fmt::format("arm \"{}\": its median of {} is 0, of which no share makes a "
                        "margin",
                        baseline.arm->name, plan.measure));
    }
    contrast.shift = statistics::shift_of_location(x, y);
    contrast.effect = statistics::vargha_delaney_a(x, y);
    contrast.effect_interval = statistics::bootstrap_interval(x, y, statistics::vargha_delaney_a);
    contrast.difference_p_value = statistics::mann_whitney(x, y).p_value;
    contrast.equivalence_p_value = statistics::equivalence_p_value(x, y, contrast.margin);
    contrast.power = statistics::power(x, y, contrast.margin, {.level = plan.level});
    return contrast;
}

ContrastVerdict verdict_of(const Contrast& contrast, double level) {
    const bool is_different = contrast.difference_p_corrected < level;
    const bool is_equivalent = contrast.equivalence_p_corrected < level;
    if (is_different) return is_equivalent ? ContrastVerdict::small : ContrastVerdict::different;
    return is_equivalent ? ContrastVerdict::equivalent : ContrastVerdict::undecided;
}

void correct(std::vector<Contrast>& contrasts, double level) {
    std::map<Family, std::vector<Contrast*>> families;
    for (Contrast& contrast : contrasts) families[family_of(*contrast.arm)].push_back(&contrast);
    for (auto& [name, family] : families) {
        std::vector<double> difference;
        std::vector<double> equivalence;
        for (const Contrast* member : family) {
            difference.push_back(member->difference_p_value);
            equivalence.push_back(member->equivalence_p_value);
        }
        difference = statistics::holm(difference);
        equivalence = statistics::holm(equivalence);
        for (std::size_t i = 0; i < family.size(); ++i) {
            family[i]->difference_p_corrected = difference[i];
            family[i]->equivalence_p_corrected = equivalence[i];
            family[i]->verdict = verdict_of(*family[i], level);
        }
    }
}

}  // namespace

std::string_view name_of(ContrastVerdict verdict) {
    switch (verdict) {
        case ContrastVerdict::equivalent:
            return "equivalent";
        case ContrastVerdict::small:
            return "small";
        case ContrastVerdict::different:
            return "different";
        case ContrastVerdict::undecided:
            break;
    }
    return "undecided";
}

std::vector<Contrast> contrast(const Input& input, const ContrastPlan& plan,
                               std::vector<std::string>* without_baseline) {
    check(plan);
    const std::vector<ArmNumbers> all = arm_numbers(input);
    std::vector<ContrastPair> pairs;
    for (const ArmNumbers& numbers : all) {
        const sim::Settings wanted = baseline_settings(plan, numbers.arm->settings);
        if (equal(wanted, numbers.arm->settings)) continue;
        const auto baseline = std::ranges::find_if(all, [&](const ArmNumbers& other) {
            return other.arm->profile == numbers.arm->profile && equal(other.arm->settings, wanted);
        });
        if (baseline != all.end()) {
            pairs.push_back({&numbers, &*baseline});
        } else if (without_baseline != nullptr) {
            without_baseline->push_back(numbers.arm->name);
        }
    }
    if (pairs.empty()) {
        throw InputError(
            fmt::format("study \"{}\": no arm has one to be held against, which would "
                        "differ from it in {} alone",
                        input.study, fmt::join(plan.baseline, ", ")));
    }
    return contrast_pairs(pairs, plan);
}

std::vector<Contrast> contrast_pairs(std::span<const ContrastPair> pairs,
                                     const ContrastPlan& plan) {
    check(plan);
    std::vector<Contrast> contrasts;
    for (const auto& [arm, baseline] : pairs)
        contrasts.push_back(contrast_of(*arm, *baseline, plan));
    correct(contrasts, plan.level);
    return contrasts;
}

}  // namespace gene_clocks::report
