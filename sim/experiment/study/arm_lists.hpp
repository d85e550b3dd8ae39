#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/settings/document.hpp"
#include "sim/settings/settings_io.hpp"

namespace gene_clocks::experiment {

/// One of the arms that an [[arm]] of a study's file stands for, not evaluated yet.
struct ArmPlan {
    std::string name;
    /// Task, source, profile, parameters and settings, in the order in which they are to be taken
    /// over. Invariant: no key is there twice.
    std::vector<KeyedNode> values;
};

/// Most arms that a study may have.
inline constexpr std::size_t arms_maximum = 10'000;

/// Whether a name may be a study's or an arm's: 1 to 100 letters, digits and hyphens, since names
/// become file names and columns of tables.
bool is_fit_name(const std::string& name);

/// The arms that an [[arm]] stands for: the product of its lists. Lists are `task`, `source`,
/// `profile` and `parameters` where they have several values, then each list in [arm.grid] and each
/// [[arm.linked]] (lists that go along with each other), in the order of the file. The last varies
/// fastest.
///
/// An arm is called by its name, or else by its task and source; then by its value in each list:
/// the value itself of task, source, profile and parameters, and key and value of settings, as in
/// "navigation-gene-clock-loss-0p5". A [[arm.linked]] gives the value of its first key, or its
/// `name`.
///
/// Throws InputError, with file, line and key, where a list is empty, holds a value twice or is not
/// as long as those linked with it, where a key is there twice or unknown, where a name is unfit,
/// or where the arms would be more than `maximum`. The values themselves are yet to be checked.
std::vector<ArmPlan> expand_arm(const Document& document, const toml::table& arm,
                                std::size_t maximum = arms_maximum);

}  // namespace gene_clocks::experiment
