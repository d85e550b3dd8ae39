#include "sim/report/contrast_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "sim/experiment/study/measures.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/settings_io.hpp"
#include "sim/settings/settings_table.hpp"
#include "sim/settings/suggestion.hpp"
#include "sim/statistics/quantiles.hpp"

namespace gene_clocks::report {
namespace {

using experiment::InputError;

bool equal(const sim::Settings& one, const sim::Settings& other) {
    return experiment::differing_keys(one, other).empty();
}

sim::Settings baseline_settings(const ContrastPlan& plan, sim::Settings settings) {
    for (const std::string& assignment : plan.baseline) {
        experiment::assign(settings, assignment, "--baseline");
    }
    return settings;
}

/// The arms that the plan names, by what they stand for.
std::map<Family, const ArmNumbers*> named_baselines(const std::vector<ArmNumbers>& all,
                                                    const ContrastPlan& plan) {
    std::vector<std::string> names;
    for (const ArmNumbers& numbers : all) names.push_back(numbers.arm->name);
    std::map<Family, const ArmNumbers*> baselines;
    for (const std::string& name : plan.against) {
        const auto place = std::ranges::find(names, name);
        if (place == names.end()) {
            throw InputError(fmt::format("--against: there is no arm \"{}\" with runs{}", name,
                                         experiment::suggestion(name, names)));
        }
        if (std::ranges::count(names, name) > 1) {
            throw InputError(fmt::format(
                "--against: several studies have an arm \"{}\"; choose one by --study", name));
        }
        const ArmNumbers& numbers = all[static_cast<std::size_t>(place - names.begin())];
        const auto [known, is_new] = baselines.emplace(family_of(*numbers.arm), &numbers);
        if (!is_new && known->second != &numbers) {
            throw InputError(fmt::format(
                "--against: \"{}\" and \"{}\" are of one task and profile; name one of them",
                known->second->arm->name, name));
        }
    }
    return baselines;
}

/// The baseline of an arm; itself if it is one, null where there is none.
const ArmNumbers* baseline_of(const ArmNumbers& numbers, const std::vector<ArmNumbers>& all,
                              const ContrastPlan& plan) {
    const sim::Settings wanted = baseline_settings(plan, numbers.arm->settings);
    if (equal(wanted, numbers.arm->settings)) return &numbers;
    const auto baseline = std::ranges::find_if(all, [&](const ArmNumbers& other) {
        return other.arm->profile == numbers.arm->profile && equal(other.arm->settings, wanted);
    });
    return baseline == all.end() ? nullptr : &*baseline;
}

}  // namespace

ContrastPlan with_baselines(ContrastPlan plan, const experiment::Baselines& baselines) {
    if (!baselines.baseline.empty()) plan.baseline = baselines.baseline;
    plan.against = baselines.against;
    plan.over = baselines.over;
    return plan;
}

void check(const ContrastPlan& plan) {
    std::vector<std::string> names;
    for (const experiment::Measure& measure : experiment::measures) names.emplace_back(measure.id);
    if (std::ranges::find(names, plan.measure) == names.end()) {
        throw InputError(fmt::format("there is no measure \"{}\"{}; there are {}", plan.measure,
                                     experiment::suggestion(plan.measure, names),
                                     fmt::join(names, ", ")));
    }
    const auto is_share = [](double value) { return value > 0.0 && value < 1.0; };
    if (!is_share(plan.margin_share)) throw InputError("--margin: is not between 0 and 1");
    if (!is_share(plan.level)) throw InputError("--level: is not between 0 and 1");
    for (const std::string& key : plan.over) {
        if (experiment::find_setting(key) == nullptr) {
            throw InputError(fmt::format("--over: there is no setting \"{}\"{}", key,
                                         experiment::suggest_setting(key)));
        }
    }
}

std::string_view name_of(ContrastVerdict verdict) {
    switch (verdict) {
        case ContrastVerdict::equivalent:
            return "equivalent";
        case ContrastVerdict::small:
            return "small";
        case ContrastVerdict::different:
            return "different";
        case ContrastVerdict::undecided:
            return "undecided";
        case ContrastVerdict::identical:
            return "identical";
    }
    throw std::logic_error("unknown verdict");
}

ContrastVerdict verdict_of(double difference_p_value, double equivalence_p_value, double level) {
    const bool is_equivalent = equivalence_p_value < level;
    if (difference_p_value < level)
        return is_equivalent ? ContrastVerdict::small : ContrastVerdict::different;
    return is_equivalent ? ContrastVerdict::equivalent : ContrastVerdict::undecided;
}

std::vector<ContrastPair> pair_with_baselines(const std::vector<ArmNumbers>& all,
                                              const ContrastPlan& plan,
                                              std::vector<std::string>& left_out) {
    const std::map<Family, const ArmNumbers*> named = named_baselines(all, plan);
    std::vector<ContrastPair> pairs;
    for (const ArmNumbers& numbers : all) {
        const auto of_family = named.find(family_of(*numbers.arm));
        const ArmNumbers* baseline = of_family != named.end() ? of_family->second
                                     : named.empty()          ? baseline_of(numbers, all, plan)
                                                              : nullptr;
        const auto leave_out = [&](const std::string& why) {
            left_out.push_back(fmt::format("{} is left out: {}", numbers.arm->name, why));
        };
        if (baseline == nullptr) {
            leave_out(plan.against.empty()
                          ? fmt::format("there is no arm with runs that has {} and is otherwise "
                                        "the same",
                                        fmt::join(plan.baseline, " and "))
                          : "none of the arms to compare with has its task and profile");
        } else if (experiment::refers_to_best(plan.measure) &&
                   baseline->best.value != numbers.best.value) {
            leave_out(fmt::format(
                "its {} refers to the best swarm fitness over {}, that of {} to "
                "the best over {}",
                plan.measure, numbers.best.over, baseline->arm->name, baseline->best.over));
        } else if (baseline != &numbers && !has_margin({&numbers, baseline}, plan)) {
            leave_out(fmt::format("the median {} of {} is 0, and a margin is a share of that",
                                  plan.measure, baseline->arm->name));
        } else if (baseline != &numbers) {
            pairs.push_back({&numbers, baseline});
        }
    }
    return pairs;
}

bool has_margin(const ContrastPair& pair, const ContrastPlan& plan) {
    return statistics::median(values_of(*pair.baseline, plan)) != 0.0;
}

const std::vector<double>& values_of(const ArmNumbers& numbers, const ContrastPlan& plan) {
    const auto found = numbers.values.find(plan.measure);
    if (found == numbers.values.end() || found->second.size() != numbers.runs.size()) {
        throw InputError(fmt::format(
            "arm \"{}\": its runs are too short for {}; choose another measure with --measure",
            numbers.arm->name, plan.measure));
    }
    return found->second;
}

}  // namespace gene_clocks::report
