#include "sim/settings/profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/settings/choice_names.hpp"
#include "sim/settings/settings_io.hpp"
#include "tests/sim/experiment/expect_input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::experiment {
namespace {

using sim::Task;
using test::input_error;

sim::Settings of(const std::string& profile, Task task,
                 std::optional<std::string> parameters = {}) {
    return select({.task = task, .profile = profile, .parameters = std::move(parameters)});
}

/// p_mate, p_mutate, p_w, p_node, p_conn, p_recur, sigma, T_m, |P|
using Parameters = std::array<double, 9>;
Parameters parameters_of(const sim::Settings& settings) {
    const neat::OdneatSettings& odneat = settings.odneat;
    return {odneat.p_mate,
            odneat.p_mutate,
            odneat.p_weight,
            odneat.p_node,
            odneat.p_connection,
            odneat.p_recurrent,
            odneat.sigma,
            static_cast<double>(odneat.maturation_cycles),
            static_cast<double>(odneat.population)};
}
// Table 1 prints A as navigation and B as collection; C is absent from it.
constexpr Parameters set_a{.842, .154, .575, .057, .184, .376, .442, 19, 5};
constexpr Parameters set_b{.212, .244, .559, .422, .275, .526, .114, 27, 7};
constexpr Parameters set_c{.085, .784, .864, .162, .583, .541, .62, 5, 6};

TEST(Parameters, AreThoseOfThePaper) {
    EXPECT_THAT(parameter_set_names(), testing::ElementsAre("A", "B", "C"));
    EXPECT_EQ(parameters_of(of("gecco15", Task::navigation, "A")), set_a);
    EXPECT_EQ(parameters_of(of("gecco15", Task::collection, "B")), set_b);
    EXPECT_EQ(parameters_of(of("gecco15", Task::navigation, "C")), set_c);
}

TEST(Parameters, AreTheTasksOwnIfNoneIsNamed) {
    for (const std::string& profile : builtin_names(Builtin::profile)) {
        EXPECT_EQ(parameters_of(of(profile, Task::navigation)), set_b) << profile;
        EXPECT_EQ(parameters_of(of(profile, Task::collection)), set_c) << profile;
        EXPECT_EQ(parameter_set_of({.task = Task::navigation, .profile = profile}), "B");
        EXPECT_EQ(parameter_set_of({.task = Task::collection, .profile = profile}), "C");
    }
    EXPECT_EQ(parameter_set_of({.parameters = "A"}), "A");
}

TEST(Parameters, RefuseASetThatIsNone) {
    EXPECT_THAT(
        input_error([] { of("gecco15", Task::navigation, "D"); }),
        testing::HasSubstr("parameter set \"D\": there is none of that name; there are A, B or C"));
}

TEST(Profile, Gecco15HasTheSlips) {
    const sim::Settings navigation = of("gecco15", Task::navigation);
    const sim::Settings collection = of("gecco15", Task::collection);
    EXPECT_EQ(collection.world.item_slip, 0.21);
    for (const sim::Settings& settings : {navigation, collection}) {
        EXPECT_EQ(settings.odneat.held_energy, neat::HeldEnergy::overwrite);
        EXPECT_EQ(settings.odneat.weight_difference, neat::WeightDifference::sum);
        EXPECT_EQ(settings.world.actuation, sim::Actuation::translation_rotation);
        EXPECT_EQ(settings.energy.navigation, sim::NavigationEnergy::reference);
    }
}

TEST(Profile, MendedDiffersFromGecco15InTheSlipsAlone) {
    for (const Task task : {Task::navigation, Task::collection}) {
        sim::Settings gecco15 = of("gecco15", task);
        gecco15.world.item_slip = 0.0;
        gecco15.odneat.held_energy = neat::HeldEnergy::running_mean;
        EXPECT_EQ(to_json(gecco15), to_json(of("mended", task)));
    }
}

TEST(Profile, TextFollowsThePaper) {
    const sim::Settings settings = of("text", Task::navigation);
    EXPECT_EQ(settings.world.actuation, sim::Actuation::wheels);
    EXPECT_EQ(settings.energy.navigation, sim::NavigationEnergy::equation_2);
    EXPECT_EQ(settings.odneat.weight_difference, neat::WeightDifference::mean);
    EXPECT_EQ(settings.odneat.held_energy, neat::HeldEnergy::running_mean);
    EXPECT_LT(settings.odneat.species_threshold, 1.0);
    EXPECT_EQ(of("text", Task::collection).world.item_slip, 0.0);
}

TEST(Profile, RunsAreAsLongAsThePaperSays) {
    for (const std::string& profile : builtin_names(Builtin::profile)) {
        EXPECT_EQ(of(profile, Task::navigation).run.cycles, 40'000);
        EXPECT_EQ(of(profile, Task::collection).run.cycles, 60'000);
        EXPECT_EQ(of(profile, Task::navigation).world.robots, 100);
        EXPECT_EQ(of(profile, Task::collection).world.items, 75);
    }
}

class ProfileFileTest : public testing::Test {
protected:
    std::string write(const std::string& text) { return folder.write("mine.toml", text).string(); }
    test::TemporaryFolder folder;
};

TEST_F(ProfileFileTest, LaterSectionsPrevail) {
    const std::string file = write(
        "parameters.navigation = \"A\"\n"
        "settings = { world.robots = 10, world.items = 11, odneat.p_mate = 0.5 }\n"
        "[collection]\nworld.robots = 20\n");
    EXPECT_EQ(of(file, Task::navigation).world.robots, 10);
    EXPECT_EQ(of(file, Task::collection).world.robots, 20);
    EXPECT_EQ(of(file, Task::collection).world.items, 11);
    EXPECT_EQ(of(file, Task::navigation).odneat.p_mate, set_a[0]);
    EXPECT_EQ(of(file, Task::collection).odneat.p_mate, 0.5);  // names no set for that task
    EXPECT_EQ(parameter_set_of({.task = Task::collection, .profile = file}), "");
}

TEST_F(ProfileFileTest, RefusesWhatItDoesNotKnow) {
    EXPECT_THAT(input_error([&] { of(write("\nnavigaton = {}\n"), Task::navigation); }),
                testing::EndsWith("mine.toml:2: navigaton: unknown key; did you mean navigation?"));
    EXPECT_THAT(input_error([&] { of(write("parameters.nav = \"A\""), Task::navigation); }),
                testing::HasSubstr("parameters.nav: unknown key"));
    EXPECT_THAT(
        input_error([&] { of(write("[settings.world]\nrobot = 3"), Task::navigation); }),
        testing::EndsWith("mine.toml:2: world.robot: unknown key; did you mean world.robots?"));
    EXPECT_THAT(input_error([&] { of(write("parameters.navigation = \"Z\""), Task::navigation); }),
                testing::HasSubstr("parameter set \"Z\""));
    EXPECT_THAT(input_error([] { of("gecco2015", Task::navigation); }),
                testing::HasSubstr("did you mean gecco15?"));
}

}  // namespace
}  // namespace gene_clocks::experiment
