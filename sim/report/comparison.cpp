#include "sim/report/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "sim/experiment/study/measures.hpp"
#include "sim/experiment/study/summary.hpp"
#include "sim/report/published.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/profile.hpp"
#include "sim/settings/settings_table.hpp"

namespace gene_clocks::report {
namespace {

using experiment::InputError;

bool is_finite(const sim::Sample& sample) {
    bool is_finite = true;
    sim::for_each_value(sample, [&](const char*, auto value) {
        is_finite = is_finite && std::isfinite(static_cast<double>(value));
    });
    return is_finite;
}

void require_sound(const ArmNumbers& numbers) {
    const std::string& name = numbers.arm->name;
    const std::vector<sim::Sample>& first = numbers.runs.front()->result.samples;
    const Run* previous = nullptr;
    for (const Run* run : numbers.runs) {
        const std::vector<sim::Sample>& samples = run->result.samples;
        const auto refuse = [&](std::string_view what) {
            throw InputError(fmt::format("arm \"{}\", seed {}: {}", name, run->seed, what));
        };
        if (previous != nullptr && previous->seed == run->seed) refuse("the seed occurs twice");
        if (samples.empty()) refuse("the run has no samples");
        if (!std::ranges::all_of(samples, is_finite)) refuse("a sample is not a number");
        if (!std::ranges::is_sorted(samples, std::ranges::less_equal{}, &sim::Sample::cycle))
            refuse("the samples are not in the order of their cycles");
        if (!std::ranges::equal(samples, first, {}, &sim::Sample::cycle, &sim::Sample::cycle))
            refuse("the run was sampled at other cycles than the arm's first run");
        previous = run;
    }
}

ArmNumbers order_runs(const ArmRuns& arm) {
    ArmNumbers numbers;
    numbers.arm = &arm;
    for (const Run& run : arm.runs) numbers.runs.push_back(&run);
    std::ranges::sort(numbers.runs, {}, &Run::seed);
    require_sound(numbers);
    return numbers;
}

/// Whether two arms may be compared: all else but the source is the same.
bool comparable(const ArmRuns& one, const ArmRuns& other) {
    return one.profile == other.profile &&
           experiment::differing_keys(one.settings, other.settings) ==
               std::vector<std::string>{"source"};
}

/// The name of the parameter set that the settings hold; empty where they hold none.
std::string parameter_set_in(const sim::Settings& settings) {
    for (const std::string& name : experiment::parameter_set_names()) {
        const sim::Settings set = experiment::select({.task = settings.task, .parameters = name});
        const auto is_set = [&](std::string_view key) {
            const experiment::Setting& setting = *experiment::find_setting(key);
            return setting.get(set) == setting.get(settings);
        };
        if (std::ranges::all_of(tuned_keys, is_set)) return name;
    }
    return {};
}

Role role_of(const Comparison& comparison) {
    const PublishedTask& task = published().tasks.at(comparison.settings.task);
    if (comparison.parameters == task.run_parameters) return Role::as_run;
    if (comparison.parameters == task.printed_parameters) return Role::as_printed;
    return Role::other;
}

/// `best` is what t_f and f_a refer to.
void fill_values(ArmNumbers& numbers, const experiment::BestSwarmFitness& best) {
    numbers.best = best;
    for (const Run* run : numbers.runs) {
        const auto summary =
            experiment::summarise(run->result.samples, numbers.arm->settings.measures, best);
        for (const experiment::Measure& measure : experiment::measures) {
            if (const auto value = measure.of(summary))
                numbers.values[measure.id].push_back(*value);
        }
    }
}

std::vector<std::uint64_t> shared_seeds(const ArmNumbers& x, const ArmNumbers& y) {
    std::vector<std::uint64_t> of_x;
    std::vector<std::uint64_t> of_y;
    std::ranges::transform(x.runs, std::back_inserter(of_x), &Run::seed);
    std::ranges::transform(y.runs, std::back_inserter(of_y), &Run::seed);
    std::vector<std::uint64_t> shared;
    std::ranges::set_intersection(of_x, of_y, std::back_inserter(shared));
    return shared;
}

/// The values of the runs, less those with every other one of the shared seeds, from `first` on.
std::vector<double> values_without(const ArmNumbers& numbers, std::string_view measure,
                                   const std::vector<std::uint64_t>& shared, std::size_t first) {
    const auto found = numbers.values.find(measure);
    if (found == numbers.values.end()) return {};
    std::vector<double> kept;
    for (std::size_t i = 0; i < numbers.runs.size(); ++i) {
        const auto position = std::ranges::lower_bound(shared, numbers.runs[i]->seed);
        const bool is_shared = position != shared.end() && *position == numbers.runs[i]->seed;
        const auto rank = static_cast<std::size_t>(position - shared.begin());
        if (!is_shared || rank % 2 != first) kept.push_back(found->second[i]);
    }
    return kept;
}

const Run& run_of(const ArmNumbers& numbers, std::uint64_t seed) {
    return **std::ranges::lower_bound(numbers.runs, seed, {}, &Run::seed);
}

using SampleValues = std::array<double, sim::sample_values>;

SampleValues values_in(const sim::Sample& sample) {
    SampleValues values{};
    sim::for_each_value(sample, [place = values.begin()](const char*, auto value) mutable {
        *place++ = static_cast<double>(value);
    });
    return values;
}

bool equal_samples(const sim::Sample& one, const sim::Sample& other) {
    return values_in(one) == values_in(other);
}

}  // namespace

const ArmNumbers* Comparison::arm(sim::Source source) const {
    const auto found = std::ranges::find(
        arms, source, [](const ArmNumbers& numbers) { return numbers.arm->settings.source; });
    return found == arms.end() ? nullptr : &*found;
}

std::vector<ArmNumbers> arm_numbers(const Input& input) {
    std::vector<ArmNumbers> all;
    experiment::ComparedRuns compared;
    for (const ArmRuns& arm : input.arms) {
        if (arm.runs.empty()) continue;
        all.push_back(order_runs(arm));
        for (const Run& run : arm.runs)
            compared.add(family_of(arm), {arm.settings_hash, run.seed}, run.result.samples);
    }
    for (ArmNumbers& numbers : all) {
        const ArmRuns& arm = *numbers.arm;
        fill_values(numbers, compared.best(family_of(arm), arm.settings.measures));
    }
    return all;
}

std::vector<Comparison> compare(const Input& input) {
    std::vector<Comparison> comparisons;
    for (ArmNumbers& numbers : arm_numbers(input)) {
        const ArmRuns& arm = *numbers.arm;
        const auto partner = std::ranges::find_if(comparisons, [&](const Comparison& comparison) {
            return std::ranges::all_of(comparison.arms, [&](const ArmNumbers& other) {
                return comparable(*other.arm, arm);
            });
        });
        if (partner != comparisons.end()) {
            partner->arms.push_back(std::move(numbers));
            continue;
        }
        Comparison& comparison = comparisons.emplace_back();
        comparison.profile = arm.profile;
        comparison.parameters = parameter_set_in(arm.settings);
        comparison.settings = arm.settings;
        comparison.role = role_of(comparison);
        comparison.best = numbers.best;
        comparison.arms.push_back(std::move(numbers));
    }
    if (comparisons.empty()) {
        throw InputError(
            fmt::format("study \"{}\": there are no finished runs to report on", input.study));
    }
    for (Comparison& comparison : comparisons) {
        std::ranges::sort(comparison.arms, {},
                          [](const ArmNumbers& numbers) { return numbers.arm->settings.source; });
    }
    return comparisons;
}

Family family_of(const ArmRuns& arm) {
    return {arm.settings.task, arm.profile};
}

std::optional<std::pair<std::vector<double>, std::vector<double>>> independent_halves(
    const ArmNumbers& x, const ArmNumbers& y, std::string_view measure) {
    const std::vector<std::uint64_t> shared = shared_seeds(x, y);
    if (shared.empty()) return std::nullopt;
    auto of_x = values_without(x, measure, shared, 1);
    auto of_y = values_without(y, measure, shared, 0);
    if (of_x.empty() || of_y.empty()) return std::nullopt;
    return std::pair(std::move(of_x), std::move(of_y));
}

SharedTrajectories share_trajectories(const ArmNumbers& x, const ArmNumbers& y) {
    SharedTrajectories shared;
    for (const std::uint64_t seed : shared_seeds(x, y)) {
        const sim::RunResult& one = run_of(x, seed).result;
        const sim::RunResult& other = run_of(y, seed).result;
        ++shared.pairs;
        if (one.trajectory_hash == other.trajectory_hash) {
            ++shared.identical;
            continue;
        }
        const auto different = std::ranges::mismatch(one.samples, other.samples, equal_samples).in1;
        if (different != one.samples.end())
            shared.first_difference_cycles.push_back(static_cast<double>(different->cycle));
    }
    return shared;
}

}  // namespace gene_clocks::report
