#include "sim/app/contrast_tables.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sim/experiment/store/csv_export.hpp"
#include "sim/experiment/study/measures.hpp"
#include "sim/settings/choice_names.hpp"

namespace gene_clocks::app {
namespace {

using experiment::name_of;
using report::Contrast;
using report::name_of;
using report::PairedContrast;

/// A p-value as a reader wants it: small ones by their order of magnitude.
std::string p_text(double p_value) {
    return p_value < 0.0005 ? fmt::format("{:.0e}", p_value) : fmt::format("{:.3f}", p_value);
}

/// A mean or shift with its interval, as in "+0.3 [-1.0, +1.6]": with as many decimals as it takes
/// to tell it from the margin.
std::string interval_text(double value, const statistics::Interval& interval, double margin) {
    const int decimals = margin >= 1.0 ? 1 : 3;
    const auto text = [&](double number) {
        const std::string rounded = fmt::format("{:+.{}f}", number, decimals);
        const bool is_zero = rounded.find_first_not_of("+-0.") == std::string::npos;
        return is_zero ? fmt::format("+{:.{}f}", 0.0, decimals) : rounded;
    };
    return fmt::format("{} [{}, {}]", text(value), text(interval.lower), text(interval.upper));
}

void print_row(const Contrast& row, std::size_t width) {
    fmt::print("  {:<{}} {:>5} {:>9} {:>8.2f}  {:<17} {:<17} {:>7} {:>6} {:>6.2f}  {}\n",
               row.arm->name, width, row.runs, fmt::format("{}/{}", row.identical, row.pairs),
               row.median, interval_text(row.shift.estimate, row.shift.interval, row.margin),
               fmt::format("{:.2f} [{:.2f}, {:.2f}]", row.effect, row.effect_interval.lower,
                           row.effect_interval.upper),
               p_text(row.difference_p_corrected), p_text(row.equivalence_p_corrected),
               row.power.equivalence, name_of(row.verdict));
}

void print_paired_row(const PairedContrast& row, std::size_t width, const std::string& change) {
    const auto tested = [&](const std::string& text) {
        return row.verdict == report::ContrastVerdict::identical ? "-" : text;
    };
    fmt::print(
        "  {:<{}} {:>5} {:>5} {:>11} {:>8.2f} {:>7.2f}  {:<19} {:>7} {:>6} {:>6}  {}\n", change,
        width, row.arms, row.seeds, fmt::format("{}/{}", row.identical, row.arms * row.seeds),
        row.baseline_mean, row.margin, interval_text(row.test.mean, row.test.interval, row.margin),
        tested(p_text(row.difference_p_corrected)), tested(p_text(row.equivalence_p_corrected)),
        tested(fmt::format("{:.2f}", row.power.equivalence)), name_of(row.verdict));
}

/// "source=timestamp"; where nothing but conditions differs, if that, "nothing else".
std::string change_text(const PairedContrast& row) {
    return row.changes.empty() ? "nothing else" : fmt::format("{}", fmt::join(row.changes, " "));
}

/// "navigation, source=timestamp", with the profile where that varies; an arm that differs from its
/// baseline in much, and is alone in that, is told by its name.
std::string title_of(const PairedContrast& row, bool with_profile) {
    if (row.arms == 1 && row.changes.size() > 1) return row.first_arm->name;
    return fmt::format("{}{}{}, {}", name_of(row.family.first), with_profile ? ", " : "",
                       with_profile ? row.family.second : "", change_text(row));
}

/// What t_f and f_a refer to, as two fields.
std::string best_fields(const experiment::BestSwarmFitness& best) {
    return fmt::format("{},{}", best.value, experiment::csv_field(best.over));
}

/// Where the measure refers to the best swarm fitness: which that is.
std::string best_text(const experiment::BestSwarmFitness& best, const std::string& measure) {
    if (!experiment::refers_to_best(measure)) return {};
    return fmt::format("; best swarm fitness {:.2f}, over {}", best.value, best.over);
}

}  // namespace

void write_csv(const std::vector<Contrast>& rows, const std::string& measure, std::ostream& out) {
    fmt::print(out,
               "measure,task,profile,arm,baseline,runs,baseline_runs,pairs,identical,median,"
               "baseline_median,margin,shift,shift_lower,shift_upper,effect,effect_lower,"
               "effect_upper,difference_p_value,difference_p_corrected,equivalence_p_value,"
               "equivalence_p_corrected,power_equivalence,power_difference,verdict,"
               "best_swarm_fitness,best_over\n");
    for (const Contrast& row : rows) {
        fmt::print(out, "{},{},{},{},{},{},{},{},{},", measure,
                   experiment::name_of(row.arm->settings.task),
                   experiment::csv_field(row.arm->profile), row.arm->name, row.baseline->name,
                   row.runs, row.baseline_runs, row.pairs, row.identical);
        fmt::print(out, "{},{},{},{},{},{},{},{},{},", row.median, row.baseline_median, row.margin,
                   row.shift.estimate, row.shift.interval.lower, row.shift.interval.upper,
                   row.effect, row.effect_interval.lower, row.effect_interval.upper);
        fmt::print(out, "{},{},{},{},{},{},{},{}\n", row.difference_p_value,
                   row.difference_p_corrected, row.equivalence_p_value, row.equivalence_p_corrected,
                   row.power.equivalence, row.power.difference, name_of(row.verdict),
                   best_fields(row.best));
    }
}

void write_csv(const std::vector<PairedContrast>& rows, const std::string& measure,
               std::ostream& out) {
    fmt::print(out,
               "measure,task,profile,change,first_arm,arms,seeds,identical,baseline_mean,margin,"
               "difference,difference_lower,difference_upper,difference_p_value,"
               "difference_p_corrected,equivalence_p_value,equivalence_p_corrected,"
               "power_equivalence,power_difference,verdict,best_swarm_fitness,best_over\n");
    for (const PairedContrast& row : rows) {
        fmt::print(out, "{},{},{},{},{},{},{},{},{},{},", measure, name_of(row.family.first),
                   experiment::csv_field(row.family.second),
                   experiment::csv_field(change_text(row)), row.first_arm->name, row.arms,
                   row.seeds, row.identical, row.baseline_mean, row.margin);
        fmt::print(out, "{},{},{},{},{},{},{},{},{},{},{}\n", row.test.mean,
                   row.test.interval.lower, row.test.interval.upper, row.difference_p_value,
                   row.difference_p_corrected, row.equivalence_p_value, row.equivalence_p_corrected,
                   row.power.equivalence, row.power.difference, name_of(row.verdict),
                   best_fields(row.best));
    }
}

void print_table(const std::vector<Contrast>& rows, const std::string& measure) {
    std::size_t width = 3;
    std::vector<const report::ArmRuns*> baselines;  // in the order of the arms
    for (const Contrast& row : rows) {
        width = std::max(width, row.arm->name.size());
        if (std::ranges::find(baselines, row.baseline) == baselines.end())
            baselines.push_back(row.baseline);
    }
    for (const report::ArmRuns* baseline : baselines) {
        const Contrast& first = *std::ranges::find(rows, baseline, &Contrast::baseline);
        fmt::print("{}{} against {} (median {:.2f}, {} runs; margin {:.2f}{})\n",
                   baseline == baselines.front() ? "" : "\n", measure, baseline->name,
                   first.baseline_median, first.baseline_runs, first.margin,
                   best_text(first.best, measure));
        fmt::print("  {:<{}} {:>5} {:>9} {:>8}  {:<17} {:<17} {:>7} {:>6} {:>6}  {}\n", "arm",
                   width, "runs", "identical", "median", "shift [95 %]", "A [95 %]", "p diff.",
                   "p eq.", "power", "verdict");
        for (const Contrast& row : rows) {
            if (row.baseline == baseline) print_row(row, width);
        }
    }
}

void print_table(const std::vector<PairedContrast>& rows, const std::string& measure) {
    if (rows.empty()) return;
    const bool with_profile = std::ranges::any_of(rows, [&](const PairedContrast& row) {
        return row.family.second != rows.front().family.second;
    });
    std::size_t width = 3;
    for (const PairedContrast& row : rows)
        width = std::max(width, title_of(row, with_profile).size());
    fmt::print("\n{} seed by seed, over all arms that change their baselines alike\n", measure);
    fmt::print("  {:<{}} {:>5} {:>5} {:>11} {:>8} {:>7}  {:<19} {:>7} {:>6} {:>6}  {}\n", "change",
               width, "arms", "seeds", "identical", "baseline", "margin", "difference [95 %]",
               "p diff.", "p eq.", "power", "verdict");
    for (const PairedContrast& row : rows)
        print_paired_row(row, width, title_of(row, with_profile));
}

}  // namespace gene_clocks::app
