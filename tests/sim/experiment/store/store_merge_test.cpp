#include "sim/experiment/store/store_merge.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <map>
#include <sstream>

#include "sim/experiment/store/csv_export.hpp"
#include "tests/sim/experiment/example_study.hpp"
#include "tests/sim/experiment/expect_input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::experiment {
namespace {

using test::example_run;
using test::example_study;
using test::input_error;
using testing::HasSubstr;

class StoreMergeTest : public testing::Test {
protected:
    /// A store with some runs of the study's: pairs of an arm's index and a seed.
    std::filesystem::path store(
        const std::string& name,
        const std::vector<std::pair<std::size_t, std::uint64_t>>& runs) const {
        const auto file = folder / name;
        Store store = Store::open_for_writing(file);
        store.put_study(study);
        for (const auto& [arm, seed] : runs) store.put_run(example_run(study.arms.at(arm), seed));
        return file;
    }
    static void change(const std::filesystem::path& file, const std::string& sql) {
        SQLite::Database(file, SQLite::OPEN_READWRITE).exec(sql);
    }
    static std::string contents(const std::filesystem::path& file) {
        const Store store = Store::open_for_reading(file);
        std::ostringstream text;
        write_runs_csv(store, store.studies(), text);
        write_samples_csv(store, store.studies(), text);
        return text.str();
    }
    [[nodiscard]] std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            all[entry.path().filename()] = test::read_all(entry.path());
        }
        return all;
    }
    /// A merge is refused with this message, and changes nothing.
    void expect_refusal(const std::filesystem::path& out,
                        const std::vector<std::filesystem::path>& in,
                        const std::string& message) const {
        const auto before = files();
        EXPECT_THAT(input_error([&] { merge_stores(out, in); }), HasSubstr(message));
        EXPECT_EQ(files(), before);
    }
    test::TemporaryFolder folder;
    Study study = example_study();
};

TEST_F(StoreMergeTest, GivesTheStoreThatHasAllRuns) {
    const auto whole = store("whole.sqlite", {{0, 3}, {0, 4}, {1, 3}, {1, 7}});
    const auto a = store("a.sqlite", {{0, 4}, {1, 7}});
    const auto b = store("b.sqlite", {{1, 3}, {0, 3}});
    const auto before = files();
    const auto result = merge_stores(folder / "out.sqlite", {a, b});
    EXPECT_EQ(result.runs_added, 4U);
    EXPECT_EQ(result.runs_in_all, 4U);
    EXPECT_EQ(result.runs_of_other_versions, 0U);
    EXPECT_EQ(contents(folder / "out.sqlite"), contents(whole));
    auto after = files();
    after.erase("out.sqlite");
    EXPECT_EQ(after, before);
}

TEST_F(StoreMergeTest, KeepsEveryTableOfARun) {
    const auto a = store("a.sqlite", {{0, 4}});
    merge_stores(folder / "out.sqlite", {a});
    const auto rows = [&](const std::string& file) {
        SQLite::Database database((folder / file).string());
        std::map<std::string, int> count;
        SQLite::Statement tables(database, "SELECT name FROM sqlite_schema WHERE type = 'table'");
        while (tables.executeStep()) {
            const std::string table = tables.getColumn(0).getString();
            count[table] = database.execAndGet("SELECT COUNT(*) FROM " + table).getInt();
        }
        return count;
    };
    EXPECT_GE(rows("a.sqlite").size(), 6U);
    EXPECT_EQ(rows("out.sqlite"), rows("a.sqlite"));
}

TEST_F(StoreMergeTest, AddsToWhatIsThere) {
    const auto out = store("out.sqlite", {{0, 3}, {1, 3}});
    const auto a = store("a.sqlite", {{0, 3}, {0, 4}});
    EXPECT_EQ(merge_stores(out, {a}).runs_added, 1U);
    EXPECT_EQ(contents(out), contents(store("whole.sqlite", {{0, 3}, {0, 4}, {1, 3}})));
    const auto again = merge_stores(out, {a});
    EXPECT_EQ(again.runs_added, 0U);
    EXPECT_EQ(again.runs_in_all, 3U);
}

