#include "tests/sim/determinism/golden_runs.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <variant>

#include "sim/settings/settings_table.hpp"

namespace gene_clocks::test {
namespace {

using experiment::Setting;
using experiment::to_text;
using experiment::Value;

/// A number on the other side of its switch. `given` is what else must be set for it to matter.
struct Deviation {
    std::string_view key;
    std::string_view value;
    std::string_view given = "";
};

// Every setting that is a number or a text. Each other value of a choice or a flag gets a run
// anyway; here it only has what must be set for it to matter, if anything must.
constexpr std::array deviations = std::to_array<Deviation>({
    {"odneat.p_mate", "0.1"},
    {"odneat.p_mutate", "0.2"},
    {"odneat.p_weight", "0"},
    {"odneat.p_node", "0.9"},
    {"odneat.p_connection", "0"},
    {"odneat.p_recurrent", "0"},
    {"odneat.sigma", "1.5"},
    {"odneat.maturation_cycles", "200"},
    {"odneat.population", "2"},
    {"odneat.c_excess", "0.5"},
    {"odneat.c_disjoint", "1.5"},
    {"odneat.c_weight", "0.05"},
    {"odneat.species_threshold", "0.6"},
    {"odneat.tabu_threshold", "3"},
    {"odneat.tabu_receptions", "2"},
    {"odneat.mismatch", "", "source=random-identifier"},
    {"odneat.weight_limit", "1"},
    {"odneat.activation_slope", "1"},
    {"odneat.energy_initial", "40"},
    {"odneat.energy_maximum", "110"},
    {"odneat.fitness_period_cycles", "3"},
    {"odneat.structural_tries", "1"},
    {"odneat.disable_probability", "0"},
    {"world.arena", "open"},
    {"world.arena_scale", "1.5"},
    {"world.robots", "9"},
    {"world.items", "2", "task=collection"},
    {"world.robot_radius_px", "4"},
    {"world.sensor_range_px", "50"},
    {"world.translation_px", "1"},
    {"world.acceleration_px", "0.1"},
    {"world.rotation_deg", "10"},
    {"world.item_radius_px", "3", "task=collection"},
    {"world.item_reach_px", "14", "task=collection"},
    {"world.item_absence_cycles", "40", "task=collection"},
    {"world.item_slip", "0.3", "task=collection"},
    {"radio.range_px", "10"},
    {"radio.loss", "0.5"},
    {"radio.delay_cycles", "3"},
    {"energy.item_gain", "25", "task=collection"},
    {"energy.decay", "0.5", "task=collection"},
    {"timestamp.offset_cycles", "500", "source=timestamp"},
    {"timestamp.drift_ppm", "900000", "source=timestamp"},
    {"timestamp.synchronised_every_cycles", "50", "source=timestamp-drift"},
    {"timestamp.synchronisation_error_cycles", "40",
     "source=timestamp-drift timestamp.synchronised_every_cycles=50"},
    {"reboot.probability", "0.004"},
    {"reboot.clock", "", "reboot.probability=0.004"},
    {"join.late_share", "0.5"},
    {"join.cycles", "300", "join.late_share=0.5"},
    {"run.cycles", "900"},
    {"run.sample_period_cycles", "30"},
    {"measures.accumulated_share", "0.5"},
    {"measures.budget_share", "0.5"},
    {"measures.target_share", "0.5"},
    {"measures.best_fitness", "150"},
});

/// Bars at the paper's ±45°, and one at an angle at which nothing can be computed exactly.
sim::Arena arena_of(const std::string& name, bool is_large) {
    sim::Arena arena{name, 300.0, 300.0, 5.0, 6.0, 5.0, 5.0, {}};
    if (!is_large) arena.width_px = arena.height_px = 160.0;
    if (name == "open") return arena;
    if (is_large) {
        arena.walls = {{40.0, 40.0, 110.0, 110.0, 8.0},
                       {260.0, 40.0, 190.0, 110.0, 7.0},
                       {60.0, 250.0, 240.0, 201.7, 7.5}};
    } else {
        arena.walls = {{30.0, 30.0, 60.0, 60.0, 8.0},
                       {130.0, 30.0, 100.0, 60.0, 7.0},
                       {40.0, 130.0, 120.0, 108.3, 7.5}};
    }
    return arena;
}

/// What every short run starts from: few robots that meet, mate and mutate often.
sim::Settings short_run() {
    sim::Settings settings;
    settings.odneat.p_mate = 0.6;
    settings.odneat.p_mutate = 0.8;
    settings.odneat.c_excess = 10.0;
    settings.odneat.c_disjoint = 20.0;
    settings.odneat.second_parent = neat::SecondParent::population;
    settings.energy.decay = 1.0;
    settings.world.robots = 16;
    settings.world.items = 6;
    settings.run.cycles = 800;
    settings.run.sample_period_cycles = 50;
    return settings;
}

/// The paper's sets B and C, as published.
sim::Settings published(sim::Task task) {
    sim::Settings settings;
    settings.task = task;
    settings.world.robots = 60;
    settings.world.items = 30;
    settings.run.cycles = 3000;
    if (task == sim::Task::collection) {
        settings.odneat = {.p_mate = 0.085,
                           .p_mutate = 0.784,
                           .p_weight = 0.864,
                           .p_node = 0.162,
                           .p_connection = 0.583,
                           .p_recurrent = 0.541,
                           .sigma = 0.62,
                           .maturation_cycles = 5,
                           .population = 6};
        settings.world.item_slip = 0.21;
    }
    return settings;
}

/// Much that nobody published, all at once.
sim::Settings unpublished(sim::Task task) {
    sim::Settings settings = published(task);
    settings.source = sim::Source::timestamp;
    settings.world.actuation = sim::Actuation::wheels;
    settings.energy.navigation = sim::NavigationEnergy::equation_2;
    settings.odneat.weight_difference = neat::WeightDifference::mean;
    settings.odneat.held_energy = neat::HeldEnergy::overwrite;
    settings.odneat.species_threshold = 0.6;
    settings.odneat.tabu_threshold = 0.2;
    settings.odneat.p_mate = 0.9;
    settings.radio = {.range_px = 20.0, .loss = 0.3, .delay_cycles = 2};
    settings.timestamp = {.offset_cycles = 50.0, .drift_ppm = 200.0};
    return settings;
}

/// Clocks that forget what they marked, so that one mark means two things.
sim::Settings forgetful() {
    sim::Settings settings = published(sim::Task::navigation);
    settings.source = sim::Source::gene_clock_no_merge;
    settings.odneat.p_mate = settings.odneat.p_mutate = 0.9;
    settings.odneat.second_parent = neat::SecondParent::population;
    settings.reboot = {.probability = 0.001, .clock = sim::RebootClock::lost};
    return settings;
}

template <class Number>
Number number_of(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) {
        throw std::runtime_error("no number: " + std::string(text));
    }
    return number;
}

/// Carries out one "key=value".
void assign(sim::Settings& settings, std::string_view assignment) {
    const auto equals = assignment.find('=');
    const std::string_view key = assignment.substr(0, equals);
    const std::string_view text = assignment.substr(equals + 1);
    const Setting* const setting = experiment::find_setting(key);
    if (setting == nullptr) throw std::runtime_error("no setting: " + std::string(key));
    Value value = setting->get(settings);
    if (auto* flag = std::get_if<bool>(&value)) {
        *flag = text == "true";
    } else if (auto* whole = std::get_if<std::int64_t>(&value)) {
        *whole = number_of<std::int64_t>(text);
    } else if (auto* real = std::get_if<double>(&value)) {
        *real = number_of<double>(text);
    } else {
        value = std::string(text);
    }
    setting->set(settings, value);
}

GoldenRun make_short(const std::string& assignments) {
    GoldenRun run{assignments, {}, short_run(), {}, 1};
    std::istringstream words(assignments);
    for (std::string word; words >> word;) assign(run.settings, word);
    run.arena = arena_of(run.settings.world.arena, false);
    return run;
}

/// The values of a setting that a short run does not have anyway.
std::vector<std::string> other_values(const Setting& setting) {
    const Value value = setting.get(short_run());
    if (const auto* flag = std::get_if<bool>(&value)) return {*flag ? "false" : "true"};
    std::vector<std::string> others = setting.choices;
    std::erase(others, to_text(value));
    if (!others.empty()) return others;
    const auto found = std::ranges::find(deviations, setting.key, &Deviation::key);
    if (found == deviations.end()) {
        throw std::runtime_error(setting.key +
                                 ": no value for it in tests/sim/determinism/golden_runs.cpp; add "
                                 "one there that changes a run, and then: ./run goldens");
    }
    return {std::string(found->value)};
}

std::string given_for(const Setting& setting) {
    const auto found = std::ranges::find(deviations, setting.key, &Deviation::key);
    return found == deviations.end() ? "" : std::string(found->given);
}

class List {
public:
    void add(GoldenRun run) {
        const auto same = std::ranges::find(runs_, run.name, &GoldenRun::name);
        if (same == runs_.end()) runs_.push_back(std::move(run));
    }
    /// A short run with `assignment` on top of what is `given`, and the one without it.
    void add(const std::string& given, const std::string& assignment) {
        add(make_short(given));
        GoldenRun run = make_short(given + " " + assignment);
        run.differs_from = given;
        add(std::move(run));
    }
    std::vector<GoldenRun> take() { return std::move(runs_); }

private:
    std::vector<GoldenRun> runs_;
};

/// What is `given`, with task and source first, as every short run's name has them.
std::string in_full(const std::string& given) {
    std::string task = "task=" + to_text(experiment::find_setting("task")->default_value());
    std::string source = "source=" + to_text(experiment::find_setting("source")->default_value());
    std::string others;
    std::istringstream words(given);
    for (std::string word; words >> word;) {
        if (word.starts_with("task=")) {
            task = word;
        } else if (word.starts_with("source=")) {
            source = word;
        } else {
            others += " " + word;
        }
    }
    return task + " " + source + others;
}

}  // namespace

