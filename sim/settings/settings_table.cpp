#include "sim/settings/settings_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <utility>

#include "sim/settings/choice_names.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::experiment {
namespace {

using neat::OdneatSettings;
using sim::EnergySettings;
using sim::JoinSettings;
using sim::MeasureSettings;
using sim::RadioSettings;
using sim::RebootSettings;
using sim::RunSettings;
using sim::Settings;
using sim::TimestampSettings;
using sim::WorldSettings;

constexpr Range probability{0.0, 1.0};
constexpr Range positive_share{0.0, 1.0, true};
constexpr Range length_px{0.0, 1e5};
constexpr Range positive_length_px{0.0, 1e5, true};
constexpr Range weight{0.0, 1e3};
constexpr Range energy{0.0, 1e6};
constexpr Range positive_energy{0.0, 1e6, true};
constexpr Range cycles{1.0, 1e9};
constexpr Range unused{};  // of settings that are not numbers

template <auto... Path>
constexpr auto& field(auto& settings) {
    return (settings.*....*Path);
}

/// A row of the table for the field at `Path`, a chain of pointers to members.
template <auto... Path>
Setting row(const char* key, Range range, const char* unit, const char* paper,
            const char* description) {
    using Field = std::remove_cvref_t<decltype(field<Path...>(std::declval<Settings&>()))>;
    Setting setting{key, range, unit, paper, description, {}, nullptr, nullptr};
    if constexpr (std::is_enum_v<Field>) {
        setting.choices.assign(choice_names<Field>.begin(), choice_names<Field>.end());
        setting.get = [](const Settings& settings) -> Value {
            return std::string(name_of(field<Path...>(settings)));
        };
        setting.set = [](Settings& settings, const Value& value) {
            field<Path...>(settings) = choice_of<Field>(std::get<std::string>(value)).value();
        };
    } else {
        setting.get = [](const Settings& settings) -> Value { return field<Path...>(settings); };
        setting.set = [](Settings& settings, const Value& value) {
            field<Path...>(settings) = std::get<Field>(value);
        };
    }
    return setting;
}

template <auto Member>
Setting odneat(const char* key, Range range, const char* unit, const char* paper,
               const char* description) {
    return row<&Settings::odneat, Member>(key, range, unit, paper, description);
}
template <auto Member>
Setting world(const char* key, Range range, const char* unit, const char* paper,
              const char* description) {
    return row<&Settings::world, Member>(key, range, unit, paper, description);
}

std::vector<Setting> task_rows() {
    return {
        row<&Settings::task>("task", unused, "", "4.1", "what the robots learn"),
        row<&Settings::source>("source", unused, "", "3.1", "what marks new genes"),
    };
}

std::vector<Setting> odneat_rows() {
    using S = OdneatSettings;
    return {
        odneat<&S::p_mate>("odneat.p_mate", probability, "", "3.2, Table 1",
                           "probability that an offspring has two parents"),
        odneat<&S::p_mutate>("odneat.p_mutate", probability, "", "3.2, Table 1",
                             "probability that an offspring is mutated"),
        odneat<&S::p_weight>("odneat.p_weight", probability, "", "3.2, Table 1 (p_w)",
                             "probability of mutating all weights, if the structure was not"),
        odneat<&S::p_node>("odneat.p_node", probability, "", "3.2, Table 1",
                           "probability of adding a neuron"),
        odneat<&S::p_connection>("odneat.p_connection", probability, "", "3.2, Table 1 (p_conn)",
                                 "probability of adding a connection, if no neuron was added"),
        odneat<&S::p_recurrent>("odneat.p_recurrent", probability, "", "3.2, Table 1 (p_recur)",
                                "probability that a new connection is recurrent"),
        odneat<&S::sigma>("odneat.sigma", weight, "", "3.2, Table 1",
                          "standard deviation of a weight mutation"),
        odneat<&S::maturation_cycles>("odneat.maturation_cycles", {0, 1e9}, "cycles",
                                      "3.2, Table 1 (T_m)",
                                      "age below which a genome is not replaced"),
        odneat<&S::population>("odneat.population", {1, 1000}, "genomes", "3.2, Table 1 (|P|)",
                               "genomes that a robot holds, the active one included"),
        odneat<&S::c_excess>("odneat.c_excess", weight, "", "Equation 1, Table 1 (c_1)",
                             "weight of excess genes in the genotypic distance"),
        odneat<&S::c_disjoint>("odneat.c_disjoint", weight, "", "Equation 1, Table 1 (c_2)",
                               "weight of disjoint genes in the genotypic distance"),
        odneat<&S::c_weight>("odneat.c_weight", weight, "", "Equation 1, Table 1 (c_3)",
                             "weight of the weight difference in the genotypic distance"),
        odneat<&S::species_threshold>("odneat.species_threshold", weight, "", "3.2",
                                      "distance below which a genome belongs to a species"),
        odneat<&S::tabu_threshold>("odneat.tabu_threshold", weight, "", "3.2",
                                   "distance below which a genome resembles a tabu entry"),
        odneat<&S::tabu_receptions>("odneat.tabu_receptions", {1, 1e9}, "receptions", "3.2",
                                    "receptions that a tabu entry lasts"),
        odneat<&S::weight_difference>(
            "odneat.weight_difference", unused, "", "Equation 1",
            "how the weight differences of matching genes enter the distance"),
        odneat<&S::held_energy>("odneat.held_energy", unused, "", "3.2",
                                "what the energy received with a genome already held does"),
        odneat<&S::held_reports>("odneat.held_reports", unused, "", "3.2",
                                 "which messages about a genome already held count: all, or only "
                                 "those with the energy that a new genome would need"),
        odneat<&S::crossover>("odneat.crossover", unused, "", "3.2, 5",
                              "how a child gets the genes that both parents have: each by chance, "
                              "or the older from one parent and the younger from the other"),
        odneat<&S::mismatch>(
            "odneat.mismatch", unused, "", "Equation 1, 5",
            "what an unmatched gene adds to the distance: c_1 or c_2 (as excess or "
            "disjoint, or as above or below the last common gene), or the more "
            "the older it is"),
        odneat<&S::second_parent>("odneat.second_parent", unused, "", "3.2",
                                  "from whom the second parent is drawn: the first one's species, "
                                  "the others of it, or all others in the population"),
        odneat<&S::weight_limit>("odneat.weight_limit", {0, 1e6, true}, "", "3.2",
                                 "weights stay within plus and minus this"),
        odneat<&S::activation_slope>("odneat.activation_slope", {0, 1e3, true}, "", "",
                                     "slope of the neurons' logistic activation"),
        odneat<&S::energy_initial>("odneat.energy_initial", positive_energy, "energy", "4.1",
                                   "energy of a new genome, and its first fitness sample"),
        odneat<&S::energy_maximum>("odneat.energy_maximum", positive_energy, "energy", "4.1",
                                   "energy never exceeds this"),
        odneat<&S::fitness_period_cycles>("odneat.fitness_period_cycles", cycles, "cycles", "3.2",
                                          "period of the energy samples whose mean is the fitness"),
        odneat<&S::structural_tries>("odneat.structural_tries", {1, 1e6}, "draws", "",
                                     "draws after which a structural mutation gives up"),
        odneat<&S::disable_probability>("odneat.disable_probability", probability, "", "",
                                        "probability that a matching gene disabled in one parent "
                                        "is disabled (uniform crossover)"),
    };
}

std::vector<Setting> world_rows() {
    using S = WorldSettings;
    return {
        world<&S::arena>("world.arena", unused, "", "4.1, Figure 1",
                         "a built-in arena's name, or a file ending in .toml"),
        world<&S::arena_scale>(
            "world.arena_scale", {0.0, 100.0, true}, "", "",
            "factor of all lengths of the arena; its square is that of the area"),
        world<&S::robots>("world.robots", {1, 100000}, "robots", "4.1, Table 1",
                          "robots in the arena"),
        world<&S::items>("world.items", {0, 100000}, "items", "4.1, Table 1",
                         "items in the arena (collection)"),
        world<&S::robot_radius_px>("world.robot_radius_px", positive_length_px, "px", "",
                                   "half the diagonal of a robot's diamond"),
        world<&S::sensor_range_px>("world.sensor_range_px", positive_length_px, "px", "4.1",
                                   "range of the proximity rays, from the robot's edge"),
        world<&S::translation_px>("world.translation_px", length_px, "px per cycle", "",
                                  "largest translation"),
        world<&S::acceleration_px>("world.acceleration_px", length_px, "px per cycle", "",
                                   "largest change of translation from one cycle to the next"),
        world<&S::rotation_deg>("world.rotation_deg", {0, 180}, "degrees per cycle", "",
                                "largest rotation"),
        world<&S::actuation>("world.actuation", unused, "", "4.1",
                             "what a controller's two outputs mean"),
        world<&S::item_radius_px>("world.item_radius_px", length_px, "px", "",
                                  "radius of an item's body, which rays and robots meet"),
        world<&S::item_reach_px>("world.item_reach_px", length_px, "px", "",
                                 "a robot collects an item whose centre is this near"),
        world<&S::item_absence_cycles>("world.item_absence_cycles", {1, 1e9}, "cycles", "4.1",
                                       "cycles until a collected item reappears elsewhere"),
        world<&S::item_slip>("world.item_slip", probability, "", "",
                             "share of wall readings that pass for items (collection)"),
    };
}

std::vector<Setting> physics_rows() {
    return {
        row<&Settings::radio, &RadioSettings::range_px>(
            "radio.range_px", length_px, "px", "3.2",
            "range of a broadcast, from the robot's edge; at most the sensor range"),
        row<&Settings::radio, &RadioSettings::loss>("radio.loss", probability, "", "",
                                                    "probability that one reception fails"),
        row<&Settings::radio, &RadioSettings::delay_cycles>(
            "radio.delay_cycles", {0, 1e6}, "cycles", "", "cycles between sending and reception"),
        row<&Settings::energy, &EnergySettings::navigation>(
            "energy.navigation", unused, "", "Equation 2", "how a navigating robot gains energy"),
        row<&Settings::energy, &EnergySettings::item_gain>("energy.item_gain", energy, "energy",
                                                           "Equation 3", "energy per item"),
        row<&Settings::energy, &EnergySettings::decay>("energy.decay", energy, "energy per cycle",
                                                       "Equation 3", "energy lost (collection)"),
        row<&Settings::timestamp, &TimestampSettings::offset_cycles>(
            "timestamp.offset_cycles", {0, 1e9}, "cycles", "2",
            "a robot's clock starts off by a uniform draw from plus and minus this"),
        row<&Settings::timestamp, &TimestampSettings::drift_ppm>(
            "timestamp.drift_ppm", {0, 9e5}, "ppm", "2",
            "a robot's clock drifts by a uniform draw from plus and minus this"),
        row<&Settings::timestamp, &TimestampSettings::synchronised_every_cycles>(
            "timestamp.synchronised_every_cycles", {0, 1e9}, "cycles", "",
            "the clocks are set anew this often; 0: never"),
        row<&Settings::timestamp, &TimestampSettings::synchronisation_error_cycles>(
            "timestamp.synchronisation_error_cycles", {0, 1e9}, "cycles", "",
            "a clock that is set anew is off by a uniform draw from plus and minus this"),
    };
}

std::vector<Setting> lifetime_rows() {
    return {
        row<&Settings::reboot, &RebootSettings::probability>(
            "reboot.probability", probability, "per cycle", "",
            "probability that a robot reboots: it loses its population, tabu list and genome"),
        row<&Settings::reboot, &RebootSettings::clock>(
            "reboot.clock", unused, "", "",
            "whether what marks its genes goes on after a reboot, or starts anew"),
        row<&Settings::join, &JoinSettings::late_share>(
            "join.late_share", probability, "", "",
            "share of the robots that are switched on late; at least one is there at the start"),
        row<&Settings::join, &JoinSettings::cycles>(
            "join.cycles", cycles, "cycles", "",
            "a late robot is switched on at a cycle drawn from 1 to this"),
    };
}

std::vector<Setting> run_rows() {
    return {
        row<&Settings::run, &RunSettings::cycles>("run.cycles", cycles, "cycles", "4.1",
                                                  "length of a run"),
        row<&Settings::run, &RunSettings::sample_period_cycles>(
            "run.sample_period_cycles", cycles, "cycles", "4.1",
            "period of the samples of swarm fitness, species and controller size"),
        row<&Settings::run, &RunSettings::record_creation_times>(
            "run.record_creation_times", unused, "", "", "keep the time at which each gene arose"),
        row<&Settings::measures, &MeasureSettings::accumulated_share>(
            "measures.accumulated_share", positive_share, "", "4.1, Figure 2 (f_c)",
            "last share of the samples, over which f_c, species and added elements are means"),
        row<&Settings::measures, &MeasureSettings::budget_share>(
            "measures.budget_share", positive_share, "", "4.1, Figure 2 (f_b)",
            "share of the run after which f_b is read"),
        row<&Settings::measures, &MeasureSettings::target_share>(
            "measures.target_share", positive_share, "", "4.1, Figure 2 (t_f, f_a)",
            "the target of t_f and f_a as a share of the best swarm fitness"),
        row<&Settings::measures, &MeasureSettings::best_fitness>(
            "measures.best_fitness", energy, "energy", "4.1, Figure 2 (t_f, f_a)",
            "the best swarm fitness that t_f and f_a refer to; 0 means that of all compared runs"),
    };
}

}  // namespace

