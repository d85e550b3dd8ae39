#include "sim/report/paired_contrast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "sim/settings/input_error.hpp"
#include "sim/settings/settings_table.hpp"
#include "sim/statistics/quantiles.hpp"

namespace gene_clocks::report {
namespace {

/// Pairs of arms that change their baselines in the same way.
struct Change {
    Family family;
    std::vector<std::string> settings;  ///< as in "source=timestamp"
    std::vector<ContrastPair> pairs;
};

std::vector<std::string> changed_settings(const ContrastPair& pair, const ContrastPlan& plan) {
    std::vector<std::string> changed;
    for (const std::string& key :
         experiment::differing_keys(pair.baseline->arm->settings, pair.arm->arm->settings)) {
        if (std::ranges::find(plan.over, key) != plan.over.end()) continue;
        const experiment::Setting& setting = *experiment::find_setting(key);
        changed.push_back(
            fmt::format("{}={}", key, experiment::to_text(setting.get(pair.arm->arm->settings))));
    }
    return changed;
}

std::vector<Change> changes_of(std::span<const ContrastPair> pairs, const ContrastPlan& plan) {
    std::vector<Change> changes;
    for (const ContrastPair& pair : pairs) {
        const Family family = family_of(*pair.arm->arm);
        std::vector<std::string> settings = changed_settings(pair, plan);
        auto change = std::ranges::find_if(changes, [&](const Change& known) {
            return known.family == family && known.settings == settings;
        });
        if (change == changes.end())
            change = changes.insert(changes.end(), {family, std::move(settings), {}});
        change->pairs.push_back(pair);
    }
    return changes;
}

/// What the arms of a change say under one seed.
struct OfSeed {
    std::size_t arms{};  ///< that hold it, as their baselines do
    std::size_t identical{};
    double difference{};  ///< summed over the arms
    double baseline{};    ///< likewise
};

void add_seeds(const ContrastPair& pair, const ContrastPlan& plan,
               std::map<std::uint64_t, OfSeed>& seeds) {
    const auto& [arm, baseline] = pair;
    const std::vector<double>& values = values_of(*arm, plan);
    const std::vector<double>& baseline_values = values_of(*baseline, plan);
    for (std::size_t i = 0; i < arm->runs.size(); ++i) {
        const Run& run = *arm->runs[i];
        const auto other = std::ranges::lower_bound(baseline->runs, run.seed, {}, &Run::seed);
        if (other == baseline->runs.end() || (*other)->seed != run.seed) continue;
        const double of_baseline =
            baseline_values[static_cast<std::size_t>(other - baseline->runs.begin())];
        OfSeed& seed = seeds[run.seed];
        ++seed.arms;
        if (run.result.trajectory_hash == (*other)->result.trajectory_hash) ++seed.identical;
        seed.difference += values[i] - of_baseline;
        seed.baseline += of_baseline;
    }
}

double margin_of(const Change& change, const ContrastPlan& plan) {
    double sum = 0.0;
    for (const ContrastPair& pair : change.pairs)
        sum += statistics::median(values_of(*pair.baseline, plan));
    return plan.margin_share * std::fabs(sum) / static_cast<double>(change.pairs.size());
}

std::optional<PairedContrast> contrast_of(const Change& change, const ContrastPlan& plan) {
    std::map<std::uint64_t, OfSeed> seeds;
    for (const ContrastPair& pair : change.pairs) add_seeds(pair, plan, seeds);
    std::erase_if(seeds,
                  [&](const auto& entry) { return entry.second.arms != change.pairs.size(); });
    if (seeds.size() < 2) return std::nullopt;

    PairedContrast contrast;
    contrast.family = change.family;
    contrast.changes = change.settings;
    contrast.first_arm = change.pairs.front().arm->arm;
    contrast.best = change.pairs.front().arm->best;
    contrast.arms = change.pairs.size();
    contrast.seeds = seeds.size();
    contrast.margin = margin_of(change, plan);
    if (!(contrast.margin > 0.0)) {
        throw experiment::InputError(fmt::format(
            "arm \"{}\": the median {} of its baseline is 0, and a margin is a share of that; "
            "choose another measure with --measure",
            change.pairs.front().arm->arm->name, plan.measure));
    }
    const auto arms = static_cast<double>(contrast.arms);
    std::vector<double> differences;
    for (const auto& [number, seed] : seeds) {
        differences.push_back(seed.difference / arms);
        contrast.identical += seed.identical;
        contrast.baseline_mean += seed.baseline / arms / static_cast<double>(seeds.size());
    }
    contrast.test = statistics::paired_test(differences, contrast.margin);
    contrast.difference_p_value = contrast.test.difference_p_value;
    contrast.equivalence_p_value = contrast.test.equivalence_p_value;
    contrast.power = statistics::paired_power(differences, contrast.margin, {.level = plan.level});
    return contrast;
}

}  // namespace

Family family_of(const PairedContrast& contrast) {
    return contrast.family;
}

std::vector<PairedContrast> paired_contrasts(std::span<const ContrastPair> pairs,
                                             const ContrastPlan& plan,
                                             std::vector<std::string>* left_out) {
    check(plan);
    std::vector<PairedContrast> contrasts;
    for (const Change& change : changes_of(pairs, plan)) {
        if (auto contrast = contrast_of(change, plan)) {
            contrasts.push_back(*std::move(contrast));
        } else if (left_out != nullptr) {
            left_out->push_back(fmt::format(
                "{} and the arms that differ from their baselines as it does are left out of what "
                "is compared seed by seed: fewer than two seeds are common to all of them",
                change.pairs.front().arm->arm->name));
        }
    }
    correct_by_family(contrasts, plan.level);
    for (PairedContrast& contrast : contrasts) {
        if (contrast.identical == contrast.arms * contrast.seeds)
            contrast.verdict = ContrastVerdict::identical;
    }
    return contrasts;
}

}  // namespace gene_clocks::report
