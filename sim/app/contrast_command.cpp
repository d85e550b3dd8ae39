#include <fmt/format.h>

#include <memory>
#include <optional>

#include "sim/app/commands.hpp"
#include "sim/app/contrast_tables.hpp"
#include "sim/app/output_file.hpp"
#include "sim/report/contrast.hpp"
#include "sim/settings/input_error.hpp"

namespace gene_clocks::app {
namespace {

struct Options {
    std::string store;
    std::vector<std::string> studies;
    experiment::Baselines baselines;
    report::ContrastPlan plan;
    std::string csv;
    std::string paired_csv;
};

/// What arms are compared with: what the command line says, else what the studies' tables
/// [contrast] say, else gene clocks. Throws InputError where the studies contradict each other.
experiment::ContrastTable contrast_table(const Options& options, const report::Input& input) {
    const experiment::Baselines& own = options.baselines;
    experiment::ContrastTable table;
    if (own.baseline.empty() && own.against.empty()) {
        if (input.contrary_studies) {
            const auto& [one, other] = *input.contrary_studies;
            throw experiment::InputError(
                fmt::format("{}: the studies {} and {} say different things of what their arms are "
                            "compared with; choose one by --study, or say it by --baseline or "
                            "--against",
                            options.store, one, other));
        }
        table = input.contrast.value_or(experiment::ContrastTable{});
    } else {
        table.arms = own;
    }
    if (own.over.empty()) return table;
    table.arms.over = own.over;
    if (table.paired) table.paired->over = own.over;
    return table;
}

int run(const Options& options) {
    require_different({{"--csv", options.csv}, {"--paired-csv", options.paired_csv}});
    const report::Input input = report::read_input(options.store, options.studies);
    const experiment::ContrastTable table = contrast_table(options, input);
    const report::ContrastPlan plan = report::with_baselines(options.plan, table.arms);
    const report::ContrastPlan paired_plan =
        report::with_baselines(options.plan, table.paired.value_or(table.arms));
    const report::Contrasts contrasts = report::contrast(input, plan, paired_plan);
    const std::string& measure = options.plan.measure;
    std::optional<Output> csv;
    std::optional<Output> paired_csv;
    if (!options.csv.empty()) csv.emplace(options.csv);
    if (!options.paired_csv.empty()) paired_csv.emplace(options.paired_csv);
    for (const std::string& what : contrasts.left_out) fmt::print(stderr, "{}\n", what);
    if (csv) write_csv(contrasts.arms, measure, csv->stream());
    if (paired_csv) write_csv(contrasts.paired, measure, paired_csv->stream());
    if (csv) csv->finish();
    if (paired_csv) paired_csv->finish();
    if (options.csv == "-" || options.paired_csv == "-") return success;
    print_table(contrasts.arms, measure);
    print_table(contrasts.paired, measure);
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
        ->allow_extra_args(false)
        ->type_name("NAME");
    auto* baseline =
        command
            ->add_option(
                "--baseline", options->baselines.baseline,
                "An arm is compared with the one whose settings are its own but for this; may "
                "be repeated. Without it, and without --against, what the study's table "
                "[contrast] says, or else source=gene-clock")
            ->allow_extra_args(false)
            ->type_name("KEY=VALUE");
    command
        ->add_option("--against", options->baselines.against,
                     "An arm by name: all others of its task and profile are compared with it; may "
                     "be repeated, once for each of these")
        ->allow_extra_args(false)
        ->type_name("ARM")
        ->excludes(baseline);
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
        ->add_option("--over", options->baselines.over,
                     "A setting that is a condition: the paired tests put arms together that "
                     "differ from their baselines in it, and otherwise alike; may be repeated")
        ->allow_extra_args(false)
        ->type_name("KEY");
    command
        ->add_option("--csv", options->csv, "CSV file, a line for each arm; - for standard output")
        ->type_name("FILE");
    command
        ->add_option("--paired-csv", options->paired_csv,
                     "CSV file, a line for each paired contrast; - for standard output")
        ->type_name("FILE");
    command->footer(
        "Arm by arm: two-sided Mann-Whitney tests for difference, two one-sided ones for\n"
        "equivalence, each corrected by Holm over the arms of a task and profile. Shift: Hodges\n"
        "and Lehmann's; A: Vargha and Delaney's; power: how often runs as these would show\n"
        "equivalence if there were no difference.\n"
        "Seed by seed: the mean of the differences between arms and baselines over all arms that\n"
        "change their baselines alike, by Student's t-tests; corrected likewise.\n"
        "Examples:\n"
        "  gene-clocks contrast results/markings.sqlite\n"
        "  gene-clocks contrast results/loss.sqlite --baseline radio.loss=0 --csv loss.csv\n"
        "  gene-clocks contrast results/loss.sqlite --paired-csv paired.csv\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
