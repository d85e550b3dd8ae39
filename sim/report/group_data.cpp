#include "group_data.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "choice_names.hpp"
#include "contrast.hpp"
#include "statistics/quantiles.hpp"
#include "study_design.hpp"

namespace gene_clocks::report {
namespace {

using experiment::name_of;
using Json = nlohmann::ordered_json;

Json to_json(const statistics::Interval& interval) {
    return {interval.lower, interval.upper};
}

Json factor_json(const Factor& factor, bool is_treatment) {
    const experiment::Setting& leader = *factor.settings.front();
    Json json = {{"key", leader.key},
                 {"unit", leader.unit},
                 {"description", leader.description},
                 {"linked_keys", Json::array()},
                 {"numeric", factor.is_numeric()},
                 {"treatment", is_treatment},
                 {"levels", Json::array()},
                 {"base", factor.base}};
    for (std::size_t i = 1; i < factor.settings.size(); ++i)
        json["linked_keys"].push_back(factor.settings[i]->key);
    for (const auto& values : factor.levels) {
        Json level = Json::array();
        for (const experiment::Value& value : values)
            level.push_back(std::visit([](const auto& held) { return Json(held); }, value));
        json["levels"].push_back(std::move(level));
    }
    return json;
}

Json arm_json(const GroupArm& arm) {
    return {{"name", arm.numbers->arm->name},
            {"source", name_of(arm.numbers->arm->settings.source)},
            {"levels", arm.levels},
            {"comparison", arm.comparison},
            {"arm", arm.index}};
}

Json contrast_json(const Contrast& contrast) {
    return {{"runs", contrast.runs},
            {"baseline_runs", contrast.baseline_runs},
            {"pairs", contrast.pairs},
            {"identical", contrast.identical},
            {"median", contrast.median},
            {"baseline_median", contrast.baseline_median},
            {"margin", contrast.margin},
            {"shift", contrast.shift.estimate},
            {"shift_interval", to_json(contrast.shift.interval)},
            {"effect", contrast.effect},
            {"effect_interval", to_json(contrast.effect_interval)},
            {"difference_p_value", contrast.difference_p_value},
            {"difference_p_corrected", contrast.difference_p_corrected},
            {"equivalence_p_value", contrast.equivalence_p_value},
            {"equivalence_p_corrected", contrast.equivalence_p_corrected},
            {"power_equivalence", contrast.power.equivalence},
            {"power_difference", contrast.power.difference},
            {"verdict", name_of(contrast.verdict)}};
}

/// The margin is a share of the baseline's median, so that none of zero makes one.
bool has_margin(const Pairing& pairing, const ContrastPlan& plan) {
    return statistics::median(pairing.baseline->numbers->values.at(plan.measure)) != 0.0;
}

std::vector<Pairing> with_margin(std::vector<Pairing> pairings, const ContrastPlan& plan) {
    std::erase_if(pairings, [&](const Pairing& pairing) { return !has_margin(pairing, plan); });
    return pairings;
}

std::vector<ContrastPair> numbers_of(const std::vector<Pairing>& pairings) {
    std::vector<ContrastPair> pairs;
    for (const auto& [arm, baseline] : pairings) pairs.push_back({arm->numbers, baseline->numbers});
    return pairs;
}

Json contrasts_json(const Group& group, const std::vector<Pairing>& pairings,
                    const ContrastPlan& plan) {
    const std::vector<Contrast> contrasts = contrast_pairs(numbers_of(pairings), plan);
    Json json = Json::array();
    for (std::size_t i = 0; i < contrasts.size(); ++i) {
        Json row = {{"arm", pairings[i].arm - group.arms.data()},
                    {"baseline", pairings[i].baseline - group.arms.data()}};
        row.update(contrast_json(contrasts[i]));
        json.push_back(std::move(row));
    }
    return json;
}

Json paired_json(const PairedContrast& contrast) {
    return {{"changes", contrast.changes},
            {"arms", contrast.arms},
            {"seeds", contrast.seeds},
            {"identical", contrast.identical},
            {"baseline_mean", contrast.baseline_mean},
            {"margin", contrast.margin},
            {"difference", contrast.test.mean},
            {"difference_interval", to_json(contrast.test.interval)},
            {"difference_p_value", contrast.difference_p_value},
            {"difference_p_corrected", contrast.difference_p_corrected},
            {"equivalence_p_value", contrast.equivalence_p_value},
            {"equivalence_p_corrected", contrast.equivalence_p_corrected},
            {"power_equivalence", contrast.power.equivalence},
            {"power_difference", contrast.power.difference},
            {"verdict", name_of(contrast.verdict)}};
}

/// Of the treatments, over all conditions.
Json paired_contrasts_json(const Group& group, const std::vector<ContrastPair>& pairs,
                           ContrastPlan plan) {
    for (const Factor& factor : group.factors) {
        if (group.is_treatment(factor)) continue;
        for (const experiment::Setting* setting : factor.settings)
            plan.over.push_back(setting->key);
    }
    Json json = Json::array();
    for (const PairedContrast& contrast : paired_contrasts(pairs, plan))
        json.push_back(paired_json(contrast));
    return json;
}

Json group_json(const Group& group, const ContrastPlan& plan) {
    Json json = {{"task", name_of(group.task)},
                 {"profile", group.profile},
                 {"parameters", group.parameters},
                 {"baseline_source", nullptr},
                 {"measure", plan.measure},
                 {"margin_share", plan.margin_share},
                 {"level", plan.level},
                 {"factors", Json::array()},
                 {"arms", Json::array()}};
    if (group.baseline) json["baseline_source"] = name_of(*group.baseline);
    for (const Factor& factor : group.factors)
        json["factors"].push_back(factor_json(factor, group.is_treatment(factor)));
    for (const GroupArm& arm : group.arms) json["arms"].push_back(arm_json(arm));
    const std::vector<Pairing> treatments = with_margin(pair_treatments(group), plan);
    json["treatment_contrasts"] = contrasts_json(group, treatments, plan);
    json["condition_contrasts"] =
        contrasts_json(group, with_margin(pair_conditions(group), plan), plan);
    json["paired_contrasts"] = paired_contrasts_json(group, numbers_of(treatments), plan);
    return json;
}

}  // namespace

nlohmann::ordered_json groups_json(const std::vector<Comparison>& comparisons) {
    Json json = Json::array();
    for (const Group& group : groups_of(comparisons))
        json.push_back(group_json(group, ContrastPlan{}));
    return json;
}

}  // namespace gene_clocks::report
