#include "sim/experiment/study/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "sim/settings/choice_names.hpp"
#include "tests/sim/experiment/expect_input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::experiment {
namespace {

using test::input_error;

constexpr const char* head = "name = \"x\"\ntitle = \"X\"\n";
constexpr const char* arm =
    "[[arm]]\nname = \"a\"\ntask = \"navigation\"\nsource = \"gene-clock\"\n";

Study read(const std::string& text, const StudyOptions& options = {}) {
    return read_study(parse_document(text, "x.toml"), options);
}

TEST(PaperStudy, IsAsTheRunsWereMade) {
    const Study study = read_study(find_document(Builtin::study, "gecco15"));
    EXPECT_EQ(study.name, "gecco15");
    EXPECT_EQ(study.seeds, 64);
    EXPECT_EQ(study.first_seed, 1U);
    ASSERT_EQ(study.arms.size(), 4U);
    std::set<std::pair<sim::Task, sim::Source>> arms;
    for (const Arm& each : study.arms) {
        EXPECT_EQ(each.profile, "gecco15");
        EXPECT_EQ(each.parameters, each.settings.task == sim::Task::navigation ? "B" : "C");
        EXPECT_EQ(each.arena.name, "gecco15");
        EXPECT_EQ(each.settings.run.cycles,
                  each.settings.task == sim::Task::navigation ? 40'000 : 60'000);
        arms.emplace(each.settings.task, each.settings.source);
    }
    EXPECT_EQ(arms.size(), 4U);
}

TEST(PaperStudy, AsPrintedDiffersInTheParametersAlone) {
    const Study as_run = read_study(find_document(Builtin::study, "gecco15"));
    const Study as_printed = read_study(find_document(Builtin::study, "gecco15-as-printed"));
    ASSERT_EQ(as_printed.arms.size(), as_run.arms.size());
    EXPECT_EQ(as_printed.seeds, as_run.seeds);
    for (std::size_t i = 0; i < as_run.arms.size(); ++i) {
        const Arm& run = as_run.arms[i];
        const Arm& printed = as_printed.arms[i];
        EXPECT_EQ(printed.name, run.name);
        EXPECT_EQ(printed.settings.task, run.settings.task);
        EXPECT_EQ(printed.settings.source, run.settings.source);
        EXPECT_EQ(printed.parameters, run.settings.task == sim::Task::navigation ? "A" : "B");
        EXPECT_EQ(printed.settings.run.cycles, run.settings.run.cycles);
        EXPECT_EQ(printed.settings.world.item_slip, run.settings.world.item_slip);
    }
}

TEST(BuiltinStudies, HaveQuickVersionsAndThePapersReachTheCycleOfComparison) {
    for (const std::string& name : builtin_names(Builtin::study)) {
        const Study study = read_study(find_document(Builtin::study, name), {.quick = true});
        EXPECT_EQ(study.name, name + "-quick");
        EXPECT_LE(study.seeds, 10);
        const bool is_the_papers = name.starts_with("gecco15");
        for (const Arm& each : study.arms) {
            EXPECT_LE(each.settings.run.cycles, 12'000) << name;
            EXPECT_TRUE(!is_the_papers || each.settings.run.cycles > 10'000) << name;
        }
    }
}

TEST(Study, LaterSettingsPrevail) {
    const std::string text =
        std::string(head) +
        "profile = \"text\"\nseeds = 5\nfirst_seed = 3\n"
        "[settings]\nworld.robots = 10\nworld.items = 10\nrun.cycles = 1000\nodneat.sigma = 1\n" +
        arm +
        "settings = { world.items = 20, run.cycles = 2000 }\n"
        "[quick]\nseeds = 2\nsettings = { run.cycles = 300 }\n";
    const Study study = read(text);
    EXPECT_EQ(study.seeds, 5);
    EXPECT_EQ(study.first_seed, 3U);
    EXPECT_EQ(study.arms[0].settings.world.actuation, sim::Actuation::wheels);
    EXPECT_EQ(study.arms[0].settings.odneat.sigma, 1.0);  // over the parameter set
    EXPECT_EQ(study.arms[0].settings.world.robots, 10);
    EXPECT_EQ(study.arms[0].settings.world.items, 20);
    EXPECT_EQ(study.arms[0].settings.run.cycles, 2000);
    const Study quick = read(text, {.quick = true, .assignments = {"world.robots=4"}});
    EXPECT_EQ(quick.name, "x-quick");
    EXPECT_EQ(quick.title, "X (quick)");
    EXPECT_EQ(quick.seeds, 2);
    EXPECT_EQ(quick.arms[0].settings.run.cycles, 300);
    EXPECT_EQ(quick.arms[0].settings.world.robots, 4);
    EXPECT_EQ(read(text, {.quick = true, .seeds = 9}).seeds, 9);
}

TEST(Study, AnArmMayHaveItsOwnProfileAndArena) {
    const test::TemporaryFolder folder;
    folder.write("arena.toml",
                 "name = \"mine\"\nwidth_px = 100\nheight_px = 100\nwalls = []\n"
                 "frame = { left_px = 0, top_px = 0, right_px = 0, bottom_px = 0 }\n");
    const auto file =
        folder.write("study.toml", std::string(head) + arm + "profile = \"gecco15\"\n" +
                                       "settings.world.arena = \"arena.toml\"\n");
    const Study study = read_study(load_document(file));
    EXPECT_EQ(study.arms[0].profile, "gecco15");
    EXPECT_EQ(study.arms[0].arena.name, "mine");
}

TEST(Study, RefusesWhatIsUnfit) {
    const std::string good = std::string(head) + arm;
    EXPECT_NO_THROW(read(good));
    const std::vector<std::pair<std::string, std::string>> cases = {
        {arm, "name: is missing"},
        {"name = \"../x\"\ntitle = \"X\"\n" + std::string(arm),
         "x.toml:1: name: expected 1 to 100 letters"},
        {"name = \"x\"\n" + std::string(arm), "title: is missing"},
        {head, "arm: is missing"},
        {head + std::string("arm = 3"), "expected tables [[arm]]"},
        {good + "taks = 3\n", "x.toml:7: arm.taks: unknown key; did you mean task?"},
        {std::string(head) + "seed = 3\n" + arm,
         "x.toml:3: seed: unknown key; did you mean seeds?"},
        {std::string(head) + "seeds = 0\n" + arm, "x.toml:3: seeds: 0 is outside"},
        {std::string(head) + "seeds = 2.5\n" + arm, "expected a whole number"},
        {std::string(head) + "first_seed = -1\n" + arm, "-1 is outside"},
        {std::string(head) + "profile = \"mendde\"\n" + arm,
         "x.toml:3: profile \"mendde\": there is"},
        {good + "profile = \"mendde\"\n", "x.toml:7: profile \"mendde\": there is"},
        {std::string(head) + "[settings]\nworld.arena = \"opne\"\n" + arm,
         "x.toml:4: arena \"opne\""},
        {good + "parameters = \"D\"\n", "x.toml:7: parameter set \"D\""},
        {good + "settings = { odneat.p_mtae = 1 }\n",
         "x.toml:7: odneat.p_mtae: unknown key; did you mean odneat.p_mate?"},
        {good + "settings = { radio.range_px = 50 }\n", "arm a: radio.range_px: 50 exceeds"},
        {good + "settings = { world.arena = \"opne\" }\n", "x.toml:7: arena \"opne\": there is"},
        {good + arm, "x.toml:7: arm.name: there are two arms \"a\""},
        {good + "[quick]\nseed = 3\n", "quick.seed: unknown key; did you mean seeds?"},
        {good + "[quick]\nsettings.radio.los = 1\n", "radio.los: unknown key"},
        {"name = \"x\"\ntitle = \"X\"\n[[arm]]\nname = \"a\"\ntask = \"navigate\"\nsource = "
         "\"gene-clock\"\n",
         "x.toml:5: arm.task: \"navigate\" is not navigation or collection; did you mean "
         "navigation?"},
    };
    for (const auto& [text, message] : cases) {
        EXPECT_THAT(input_error([&] { read(text); }), testing::HasSubstr(message)) << text;
    }
    EXPECT_THAT(input_error([&] { read(good, {.quick = true}); }),
                testing::HasSubstr("no section [quick]"));
    EXPECT_THAT(input_error([&] { read(good, {.assignments = {"world.robot=3"}}); }),
                testing::HasSubstr("did you mean world.robots?"));
}

TEST(Rehearse, RefusesAnArenaWithNoFreePlace) {
    const test::TemporaryFolder folder;
    folder.write("full.toml",
                 "name = \"full\"\nwidth_px = 30\nheight_px = 30\nwalls = []\n"
                 "frame = { left_px = 5, top_px = 5, right_px = 5, bottom_px = 5 }\n");
    const auto file = folder.write(
        "study.toml",
        std::string(head) + arm + "settings.world = { arena = \"full.toml\", robots = 500 }\n");
    const Study study = read_study(load_document(file));
    EXPECT_THAT(input_error([&] { rehearse(study); }), testing::StartsWith("arm a: "));
}

TEST(Rehearse, PassesTheBuiltinStudies) {
    for (const std::string& name : builtin_names(Builtin::study)) {
        EXPECT_NO_THROW(rehearse(read_study(find_document(Builtin::study, name)))) << name;
    }
}

}  // namespace
}  // namespace gene_clocks::experiment
