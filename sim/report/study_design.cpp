#include "sim/report/study_design.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "sim/settings/input_error.hpp"
#include "sim/settings/profile.hpp"

namespace gene_clocks::report {
namespace {

using experiment::Setting;
using experiment::Value;

bool is_number(const Value& value) {
    return std::holds_alternative<std::int64_t>(value) || std::holds_alternative<double>(value);
}

const sim::Settings& settings_of(const GroupArm& arm) {
    return arm.numbers->arm->settings;
}

/// How much a setting says of those that are linked with it: a count more than a measure, which may
/// be derived from one, and either more than a choice.
int telling(const Setting* setting) {
    const Value value = setting->default_value();
    if (std::holds_alternative<std::int64_t>(value)) return 0;
    return is_number(value) ? 1 : 2;
}

/// What varies but for task and source. The most telling first, each kind in the table's order,
/// since the first of settings that are linked names them.
std::vector<const Setting*> varied_settings(const Group& group) {
    std::set<std::string> keys;
    for (const GroupArm& arm : group.arms) {
        keys.merge([&] {
            const auto differing =
                experiment::differing_keys(settings_of(group.arms.front()), settings_of(arm));
            return std::set<std::string>(differing.begin(), differing.end());
        }());
    }
    keys.erase("source");
    std::vector<const Setting*> varied;
    for (const Setting& setting : experiment::settings_table()) {
        if (keys.contains(setting.key)) varied.push_back(&setting);
    }
    std::ranges::stable_sort(varied, {}, telling);
    return varied;
}

/// Whether arms with the same value of `one` have the same value of `other`.
bool determines(const Setting& one, const Setting& other, const Group& group) {
    std::map<Value, Value> seen;
    return std::ranges::all_of(group.arms, [&](const GroupArm& arm) {
        const Value value = other.get(settings_of(arm));
        return seen.emplace(one.get(settings_of(arm)), value).first->second == value;
    });
}

/// Distributes the settings: each to the first that determines it, or to a factor of its own.
std::vector<Factor> link(const std::vector<const Setting*>& varied, const Group& group) {
    std::vector<Factor> factors;
    std::vector<bool> taken(varied.size(), false);
    for (std::size_t i = 0; i < varied.size(); ++i) {
        const auto follows = [&](std::size_t j) {
            return j != i && determines(*varied[j], *varied[i], group) &&
                   (j < i || !determines(*varied[i], *varied[j], group));
        };
        for (std::size_t j = 0; j < varied.size() && !taken[i]; ++j) taken[i] = follows(j);
        if (!taken[i]) factors.push_back({.settings = {varied[i]}, .levels = {}});
    }
    for (std::size_t i = 0; i < varied.size(); ++i) {
        if (!taken[i]) continue;
        const auto leader = std::ranges::find_if(factors, [&](const Factor& factor) {
            return determines(*factor.settings.front(), *varied[i], group);
        });
        leader->settings.push_back(varied[i]);
    }
    return factors;
}

std::vector<Value> values_of(const Factor& factor, const sim::Settings& settings) {
    std::vector<Value> values;
    for (const Setting* setting : factor.settings) values.push_back(setting->get(settings));
    return values;
}

std::size_t level_of(const Factor& factor, const GroupArm& arm) {
    const auto level = std::ranges::find(factor.levels, values_of(factor, settings_of(arm)));
    return static_cast<std::size_t>(level - factor.levels.begin());
}

std::optional<sim::Settings> plain_settings(const Group& group) {
    try {
        return experiment::select({.task = group.task, .profile = group.profile});
    } catch (const experiment::InputError&) {
        return std::nullopt;  // a profile that was a file, and is gone
    }
}

void fill_levels(Factor& factor, const Group& group) {
    for (const GroupArm& arm : group.arms) {
        if (level_of(factor, arm) == factor.levels.size())
            factor.levels.push_back(values_of(factor, settings_of(arm)));
    }
    if (factor.is_numeric()) std::ranges::sort(factor.levels);
    factor.base = level_of(factor, group.arms.front());
    if (const auto plain = plain_settings(group)) {
        const Setting& leader = *factor.settings.front();
        const auto usual = std::ranges::find(factor.levels, leader.get(*plain),
                                             [](const auto& level) { return level.front(); });
        if (usual != factor.levels.end())
            factor.base = static_cast<std::size_t>(usual - factor.levels.begin());
    }
}

std::optional<sim::Source> baseline_source(const Group& group) {
    std::set<sim::Source> sources;
    for (const GroupArm& arm : group.arms) sources.insert(settings_of(arm).source);
    if (sources.size() < 2) return std::nullopt;
    return *sources.begin();  // gene clocks are the first of all
}

/// The arms by task and profile, then split by parameter set where every arm has one.
std::vector<Group> sort_arms(const std::vector<Comparison>& comparisons) {
    std::map<Family, bool> all_named;
    for (const Comparison& comparison : comparisons) {
        all_named.try_emplace({comparison.settings.task, comparison.profile}, true).first->second &=
            !comparison.parameters.empty();
    }
    std::vector<Group> groups;
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
        const Comparison& comparison = comparisons[i];
        const sim::Task task = comparison.settings.task;
        const bool is_named = all_named.at({task, comparison.profile});
        const std::string parameters = is_named ? comparison.parameters : "";
        auto group = std::ranges::find_if(groups, [&](const Group& other) {
            return other.task == task && other.profile == comparison.profile &&
                   other.parameters == parameters;
        });
        if (group == groups.end()) {
            groups.push_back({.task = task,
                              .profile = comparison.profile,
                              .parameters = parameters,
                              .arms = {},
                              .factors = {},
                              .baseline = {}});
            group = std::prev(groups.end());
        }
        for (std::size_t j = 0; j < comparison.arms.size(); ++j)
            group->arms.push_back({&comparison.arms[j], i, j, {}});
    }
    return groups;
}

/// Where an arm is sought.
struct Place {
    sim::Source source{};
    std::vector<std::size_t> levels;
};

const GroupArm* find_arm(const Group& group, const Place& place) {
    const auto found = std::ranges::find_if(group.arms, [&](const GroupArm& arm) {
        return settings_of(arm).source == place.source && arm.levels == place.levels;
    });
    return found == group.arms.end() ? nullptr : &*found;
}

enum class Part : bool { treatments, conditions };

/// Where an arm would stand if one part of what varies were at its base.
Place with_base(const Group& group, Place place, Part part) {
    if (part == Part::treatments && group.baseline) place.source = *group.baseline;
    for (std::size_t i = 0; i < group.factors.size(); ++i) {
        const Factor& factor = group.factors[i];
        if (group.is_treatment(factor) == (part == Part::treatments)) place.levels[i] = factor.base;
    }
    return place;
}

std::vector<Pairing> pair(const Group& group, Part part) {
    const Part other = part == Part::treatments ? Part::conditions : Part::treatments;
    std::vector<Pairing> pairings;
    for (const GroupArm& arm : group.arms) {
        const Place own{settings_of(arm).source, arm.levels};
        const Place nearest = with_base(group, own, part);
        if (nearest.source == own.source && nearest.levels == own.levels) continue;
        const GroupArm* baseline = find_arm(group, nearest);
        if (baseline == nullptr) baseline = find_arm(group, with_base(group, nearest, other));
        if (baseline != nullptr && baseline != &arm) pairings.push_back({&arm, baseline});
    }
    return pairings;
}

}  // namespace

bool Factor::is_numeric() const {
    return is_number(settings.front()->default_value());
}

bool Group::is_treatment(const Factor& factor) const {
    return !baseline && !factor.is_numeric();
}

std::vector<Group> groups_of(const std::vector<Comparison>& comparisons) {
    std::vector<Group> groups = sort_arms(comparisons);
    for (Group& group : groups) {
        group.baseline = baseline_source(group);
        group.factors = link(varied_settings(group), group);
        for (Factor& factor : group.factors) {
            fill_levels(factor, group);
            for (GroupArm& arm : group.arms) arm.levels.push_back(level_of(factor, arm));
        }
    }
    return groups;
}

std::vector<Pairing> pair_treatments(const Group& group) {
    return pair(group, Part::treatments);
}

std::vector<Pairing> pair_conditions(const Group& group) {
    return pair(group, Part::conditions);
}

}  // namespace gene_clocks::report
