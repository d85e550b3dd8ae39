#include "sim/settings/settings_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/settings/arena_file.hpp"
#include "tests/sim/experiment/expect_input_error.hpp"

namespace gene_clocks::experiment {
namespace {

using test::input_error;

sim::Settings read(const std::string& text) {
    const Document document = parse_document(text, "x.toml", "folder");
    sim::Settings settings;
    read_settings(document, document.table, settings);
    return settings;
}

TEST(ReadSettings, TakesOverWhatIsThere) {
    const sim::Settings settings = read(
        "task = \"collection\"\n"
        "odneat.p_mate = 0.25\n"
        "[world]\nrobots = 7\nactuation = \"wheels\"\n"
        "[run]\nrecord_creation_times = true\n");
    EXPECT_EQ(settings.task, sim::Task::collection);
    EXPECT_EQ(settings.odneat.p_mate, 0.25);
    EXPECT_EQ(settings.world.robots, 7);
    EXPECT_EQ(settings.world.actuation, sim::Actuation::wheels);
    EXPECT_TRUE(settings.run.record_creation_times);
    EXPECT_EQ(settings.odneat.p_mutate, sim::Settings{}.odneat.p_mutate);
}

TEST(ReadSettings, TakesWholeNumbersForRealsOnly) {
    EXPECT_EQ(read("odneat.p_mate = 1").odneat.p_mate, 1.0);
    EXPECT_EQ(input_error([] { read("[world]\nrobots = 7.0"); }),
              "x.toml:2: world.robots: expected a whole number, found a real number");
}

TEST(ReadSettings, RefusesUnknownKeys) {
    EXPECT_EQ(input_error([] { read("\n[odneat]\np_mtae = 0.5"); }),
              "x.toml:3: odneat.p_mtae: unknown key; did you mean odneat.p_mate?");
    EXPECT_EQ(input_error([] { read("p_mate = 0.5"); }),
              "x.toml:1: p_mate: unknown key; did you mean odneat.p_mate?");
    EXPECT_EQ(input_error([] { read("[wolrd]\nrobots = 5"); }), "x.toml:1: wolrd: unknown key");
}

TEST(ReadSettings, RefusesWrongTypes) {
    EXPECT_EQ(input_error([] { read("world = 3"); }),
              "x.toml:1: world: is the name of a table of settings, not of a setting");
    EXPECT_THAT(input_error([] { read("[odneat.p_mate]\na = 1"); }),
                testing::HasSubstr("odneat.p_mate: expected a real number, found a table"));
    EXPECT_THAT(input_error([] { read("odneat.p_mate = [0.5]"); }), testing::HasSubstr("an array"));
    EXPECT_THAT(input_error([] { read("odneat.p_mate = \"0.5\""); }), testing::HasSubstr("a text"));
    EXPECT_THAT(input_error([] { read("world.arena = 5"); }), testing::HasSubstr("a text"));
    EXPECT_THAT(input_error([] { read("run.record_creation_times = 1"); }),
                testing::HasSubstr("expected true or false"));
}

TEST(ReadSettings, RefusesValuesOutOfRange) {
    EXPECT_EQ(input_error([] { read("odneat.p_mate = 1.01"); }),
              "x.toml:1: odneat.p_mate: 1.01 is outside [0, 1]");
    EXPECT_THAT(input_error([] { read("odneat.p_mate = nan"); }), testing::HasSubstr("outside"));
    EXPECT_THAT(input_error([] { read("odneat.sigma = inf"); }), testing::HasSubstr("outside"));
    EXPECT_THAT(input_error([] { read("world.robots = 0"); }), testing::HasSubstr("outside [1, "));
    EXPECT_THAT(input_error([] { read("world.robots = 9223372036854775807"); }),
                testing::HasSubstr("outside"));
    EXPECT_EQ(
        input_error([] { read("task = \"navigaton\""); }),
        "x.toml:1: task: \"navigaton\" is not navigation or collection; did you mean navigation?");
}

TEST(ReadSettings, FindsAnArenasFileFromItsOwnFolder) {
    EXPECT_EQ(read("world.arena = \"mine.toml\"").world.arena, "folder/mine.toml");
    EXPECT_EQ(read("world.arena = \"../mine.toml\"").world.arena, "mine.toml");
    EXPECT_EQ(read("world.arena = \"/a/mine.toml\"").world.arena, "/a/mine.toml");
    EXPECT_EQ(read("world.arena = \"open\"").world.arena, "open");
}

TEST(Assign, SetsOneKey) {
    sim::Settings settings;
    assign(settings, "odneat.p_mate=0.5");
    assign(settings, "world.robots=12");
    assign(settings, "world.arena=open");
    assign(settings, "odneat.held_energy=\"overwrite\"");
    assign(settings, "run.record_creation_times=true");
    assign(settings, "odneat.sigma=1");
    EXPECT_EQ(settings.odneat.p_mate, 0.5);
    EXPECT_EQ(settings.world.robots, 12);
    EXPECT_EQ(settings.world.arena, "open");
    EXPECT_EQ(settings.odneat.held_energy, neat::HeldEnergy::overwrite);
    EXPECT_TRUE(settings.run.record_creation_times);
    EXPECT_EQ(settings.odneat.sigma, 1.0);
}

TEST(Assign, RefusesWhatItCannotSetAndChangesNothing) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"odneat.p_mate", "expected key=value"},
        {"=5", "expected key=value"},
        {"odneat.p_mate=", "is not a value"},
        {"odneat.p_mate=abc", "is not a value"},
        {"odneat.p_mate=0.5\nrobots = 3", "is not one value"},
        {"odneat.p_mate=2", "2 is outside [0, 1]"},
        {"world.robots=1.5", "expected a whole number"},
        {"world.robots=ten", "is not a value"},
        {"odneat.p_mtae=0.5", "did you mean odneat.p_mate?"},
        {"odneat.held_energy=overwritten", "did you mean overwrite?"},
        {"task=", "is not navigation or collection"},
    };
    for (const auto& [assignment, message] : cases) {
        sim::Settings settings;
        EXPECT_THAT(input_error([&] { assign(settings, assignment); }),
                    testing::HasSubstr(message));
        EXPECT_EQ(to_json(settings), to_json({}));
    }
}