std::string to_text(const Value& value) {
    return std::visit([](const auto& held) { return fmt::format("{}", held); }, value);
}

std::string Range::text() const {
    return fmt::format("{}{}, {}]", minimum_excluded ? "(" : "[", minimum, maximum);
}

std::string_view Setting::table() const {
    const auto dot = key.find('.');
    return dot == std::string::npos ? std::string_view{} : std::string_view(key).substr(0, dot);
}

std::string_view Setting::name() const {
    const auto dot = key.find('.');
    return dot == std::string::npos ? std::string_view(key) : std::string_view(key).substr(dot + 1);
}

const std::vector<Setting>& settings_table() {
    static const std::vector<Setting> table = [] {
        std::vector<Setting> rows;
        for (auto part :
             {task_rows, odneat_rows, world_rows, physics_rows, lifetime_rows, run_rows}) {
            std::ranges::move(part(), std::back_inserter(rows));
        }
        return rows;
    }();
    return table;
}

const Setting* find_setting(std::string_view key) {
    const auto found = std::ranges::find(settings_table(), key, &Setting::key);
    return found == settings_table().end() ? nullptr : &*found;
}

std::vector<std::string> differing_keys(const sim::Settings& one, const sim::Settings& other) {
    std::vector<std::string> keys;
    for (const Setting& setting : settings_table()) {
        if (setting.get(one) != setting.get(other)) keys.emplace_back(setting.key);
    }
    return keys;
}

std::string suggest_setting(std::string_view key) {
    const auto dot = key.find('.');
    const std::string_view name = dot == std::string_view::npos ? key : key.substr(dot + 1);
    std::vector<std::string> keys;
    std::vector<std::string> names;
    for (const Setting& setting : settings_table()) {
        keys.push_back(setting.key);
        names.emplace_back(setting.name());
    }
    auto index = nearest(key, keys);
    if (!index) index = nearest(name, names);
    return index ? "; did you mean " + keys[*index] + "?" : std::string{};
}

}  // namespace gene_clocks::experiment
