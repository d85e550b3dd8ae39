#include "sim/core/src/task.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gene_clocks::sim {
namespace {

struct Movement {
    float translation, rotation;
};

Movement interpret(Actuation actuation, float output_0, float output_1) {
    Movement movement{};
    interpret_outputs(actuation,
                      {1, &output_0, &output_1, &movement.translation, &movement.rotation});
    return movement;
}

float energy(NavigationEnergy rule, float translation, float rotation, float nearest) {
    float unused = 0.0f;
    float change = 0.0f;
    navigation_energy(rule, {1, &unused, &unused, &translation, &rotation}, &nearest, &change);
    return change;
}

TEST(InterpretOutputs, TranslationAndRotationSpanBothSigns) {
    for (const float output : {0.0f, 0.25f, 0.5f, 1.0f}) {
        const auto movement = interpret(Actuation::translation_rotation, output, 1.0f - output);
        EXPECT_FLOAT_EQ(movement.translation, 2.0f * output - 1.0f);
        EXPECT_FLOAT_EQ(movement.rotation, 1.0f - 2.0f * output);
    }
}

TEST(InterpretOutputs, WheelsGoStraightTogetherAndTurnApart) {
    EXPECT_FLOAT_EQ(interpret(Actuation::wheels, 1.0f, 1.0f).translation, 1.0f);
    EXPECT_FLOAT_EQ(interpret(Actuation::wheels, 1.0f, 1.0f).rotation, 0.0f);
    EXPECT_FLOAT_EQ(interpret(Actuation::wheels, 0.0f, 0.0f).translation, -1.0f);
    // The left wheel alone turns the robot clockwise, which is positive.
    EXPECT_FLOAT_EQ(interpret(Actuation::wheels, 1.0f, 0.0f).rotation, 1.0f);
    EXPECT_FLOAT_EQ(interpret(Actuation::wheels, 1.0f, 0.0f).translation, 0.0f);
}

TEST(InterpretOutputs, EveryRobotHasItsOwn) {
    constexpr std::size_t robots = 37;  // not a multiple of any register
    std::vector<float> output_0, output_1, translation(robots), rotation(robots);
    for (std::size_t i = 0; i < robots; ++i) {
        output_0.push_back(static_cast<float>(i) / robots);
        output_1.push_back(1.0f - output_0.back());
    }
    interpret_outputs(Actuation::translation_rotation, {robots, output_0.data(), output_1.data(),
                                                        translation.data(), rotation.data()});
    for (std::size_t i = 0; i < robots; ++i) {
        EXPECT_FLOAT_EQ(translation[i], 2.0f * (output_0[i] - 0.5f));
        EXPECT_FLOAT_EQ(rotation[i], 2.0f * (output_1[i] - 0.5f));
    }
}

// docs/deviations.md, energy in navigation.
TEST(NavigationEnergy, OfTheReferenceIsItsFormula) {
    for (float t = -1.0f; t <= 1.0f; t += 0.25f) {
        for (float r = -1.0f; r <= 1.0f; r += 0.25f) {
            for (const double m : {0.0, 0.3, 1.0}) {
                const double right = (t - r / 2) / 1.5;
                const double left = (t + r / 2) / 1.5;
                const double speed = std::abs(right / 2 + 0.5) + std::abs(left / 2 + 0.5);
                const double expected = 2 * speed * (1 - std::sqrt(std::abs(right - left))) * m - 1;
                EXPECT_NEAR(energy(NavigationEnergy::reference, t, r, static_cast<float>(m)),
                            expected, 1e-5);
            }
        }
    }
}

TEST(NavigationEnergy, OfTheReferenceRewardsStandingInTheOpen) {
    EXPECT_FLOAT_EQ(energy(NavigationEnergy::reference, 0.0f, 0.0f, 1.0f), 1.0f);
    EXPECT_NEAR(energy(NavigationEnergy::reference, 1.0f, 0.0f, 1.0f), 7.0 / 3, 1e-5);
}

TEST(NavigationEnergy, OfEquation2DoesNot) {
    EXPECT_FLOAT_EQ(energy(NavigationEnergy::equation_2, 0.0f, 0.0f, 1.0f), -1.0f);
    EXPECT_FLOAT_EQ(energy(NavigationEnergy::equation_2, 1.0f, 0.0f, 1.0f), 1.0f);
    EXPECT_FLOAT_EQ(energy(NavigationEnergy::equation_2, 1.0f, 0.0f, 0.25f), -0.5f);
    EXPECT_FLOAT_EQ(energy(NavigationEnergy::equation_2, 0.5f, 0.25f, 1.0f), -0.5f);
}

}  // namespace
}  // namespace gene_clocks::sim
