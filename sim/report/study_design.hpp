#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/report/comparison.hpp"
#include "sim/settings/settings_table.hpp"

namespace gene_clocks::report {

/// Settings that a study varies together: the first determines the others and names them all.
struct Factor {
    std::vector<const experiment::Setting*> settings;  ///< never empty
    /// By level, the values of `settings`: numbers ascending, else in the order of the arms.
    std::vector<std::vector<experiment::Value>> levels;
    std::size_t base{};  ///< the level that profile and task give, or else that of the first arm

    [[nodiscard]] bool is_numeric() const;
};

/// An arm and where it stands in its group.
struct GroupArm {
    const ArmNumbers* numbers{};
    std::size_t comparison{};         ///< that holds it
    std::size_t index{};              ///< among the arms of that comparison
    std::vector<std::size_t> levels;  ///< by factor
};

/// Arms that a study sets side by side: of one task and one profile. Where all of these hold a
/// named parameter set, also of one parameter set.
struct Group {
    sim::Task task{};
    std::string profile;
    std::string parameters;  ///< the set; empty where not all arms hold one
    std::vector<GroupArm> arms;
    std::vector<Factor> factors;          ///< all that varies but the source
    std::optional<sim::Source> baseline;  ///< gene clocks, or else the first; none: one source only

    /// The factors that stand beside the source as what is compared, not under which conditions:
    /// the choices of a study with a single source.
    [[nodiscard]] bool is_treatment(const Factor& factor) const;
};

/// The groups of the arms in `comparisons`, in their order; points into them.
std::vector<Group> groups_of(const std::vector<Comparison>& comparisons);

/// Two arms of a group, the second of which is the baseline.
struct Pairing {
    const GroupArm* arm{};
    const GroupArm* baseline{};
};

/// Each arm against the one with the baseline's source (of a single source: with the base levels of
/// all choices) that is otherwise the same. Where there is none, against that whose other settings
/// are at their base levels, too. In the order of the arms; the baselines themselves are left out.
std::vector<Pairing> pair_treatments(const Group& group);

/// Each arm against the one of the same source and choices whose other settings are at their base
/// levels; where there is none, against that of the base choices.
std::vector<Pairing> pair_conditions(const Group& group);

}  // namespace gene_clocks::report
