#pragma once

#include <cstdint>
#include <gene_clocks/sim/arena.hpp>
#include <gene_clocks/sim/settings.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/experiment/study/contrast_table.hpp"
#include "sim/experiment/study/runner.hpp"
#include "sim/settings/document.hpp"

namespace gene_clocks::experiment {

/// One arm of a study: settings, run once for each of the study's seeds.
struct Arm {
    std::string name;
    std::string profile;
    std::string parameters;  ///< the parameter set; empty where the arm uses none
    sim::Settings settings;
    sim::Arena arena;
    std::string canonical;      ///< canonical_text of settings and arena
    std::string settings_hash;  ///< hash_of(canonical)
};

/// Arms × seeds. Every arm has the same seeds, so that arms can be compared in pairs.
struct Study {
    std::string name;  ///< letters, digits and hyphens; a quick study's ends in "-quick"
    std::string title;
    std::string description;
    std::uint64_t first_seed = 1;
    std::int64_t seeds = 1;
    std::vector<Arm> arms;
    std::optional<ContrastTable> contrast = {};  ///< its table [contrast], if it has one
};

/// What the command line may change about a study.
struct StudyOptions {
    bool quick = false;                         ///< with the changes of the file's section [quick]
    std::optional<std::int64_t> seeds = {};     ///< instead of the file's
    std::vector<std::string> assignments = {};  ///< "key=value", over the settings of every arm
};

/// Reads a study, each [[arm]] of which stands for one arm or, where it has lists, for several
/// (expand_arm). Each arm's settings are those of its profile, task and parameter set, then the
/// study's [settings], the arm's settings, [quick.settings], and the options' assignments.
/// Throws InputError, with file, line and key.
Study read_study(const Document& document, const StudyOptions& options = {});

/// Runs each arm for one cycle, so that what only the simulator can refuse (an arena with no free
/// place for the robots) is refused before anything is written. Throws InputError.
void rehearse(const Study& study, const RunFunction& simulate = sim::simulate);

}  // namespace gene_clocks::experiment
