#include "sim/experiment/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "sim/experiment/study/arm_lists.hpp"
#include "sim/settings/arena_file.hpp"
#include "sim/settings/choice_names.hpp"
#include "sim/settings/profile.hpp"
#include "sim/settings/settings_io.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::experiment {
namespace {

constexpr Range seeds_range{1, 1e6};
constexpr Range first_seed_range{0, 1e15};

/// The sections of a study's file that every arm builds on.
struct Common {
    std::string profile;
    const toml::table* settings = nullptr;
    const toml::table* quick_settings = nullptr;  ///< null unless the quick study is asked for
};

template <typename Choice>
Choice read_choice(const Document& document, const KeyedNode& node) {
    const Place place = document.place_of(*node.value);
    const std::string key = "arm." + node.key;
    const std::string text = read_text(*node.value, place, key);
    if (const auto choice = choice_of<Choice>(text)) return *choice;
    const std::vector<std::string> names(choice_names<Choice>.begin(), choice_names<Choice>.end());
    throw key_error(
        place, key,
        fmt::format("\"{}\" is not {}{}", text, one_of(names), suggestion(text, names)));
}

/// Takes over the value of a key that selects where settings start; false for any other key.
bool read_selection(const Document& document, const KeyedNode& node, Selection& selection) {
    const auto text = [&] {
        return read_text(*node.value, document.place_of(*node.value), "arm." + node.key);
    };
    if (node.key == "task") {
        selection.task = read_choice<sim::Task>(document, node);
    } else if (node.key == "source") {
        selection.source = read_choice<sim::Source>(document, node);
    } else if (node.key == "profile") {
        selection.profile = text();
    } else if (node.key == "parameters") {
        selection.parameters = text();
    } else {
        return false;
    }
    return true;
}

std::string checked_name(TableReader& reader) {
    std::string name = reader.required_text("name");
    if (is_fit_name(name)) return name;
    throw reader.error("name", "expected 1 to 100 letters, digits and hyphens");
}

/// Runs a function whose errors know the key but not the place.
template <typename Function>
auto located(const Place& place, Function function) {
    try {
        return function();
    } catch (const InputError& error) {
        throw InputError(place.prefix() + error.what());
    }
}

/// Where the arm's file gives a key, as in "profile" or "world.arena"; `otherwise` where it does
/// not.
Place place_of_key(const Document& document, std::string_view key, const ArmPlan& plan,
                   const Common& common, const Place& otherwise) {
    for (const KeyedNode& node : plan.values) {
        if (node.key == key) return node.place;
    }
    if (common.settings != nullptr) {
        for (const KeyedNode& node : flatten(document, *common.settings)) {
            if (node.key == key) return node.place;
        }
    }
    const toml::node* of_all = document.table.get(key);
    return of_all != nullptr ? document.place_of(*of_all) : otherwise;
}

Arm read_arm(const Document& document, const Place& place, const ArmPlan& plan,
             const Common& common, const StudyOptions& options) {
    Arm arm;
    arm.name = plan.name;
    Selection selection;
    selection.profile = common.profile;
    std::vector<KeyedNode> own_settings;
    for (const KeyedNode& node : plan.values) {
        if (!read_selection(document, node, selection)) own_settings.push_back(node);
    }
    arm.profile = selection.profile;
    const auto place_of = [&](std::string_view key) {
        return place_of_key(document, key, plan, common, place);
    };
    // Whatever is wrong with the profile is found here, what is wrong with the parameters there.
    arm.parameters = located(place_of("profile"), [&] {
        find_document(Builtin::profile, selection.profile);
        return parameter_set_of(selection);
    });
    arm.settings = located(place_of(selection.parameters ? "parameters" : "profile"),
                           [&] { return select(selection); });
    if (common.settings != nullptr) read_settings(document, *common.settings, arm.settings);
    for (const KeyedNode& node : own_settings) read_setting(document, node, arm.settings);
    if (common.quick_settings != nullptr) {
        read_settings(document, *common.quick_settings, arm.settings);
    }
    for (const std::string& assignment : options.assignments) assign(arm.settings, assignment);
    check_together(arm.settings, {fmt::format("{}arm {}", place.prefix(), arm.name)});
    arm.arena =
        located(place_of("world.arena"), [&] { return find_arena(arm.settings.world.arena); });
    arm.canonical = canonical_text(arm.settings, arm.arena);
    arm.settings_hash = hash_of(arm.canonical);
    return arm;
}

/// Throws InputError where a table [contrast] names an arm that the study has not.
void check_names(const Study& study, const Place& place) {
    std::vector<std::string> names;
    for (const Arm& arm : study.arms) names.push_back(arm.name);
    const auto check = [&](const Baselines& baselines, const char* key) {
        for (const std::string& name : baselines.against) {
            if (std::ranges::find(names, name) != names.end()) continue;
            throw key_error(
                place, key,
                fmt::format("the study has no arm \"{}\"{}", name, suggestion(name, names)));
        }
    };
    check(study.contrast->arms, "contrast.against");
    if (study.contrast->paired) check(*study.contrast->paired, "contrast.paired.against");
}

}  // namespace