TEST(CheckTogether, RefusesContradictions) {
    sim::Settings settings;
    EXPECT_NO_THROW(check_together(settings, {}));
    settings.radio.range_px = settings.world.sensor_range_px + 1;
    EXPECT_THAT(input_error([&] {
                    check_together(settings, {"x.toml", 3});
                }),
                testing::StartsWith("x.toml:3: radio.range_px: 31 exceeds"));
    settings = {};
    settings.odneat.energy_initial = settings.odneat.energy_maximum + 1;
    EXPECT_THAT(input_error([&] { check_together(settings, {}); }),
                testing::StartsWith("odneat.energy_initial: "));
    settings = {};
    settings.run.cycles = settings.run.sample_period_cycles - 1;
    EXPECT_THAT(input_error([&] { check_together(settings, {}); }),
                testing::StartsWith("run.sample_period_cycles: "));
}

TEST(SettingsFromJson, RefusesWhatIsNoSettings) {
    const Place place{"store"};
    EXPECT_THAT(input_error([&] { settings_from_json(nlohmann::json::array(), place); }),
                testing::StartsWith("store: "));
    EXPECT_THAT(input_error([&] {
                    settings_from_json({{"odneat", {{"p_mate", nullptr}}}}, place);
                }),
                testing::HasSubstr("p_mate"));
    EXPECT_THAT(input_error([&] {
                    settings_from_json({{"odneat", {{"later", 1}}}}, place);
                }),
                testing::HasSubstr("odneat.later: unknown key"));
    EXPECT_THAT(input_error([&] {
                    settings_from_json({{"odneat", {{"p_mate", 7}}}}, place);
                }),
                testing::HasSubstr("outside"));
}

