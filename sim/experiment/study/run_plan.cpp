#include "sim/experiment/study/run_plan.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <set>
#include <string_view>

namespace gene_clocks::experiment {
namespace {

/// The whole text as a number from 1 on.
std::optional<std::int64_t> parse_count(std::string_view text) {
    std::int64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc{} || result.ptr != end || value < 1) return std::nullopt;
    return value;
}

}  // namespace

Shard parse_shard(const std::string& text) {
    const auto slash = text.find('/');
    if (slash != std::string::npos) {
        const auto index = parse_count(std::string_view(text).substr(0, slash));
        const auto count = parse_count(std::string_view(text).substr(slash + 1));
        if (index && count && *index <= *count && *count <= shards_maximum) {
            return {*index, *count};
        }
    }
    throw InputError(
        fmt::format("--shard: \"{}\" is no part such as 2/4, the second of four (from 1/N to N/N, "
                    "N at most {})",
                    text, shards_maximum));
}

PlannedRun planned_run(const Arm& arm, std::uint64_t seed) {
    return {&arm.settings, &arm.arena, seed, arm.settings_hash,
            fmt::format("arm {}, seed {}", arm.name, seed)};
}

std::vector<PlannedRun> plan_runs(const Study& study, const Shard& shard) {
    std::vector<PlannedRun> planned_runs;
    std::set<std::string> planned;
    // Arm by arm, so that dealing the runs out in turn deals out each arm's evenly.
    std::int64_t position = 0;
    for (const Arm& arm : study.arms) {
        if (!planned.insert(arm.settings_hash).second) continue;
        for (std::int64_t i = 0; i < study.seeds; ++i) {
            if (position++ % shard.count != shard.index - 1) continue;
            planned_runs.push_back(
                planned_run(arm, study.first_seed + static_cast<std::uint64_t>(i)));
        }
    }
    return planned_runs;
}

}  // namespace gene_clocks::experiment
