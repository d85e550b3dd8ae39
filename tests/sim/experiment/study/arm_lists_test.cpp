// What the lists in a study's file stand for.
#include "sim/experiment/study/arm_lists.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/experiment/study/study.hpp"
#include "tests/sim/experiment/expect_input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::experiment {
namespace {

using test::input_error;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* head = "name = \"x\"\ntitle = \"X\"\n";
constexpr const char* arm = "[[arm]]\ntask = \"navigation\"\nsource = \"gene-clock\"\n";

Study read(const std::string& text, const StudyOptions& options = {}) {
    return read_study(parse_document(text, "x.toml"), options);
}

std::vector<std::string> names(const Study& study) {
    std::vector<std::string> all;
    for (const Arm& each : study.arms) all.push_back(each.name);
    return all;
}

TEST(ArmLists, AnArmWithoutANameIsCalledByTaskAndSource) {
    const Study study = read(std::string(head) + arm + "parameters = \"A\"\n");
    EXPECT_THAT(names(study), ElementsAre("navigation-gene-clock"));
    EXPECT_EQ(study.arms[0].parameters, "A");
}

TEST(ArmLists, StandForTheirProductWithTheLastVaryingFastest) {
    const Study study = read(std::string(head) + R"([[arm]]
source = ["gene-clock", "timestamp"]
task = ["navigation", "collection"]
[arm.grid]
world.robots = [10, 20, 30]
radio.loss = [0.0, 0.5]
)");
    ASSERT_EQ(study.arms.size(), 2U * 2U * 3U * 2U);
    EXPECT_THAT(names(study), testing::IsSupersetOf({"navigation-gene-clock-robots-10-loss-0",
                                                     "collection-timestamp-robots-30-loss-0p5"}));
    std::size_t index = 0;
    for (const sim::Task task : {sim::Task::navigation, sim::Task::collection}) {
        for (const sim::Source source : {sim::Source::gene_clock, sim::Source::timestamp}) {
            for (const std::int64_t robots : {10, 20, 30}) {
                for (const double loss : {0.0, 0.5}) {
                    const Arm& each = study.arms[index++];
                    EXPECT_EQ(each.settings.task, task) << each.name;
                    EXPECT_EQ(each.settings.source, source) << each.name;
                    EXPECT_EQ(each.settings.world.robots, robots) << each.name;
                    EXPECT_EQ(each.settings.radio.loss, loss) << each.name;
                    EXPECT_EQ(each.parameters, task == sim::Task::navigation ? "B" : "C");
                }
            }
        }
    }
}

TEST(ArmLists, GiveWhatTheSameArmsOneByOneGive) {
    const Study lists = read(std::string(head) + R"([[arm]]
name = "a"
task = "collection"
source = "timestamp"
profile = ["gecco15", "text"]
parameters = ["A", "B"]
settings = { world.items = 20 }
grid = { radio.loss = [0, 0.25] }
)");
    std::string text = head;
    for (const std::string profile : {"gecco15", "text"}) {
        for (const std::string parameters : {"A", "B"}) {
            for (const auto& [loss, label] : {std::pair{"0.0", "0"}, {"0.25", "0p25"}}) {
                text += "[[arm]]\nname = \"a-" + profile + "-" + parameters + "-loss-" + label +
                        "\"\ntask = \"collection\"\nsource = \"timestamp\"\nprofile = \"" +
                        profile + "\"\nparameters = \"" + parameters +
                        "\"\nsettings = { world.items = 20, radio.loss = " + loss + " }\n";
            }
        }
    }
    const Study one_by_one = read(text);
    ASSERT_EQ(lists.arms.size(), one_by_one.arms.size());
    for (std::size_t i = 0; i < lists.arms.size(); ++i) {
        EXPECT_EQ(lists.arms[i].name, one_by_one.arms[i].name);
        EXPECT_EQ(lists.arms[i].profile, one_by_one.arms[i].profile);
        EXPECT_EQ(lists.arms[i].parameters, one_by_one.arms[i].parameters);
        EXPECT_EQ(lists.arms[i].canonical, one_by_one.arms[i].canonical);
    }
}

TEST(ArmLists, LinkedListsGoAlongWithEachOther) {
    const Study study = read(std::string(head) + arm + R"(
[[arm.linked]]
world.robots = [10, 40]
world.items = [7, 30]
[[arm.linked]]
name = ["perfect", "bad"]
timestamp.drift_ppm = [0, 100]
timestamp.offset_cycles = [0, 5]
)");
    EXPECT_THAT(names(study), ElementsAre("navigation-gene-clock-robots-10-perfect",
                                          "navigation-gene-clock-robots-10-bad",
                                          "navigation-gene-clock-robots-40-perfect",
                                          "navigation-gene-clock-robots-40-bad"));
    for (const Arm& each : study.arms) {
        const bool many = each.name.find("robots-40") != std::string::npos;
        const bool bad = each.name.ends_with("bad");
        EXPECT_EQ(each.settings.world.robots, many ? 40 : 10) << each.name;
        EXPECT_EQ(each.settings.world.items, many ? 30 : 7) << each.name;
        EXPECT_EQ(each.settings.timestamp.drift_ppm, bad ? 100.0 : 0.0) << each.name;
        EXPECT_EQ(each.settings.timestamp.offset_cycles, bad ? 5.0 : 0.0) << each.name;
    }
}

TEST(ArmLists, TaskAndSourceMayBeLinkedToo) {
    const Study study = read(std::string(head) + R"([[arm]]
task = "navigation"
[[arm.linked]]
source = ["gene-clock", "timestamp"]
odneat.p_mate = [0.1, 0.2]
)");
    EXPECT_THAT(names(study), ElementsAre("navigation-gene-clock", "navigation-timestamp"));
    EXPECT_EQ(study.arms[1].settings.source, sim::Source::timestamp);
    EXPECT_EQ(study.arms[1].settings.odneat.p_mate, 0.2);
}

TEST(ArmLists, NamesAreReadableAndTellValuesApart) {
    const test::TemporaryFolder folder;
    for (const char* name : {"small rooms.toml", "open-field.toml"}) {
        folder.write(name,
                     "name = \"mine\"\nwidth_px = 100\nheight_px = 100\nwalls = []\n"
                     "frame = { left_px = 0, top_px = 0, right_px = 0, bottom_px = 0 }\n");
    }
    const auto named = [&](const std::string& lists) {
        const auto file = folder.write(
            "x.toml", std::string(head) + arm + "name = \"a\"\n[arm.grid]\n" + lists + "\n");
        return names(read_study(load_document(file)));
    };
    EXPECT_THAT(named("radio.loss = [0, 1.0, 0.25, 1e-7, 0.30000000000000004, 0.3]"),
                ElementsAre("a-loss-0", "a-loss-1", "a-loss-0p25", "a-loss-0p0000001",
                            "a-loss-0p30000000000000004", "a-loss-0p3"));
    EXPECT_THAT(named("world.arena = [\"open\", \"small rooms.toml\", \"open-field.toml\"]"),
                ElementsAre("a-arena-open", "a-arena-small-rooms", "a-arena-open-field"));
    EXPECT_THAT(named("world.actuation = [\"wheels\"]\nrun.record_creation_times = [true, false]"),
                ElementsAre("a-actuation-wheels-record-creation-times-true",
                            "a-actuation-wheels-record-creation-times-false"));
}

TEST(ArmLists, QuickAndAssignmentsPrevail) {
    const std::string text = std::string(head) + arm +
                             "grid.run.cycles = [1000, 2000]\n"
                             "[settings]\nrun.cycles = 5000\n[quick]\nsettings.run.cycles = 300\n";
    const auto cycles = [&](const StudyOptions& options) {
        const Study study = read(text, options);
        return std::pair(study.arms[0].settings.run.cycles, study.arms[1].settings.run.cycles);
    };
    EXPECT_EQ(cycles({}), std::pair(std::int64_t{1000}, std::int64_t{2000}));
    EXPECT_EQ(cycles({.quick = true}), std::pair(std::int64_t{300}, std::int64_t{300}));
    EXPECT_EQ(cycles({.assignments = {"run.cycles=400"}}).second, 400);
}

TEST(ArmLists, RefuseWhatIsUnfit) {
    const std::string start = std::string(head) + arm;  // five lines
    EXPECT_NO_THROW(read(start));
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"grid = 3", "x.toml:6: arm.grid: expected a table"},
        {"[arm.grid]\nradio.loss = 0.5", "x.toml:7: radio.loss: expected a list"},
        {"[arm.grid]\nradio.loss = []", "x.toml:7: radio.loss: the list is empty"},
        {"[arm.grid]\nradio.loss = [0, [1]]", "x.toml:7: radio.loss: expected a list of numbers"},
        {"[arm.grid]\nradio.loss = [0,\n1.5]", "x.toml:8: radio.loss: 1.5 is outside [0, 1]"},
        {"[arm.grid]\nradio.loss = [0,\n\"x\"]", "x.toml:8: radio.loss: expected a real number"},
        {"[arm.grid]\nradio.loss = [nan]", "x.toml:7: radio.loss: nan is outside [0, 1]"},
        {"[arm.grid]\nradio.loss = [0, 0.5,\n0.0]",
         "x.toml:8: radio.loss: two values of the list would both be called loss-0"},
        {"[arm.grid]\nradio.los = [0]",
         "x.toml:7: radio.los: unknown key; did you mean radio.loss?"},
        {"[arm.grid]\nradio = [0]", "radio: is the name of a table of settings"},
        {"settings.radio.loss = 0.1\n[arm.grid]\nradio.loss = [0]",
         "x.toml:8: radio.loss: the arm has this key twice"},
        {"[arm.grid]\ntask = [\"collection\"]", "x.toml:7: task: the arm has this key twice"},
        {"settings.task = \"collection\"", "x.toml:6: task: the arm has this key twice"},
        {"parameters = [\"A\", \"D\"]", "x.toml:6: parameter set \"D\""},
        {"profile = []", "x.toml:6: profile: the list is empty"},
        {"name = \"a b\"", "x.toml:6: arm.name: expected 1 to 100 letters"},
        {"[arm.linked]\nradio.loss = [0]", "x.toml:6: arm.linked: expected tables [[arm.linked]]"},
        {"[[arm.linked]]\nname = [\"a\"]", "x.toml:6: arm.linked: has no list of values"},
        {"[[arm.linked]]\nworld.robots = [1, 2]\nworld.items = [1]",
         "x.toml:8: world.items: has 1 values, world.robots, which it is linked with, has 2"},
        {"[[arm.linked]]\nworld.robots = [1, 2]\nworld.items = [1, 2, 3]",
         "x.toml:8: world.items: has 3 values"},
        {"[[arm.linked]]\nname = [\"a\"]\nworld.robots = [1, 2]",
         "x.toml:7: arm.linked.name: has 1 names for the 2 values of world.robots"},
        {"[[arm.linked]]\nname = [\"a\", 2]\nworld.robots = [1, 2]", "expected a text"},
        {"[[arm.linked]]\nname = [\"a\", \"\"]\nworld.robots = [1, 2]", "expected 1 to 100"},
        {"[[arm.linked]]\nname = [\"a\", \"a\"]\nworld.robots = [1, 2]", "both be called a"},
        {"[[arm.linked]]\nworld.robots = [1, 1]\nworld.items = [1, 2]",
         "two values of the list would both be called robots-1"},
        {"[arm.gird]\nradio.loss = [0]", "arm.gird: unknown key; did you mean grid?"},
        {"name = \"" + std::string(99, 'a') + "\"\ngrid.radio.loss = [0]",
         "x.toml:3: arm.name: \"aaaa"},
        {"[[arm]]\nsource = \"gene-clock\"", "x.toml:6: arm.task: is missing"},
        {"[[arm]]\ntask = [\"navigation\"]", "x.toml:6: arm.source: is missing"},
        {"[[arm]]\ntask = [\"navigation\",\n\"navigate\"]\nsource = \"timestamp\"",
         "x.toml:8: arm.task: \"navigate\" is not navigation or collection"},
        {"[[arm]]\ntask = [\"navigation\"]\nsource = [\"gene-clock\", \"timestamp\"]",
         "x.toml:6: arm.name: there are two arms \"navigation-gene-clock\""},
    };
    for (const auto& [text, message] : cases) {
        EXPECT_THAT(input_error([&] { read(start + text + "\n"); }), HasSubstr(message)) << text;
    }
}

