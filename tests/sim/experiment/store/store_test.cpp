#include "sim/experiment/store/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "sim/settings/settings_io.hpp"
#include "tests/sim/experiment/example_study.hpp"
#include "tests/sim/experiment/expect_input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::experiment {
namespace {

using test::example_run;
using test::example_study;
using test::input_error;

class StoreTest : public testing::Test {
protected:
    void change(const std::string& sql) const {
        SQLite::Database(file, SQLite::OPEN_READWRITE).exec(sql);
    }
    /// Opening for writing and for reading is refused with this message, and changes nothing.
    void expect_refusal(const std::string& message) const {
        const std::string before = test::read_all(file);
        EXPECT_THAT(input_error([&] { Store::open_for_writing(file); }),
                    testing::HasSubstr(file + ": " + message));
        EXPECT_THAT(input_error([&] { Store::open_for_reading(file); }),
                    testing::HasSubstr(file + ": " + message));
        EXPECT_EQ(test::read_all(file), before);
        EXPECT_FALSE(std::filesystem::exists(file + "-wal"));
    }
    test::TemporaryFolder folder;
    std::string file = (folder / "runs.sqlite").string();
    Study study = example_study();
};

TEST_F(StoreTest, KeepsStudiesAndRuns) {
    {
        Store store = Store::open_for_writing(file);
        store.put_study(study);
        store.put_run(example_run(study.arms[0], 4));
        store.put_run(example_run(study.arms[0], 3));
        store.put_run(example_run(study.arms[1], 3));
    }
    const Store store = Store::open_for_reading(file);
    const StoredStudy stored = store.study("");
    EXPECT_EQ(stored.name, study.name);
    EXPECT_EQ(stored.title, study.title);
    EXPECT_EQ(stored.description, study.description);
    EXPECT_EQ(stored.first_seed, 3U);
    EXPECT_EQ(stored.seeds, 5);
    ASSERT_EQ(stored.arms.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(stored.arms[i].name, study.arms[i].name);
        EXPECT_EQ(stored.arms[i].profile, "mended");
        EXPECT_EQ(stored.arms[i].settings_hash, study.arms[i].settings_hash);
        EXPECT_EQ(to_json(stored.arms[i].settings), to_json(study.arms[i].settings));
    }
    EXPECT_EQ(stored.arms[0].parameters, "B");
    EXPECT_EQ(stored.arms[1].parameters, "A");
    EXPECT_THAT(store.finished(),
                testing::UnorderedElementsAre(RunKey{study.arms[0].settings_hash, 3},
                                              RunKey{study.arms[0].settings_hash, 4},
                                              RunKey{study.arms[1].settings_hash, 3}));

    const auto runs = store.runs(stored, stored.arms[0]);
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_EQ(runs[0].seed, 3U);
    const RunRecord expected = example_run(study.arms[0], 4);
    const RunRecord& run = runs[1];
    EXPECT_EQ(run.seed, expected.seed);
    EXPECT_EQ(run.settings_hash, expected.settings_hash);
    EXPECT_EQ(run.wall_seconds, expected.wall_seconds);
    EXPECT_EQ(run.finished_at, expected.finished_at);
    EXPECT_EQ(run.program_version, expected.program_version);
    EXPECT_EQ(run.result.trajectory_hash, expected.result.trajectory_hash);
    EXPECT_EQ(run.result.robot_steps, expected.result.robot_steps);
    EXPECT_EQ(run.result.cpu_seconds, expected.result.cpu_seconds);
    const auto counters = [](const sim::RunResult& result) {
        std::map<std::string, double> values;
        const auto add = [&](const char* name, const auto& value) {
            values[name] = static_cast<double>(value);
        };
        sim::for_each_counter(result.counters, add);
        sim::for_each_measure(result.chronology, add);
        return values;
    };
    EXPECT_EQ(counters(run.result).size(), sim::run_counters + sim::chronology_measures);
    EXPECT_EQ(counters(run.result), counters(expected.result));
    const auto creations = [](const sim::RunResult& result) {
        std::vector<std::tuple<std::uint64_t, RobotId, RobotId, double>> all;
        for (const sim::GeneCreation& c : result.creations) {
            all.emplace_back(c.mark.counter, c.mark.robot, c.robot, c.cycle);
        }
        return all;
    };
    EXPECT_EQ(creations(run.result).size(), 2U);
    EXPECT_EQ(creations(run.result), creations(expected.result));
    ASSERT_EQ(run.result.samples.size(), expected.result.samples.size());
    for (std::size_t i = 0; i < run.result.samples.size(); ++i) {
        const auto values = [](const sim::Sample& sample) {
            std::vector<double> all;
            sim::for_each_value(sample, [&](const char*, const auto& value) {
                all.push_back(static_cast<double>(value));
            });
            return all;
        };
        EXPECT_EQ(values(run.result.samples[i]), values(expected.result.samples[i]));
    }
}

/// The columns of a table, each as "name TYPE".
std::vector<std::string> columns_of(const std::filesystem::path& file, const std::string& table) {
    const SQLite::Database database(file.string());
    SQLite::Statement rows(database, "SELECT name, type FROM pragma_table_info(?)");
    rows.bind(1, table);
    std::vector<std::string> columns;
    while (rows.executeStep())
        columns.push_back(rows.getColumn(0).getString() + " " + rows.getColumn(1).getString());
    return columns;
}

/// What a visitor of fields calls for: its fields, by name and type.
template <typename ForEach>
std::vector<std::string> fields_of(std::vector<std::string> columns, ForEach for_each) {
    for_each([&](const char* name, auto value) {
        columns.push_back(
            name + std::string(std::is_floating_point_v<decltype(value)> ? " REAL" : " INTEGER"));
    });
    return columns;
}

TEST_F(StoreTest, TablesHaveAColumnForEachFieldAndNoOther) {
    { const Store store = Store::open_for_writing(file); }
    auto run = fields_of({"id INTEGER", "settings_hash TEXT", "seed INTEGER"},
                         [](auto visit) { sim::for_each_counter(sim::RunCounters{}, visit); });
    for (const char* column : {"trajectory_hash TEXT", "robot_steps INTEGER", "cpu_seconds REAL",
                               "wall_seconds REAL", "finished_at TEXT", "program_version TEXT"})
        run.emplace_back(column);
    EXPECT_EQ(columns_of(file, "run"), run);
    EXPECT_EQ(columns_of(file, "sample"), fields_of({"run INTEGER"}, [](auto visit) {
                  sim::for_each_value(sim::Sample{}, visit);
              }));
    EXPECT_EQ(columns_of(file, "chronology"), fields_of({"run INTEGER"}, [](auto visit) {
                  sim::for_each_measure(sim::ChronologyMeasures{}, visit);
              }));
}

TEST_F(StoreTest, KeepsWhatArmsAreComparedWith) {
    study.contrast = ContrastTable{{.baseline = {"radio.loss=0"}}, Baselines{.against = {"one"}}};
    {
        Store store = Store::open_for_writing(file);
        store.put_study(study);
    }
    EXPECT_EQ(Store::open_for_reading(file).study("example").contrast, study.contrast);
    study.contrast.reset();
    Store::open_for_writing(file).put_study(study);
    EXPECT_FALSE(Store::open_for_reading(file).study("example").contrast);
}

TEST_F(StoreTest, OfEarlierVersionsKnowsNoContrasts) {
    {
        Store store = Store::open_for_writing(file);
        store.put_study(study);
        store.put_run(example_run(study.arms[0], 3));
    }
    SQLite::Database(file, SQLite::OPEN_READWRITE).exec("DROP TABLE contrast");
    EXPECT_FALSE(Store::open_for_reading(file).study("example").contrast);
    study.contrast = ContrastTable{{.over = {"radio.loss"}}, {}};
    {
        Store store = Store::open_for_writing(file);
        EXPECT_EQ(store.finished().size(), 1U);
        store.put_study(study);
    }
    EXPECT_EQ(Store::open_for_reading(file).study("example").contrast, study.contrast);
}

TEST_F(StoreTest, LeavesOutRunsWithOtherSeeds) {
    Store store = Store::open_for_writing(file);
    store.put_study(study);
    for (const std::uint64_t seed : {2U, 3U, 7U, 8U})
        store.put_run(example_run(study.arms[0], seed));
    const StoredStudy stored = store.study("example");
    const auto runs = store.runs(stored, stored.arms[0]);
    ASSERT_EQ(runs.size(), 2U);  // seeds 3 to 7
    EXPECT_EQ(runs[0].seed, 3U);
    EXPECT_EQ(runs[1].seed, 7U);
}

TEST_F(StoreTest, PutsAStudyInPlaceOfTheOneOfThatNameAndKeepsTheRuns) {
    Store store = Store::open_for_writing(file);
    store.put_study(study);
    store.put_run(example_run(study.arms[1], 3));
    study.arms.pop_back();
    study.title = "Another title";
    store.put_study(study);
    EXPECT_EQ(store.study("example").title, "Another title");
    EXPECT_EQ(store.study("example").arms.size(), 1U);
    EXPECT_EQ(store.finished().size(), 1U);
}

TEST_F(StoreTest, RefusesARunThatIsThereAlreadyAndKeepsIt) {
    Store store = Store::open_for_writing(file);
    store.put_study(study);
    store.put_run(example_run(study.arms[0], 3));
    RunRecord second = example_run(study.arms[0], 3);
    second.result.trajectory_hash = 1;
    EXPECT_THROW(store.put_run(second), std::runtime_error);
    const StoredStudy stored = store.study("");
    EXPECT_EQ(store.runs(stored, stored.arms[0]).at(0).result.trajectory_hash,
              0xf000'0000'0000'0003);
}

TEST_F(StoreTest, RefusesARunOfSettingsThatItDoesNotKnow) {
    Store store = Store::open_for_writing(file);
    EXPECT_THROW(store.put_run(example_run(study.arms[0], 3)), std::runtime_error);
    EXPECT_TRUE(store.finished().empty());
}

TEST_F(StoreTest, NamesTheFileThatIsDamagedInside) {
    {
        Store store = Store::open_for_writing(file);
        store.put_study(study);
        for (std::uint64_t seed = 3; seed < 8; ++seed)
            store.put_run(example_run(study.arms[0], seed));
    }
    const std::string whole = test::read_all(file);
    std::size_t noticed = 0;
    for (std::size_t page = 1; page < whole.size() / 4096; ++page) {
        std::string damaged = whole;
        damaged.replace(4096 * page, 4096, std::string(4096, '\x5a'));
        std::ofstream(file, std::ios::binary) << damaged;
        try {
            const Store store = Store::open_for_reading(file);
            const StoredStudy stored = store.study("example");
            for (const StoredArm& arm : stored.arms) static_cast<void>(store.runs(stored, arm));
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(file + ": is damaged"));
            ++noticed;
        }
    }
    EXPECT_GT(noticed, 3U);
}

TEST_F(StoreTest, NamesTheStudiesThatItHas) {
    Store store = Store::open_for_writing(file);
    EXPECT_THAT(input_error([&] { return store.study(""); }), testing::HasSubstr("holds no study"));
    store.put_study(study);
    study.name = "other";
    store.put_study(study);
    EXPECT_THAT(input_error([&] { return store.study(""); }),
                testing::HasSubstr("name one: example or other"));
    EXPECT_THAT(input_error([&] { return store.study("x"); }),
                testing::HasSubstr("example or other"));
    EXPECT_EQ(store.study("other").name, "other");
}

TEST_F(StoreTest, CountsRunsOfOtherVersions) {
    Store store = Store::open_for_writing(file);
    store.put_study(study);
    RunRecord run = example_run(study.arms[0], 3);
    store.put_run(run);
    EXPECT_EQ(store.runs_of_other_versions(), 0);
    run.seed = 4;
    run.program_version = "0.0.1";
    store.put_run(run);
    EXPECT_EQ(store.runs_of_other_versions(), 1);
}

TEST_F(StoreTest, AddsUpTheTimesOfRuns) {
    Store store = Store::open_for_writing(file);
    store.put_study(study);
    store.put_run(example_run(study.arms[0], 3));
    store.put_run(example_run(study.arms[0], 4));
    const auto times = store.recorded_times();
    ASSERT_EQ(times.size(), 1U);
    const RecordedTime& time = times.at(study.arms[0].settings_hash);
    EXPECT_EQ(time.runs, 2U);
    EXPECT_EQ(time.robot_steps, 246U);
    EXPECT_DOUBLE_EQ(time.wall_seconds, 1.0);
}

TEST_F(StoreTest, RefusesAFileThatIsNoDatabase) {
    folder.write("runs.sqlite", "seed,f_c\n1,160\n" + std::string(1000, 'x'));
    expect_refusal("is not a store of runs (it is no SQLite file)");
}

TEST_F(StoreTest, RefusesAnotherProgramsDatabase) {
    {
        SQLite::Database(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
            .exec("CREATE TABLE run (x)");
    }
    expect_refusal("is not a store of runs (it is another program's SQLite file)");
}

TEST_F(StoreTest, RefusesAnotherVersion) {
    { Store::open_for_writing(file); }
    change("PRAGMA user_version = 99");
    expect_refusal("is a store of format 99; gene-clocks");
}

TEST_F(StoreTest, RefusesAStoreFromBeforeTheMeasuresOfChronology) {
    { Store::open_for_writing(file); }
    change("DROP TABLE chronology; PRAGMA user_version = 1");
    expect_refusal("is a store of format 1; gene-clocks");
}

TEST_F(StoreTest, RefusesADamagedFile) {
    { Store::open_for_writing(file).put_study(study); }
    std::string bytes = test::read_all(file);
    std::fill(bytes.begin() + 100, bytes.end(), 'x');
    folder.write("runs.sqlite", bytes);
    EXPECT_THAT(input_error([&] { Store::open_for_writing(file); }),
                testing::HasSubstr("is damaged"));
    EXPECT_EQ(test::read_all(file), bytes);
}

TEST_F(StoreTest, TakesAnEmptyFileForANewStore) {
    folder.write("runs.sqlite", "");
    EXPECT_TRUE(Store::open_for_writing(file).finished().empty());
}

TEST_F(StoreTest, RefusesPathsWhereNoStoreCanBe) {
    EXPECT_THAT(input_error([&] { Store::open_for_writing(folder.path()); }),
                testing::HasSubstr("is a folder"));
    EXPECT_THAT(input_error([&] { Store::open_for_writing(folder / "none/runs.sqlite"); }),
                testing::HasSubstr("none does not exist"));
    EXPECT_THAT(input_error([&] { Store::open_for_writing("/proc/runs.sqlite"); }),
                testing::HasSubstr("cannot be opened or created there"));
    EXPECT_THAT(input_error([&] { Store::open_for_reading(file); }),
                testing::HasSubstr("no such store"));
    EXPECT_TRUE(folder.is_empty());
}

TEST_F(StoreTest, IsForOneProcessAtATime) {
    Store store = Store::open_for_writing(file);
    EXPECT_THAT(input_error([&] { Store::open_for_writing(file); }),
                testing::HasSubstr("is in use by another process"));
    EXPECT_THAT(input_error([&] { Store::open_for_reading(file); }),
                testing::HasSubstr("is in use by another process"));
    store.put_study(study);  // still ours
}

TEST_F(StoreTest, MayBeReadByManyAtATime) {
    { Store::open_for_writing(file).put_study(study); }
    const Store one = Store::open_for_reading(file);
    const Store two = Store::open_for_reading(file);
    EXPECT_EQ(one.studies().size() + two.studies().size(), 2U);
}

// A store that was written before a setting was introduced.
TEST_F(StoreTest, TakesOverRunsFromBeforeTheSettingsWereExtended) {
    {
        Store store = Store::open_for_writing(file);
        store.put_study(study);
        store.put_run(example_run(study.arms[0], 3));
        EXPECT_TRUE(store.new_keys().empty());
    }
    change(
        "UPDATE settings SET canonical = json_remove(canonical, '$.settings.radio.loss');"
        "UPDATE arm SET settings = json_remove(settings, '$.radio.loss');"
        "PRAGMA foreign_keys = ON;"
        "UPDATE settings SET hash = 'old' || substr(hash, 4)");
    {
        const Store reader = Store::open_for_reading(file);
        EXPECT_EQ(reader.study("").arms[0].settings.radio.loss, 0.0);
        const RunKey key{study.arms[0].settings_hash, 3};
        EXPECT_THAT(reader.finished(), testing::ElementsAre(key));
        EXPECT_EQ(reader.recorded_times().at(key.first).runs, 1U);
    }
    {
        const Store store = Store::open_for_writing(file);
        EXPECT_THAT(store.new_keys(), testing::ElementsAre("radio.loss"));
        EXPECT_THAT(store.finished(), testing::ElementsAre(RunKey{study.arms[0].settings_hash, 3}));
    }
    EXPECT_TRUE(Store::open_for_writing(file).new_keys().empty());
}

TEST_F(StoreTest, RefusesSettingsOfALaterProgram) {
    { Store::open_for_writing(file).put_study(study); }
    change("UPDATE settings SET canonical = json_set(canonical, '$.settings.odneat.later', 1)");
    EXPECT_THAT(input_error([&] { Store::open_for_writing(file); }),
                testing::HasSubstr("odneat.later: unknown key"));
}

TEST_F(StoreTest, LeavesNoFilesBesideItself) {
    { Store::open_for_writing(file).put_study(study); }
    EXPECT_EQ(Store::open_for_reading(file).studies().size(), 1U);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST_F(StoreTest, SamplesCanBeQueriedWithSql) {
    {
        Store store = Store::open_for_writing(file);
        store.put_study(study);
        store.put_run(example_run(study.arms[1], 3));
    }
    SQLite::Database database(file);
    EXPECT_EQ(database
                  .execAndGet("SELECT COUNT(*) FROM sample JOIN run ON sample.run = run.id "
                              "JOIN settings ON settings.hash = run.settings_hash "
                              "WHERE settings.canonical ->> '$.settings.source' = 'timestamp'")
                  .getInt(),
              20);
}

/// A child process that fills the store with run after run and reports each through a pipe as soon
/// as put_run has returned, until it is killed.
class Writer {
public:
    Writer(const std::string& file, const Study& study, std::uint64_t first_seed) {
        if (pipe(pipe_.data()) != 0) throw std::runtime_error("no pipe");
        child_ = fork();
        if (child_ != 0) return;
        Store store = Store::open_for_writing(file);
        store.put_study(study);
        for (std::uint64_t seed = first_seed;; ++seed) {
            store.put_run(example_run(study.arms[0], seed));
            if (write(pipe_[1], &seed, sizeof seed) != sizeof seed) _exit(1);
        }
    }
    /// The seed of the next run that was put.
    [[nodiscard]] std::uint64_t wait_for_run() const {
        std::uint64_t seed = 0;
        if (read(pipe_[0], &seed, sizeof seed) != sizeof seed)
            throw std::runtime_error("writer died");
        return seed;
    }
    void kill() const {
        ::kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
        close(pipe_[0]);
        close(pipe_[1]);
    }

private:
    std::array<int, 2> pipe_{};
    pid_t child_ = 0;
};

TEST_F(StoreTest, ThatIsKilledAnywhereHoldsWholeRunsOnlyAndAllThatWerePut) {
    study.first_seed = 1;
    study.seeds = 1'000'000;
    std::uint64_t last_seed = 0;
    for (int kill = 0; kill < 12; ++kill) {
        const Writer writer(file, study, last_seed + 1);
        for (int runs = 0; runs < 3; ++runs) last_seed = writer.wait_for_run();
        usleep(static_cast<useconds_t>(137 * kill));  // into the next transaction
        writer.kill();

        const Store store = Store::open_for_writing(file);
        const StoredStudy stored = store.study("");
        const auto runs = store.runs(stored, stored.arms[0]);
        ASSERT_GE(runs.size(), last_seed);
        for (std::size_t i = 0; i < runs.size(); ++i) {
            ASSERT_EQ(runs[i].seed, i + 1);
            ASSERT_EQ(runs[i].result.samples.size(), 20U);
        }
        last_seed = runs.size();
    }
}

TEST_F(StoreTest, ThatIsKilledWhileItIsMadeCanBeMadeAgain) {
    for (int kill = 0; kill < 12; ++kill) {
        const std::string fresh = (folder / fmt::format("{}.sqlite", kill)).string();
        const pid_t child = fork();
        if (child == 0) {
            Store::open_for_writing(fresh).put_study(study);
            _exit(0);
        }
        usleep(static_cast<useconds_t>(400 * kill));
        ::kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        EXPECT_TRUE(Store::open_for_writing(fresh).finished().empty());
    }
}

}  // namespace
}  // namespace gene_clocks::experiment