std::vector<GoldenRun> golden_runs() {
    List list;
    for (const std::string& task : experiment::find_setting("task")->choices) {
        for (const std::string& source : experiment::find_setting("source")->choices) {
            list.add(make_short("task=" + task + " source=" + source));
        }
    }
    for (const Setting& setting : experiment::settings_table()) {
        if (setting.key == "task" || setting.key == "source") continue;
        const std::string given = in_full(given_for(setting));
        for (const std::string& value : other_values(setting)) {
            list.add(given, setting.key + "=" + value);
        }
    }
    for (const sim::Task task : {sim::Task::navigation, sim::Task::collection}) {
        const std::string name = task == sim::Task::navigation ? " navigation" : " collection";
        list.add({"published" + name, {}, published(task), arena_of("", true), 1});
        list.add({"unpublished" + name, {}, unpublished(task), arena_of("", true), 2});
    }
    list.add({"forgetful navigation", {}, forgetful(), arena_of("", true), 3});
    return list.take();
}

namespace {

/// Words of a line. Numbers in their shortest form that reads back as the same.
class Words {
public:
    explicit Words(const std::string& name) : text_(name + ":") {}
    template <class Number>
    void add(std::string_view what, Number value, int base = 10) {
        std::array<char, 64> digits{};
        std::to_chars_result end{};
        if constexpr (std::is_floating_point_v<Number>) {
            end = std::to_chars(digits.begin(), digits.end(), value);
        } else {
            end = std::to_chars(digits.begin(), digits.end(), value, base);
        }
        text_.append(" ").append(what).append("=").append(digits.begin(), end.ptr);
    }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
};

}  // namespace

