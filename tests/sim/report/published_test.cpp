#include "sim/report/published.hpp"

#include <gtest/gtest.h>

#include <string>

#include "sim/settings/embedded_files.hpp"
#include "sim/settings/input_error.hpp"

namespace gene_clocks::report {
namespace {

TEST(Published, HoldsThePapersTables) {
    const PublishedTask& navigation = published().tasks.at(sim::Task::navigation);
    const PublishedTask& collection = published().tasks.at(sim::Task::collection);
    EXPECT_EQ(navigation.printed_parameters, "A");
    EXPECT_EQ(navigation.run_parameters, "B");
    EXPECT_EQ(collection.printed_parameters, "B");
    EXPECT_EQ(collection.run_parameters, "C");
    EXPECT_EQ(navigation.p_values,
              (std::map<std::string, double>{
                  {"f_a", 0.074}, {"f_b", 0.175}, {"f_c", 0.134}, {"t_f", 0.489}}));
    EXPECT_EQ(collection.p_values,
              (std::map<std::string, double>{
                  {"f_a", 0.697}, {"f_b", 0.956}, {"f_c", 0.698}, {"t_f", 0.373}}));
    EXPECT_EQ(navigation.cycles, 40000);
    EXPECT_EQ(collection.cycles, 60000);
    EXPECT_EQ(published().runs, 64);
    EXPECT_EQ(published().fixed.at("odneat.c_disjoint"), 1.5);
}

TEST(Published, EveryTaskAndMethodAsRunHasAReference) {
    for (const auto& [task, numbers] : published().tasks) {
        for (const sim::Source source : {sim::Source::gene_clock, sim::Source::timestamp}) {
            int found = 0;
            for (const PublishedRuns& runs : published().reference) {
                if (runs.task != task || runs.source != source) continue;
                if (runs.parameters != numbers.run_parameters) continue;
                ++found;
                EXPECT_EQ(runs.ranges.size(), 4U);
                for (const auto& [measure, range] : runs.ranges)
                    EXPECT_TRUE(range.median && range.contains(*range.median)) << measure;
            }
            EXPECT_EQ(found, 1);
        }
    }
}

/// The embedded file with one text in place of another.
std::string message_of(const std::string& text, const std::string& replacement) {
    std::string toml(experiment::embedded_text("report/published.toml"));
    const std::size_t position = toml.find(text);
    EXPECT_NE(position, std::string::npos) << text;
    toml.replace(position, text.size(), replacement);
    try {
        read_published(experiment::parse_document(toml, "p.toml"));
    } catch (const experiment::InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Published, MistakesAreNamedWithTheirLine) {
    EXPECT_EQ(message_of("runs = 64", "runs = 64"), "");
    const auto expect_message = [](const std::string& message, const std::string& part) {
        EXPECT_EQ(message.rfind("p.toml:", 0), 0U) << message;
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expect_message(message_of("species = [3.5, 3.75, 4.0]", "specis = [3.5, 3.75, 4.0]"),
                   "specis: unknown key");
    expect_message(message_of("[3.5, 3.75, 4.0]", "[3.5, 3.4, 4.0]"), "do not ascend");
    expect_message(message_of("[3.5, 3.75, 4.0]", "[3.5]"), "two or three");
    expect_message(message_of("[3.5, 3.75, 4.0]", "[3.5, \"x\"]"), "expected a real number");
    expect_message(message_of("f_b = 0.956", "f_b = 1.956"), "outside");
    expect_message(message_of("f_b = 0.956", ""), "f_b: is missing");
    expect_message(message_of("task = \"collection\"", "task = \"colection\""), "task");
    expect_message(message_of("navigation = \"B\"", ""), "navigation: is missing");
}

}  // namespace
}  // namespace gene_clocks::report
