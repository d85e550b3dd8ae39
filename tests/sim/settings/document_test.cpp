#include "sim/settings/document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/experiment/expect_input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::experiment {
namespace {

using test::input_error;

TEST(Document, SaysWhereTheTextIsNoToml) {
    EXPECT_THAT(input_error([] { parse_document("a = 1\nb = \n", "x.toml"); }),
                testing::StartsWith("x.toml:2: "));
}

TEST(Document, RefusesAKeyThatIsThereTwice) {
    EXPECT_THAT(input_error([] { parse_document("a = 1\n\na = 2\n", "x.toml"); }),
                testing::StartsWith("x.toml:3: "));
}

TEST(Document, RefusesWhatIsNoReadableFile) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(input_error([&] { load_document(folder / "none.toml"); }),
                testing::EndsWith("none.toml: there is no such file"));
    EXPECT_THAT(input_error([&] { load_document(folder.path()); }),
                testing::EndsWith("is not a regular file"));
    const auto large = folder.write("large.toml", std::string(5U << 20U, '#'));
    EXPECT_THAT(input_error([&] { load_document(large); }), testing::HasSubstr("larger than"));
}

// Tables within tables are taken down by recursion: a hundred thousand of them broke the stack.
TEST(Document, RefusesKeysOfTooManyParts) {
    std::string parts;
    for (int i = 0; i < 100'000; ++i) parts += "a.";
    for (const std::string& text :
         {parts + "b = 1", "[" + parts + "b]", "x = { " + parts + "b = 1 }"}) {
        EXPECT_THAT(input_error([&] { parse_document("c = 1\n" + text, "x.toml"); }),
                    testing::StartsWith("x.toml:2: a key with more than 10000 dots"));
    }
    std::string numbers = "list = [0.5";
    for (int i = 1; i < 30'000; ++i) numbers += ", 0.5";
    EXPECT_NO_THROW(parse_document(numbers + "]", "x.toml"));
    const std::string dots(20'000, '.');
    for (const std::string& value :
         {"\"" + dots + "\"", "'" + dots + "'", "\"\\\"" + dots + "\""}) {
        EXPECT_NO_THROW(parse_document("text = " + value, "x.toml")) << value.substr(0, 5);
    }
    EXPECT_NO_THROW(parse_document(parts.substr(0, 2 * 10'000) + "b = 1", "x.toml"));
}

TEST(Document, KnowsItsFolder) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(load_document(folder.write("x.toml", "a = 1")).directory, folder.path());
}

TEST(Builtins, AreFoundByName) {
    EXPECT_THAT(builtin_names(Builtin::profile), testing::ElementsAre("gecco15", "mended", "text"));
    EXPECT_THAT(builtin_names(Builtin::arena),
                testing::IsSupersetOf({"corridor", "gecco15", "open"}));
    EXPECT_THAT(builtin_names(Builtin::study),
                testing::IsSupersetOf({"gecco15", "gecco15-as-printed"}));
    EXPECT_EQ(find_document(Builtin::profile, "mended").name, "built-in profile mended");
}

TEST(Builtins, AreSuggested) {
    const std::string message = input_error([] { find_document(Builtin::arena, "gecco51"); });
    EXPECT_THAT(
        message,
        testing::HasSubstr("arena \"gecco51\": there is none of that name; did you mean gecco15?"));
    EXPECT_THAT(message, testing::HasSubstr("corridor"));
}

TEST(Builtins, ANameWithAnEndingIsAFile) {
    EXPECT_THAT(input_error([] { find_document(Builtin::arena, "gecco15.toml"); }),
                testing::HasSubstr("no such file"));
}

class TableReaderTest : public testing::Test {
protected:
    static constexpr const char* text =
        "name = \"x\"\nwhole = 3\nreal = 2.5\nflag = true\n[inner]\na = 1\n[[row]]\n[[row]]\n";
    Document document = parse_document(text, "x.toml");
    TableReader reader{document, document.table};
};

TEST_F(TableReaderTest, ReadsValues) {
    EXPECT_EQ(reader.text("name"), "x");
    EXPECT_EQ(reader.integer("whole", {0, 10}), 3);
    EXPECT_EQ(reader.real("whole", {0, 10}), 3.0);
    EXPECT_EQ(reader.real("real", {0, 10}), 2.5);
    EXPECT_NE(reader.table("inner"), nullptr);
    EXPECT_EQ(reader.tables("row").size(), 2U);
    EXPECT_EQ(reader.text("absent"), std::nullopt);
    EXPECT_EQ(reader.table("absent"), nullptr);
}

TEST_F(TableReaderTest, RefusesOtherTypes) {
    EXPECT_EQ(input_error([&] { reader.text("whole"); }),
              "x.toml:2: whole: expected a text, found a whole number");
    EXPECT_EQ(input_error([&] {
                  reader.integer("real", {0, 10});
              }),
              "x.toml:3: real: expected a whole number, found a real number");
    EXPECT_EQ(input_error([&] {
                  reader.real("flag", {0, 10});
              }),
              "x.toml:4: flag: expected a real number, found a truth value");
    EXPECT_THAT(input_error([&] { reader.table("name"); }), testing::HasSubstr("expected a table"));
    EXPECT_THAT(input_error([&] { reader.tables("inner"); }), testing::HasSubstr("[[inner]]"));
    EXPECT_THAT(input_error([&] { reader.array("inner"); }),
                testing::HasSubstr("expected an array"));
}

TEST_F(TableReaderTest, RefusesNumbersOutOfRange) {
    EXPECT_EQ(input_error([&] {
                  reader.integer("whole", {4, 10});
              }),
              "x.toml:2: whole: 3 is outside [4, 10]");
    EXPECT_EQ(input_error([&] {
                  reader.real("real", {2.5, 10, true});
              }),
              "x.toml:3: real: 2.5 is outside (2.5, 10]");
}

TEST_F(TableReaderTest, RefusesWhatIsMissing) {
    EXPECT_EQ(input_error([&] { reader.required_text("absent"); }), "x.toml:1: absent: is missing");
}

TEST_F(TableReaderTest, RefusesKeysThatNobodyAskedFor) {
    for (const char* key : {"name", "whole", "real", "flag", "inner"})
        reader.real("absent-" + std::string(key), {});
    EXPECT_THAT(input_error([&] { reader.refuse_other_keys(); }),
                testing::HasSubstr("unknown key"));
    reader.text("name");
    reader.integer("whole", {0, 10});
    reader.real("real", {0, 10});
    reader.table("inner");
    reader.tables("row");
    reader.text("flags");
    EXPECT_EQ(input_error([&] { reader.refuse_other_keys(); }),
              "x.toml:4: flag: unknown key; did you mean flags?");
}

}  // namespace
}  // namespace gene_clocks::experiment