std::string describe(const GoldenRun& run, const sim::RunResult& result) {
    Words words(run.name);
    words.add("hash", result.trajectory_hash, 16);
    const sim::Sample& last = result.samples.back();
    words.add("samples", result.samples.size());
    words.add("cycle", last.cycle);
    words.add("swarm_fitness", last.swarm_fitness);
    words.add("species", last.species);
    words.add("added_elements", last.added_elements);
    words.add("controller_size", last.controller_size);
    const sim::Measures measures = sim::measure(result.samples, run.settings.measures);
    words.add("f_c", measures.f_c);
    words.add("f_b", measures.f_b);
    words.add("t_f", measures.t_f);
    words.add("f_a", measures.f_a);
    const sim::RunCounters& counters = result.counters;
    words.add("births", counters.births);
    words.add("matings", counters.matings);
    words.add("mutations", counters.mutations);
    words.add("genes_created", counters.genes_created);
    words.add("messages_sent", counters.messages_sent);
    words.add("messages_received", counters.messages_received);
    words.add("genomes_accepted", counters.genomes_accepted);
    words.add("collisions", counters.collisions);
    words.add("reboots", counters.reboots);
    words.add("robot_steps", result.robot_steps);
    words.add("creations", result.creations.size());
    sim::for_each_measure(result.chronology,
                          [&](const char* name, auto value) { words.add(name, value); });
    return words.take();
}

}  // namespace gene_clocks::test