Study read_study(const Document& document, const StudyOptions& options) {
    TableReader reader(document, document.table);
    Study study;
    study.name = checked_name(reader);
    study.title = reader.required_text("title");
    study.description = reader.text("description").value_or("");
    study.first_seed =
        static_cast<std::uint64_t>(reader.integer("first_seed", first_seed_range).value_or(1));
    study.seeds = reader.integer("seeds", seeds_range).value_or(1);
    Common common{reader.text("profile").value_or("mended"), reader.table("settings"), nullptr};
    const toml::table* quick = reader.table("quick");
    const toml::table* contrast = reader.table("contrast");
    const auto arms = reader.tables("arm");
    reader.refuse_other_keys();
    if (arms.empty()) throw reader.error("arm", "is missing: a study needs one [[arm]] at least");

    if (quick != nullptr) {
        TableReader quick_reader(document, *quick, "quick");
        const auto seeds = quick_reader.integer("seeds", seeds_range);
        const toml::table* settings = quick_reader.table("settings");
        quick_reader.refuse_other_keys();
        if (options.quick) {
            study.name += "-quick";
            study.title += " (quick)";
            study.seeds = seeds.value_or(study.seeds);
            common.quick_settings = settings;
        } else if (settings != nullptr) {
            sim::Settings unused;
            read_settings(document, *settings, unused);  // refuses what --quick would
        }
    } else if (options.quick) {
        throw InputError(document.name + ": has no section [quick], which --quick needs");
    }
    study.seeds = options.seeds.value_or(study.seeds);

    std::set<std::string> names;
    for (const toml::table* table : arms) {
        const Place place = document.place_of(*table);
        for (const ArmPlan& plan : expand_arm(document, *table, arms_maximum - study.arms.size())) {
            if (!names.insert(plan.name).second) {
                throw key_error(
                    place, "arm.name",
                    fmt::format("there are two arms \"{}\"; give one of them another name",
                                plan.name));
            }
            study.arms.push_back(read_arm(document, place, plan, common, options));
        }
    }
    if (contrast != nullptr) {
        study.contrast = read_contrast_table(document, *contrast);
        check_names(study, document.place_of(*contrast));
    }
    return study;
}

void rehearse(const Study& study, const RunFunction& simulate) {
    std::set<std::string> rehearsed;
    for (const Arm& arm : study.arms) {
        if (!rehearsed.insert(arm.settings_hash).second) continue;
        sim::Settings settings = arm.settings;
        settings.run.cycles = 1;
        settings.run.sample_period_cycles = 1;
        try {
            simulate(settings, arm.arena, study.first_seed, nullptr);
        } catch (const std::exception& error) {
            throw InputError(fmt::format("arm {}: {}", arm.name, error.what()));
        }
    }
}

}  // namespace gene_clocks::experiment
