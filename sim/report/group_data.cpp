#include "sim/report/group_data.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "sim/report/contrast.hpp"
#include "sim/report/interval_json.hpp"
#include "sim/report/study_design.hpp"
#include "sim/settings/choice_names.hpp"

namespace gene_clocks::report {
namespace {

using experiment::name_of;
using Json = nlohmann::ordered_json;

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

/// What arm by arm and seed by seed have in common.
template <typename AnyContrast>
Json tests_json(const AnyContrast& contrast) {
    return {{"difference_p_value", contrast.difference_p_value},
            {"difference_p_corrected", contrast.difference_p_corrected},
            {"equivalence_p_value", contrast.equivalence_p_value},
            {"equivalence_p_corrected", contrast.equivalence_p_corrected},
            {"power_equivalence", contrast.power.equivalence},
            {"power_difference", contrast.power.difference},
            {"verdict", name_of(contrast.verdict)}};
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
            {"effect_interval", to_json(contrast.effect_interval)}};
}

std::vector<Pairing> with_margin(std::vector<Pairing> pairings, const ContrastPlan& plan) {
    std::erase_if(pairings, [&](const Pairing& pairing) {
        return !has_margin({pairing.arm->numbers, pairing.baseline->numbers}, plan);
    });
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
        row.update(tests_json(contrasts[i]));
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
            {"difference_interval", to_json(contrast.test.interval)}};
}

/// Whether the two arms of a pairing differ in treatments alone.
bool are_under_the_same_conditions(const Group& group, const Pairing& pairing) {
    for (std::size_t i = 0; i < group.factors.size(); ++i) {
        if (!group.is_treatment(group.factors[i]) &&
            pairing.arm->levels[i] != pairing.baseline->levels[i])
            return false;
    }
    return true;
}

/// Of the treatments that have a counterpart under their own conditions.
Json paired_contrasts_json(const Group& group, std::vector<Pairing> treatments,
                           const ContrastPlan& plan) {
    std::erase_if(treatments, [&](const Pairing& pairing) {
        return !are_under_the_same_conditions(group, pairing);
    });
    Json json = Json::array();
    for (const PairedContrast& contrast : paired_contrasts(numbers_of(treatments), plan)) {
        Json row = paired_json(contrast);
        row.update(tests_json(contrast));
        json.push_back(std::move(row));
    }
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
    json["paired_contrasts"] = paired_contrasts_json(group, treatments, plan);
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