TEST_F(StoreMergeTest, TakesOtherStudiesAndRunsOfArmsThatAreGone) {
    const auto out = store("out.sqlite", {{0, 3}});
    study.name = "other";
    const auto a = store("a.sqlite", {{1, 5}});
    study.arms.pop_back();
    Store::open_for_writing(a).put_study(study);  // without the arm that has the run
    EXPECT_EQ(merge_stores(out, {a}).runs_added, 1U);
    const Store merged = Store::open_for_reading(out);
    EXPECT_EQ(merged.studies().size(), 2U);
    EXPECT_EQ(merged.study("other").arms.size(), 1U);
    EXPECT_EQ(merged.finished().size(), 2U);
}

TEST_F(StoreMergeTest, CountsRunsOfOtherVersions) {
    const auto a = store("a.sqlite", {{0, 3}, {0, 4}});
    change(a, "UPDATE run SET program_version = '0.0.1' WHERE seed = 4");
    EXPECT_EQ(merge_stores(folder / "out.sqlite", {a}).runs_of_other_versions, 1U);
}

TEST_F(StoreMergeTest, RefusesAnotherRunOfTheSameKey) {
    const auto a = store("a.sqlite", {{0, 3}, {1, 4}});
    const auto b = store("b.sqlite", {{0, 4}, {1, 4}});
    change(b,
           "UPDATE run SET trajectory_hash = '00000000000000ff' WHERE seed = 4 AND births = 4 "
           "AND settings_hash = '" +
               study.arms[1].settings_hash + "'");
    const std::string message = "b.sqlite: the run with settings " + study.arms[1].settings_hash +
                                " and seed 4 differs from that in ";
    expect_refusal(folder / "new.sqlite", {a, b}, message);
    expect_refusal(a, {b}, message);
    expect_refusal(folder / "new.sqlite", {a, b},
                   "a.sqlite: trajectory hashes 00000000000000ff and f000000000000004");
}

TEST_F(StoreMergeTest, RefusesAnotherStudyOfTheSameName) {
    const auto a = store("a.sqlite", {{0, 3}});
    const auto other = [&](const auto& change_study) {
        Study changed = study;
        change_study(changed);
        const auto file = folder / "b.sqlite";
        std::filesystem::remove(file);
        Store::open_for_writing(file).put_study(changed);
        return file;
    };
    const std::vector<std::pair<std::function<void(Study&)>, std::string>> cases = {
        {[](Study& s) { s.title += "!"; }, "it has another title"},
        {[](Study& s) { s.description += "!"; }, "it has another description"},
        {[](Study& s) { ++s.seeds; }, "it has other seeds"},
        {[](Study& s) { ++s.first_seed; }, "it has other seeds"},
        {[](Study& s) { s.arms.pop_back(); }, "it has another number of arms"},
        {[](Study& s) { s.arms[1].name = "zwei"; }, "it has arm zwei for two"},
        {[](Study& s) { s.arms[1].profile = "text"; }, "it has other settings of arm two"},
        {[](Study& s) { s.arms[1].parameters = "B"; }, "it has other settings of arm two"},
        {[](Study& s) { s.arms[1].settings.measures.target_share = 0.6; },
         "it has other settings of arm two"},
        {[](Study& s) {
             std::swap(s.arms[1].settings_hash, s.arms[0].settings_hash);
             std::swap(s.arms[1].canonical, s.arms[0].canonical);
         },
         "it has other settings of arm one"},
    };
    for (const auto& [change_study, message] : cases) {
        const auto b = other(change_study);
        expect_refusal(folder / "new.sqlite", {a, b},
                       "b.sqlite: study example differs from that in");
        expect_refusal(a, {b}, message);
    }
    EXPECT_NO_THROW(merge_stores(a, {other([](Study&) {})}));
}

