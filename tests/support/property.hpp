#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <sstream>
#include <string>
#include <utility>

namespace gene_clocks::test {

/// Checks a RapidCheck property as a GoogleTest, on as many cases as RC_PARAMS asks for (100 where
/// it does not) times `effort`. A failure is shrunk, and ends in the command that runs the very
/// same case again.
template <class Testable>
void check_property(Testable&& testable, int effort = 1) {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    const std::string name = std::string(test->test_suite_name()) + "." + test->name();
    const rc::detail::TestMetadata metadata{name, name};
    auto params = rc::detail::configuration().testParams;
    params.maxSuccess *= effort;
    const auto result =
        rc::detail::checkTestable(std::forward<Testable>(testable), metadata, params);

    std::ostringstream message;
    rc::detail::printResultMessage(result, message);
    if (result.template is<rc::detail::SuccessResult>()) {
        if (!result.template get<rc::detail::SuccessResult>().distribution.empty()) {
            std::cout << message.str() << '\n';
        }
        return;
    }
    if (result.template is<rc::detail::FailureResult>()) {
        rc::detail::Configuration replay;
        replay.testParams = rc::detail::configuration().testParams;
        replay.reproduce = {{name, result.template get<rc::detail::FailureResult>().reproduce}};
        message << "\nSeed: " << replay.testParams.seed << "\nReplay: RC_PARAMS='"
                << rc::detail::configToMinimalString(replay) << "' "
                << testing::internal::GetArgvs().front() << " --gtest_filter=" << name << '\n';
    }
    FAIL() << message.str();
}

}  // namespace gene_clocks::test

/// Like TEST(suite, name), for a property: the arguments are drawn.
#define GENE_CLOCKS_PROPERTY(suite, name, arguments)                              \
    static void gene_clocks_property_##suite##_##name arguments;                  \
    TEST(suite, name) {                                                           \
        gene_clocks::test::check_property(gene_clocks_property_##suite##_##name); \
    }                                                                             \
    static void gene_clocks_property_##suite##_##name arguments
