#include "sim/settings/suggestion.hpp"

#include <gtest/gtest.h>

namespace gene_clocks::experiment {
namespace {

using Words = std::vector<std::string>;

TEST(Suggestion, FindsTheNearestWord) {
    const Words words{"navigation", "collection"};
    EXPECT_EQ(nearest("navigaton", words), 0U);    // a letter missing
    EXPECT_EQ(nearest("colllection", words), 1U);  // one too many
    EXPECT_EQ(nearest("colledtion", words), 1U);   // a wrong one
    EXPECT_EQ(nearest("anvigation", words), 0U);   // two swapped
    EXPECT_EQ(nearest("navigation", words), 0U);
}

TEST(Suggestion, IsSilentAboutWordsThatAreFarOff) {
    EXPECT_EQ(nearest("foraging", {"navigation", "collection"}), std::nullopt);
    EXPECT_EQ(nearest("", {"run"}), std::nullopt);
    EXPECT_EQ(nearest("run", {}), std::nullopt);
    EXPECT_EQ(suggestion("foraging", {"navigation"}), "");
}

TEST(Suggestion, OfShortWordsTakesOneSlipOnly) {
    EXPECT_EQ(nearest("rnu", {"run"}), 0U);  // swapped letters are one slip
    EXPECT_EQ(nearest("rxx", {"run"}), std::nullopt);
}

TEST(Suggestion, PrefersTheFewerSlips) {
    EXPECT_EQ(nearest("sed", {"sets", "seed"}), 1U);
}

TEST(Suggestion, JoinsWords) {
    EXPECT_EQ(one_of({}), "");
    EXPECT_EQ(one_of({"a"}), "a");
    EXPECT_EQ(one_of({"a", "b"}), "a or b");
    EXPECT_EQ(list_of({"a", "b", "c"}), "a, b and c");
}

}  // namespace
}  // namespace gene_clocks::experiment
