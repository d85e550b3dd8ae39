#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "choice_names.hpp"
#include "commands.hpp"
#include "contrast.hpp"
#include "output_file.hpp"
#include "study_report.hpp"

namespace gene_clocks::app {
namespace {

using report::Contrast;
using report::name_of;

struct Options {
    std::string store;
    std::vector<std::string> studies;
    std::vector<std::string> baseline;
    report::ContrastPlan plan;
    std::string csv;
};

void write_csv(const std::vector<Contrast>& contrasts, const std::string& measure,
               std::ostream& out) {
    fmt::print(out,
               "measure,task,profile,arm,baseline,runs,baseline_runs,pairs,identical,median,"
               "baseline_median,margin,shift,shift_lower,shift_upper,effect,effect_lower,"
               "effect_upper,difference_p_value,difference_p_corrected,equivalence_p_value,"
               "equivalence_p_corrected,power_equivalence,power_difference,verdict\n");
    for (const Contrast& row : contrasts) {
        fmt::print(out, "{},{},{},{},{},{},{},{},{},", measure,
                   experiment::name_of(row.arm->settings.task), row.arm->profile, row.arm->name,
                   row.baseline->name, row.runs, row.baseline_runs, row.pairs, row.identical);
        fmt::print(out, "{},{},{},{},{},{},{},{},{},", row.median, row.baseline_median, row.margin,
                   row.shift.estimate, row.shift.interval.lower, row.shift.interval.upper,
                   row.effect, row.effect_interval.lower, row.effect_interval.upper);
        fmt::print(out, "{},{},{},{},{},{},{}\n", row.difference_p_value,
                   row.difference_p_corrected, row.equivalence_p_value, row.equivalence_p_corrected,
                   row.power.equivalence, row.power.difference, name_of(row.verdict));
    }
}

/// A p-value as a reader wants it: small ones by their order of magnitude.
std::string p_text(double p_value) {
    return p_value < 0.0005 ? fmt::format("{:.0e}", p_value) : fmt::format("{:.3f}", p_value);
}

void print_row(const Contrast& row, std::size_t width) {
    fmt::print("  {:<{}} {:>5} {:>9} {:>8.2f}  {:<17} {:<17} {:>7} {:>6} {:>6.2f}  {}\n",
               row.arm->name, width, row.runs, fmt::format("{}/{}", row.identical, row.pairs),
               row.median,
               fmt::format("{:+.1f} [{:+.1f}, {:+.1f}]", row.shift.estimate,
                           row.shift.interval.lower, row.shift.interval.upper),
               fmt::format("{:.2f} [{:.2f}, {:.2f}]", row.effect, row.effect_interval.lower,
                           row.effect_interval.upper),
               p_text(row.difference_p_corrected), p_text(row.equivalence_p_corrected),
               row.power.equivalence, name_of(row.verdict));
}

/// Baseline by baseline, in the order in which they are first held against.
void print_table(const std::vector<Contrast>& contrasts, const report::ContrastPlan& plan) {
    std::size_t width = 3;
    std::vector<const report::Arm*> baselines;
    for (const Contrast& row : contrasts) {
        width = std::max(width, row.arm->name.size());
        if (std::ranges::find(baselines, row.baseline) == baselines.end())
            baselines.push_back(row.baseline);
    }
    for (const report::Arm* baseline : baselines) {
        const Contrast& first = *std::ranges::find(contrasts, baseline, &Contrast::baseline);
        fmt::print("{}{} against {} (median {:.2f}, {} runs; margin {:.2f})\n",
                   baseline == baselines.front() ? "" : "\n", plan.measure, baseline->name,
                   first.baseline_median, first.baseline_runs, first.margin);
        fmt::print("  {:<{}} {:>5} {:>9} {:>8}  {:<17} {:<17} {:>7} {:>6} {:>6}  {}\n", "arm",
                   width, "runs", "identical", "median", "shift [95 %]", "A [95 %]", "p diff.",
                   "p eq.", "power", "verdict");
        for (const Contrast& row : contrasts) {
            if (row.baseline == baseline) print_row(row, width);
        }
    }
}

int run(Options options) {
    if (!options.baseline.empty()) options.plan.baseline = options.baseline;
    const report::Input input = read_input(options.store, options.studies);
    std::vector<std::string> without_baseline;
    const std::vector<Contrast> contrasts =
        report::contrast(input, options.plan, &without_baseline);
    for (const std::string& name : without_baseline) {
        fmt::print(stderr, "{}: there is no arm to hold it against; left out\n", name);
    }
    if (options.csv == "-") {
        write_csv(contrasts, options.plan.measure, std::cout);
        return success;
    }
    if (!options.csv.empty()) {
        OutputFile file(options.csv);
        write_csv(contrasts, options.plan.measure, file.stream());
        file.finish();
    }
    print_table(contrasts, options.plan);
    return success;
}

}  // namespace

void add_contrast_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand(
        "contrast", "Test whether arms of a study differ, and whether they are the same");
    auto options = std::make_shared<Options>();
    command->add_option("STORE", options->store, "Store that `gene-clocks study` filled")
        ->required()
        ->type_name("FILE");
    command
        ->add_option("--study", options->studies,
                     "Only this study; may be repeated. Without it all")
        ->type_name("NAME");
    command
        ->add_option("--baseline", options->baseline,
                     "An arm is held against the one whose settings are its own but for this; may "
                     "be repeated. Without it source=gene-clock")
        ->type_name("KEY=VALUE");
    command->add_option("--measure", options->plan.measure, "What is compared")
        ->type_name("NAME")
        ->capture_default_str();
    command
        ->add_option("--margin", options->plan.margin_share,
                     "Share of the baseline's median below which a difference is none")
        ->type_name("SHARE")
        ->capture_default_str();
    command->add_option("--level", options->plan.level, "Significance level")
        ->type_name("P")
        ->capture_default_str();
    command
        ->add_option("--csv", options->csv, "CSV file, a line for each arm; - for standard output")
        ->type_name("FILE");
    command->footer(
        "Two-sided Mann-Whitney tests for difference, two one-sided ones for equivalence, each\n"
        "corrected by Holm over the arms of a task and profile. Shift: Hodges and Lehmann's; A:\n"
        "Vargha and Delaney's; power: how often runs as these would show equivalence if there\n"
        "were no difference.\n"
        "Examples:\n"
        "  gene-clocks contrast results/markings.sqlite\n"
        "  gene-clocks contrast results/loss.sqlite --baseline radio.loss=0 --csv loss.csv\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
