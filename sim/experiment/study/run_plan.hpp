#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/experiment/study/runner.hpp"
#include "sim/experiment/study/study.hpp"

namespace gene_clocks::experiment {

/// One of the parts into which the runs of a study are divided among machines or jobs.
struct Shard {
    std::int64_t index = 1;
    std::int64_t count = 1;  ///< Invariant: 1 <= index <= count <= shards_maximum.

    [[nodiscard]] bool is_all() const { return count == 1; }
    friend bool operator==(const Shard&, const Shard&) = default;
};

inline constexpr std::int64_t shards_maximum = 1'000'000;

/// The shard that "2/4" means: the second of four. Throws InputError where a text means none.
Shard parse_shard(const std::string& text);

/// The run of an arm with that seed. It refers to the arm.
PlannedRun planned_run(const Arm& arm, std::uint64_t seed);

/// The runs of a study, or of one shard of it, each once: two arms with the same settings share
/// their runs. They refer to the study, which must outlive them.
///
/// The shards of a study have no run in common and together have them all. Of each arm, and so of
/// all runs, every shard has as many as any other, or one more or less. Which run belongs to which
/// shard depends on the study and the number of shards alone.
std::vector<PlannedRun> plan_runs(const Study& study, const Shard& shard = {});

}  // namespace gene_clocks::experiment
