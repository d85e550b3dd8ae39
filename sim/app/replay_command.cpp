#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "sim/app/commands.hpp"
#include "sim/app/output_file.hpp"
#include "sim/app/selection_options.hpp"
#include "sim/app/stop_signal.hpp"
#include "sim/experiment/store/store.hpp"
#include "sim/experiment/study/runner.hpp"
#include "sim/replay/genealogy.hpp"
#include "sim/replay/replay_page.hpp"
#include "sim/replay/replay_recorder.hpp"
#include "sim/settings/arena_file.hpp"
#include "sim/settings/choice_names.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/program_version.hpp"
#include "sim/settings/settings_io.hpp"

namespace gene_clocks::app {
namespace {

using experiment::InputError;
using replay::FrameChoice;

/// What the page takes for one robot in one frame, about; in bytes.
constexpr double bytes_per_place = 8.0;
constexpr double usual_page_bytes = 10e6;
constexpr double largest_page_bytes = 200e6;

struct ReplayOptions {
    SelectionOptions selection;
    std::uint64_t seed = 1;
    std::optional<std::string> output;
    std::optional<std::string> genealogy;
    std::int64_t from = 0;
    std::optional<std::int64_t> to;
    std::optional<std::int64_t> every;
};

double page_bytes(const FrameChoice& frames, const sim::Settings& settings) {
    return bytes_per_place * static_cast<double>(frames.frames()) *
           static_cast<double>(settings.world.robots);
}

/// 1, 2, 5, 10, 20, 50 …
std::int64_t next_round(std::int64_t round) {
    std::int64_t leading = round;
    while (leading >= 10) leading /= 10;
    return leading == 2 ? round / 2 * 5 : round * 2;
}

/// Throws InputError where the options choose no frames, or too many.
FrameChoice choose_frames(const ReplayOptions& options, const sim::Settings& settings) {
    FrameChoice frames{options.from, options.to.value_or(settings.run.cycles), 1};
    if (frames.to > settings.run.cycles) {
        throw InputError(fmt::format("--to: the run has only {} cycles", settings.run.cycles));
    }
    if (frames.from >= frames.to) {
        throw InputError(
            fmt::format("--from: must come before the last frame, cycle {}", frames.to));
    }
    if (options.every) {
        frames.every = *options.every;
    } else {
        while (page_bytes(frames, settings) > usual_page_bytes &&
               frames.every < frames.to - frames.from) {
            frames.every = next_round(frames.every);
        }
    }
    if (page_bytes(frames, settings) > largest_page_bytes) {
        throw InputError(
            fmt::format("--every: {} frames of {} robots make a page of about {:.0f} MB, more than "
                        "{:.0f}; show "
                        "fewer cycles, or fewer of them",
                        frames.frames(), settings.world.robots, page_bytes(frames, settings) / 1e6,
                        largest_page_bytes / 1e6));
    }
    return frames;
}

replay::Facts facts_of(const ReplayOptions& options, const sim::Settings& settings,
                       const sim::Arena& arena, const sim::RunResult& result) {
    const SelectionOptions& selection = options.selection;
    replay::Facts facts{
        {"Task", std::string(experiment::name_of(settings.task))},
        {"Marks", std::string(experiment::name_of(settings.source))},
        {"Profile", selection.profile},
        {"Parameters", experiment::parameter_set_of(selection.selection())},
        {"Seed", fmt::format("{}", options.seed)},
        {"Arena", arena.name},
    };
    if (!selection.settings_file.empty())
        facts.emplace_back("Settings file", selection.settings_file);
    for (const std::string& assignment : selection.assignments)
        facts.emplace_back("Set", assignment);
    facts.emplace_back("Births", fmt::format("{}", result.counters.births));
    facts.emplace_back("Matings", fmt::format("{}", result.counters.matings));
    facts.emplace_back("Trajectory hash", fmt::format("{:016x}", result.trajectory_hash));
    facts.emplace_back("Program", "gene-clocks " + experiment::program_version());
    return facts;
}

/// Where the results go; each file is whole or not there.
struct Outputs {
    explicit Outputs(const ReplayOptions& options) {
        if (!options.output && !options.genealogy) {
            throw InputError("nothing to write: give --output FILE, --genealogy FILE, or both");
        }
        for (const auto* name : {&options.output, &options.genealogy}) {
            if (*name == "-")
                throw InputError("--output: a replay cannot go to standard output; give a file");
        }
        require_different({{"--output", options.output.value_or("")},
                           {"--genealogy", options.genealogy.value_or("")}});
        if (options.output) page.emplace(*options.output);
        if (options.genealogy) genealogy.emplace(*options.genealogy);
    }
    std::optional<OutputFile> page;
    std::optional<OutputFile> genealogy;
};

int run(const ReplayOptions& options) {
    const sim::Settings settings = options.selection.settings();
    const sim::Arena arena = experiment::find_arena(settings.world.arena);
    const sim::Arena shown = sim::scaled(arena, settings.world.arena_scale);
    const FrameChoice frames = choose_frames(options, settings);
    Outputs outputs(options);

    replay::ReplayRecorder recorder(settings, std::max(shown.width_px, shown.height_px), frames);
    experiment::RunnerOptions runner;
    runner.stop = &watch_stop_signals();
    runner.simulate = [&](const sim::Settings& run_settings, const sim::Arena& run_arena,
                          std::uint64_t seed, sim::RunControl* control) {
        return sim::simulate_observed(run_settings, run_arena, seed, recorder, control);
    };
    const experiment::PlannedRun planned{
        &settings, &arena, options.seed,
        experiment::hash_of(experiment::canonical_text(settings, arena)),
        fmt::format("seed {}", options.seed)};
    const bool is_watched = isatty(STDERR_FILENO) != 0;
    experiment::Progress progress(is_watched ? stderr : nullptr);
    std::optional<sim::RunResult> result;
    const auto outcome = experiment::execute_runs(
        {planned}, runner, progress,
        [&](const experiment::FinishedRun& finished) { result = finished.result; });
    if (outcome != experiment::Outcome::finished) {
        fmt::print(stderr, "Stopped before the end of the run.\n");
        return interrupted;
    }
    if (outputs.page) {
        replay::write_replay_page(
            {settings, shown, *result, recorder, facts_of(options, settings, shown, *result)},
            outputs.page->stream());
    }
    if (outputs.genealogy) {
        replay::write_genealogy_csv(recorder.genes(), outputs.genealogy->stream());
    }
    if (outputs.page) {
        outputs.page->finish();
        fmt::print("{}: {} frames, one every {} cycles\n", *options.output, frames.frames(),
                   frames.every);
    }
    if (outputs.genealogy) {
        outputs.genealogy->finish();
        fmt::print("{}: {} genes of the final swarm\n", *options.genealogy,
                   replay::genealogy(recorder.genes()).size());
    }
    return success;
}

}  // namespace

void add_replay_command(CLI::App& app, int& status) {
    auto* command = app.add_subcommand(
        "replay", "Make one run and write it as a page to watch: robots, messages, genes");
    auto options = std::make_shared<ReplayOptions>();
    options->selection.add_to(*command);
    const auto number = CLI::Range(std::int64_t{0}, std::int64_t{1} << 53U);
    command
        ->add_option("--seed", options->seed, "Seed: the same seed and settings give the same run")
        ->capture_default_str()
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62U));
    command
        ->add_option("--output", options->output,
                     "The page: one HTML file that opens without a network")
        ->type_name("FILE");
    command
        ->add_option("--genealogy", options->genealogy,
                     "Table of the genes in the final swarm: who made them when, upon which others")
        ->type_name("FILE.csv");
    command->add_option("--from", options->from, "First cycle that the page shows")
        ->capture_default_str()
        ->type_name("CYCLE")
        ->check(number);
    command->add_option("--to", options->to, "Last one; without it the end of the run")
        ->type_name("CYCLE")
        ->check(number);
    command
        ->add_option("--every", options->every,
                     "Cycles from frame to frame; without it as few as give a page of some 10 MB")
        ->type_name("CYCLES")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 53U));
    command->footer(
        "The run always goes to its end: the genealogy is that of the swarm it ends with.\n"
        "Examples:\n"
        "  gene-clocks replay --task navigation --seed 1 --output run.html\n"
        "  gene-clocks replay --task collection --from 30000 --to 32000 --every 1 --output "
        "run.html\n"
        "  gene-clocks replay --task navigation --genealogy genes.csv\n");
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gene_clocks::app