TEST_F(StoreMergeTest, RefusesWhatIsNoStoreOrIsNamedTwice) {
    const auto a = store("a.sqlite", {{0, 3}});
    const auto b = store("b.sqlite", {{0, 3}});
    folder.write("text.sqlite", "seed,f_c\n" + std::string(1000, '1'));
    std::filesystem::create_symlink("a.sqlite", folder / "link.sqlite");
    const auto fresh = folder / "new.sqlite";
    expect_refusal(fresh, {a, folder / "text.sqlite"}, "text.sqlite: is not a store of runs");
    expect_refusal(folder / "text.sqlite", {a}, "text.sqlite: is not a store of runs");
    expect_refusal(fresh, {a, folder / "none.sqlite"}, "none.sqlite: there is no such store");
    expect_refusal(folder.path(), {a}, "is a folder");
    expect_refusal(folder / "none/new.sqlite", {a}, "none does not exist");
    expect_refusal(a, {a}, "a.sqlite: is the output store; name only the stores that go into it");
    expect_refusal(a, {b, folder / "link.sqlite"}, "link.sqlite: is the output store");
    expect_refusal(fresh, {a, b, folder / "link.sqlite"}, "link.sqlite: is named twice");
    change(b, "PRAGMA user_version = 99");
    expect_refusal(fresh, {a, b}, "b.sqlite: is a store of format 99");
    expect_refusal(b, {a}, "b.sqlite: is a store of format 99");
}

TEST_F(StoreMergeTest, RefusesStoresThatAreInUse) {
    const auto a = store("a.sqlite", {{0, 3}});
    const auto b = store("b.sqlite", {{0, 4}});
    const Store writer = Store::open_for_writing(b);
    EXPECT_THAT(input_error([&] {
                    merge_stores(folder / "new.sqlite", {a, b});
                }),
                HasSubstr("b.sqlite: is in use by another process"));
    EXPECT_FALSE(std::filesystem::exists(folder / "new.sqlite"));
    EXPECT_THAT(input_error([&] { merge_stores(b, {a}); }), HasSubstr("is in use"));
}

// A store that was written before a setting was introduced.
TEST_F(StoreMergeTest, TakesOverRunsFromBeforeTheSettingsWereExtended) {
    const auto a = store("a.sqlite", {{0, 3}});
    const auto old = store("old.sqlite", {{0, 4}});
    change(old,
           "UPDATE settings SET canonical = json_remove(canonical, '$.settings.radio.loss');"
           "UPDATE arm SET settings = json_remove(settings, '$.radio.loss');"
           "PRAGMA foreign_keys = ON;"
           "UPDATE settings SET hash = 'old' || substr(hash, 4)");
    const auto before = test::read_all(old);
    merge_stores(folder / "out.sqlite", {a, old});
    EXPECT_EQ(contents(folder / "out.sqlite"), contents(store("whole.sqlite", {{0, 3}, {0, 4}})));
    EXPECT_EQ(test::read_all(old), before);
}

TEST_F(StoreMergeTest, ThatIsKilledAnywhereHasMergedAllOrNothing) {
    std::vector<std::pair<std::size_t, std::uint64_t>> many;
    for (std::uint64_t seed = 10; seed < 250; ++seed) many.emplace_back(0, seed);
    const auto a = store("a.sqlite", many);
    const auto out = store("out.sqlite", {{0, 3}});
    const std::string before = test::read_all(out);
    int cut_short = 0;
    for (int kill = 0; kill < 16; ++kill) {
        folder.write("out.sqlite", before);
        const pid_t child = fork();
        if (child == 0) {
            merge_stores(out, {a});
            _exit(0);
        }
        usleep(static_cast<useconds_t>(1500 * kill));
        ::kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        const std::size_t runs = Store::open_for_reading(out).finished().size();
        if (runs != 241U) ++cut_short;
        ASSERT_TRUE(runs == 1U || runs == 241U) << runs;
        std::filesystem::remove(folder / "out.sqlite-wal");
        std::filesystem::remove(folder / "out.sqlite-shm");
    }
    EXPECT_GE(cut_short, 1);
    merge_stores(out, {a});
    EXPECT_EQ(Store::open_for_reading(out).finished().size(), 241U);
}

}  // namespace
}  // namespace gene_clocks::experiment
