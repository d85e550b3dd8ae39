#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/experiment/study/compared_runs.hpp"
#include "sim/report/report_input.hpp"

namespace gene_clocks::report {

/// One arm's runs, as numbers.
struct ArmNumbers {
    const ArmRuns* arm{};
    /// Ascending by seed; never empty; all sampled at the same cycles.
    std::vector<const Run*> runs;
    /// By measure, in the order of `runs`. A measure that the runs are too short for is absent.
    std::map<std::string_view, std::vector<double>> values;
    experiment::BestSwarmFitness best;  ///< that t_f and f_a refer to
};

using experiment::Family;
Family family_of(const ArmRuns& arm);

/// Every arm that holds runs, in the order of the arms. Throws as `compare` does.
std::vector<ArmNumbers> arm_numbers(const Input& input);

/// Which of the paper's settings a comparison repeats.
enum class Role {
    as_run,      ///< the parameter set that the published runs used
    as_printed,  ///< the one that Table 1 prints for the task
    other,
};

/// Arms whose settings differ in the innovation source alone: one task, one profile, one parameter
/// set. At most one arm for each source, in the order of sim::Source.
struct Comparison {
    std::string profile;
    std::string parameters;  ///< empty where the parameters are none of the named sets
    sim::Settings settings;  ///< of the first arm
    Role role{};
    experiment::BestSwarmFitness best;  ///< that t_f and f_a of all its arms refer to
    std::vector<ArmNumbers> arms;

    [[nodiscard]] const ArmNumbers* arm(sim::Source source) const;
};

/// Groups the arms that hold runs into comparisons, in the order of the arms.
/// Throws experiment::InputError where there are no runs at all, a run has no samples or one that
/// is not a number, the runs of an arm were sampled at different cycles, or a seed occurs twice.
std::vector<Comparison> compare(const Input& input);

/// Splits the seeds that two arms share between them, so that the samples are independent even
/// where the same seed makes both arms do the same: of the shared seeds, ascending, the first arm
/// keeps the first, third, fifth …, and the second arm the others. Seeds of one arm alone stay.
/// None where the arms share no seed, or too few to leave runs for both.
std::optional<std::pair<std::vector<double>, std::vector<double>>> independent_halves(
    const ArmNumbers& x, const ArmNumbers& y, std::string_view measure);

/// How far two arms went the same way, seed by seed.
struct SharedTrajectories {
    std::size_t pairs{};      ///< seeds that both arms hold
    std::size_t identical{};  ///< of these, with the same trajectory hash
    /// Of the pairs that are not identical, the cycle of the first sample that differs.
    std::vector<double> first_difference_cycles;
};

SharedTrajectories share_trajectories(const ArmNumbers& x, const ArmNumbers& y);

}  // namespace gene_clocks::report
