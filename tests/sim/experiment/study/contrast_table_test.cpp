#include "sim/experiment/study/contrast_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/experiment/study/study.hpp"
#include "tests/sim/experiment/expect_input_error.hpp"

namespace gene_clocks::experiment {
namespace {

using testing::HasSubstr;

/// A study of two arms, "a-gene-clock" and "a-timestamp", with this table.
Study study_with(const std::string& table) {
    return read_study(parse_document(R"(name = "s"
title = "t"
[[arm]]
name = "a"
task = "navigation"
source = ["gene-clock", "timestamp"]
)" + table,
                                     "s.toml"));
}

TEST(ContrastTable, SaysWhatArmsAreComparedWith) {
    EXPECT_FALSE(study_with("").contrast);
    const ContrastTable one =
        *study_with("[contrast]\nbaseline = [\"source=gene-clock\", \"radio.loss=0\"]").contrast;
    EXPECT_EQ(one.arms.baseline, (std::vector<std::string>{"source=gene-clock", "radio.loss=0"}));
    EXPECT_TRUE(one.arms.against.empty());
    EXPECT_FALSE(one.paired);
    const ContrastTable two = *study_with(R"([contrast]
against = ["a-timestamp"]
[contrast.paired]
baseline = ["source=gene-clock"]
over = ["radio.loss"])")
                                   .contrast;
    EXPECT_EQ(two.arms.against, std::vector<std::string>{"a-timestamp"});
    EXPECT_EQ(two.paired->over, std::vector<std::string>{"radio.loss"});
    EXPECT_EQ(contrast_table_from(to_text(one), "x"), one);
    EXPECT_EQ(contrast_table_from(to_text(two), "x"), two);
}

TEST(ContrastTable, ChangesNoArm) {
    const Study without = study_with("");
    const Study with = study_with("[contrast]\nbaseline = [\"radio.loss=0\"]");
    for (std::size_t i = 0; i < without.arms.size(); ++i) {
        EXPECT_EQ(with.arms[i].settings_hash, without.arms[i].settings_hash);
    }
}

TEST(ContrastTable, WhatIsUnfitIsRefusedWithItsLine) {
    const auto refusal = [](const std::string& table) {
        return test::input_error([&] { study_with("[contrast]\n" + table); });
    };
    EXPECT_EQ(refusal("baseline = [\"radio.los=0\"]"),
              "s.toml:8: contrast.baseline: radio.los=0: radio.los: unknown key; did you mean "
              "radio.loss?");
    EXPECT_THAT(refusal("baseline = [\"radio.loss\"]"), HasSubstr("expected key=value"));
    EXPECT_THAT(refusal("baseline = [\"radio.loss=2\"]"), HasSubstr("2 is outside [0, 1]"));
    EXPECT_THAT(refusal("baseline = [1]"),
                HasSubstr("s.toml:8: contrast.baseline: expected a text"));
    EXPECT_THAT(refusal("baseline = []"), HasSubstr("is an empty list"));
    EXPECT_THAT(refusal("baseline = \"radio.loss=0\""), HasSubstr("s.toml:8: contrast.baseline"));
    EXPECT_THAT(
        refusal("over = [\"radio.los\"]"),
        HasSubstr("s.toml:8: contrast.over: there is no setting \"radio.los\"; did you mean "
                  "radio.loss?"));
    EXPECT_THAT(refusal("against = [\"a-timestamps\"]"),
                HasSubstr("contrast.against: the study has no arm \"a-timestamps\"; did you mean "
                          "a-timestamp?"));
    EXPECT_THAT(refusal("against = [\"a-timestamp\"]\nbaseline = [\"radio.loss=0\"]"),
                HasSubstr("keep one of the two"));
    EXPECT_THAT(refusal("baselin = [\"radio.loss=0\"]"),
                HasSubstr("contrast.baselin: unknown key; did you mean baseline?"));
    EXPECT_THAT(refusal("[contrast.paired]\nagainst = [\"b\"]"),
                HasSubstr("contrast.paired.against: the study has no arm \"b\""));
}

TEST(ContrastTable, ADamagedTextIsRefused) {
    for (const char* text : {"", "[]", "{\"baseline\": 1}", "{\"baseline\": [1]}"}) {
        EXPECT_THAT(test::input_error([&] { (void)contrast_table_from(text, "s.sqlite"); }),
                    HasSubstr("s.sqlite: is damaged"))
            << text;
    }
}

// No script knows a study's name: the study's file says how its results are made.
TEST(ContrastTable, BuiltInStudiesNameArmsAndKeysThatTheyHave) {
    std::size_t tables = 0;
    for (const std::string& name : builtin_names(Builtin::study)) {
        if (read_study(find_document(Builtin::study, name)).contrast) ++tables;
    }
    EXPECT_GE(tables, 10U);
}

}  // namespace
}  // namespace gene_clocks::experiment
