#include "study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "arena_file.hpp"
#include "choice_names.hpp"
#include "profile.hpp"
#include "settings_io.hpp"
#include "suggestion.hpp"

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
Choice read_choice(TableReader& reader, const std::string& key) {
    const std::string text = reader.required_text(key);
    if (const auto choice = choice_of<Choice>(text)) return *choice;
    const std::vector<std::string> names(choice_names<Choice>.begin(), choice_names<Choice>.end());
    throw reader.error(
        key, fmt::format("\"{}\" is not {}{}", text, one_of(names), suggestion(text, names)));
}

/// Names become file names and columns of tables.
std::string checked_name(TableReader& reader) {
    std::string name = reader.required_text("name");
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-';
    };
    if (name.empty() || name.size() > 100 || !std::ranges::all_of(name, allowed)) {
        throw reader.error("name", "expected 1 to 100 letters, digits and hyphens");
    }
    return name;
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

Arm read_arm(const Document& document, const toml::table& table, const Common& common,
             const StudyOptions& options) {
    const Place place = document.place_of(table);
    TableReader reader(document, table, "arm");
    Arm arm;
    arm.name = checked_name(reader);
    Selection selection;
    selection.task = read_choice<sim::Task>(reader, "task");
    selection.source = read_choice<sim::Source>(reader, "source");
    selection.profile = reader.text("profile").value_or(common.profile);
    selection.parameters = reader.text("parameters");
    const toml::table* own_settings = reader.table("settings");
    reader.refuse_other_keys();

    arm.profile = selection.profile;
    arm.parameters = located(place, [&] { return parameter_set_of(selection); });
    arm.settings = located(place, [&] { return select(selection); });
    for (const toml::table* settings : {common.settings, own_settings, common.quick_settings}) {
        if (settings != nullptr) read_settings(document, *settings, arm.settings);
    }
    for (const std::string& assignment : options.assignments) assign(arm.settings, assignment);
    check_together(arm.settings, {fmt::format("{}arm {}", place.prefix(), arm.name)});
    arm.arena = located(place, [&] { return find_arena(arm.settings.world.arena); });
    arm.canonical = canonical_text(arm.settings, arm.arena);
    arm.settings_hash = hash_of(arm.canonical);
    return arm;
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
        }
    } else if (options.quick) {
        throw InputError(document.name + ": has no section [quick]");
    }
    study.seeds = options.seeds.value_or(study.seeds);

    for (const toml::table* table : arms) {
        Arm arm = read_arm(document, *table, common, options);
        if (std::ranges::count(study.arms, arm.name, &Arm::name) > 0) {
            throw key_error(document.place_of(*table), "arm.name",
                            fmt::format("there are two arms \"{}\"", arm.name));
        }
        study.arms.push_back(std::move(arm));
    }
    return study;
}

void rehearse(const Study& study, const RunFunction& simulate) {
    for (const Arm& arm : study.arms) {
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
