// For settings drawn at random from all that are valid.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/settings/arena_file.hpp"
#include "sim/settings/settings_io.hpp"

namespace gene_clocks::experiment {
namespace {

double draw_real(const Range& range) {
    constexpr std::int64_t steps = std::int64_t{1} << 53U;
    const auto step = *rc::gen::inRange<std::int64_t>(range.minimum_excluded ? 1 : 0, steps + 1);
    const double share = static_cast<double>(step) / static_cast<double>(steps);
    // Short numbers, such as people write, are rounded otherwise than long ones.
    const double value = range.minimum + share * (range.maximum - range.minimum);
    const double rounded = std::round(value * 1000.0) / 1000.0;
    const bool use_rounded = *rc::gen::arbitrary<bool>() && range.contains(rounded);
    return use_rounded ? rounded : value;
}

Value draw_value(const Setting& setting) {
    if (!setting.choices.empty()) return *rc::gen::elementOf(setting.choices);
    switch (setting.default_value().index()) {
        case 0:
            return *rc::gen::arbitrary<bool>();
        case 1:
            return *rc::gen::inRange(static_cast<std::int64_t>(setting.range.minimum),
                                     static_cast<std::int64_t>(setting.range.maximum) + 1);
        case 2:
            return draw_real(setting.range);
        default:  // printable characters, quotes and backslashes among them
            return *rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '\x7f'));
    }
}

sim::Settings draw_settings() {
    sim::Settings settings;
    for (const Setting& setting : settings_table()) setting.set(settings, draw_value(setting));
    return settings;
}

RC_GTEST_PROP(SettingsProperty, WritingAndReadingTomlGivesTheSameSettings, ()) {
    const sim::Settings settings = draw_settings();
    const Document document = parse_document(to_toml(settings), "x.toml");
    sim::Settings copy;
    read_settings(document, document.table, copy);
    RC_ASSERT(to_json(copy) == to_json(settings));
    for (const Setting& setting : settings_table()) {
        RC_ASSERT(setting.get(copy) == setting.get(settings));
    }
}

RC_GTEST_PROP(SettingsProperty, WritingAndReadingJsonGivesTheSameSettings, ()) {
    const sim::Settings settings = draw_settings();
    const auto text = to_json(settings).dump();
    const sim::Settings copy = settings_from_json(nlohmann::json::parse(text), {"x.json"});
    for (const Setting& setting : settings_table()) {
        RC_ASSERT(setting.get(copy) == setting.get(settings));
    }
}

RC_GTEST_PROP(SettingsProperty, AssigningEveryKeyGivesTheSameSettings, ()) {
    const sim::Settings settings = draw_settings();
    sim::Settings copy;
    const auto json = to_json(settings);
    for (const Setting& setting : settings_table()) {
        const auto table = std::string(setting.table());
        const auto& value = (table.empty() ? json : json.at(table)).at(std::string(setting.name()));
        assign(copy, setting.key + "=" + value.dump());
    }
    RC_ASSERT(to_json(copy) == json);
}

RC_GTEST_PROP(SettingsProperty, DifferentSettingsHaveDifferentCanonicalTexts, ()) {
    static const sim::Arena arena = find_arena("open");
    const sim::Settings settings = draw_settings();
    sim::Settings other = settings;
    const Setting& setting = *rc::gen::elementOf(settings_table());
    setting.set(other, draw_value(setting));
    const bool same = setting.get(other) == setting.get(settings) || !setting.shapes_run() ||
                      setting.key == "world.arena";
    RC_ASSERT((canonical_text(other, arena) == canonical_text(settings, arena)) == same);
}

RC_GTEST_PROP(SettingsProperty, ReadingAnyTextEitherWorksOrIsRefused, (const std::string& noise)) {
    // No other exception, and no crash.
    const std::string text =
        to_toml({}).insert(*rc::gen::inRange<std::size_t>(0, to_toml({}).size()), noise);
    sim::Settings settings;
    try {
        const Document document = parse_document(text, "x.toml");
        read_settings(document, document.table, settings);
    } catch (const InputError& error) {
        RC_ASSERT(std::string_view(error.what()).starts_with("x.toml:"));
    }
    try {
        assign(settings, noise);
    } catch (const InputError&) {
    }
}

}  // namespace
}  // namespace gene_clocks::experiment
