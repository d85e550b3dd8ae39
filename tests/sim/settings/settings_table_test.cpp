#include "sim/settings/settings_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "sim/settings/settings_help.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::experiment {
namespace {

/// Converts to whatever an aggregate's member needs.
struct Anything {
    template <typename T>
    operator T() const;  // NOLINT: never defined, only named
};

template <typename Aggregate, std::size_t... Index>
consteval bool takes(std::index_sequence<Index...>) {
    return requires {
        Aggregate{(static_cast<void>(Index), Anything{})...};
    };
}

/// The number of members of an aggregate: the most initializers that it takes.
template <typename Aggregate, std::size_t Count = 0>
consteval std::size_t member_count() {
    if constexpr (takes<Aggregate>(std::make_index_sequence<Count + 1>{})) {
        return member_count<Aggregate, Count + 1>();
    } else {
        return Count;
    }
}

struct ThreeMembers {
    int a;
    double b;
    std::string c;
};
static_assert(member_count<ThreeMembers>() == 3);

std::size_t rows_of(std::string_view table) {
    return static_cast<std::size_t>(std::ranges::count(settings_table(), table, &Setting::table));
}

TEST(SettingsTable, HasARowForEveryMemberOfSettings) {
    EXPECT_EQ(rows_of("odneat"), member_count<neat::OdneatSettings>());
    EXPECT_EQ(rows_of("world"), member_count<sim::WorldSettings>());
    EXPECT_EQ(rows_of("radio"), member_count<sim::RadioSettings>());
    EXPECT_EQ(rows_of("energy"), member_count<sim::EnergySettings>());
    EXPECT_EQ(rows_of("timestamp"), member_count<sim::TimestampSettings>());
    EXPECT_EQ(rows_of("run"), member_count<sim::RunSettings>());
    EXPECT_EQ(rows_of("measures"), member_count<sim::MeasureSettings>());
    // The members of Settings itself are the keys outside all tables, and the tables.
    std::set<std::string_view> tables;
    for (const Setting& setting : settings_table()) tables.insert(setting.table());
    EXPECT_EQ(rows_of("") + tables.size() - 1, member_count<sim::Settings>());
}

/// Some value of the setting that is not its default.
Value other_value(const Setting& setting) {
    const Value value = setting.default_value();
    if (const auto* flag = std::get_if<bool>(&value)) return !*flag;
    if (const auto* number = std::get_if<std::int64_t>(&value)) return *number + 1;
    if (const auto* real = std::get_if<double>(&value)) return *real + 0.5;
    if (setting.choices.empty()) return std::string("elsewhere");
    return setting.choices[value == Value(setting.choices[0]) ? 1 : 0];
}

TEST(SettingsTable, EachRowHasAFieldOfItsOwn) {
    for (const Setting& changed : settings_table()) {
        sim::Settings settings;
        changed.set(settings, other_value(changed));
        for (const Setting& setting : settings_table()) {
            const Value expected =
                setting.key == changed.key ? other_value(changed) : setting.default_value();
            EXPECT_EQ(setting.get(settings), expected) << changed.key << " changed " << setting.key;
        }
    }
}

TEST(SettingsTable, DefaultsAreInRange) {
    for (const Setting& setting : settings_table()) {
        const Value value = setting.default_value();
        if (const auto* number = std::get_if<std::int64_t>(&value)) {
            EXPECT_TRUE(setting.range.contains(static_cast<double>(*number))) << setting.key;
        } else if (const auto* real = std::get_if<double>(&value)) {
            EXPECT_TRUE(setting.range.contains(*real)) << setting.key;
        }
    }
}

TEST(SettingsTable, KeysAreUniqueAndDescribed) {
    std::set<std::string> keys;
    for (const Setting& setting : settings_table()) {
        EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
        EXPECT_FALSE(setting.description.empty()) << setting.key;
        EXPECT_EQ(find_setting(setting.key), &setting);
    }
    EXPECT_EQ(find_setting("odneat.nothing"), nullptr);
}

TEST(SettingsTable, NamesCarryTheUnitThatTheTableStates) {
    for (const Setting& setting : settings_table()) {
        const std::string unit = setting.unit.substr(0, setting.unit.find(' '));
        if (setting.name().ends_with("_px")) {
            EXPECT_EQ(unit, "px") << setting.key;
        }
        if (setting.name().ends_with("_cycles")) {
            EXPECT_EQ(unit, "cycles") << setting.key;
        }
    }
}

TEST(SettingsTable, SuggestsTheKeyThatWasMeant) {
    EXPECT_EQ(suggest_setting("odneat.p_mtae"), "; did you mean odneat.p_mate?");
    EXPECT_EQ(suggest_setting("p_mate"), "; did you mean odneat.p_mate?");
    EXPECT_EQ(suggest_setting("world.p_mate"), "; did you mean odneat.p_mate?");
    EXPECT_EQ(suggest_setting("robot"), "; did you mean world.robots?");
    EXPECT_EQ(suggest_setting("colour"), "");
    EXPECT_EQ(suggest_setting(std::string(1'000'000, 'x')), "");
}

TEST(SettingsDocumentation, IsUpToDate) {
    EXPECT_EQ(test::read_all(SOURCE_FOLDER "/docs/settings.md"), settings_markdown())
        << "run: gene-clocks settings --format markdown > docs/settings.md";
}

}  // namespace
}  // namespace gene_clocks::experiment