std::string hash(const sim::Settings& settings, const std::string& arena = "open") {
    return hash_of(canonical_text(settings, find_arena(arena)));
}

TEST(SettingsHash, DoesNotDependOnTheOrderOfKeys) {
    EXPECT_EQ(
        hash(read("[odneat]\np_mate = 0.5\nsigma = 1\n[world]\nrobots = 5\nitems = 3")),
        hash(read("world = { items = 3, robots = 5 }\nodneat.sigma = 1.0\nodneat.p_mate = 5e-1")));
}

TEST(SettingsHash, DependsOnEverySettingThatShapesARun) {
    for (const Setting& setting : settings_table()) {
        if (setting.key == "world.arena") continue;  // its geometry counts, see below
        sim::Settings settings;
        const Value value = setting.default_value();
        if (setting.choices.empty()) {
            std::visit(
                [&](auto held) {
                    if constexpr (std::is_arithmetic_v<decltype(held)>) {
                        setting.set(settings, static_cast<decltype(held)>(held == 0 ? 1 : 0));
                    }
                },
                value);
        } else {
            setting.set(settings, setting.choices[value == Value(setting.choices[0]) ? 1 : 0]);
        }
        EXPECT_EQ(hash(settings) != hash({}), setting.shapes_run()) << setting.key;
    }
}

TEST(SettingsHash, DependsOnTheArenasGeometryAndNotOnItsName) {
    EXPECT_NE(hash({}, "open"), hash({}, "corridor"));
    sim::Settings settings;
    settings.world.arena = "elsewhere/open.toml";
    sim::Arena arena = find_arena("open");
    arena.name = "another name";
    EXPECT_EQ(hash_of(canonical_text(settings, arena)), hash({}));
    arena.walls.push_back({10, 10, 20, 20, 1});
    EXPECT_NE(hash_of(canonical_text(settings, arena)), hash({}));
}

// Stores identify runs by this hash. If it changes because a setting was added, its default must
// mean what runs did before, and stores take it over by themselves; if it changes for any other
// reason, the runs of all stores are lost: raise the store's format version.
TEST(SettingsHash, IsTheSameAsInStoresOfThisVersion) {
    EXPECT_EQ(hash({}), "a09e7ef58585e3bf8e8edcb5a9b7aa6b");
}

TEST(SettingsHash, IsThatOfXxhash) {
    // The hash of the empty text, as xxhash's own command line gives it: printf '' | xxhsum -H2
    EXPECT_EQ(hash_of(""), "99aa06d3014798d86001c324468d497f");
}

TEST(WithNewKeys, AddsTheDefaultsOfKeysThatWereIntroducedSince) {
    const std::string now = canonical_text({}, find_arena("open"));
    auto json = nlohmann::json::parse(now);
    json["settings"]["odneat"].erase("sigma");
    json["settings"].erase("radio");
    const auto [text, added] = with_new_keys(json.dump(), {"store"});
    EXPECT_EQ(text, now);
    EXPECT_THAT(added, testing::UnorderedElementsAre("odneat.sigma", "radio.range_px", "radio.loss",
                                                     "radio.delay_cycles"));
}

TEST(WithNewKeys, LeavesAFullTextAsItIs) {
    sim::Settings settings;
    settings.odneat.p_mate = 0.1234;
    const std::string now = canonical_text(settings, find_arena("open"));
    EXPECT_EQ(with_new_keys(now, {"store"}), (std::pair{now, std::vector<std::string>{}}));
}

TEST(WithNewKeys, RefusesKeysOfALaterProgram) {
    auto json = nlohmann::json::parse(canonical_text({}, find_arena("open")));
    json["settings"]["odneat"]["later"] = 1;
    EXPECT_THAT(input_error([&] { with_new_keys(json.dump(), {"store"}); }),
                testing::HasSubstr("odneat.later: unknown key"));
    EXPECT_THAT(input_error([&] { with_new_keys("{", {"store"}); }), testing::HasSubstr("damaged"));
}

}  // namespace
}  // namespace gene_clocks::experiment