TEST(ArmLists, HaveALimit) {
    const auto list = [](std::size_t count, std::size_t first = 0) {
        std::string text = "[";
        for (std::size_t i = 0; i < count; ++i) text += std::to_string(first + i + 1) + ",";
        return text + "]";
    };
    const auto expanded = [](const std::string& text, std::size_t maximum) {
        const Document document = parse_document(text, "x.toml");
        const toml::table& table = *document.table["arm"][0].as_table();
        return expand_arm(document, table, maximum).size();
    };
    const std::string text = arm + std::string("grid.world.robots = ") + list(6) +
                             "\ngrid.world.items = " + list(5) + "\n";
    EXPECT_EQ(expanded(text, 30), 30U);
    EXPECT_THAT(input_error([&] { expanded(text, 29); }),
                HasSubstr("x.toml:1: arm: its lists give the study more than 10000 arms"));
    // 1000 to the power of seven passes any counter's end.
    std::string many = std::string(head) + arm;
    for (const char* key :
         {"world.robots", "world.items", "world.item_absence_cycles", "run.cycles",
          "run.sample_period_cycles", "radio.delay_cycles", "timestamp.offset_cycles"}) {
        many += std::string("grid.") + key + " = " + list(1000) + "\n";
    }
    EXPECT_THAT(input_error([&] { read(many); }), HasSubstr("x.toml:3: arm: its lists give"));
    // The limit is on the study, not on each [[arm]].
    const std::string two = std::string(head) + arm + "grid.run.cycles = " + list(9999, 1000) +
                            "\n" + arm + "grid.run.cycles = " + list(2, 100) + "\n";
    EXPECT_THAT(input_error([&] { read(two); }), HasSubstr("x.toml:7: arm: its lists give"));
}

TEST(MarkingsStudy, HasEverySourceInBothTasks) {
    const Study study = read_study(find_document(Builtin::study, "markings"));
    ASSERT_EQ(study.arms.size(), 18U);
    EXPECT_EQ(study.arms.front().name, "navigation-gene-clock");
    EXPECT_EQ(study.arms.back().name, "collection-hybrid-logical-clock");
    EXPECT_EQ(study.seeds, 256);
}

}  // namespace
}  // namespace gene_clocks::experiment
