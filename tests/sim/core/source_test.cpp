// The one list of innovation sources.

#include <gtest/gtest.h>

#include <gene_clocks/sim/source.hpp>
#include <regex>
#include <set>
#include <string>

namespace gene_clocks::sim {
namespace {

TEST(Source, EachIsListedInTheOrderOfTheEnumeration) {
    for (std::size_t i = 0; i < sources.size(); ++i) {
        EXPECT_EQ(sources[i].source, static_cast<Source>(i));
        EXPECT_EQ(&display_of(sources[i].source), &sources[i]);
    }
}

// Files and scripts know sources by these names.
TEST(Source, NamesStayWhatTheyAre) {
    EXPECT_EQ(display_of(Source::gene_clock).name, "gene-clock");
    EXPECT_EQ(display_of(Source::gene_clock_no_merge).name, "gene-clock-no-merge");
    EXPECT_EQ(display_of(Source::timestamp).name, "timestamp");
    EXPECT_EQ(display_of(Source::timestamp_drift).name, "timestamp-drift");
    EXPECT_EQ(display_of(Source::random_identifier).name, "random-identifier");
    EXPECT_EQ(display_of(Source::global_counter).name, "global-counter");
    EXPECT_EQ(display_of(Source::congruence_class).name, "congruence-class");
    EXPECT_EQ(display_of(Source::content_hash).name, "content-hash");
    EXPECT_EQ(display_of(Source::hybrid_logical_clock).name, "hybrid-logical-clock");
}

TEST(Source, NoTwoLookOrSoundAlike) {
    std::set<std::string> names, titles, colours, dark_colours, lines;
    const std::regex colour("#[0-9a-f]{6}");
    const std::regex dashes("([0-9.]+ [0-9.]+( [0-9.]+ [0-9.]+)*)?");
    for (const SourceDisplay& source : sources) {
        names.emplace(source.name);
        titles.emplace(source.title);
        colours.emplace(source.colour);
        dark_colours.emplace(source.dark_colour);
        lines.insert(std::string(source.dashes) + "/" + std::string(source.marker));
        EXPECT_TRUE(std::regex_match(std::string(source.colour), colour)) << source.name;
        EXPECT_TRUE(std::regex_match(std::string(source.dark_colour), colour)) << source.name;
        EXPECT_TRUE(std::regex_match(std::string(source.dashes), dashes)) << source.name;
    }
    for (const auto* set : {&names, &titles, &colours, &dark_colours, &lines})
        EXPECT_EQ(set->size(), sources.size());
}

}  // namespace
}  // namespace gene_clocks::sim
