#include "sim/report/contrast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/settings/input_error.hpp"
#include "sim/statistics/bootstrap.hpp"
#include "sim/statistics/mann_whitney.hpp"
#include "sim/statistics/quantiles.hpp"

namespace gene_clocks::report {
namespace {

using experiment::InputError;

Contrast contrast_of(const ArmNumbers& arm, const ArmNumbers& baseline, const ContrastPlan& plan) {
    const std::vector<double>& x = values_of(arm, plan);
    const std::vector<double>& y = values_of(baseline, plan);
    const SharedTrajectories shared = share_trajectories(arm, baseline);
    Contrast contrast;
    contrast.arm = arm.arm;
    contrast.baseline = baseline.arm;
    contrast.best = arm.best;
    contrast.runs = x.size();
    contrast.baseline_runs = y.size();
    contrast.pairs = shared.pairs;
    contrast.identical = shared.identical;
    contrast.median = statistics::median(x);
    contrast.baseline_median = statistics::median(y);
    contrast.margin = plan.margin_share * std::fabs(contrast.baseline_median);
    if (!(contrast.margin > 0.0)) {
        throw InputError(fmt::format(
            "arm \"{}\": its median {} is 0, and a margin is a share of that; choose another "
            "measure with --measure",
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

InputError nothing_to_compare(const Input& input, const std::vector<std::string>& left_out) {
    std::string what = fmt::format("study \"{}\": there is nothing to compare", input.study);
    if (!left_out.empty()) what += "; " + left_out.front();
    return InputError(what +
                      "; choose what is compared by --baseline KEY=VALUE or --against ARM, and in "
                      "what by --measure NAME");
}

}  // namespace

Family family_of(const Contrast& contrast) {
    return family_of(*contrast.arm);
}

std::vector<Contrast> contrast_pairs(std::span<const ContrastPair> pairs,
                                     const ContrastPlan& plan) {
    check(plan);
    std::vector<Contrast> contrasts;
    for (const auto& [arm, baseline] : pairs)
        contrasts.push_back(contrast_of(*arm, *baseline, plan));
    correct_by_family(contrasts, plan.level);
    return contrasts;
}

Contrasts contrast(const Input& input, const ContrastPlan& plan, const ContrastPlan& paired_plan) {
    check(plan);
    check(paired_plan);
    const std::vector<ArmNumbers> all = arm_numbers(input);
    Contrasts contrasts;
    const std::vector<ContrastPair> pairs = pair_with_baselines(all, plan, contrasts.left_out);
    std::vector<std::string> left_out_of_paired;
    const std::vector<ContrastPair> paired =
        pair_with_baselines(all, paired_plan, left_out_of_paired);
    for (std::string& what : left_out_of_paired) {
        if (std::ranges::find(contrasts.left_out, what) == contrasts.left_out.end())
            contrasts.left_out.push_back(std::move(what));
    }
    if (pairs.empty()) throw nothing_to_compare(input, contrasts.left_out);
    contrasts.arms = contrast_pairs(pairs, plan);
    contrasts.paired = paired_contrasts(paired, paired_plan, &contrasts.left_out);
    return contrasts;
}

}  // namespace gene_clocks::report
