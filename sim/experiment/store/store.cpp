#include "sim/experiment/store/store.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/experiment/store/store_file.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/program_version.hpp"
#include "sim/settings/settings_io.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::experiment {
namespace {

/// Executes a statement that returns no rows.
template <typename... Arguments>
void execute(SQLite::Database& database, const char* sql, const Arguments&... arguments) {
    SQLite::Statement statement(database, sql);
    SQLite::bind(statement, arguments...);
    statement.exec();
}

std::string hexadecimal(std::uint64_t value) {
    return fmt::format("{:016x}", value);
}

std::uint64_t parse_hexadecimal(const std::string& text) {
    return std::stoull(text, nullptr, 16);
}

std::int64_t as_integer(std::uint64_t value) {
    return static_cast<std::int64_t>(value);
}
std::uint64_t unsigned_column(SQLite::Statement& row, const char* name) {
    return static_cast<std::uint64_t>(row.getColumn(name).getInt64());
}

// Binding and reading of a number of a record.
void bind_value(SQLite::Statement& statement, int position, double value) {
    statement.bind(position, value);
}
void bind_value(SQLite::Statement& statement, int position, std::int64_t value) {
    statement.bind(position, value);
}
void bind_value(SQLite::Statement& statement, int position, std::uint64_t value) {
    statement.bind(position, as_integer(value));
}
void read_value(const SQLite::Column& column, double& value) {
    value = column.getDouble();
}
void read_value(const SQLite::Column& column, std::int64_t& value) {
    value = column.getInt64();
}
void read_value(const SQLite::Column& column, std::uint64_t& value) {
    value = static_cast<std::uint64_t>(column.getInt64());
}

/// What reads a field from the column of its name.
auto reading(SQLite::Statement& row) {
    return [&row](const char* name, auto& value) { read_value(row.getColumn(name), value); };
}

/// The columns that a visitor of fields names, each after a comma, and a place for each value.
template <typename ForEach>
std::pair<std::string, std::string> columns_of(ForEach for_each) {
    std::string columns;
    std::string places;
    for_each([&](const char* name, const auto&) {
        columns += fmt::format(", {}", name);
        places += ", ?";
    });
    return {columns, places};
}

/// Inserts the fields of records into a table whose other column is the run.
template <typename Records, typename ForEach>
void insert_records(SQLite::Database& database, const char* table, std::int64_t run,
                    const Records& records, ForEach for_each) {
    const auto [columns, places] =
        columns_of([&](auto visit) { for_each(typename Records::value_type{}, visit); });
    SQLite::Statement insert(
        database, fmt::format("INSERT INTO {} (run{}) VALUES (?{})", table, columns, places));
    for (const auto& record : records) {
        int position = 1;
        insert.bind(position, run);
        for_each(record,
                 [&](const char*, const auto& value) { bind_value(insert, ++position, value); });
        insert.exec();
        insert.reset();
    }
}

void insert_samples(SQLite::Database& database, std::int64_t run,
                    const std::vector<sim::Sample>& samples) {
    insert_records(database, "sample", run, samples, [](const sim::Sample& sample, auto visit) {
        sim::for_each_value(sample, visit);
    });
}

std::vector<sim::Sample> read_samples(SQLite::Database& database, std::int64_t run) {
    std::vector<sim::Sample> samples;
    SQLite::Statement rows(database, "SELECT * FROM sample WHERE run = ? ORDER BY cycle");
    rows.bind(1, run);
    while (rows.executeStep()) sim::for_each_value(samples.emplace_back(), reading(rows));
    return samples;
}

void insert_chronology(SQLite::Database& database, std::int64_t run,
                       const sim::ChronologyMeasures& measures) {
    insert_records(database, "chronology", run, std::vector{measures},
                   [](const sim::ChronologyMeasures& record, auto visit) {
                       sim::for_each_measure(record, visit);
                   });
}

sim::ChronologyMeasures read_chronology(SQLite::Database& database, std::int64_t run) {
    SQLite::Statement row(database, "SELECT * FROM chronology WHERE run = ?");
    row.bind(1, run);
    sim::ChronologyMeasures measures;
    if (row.executeStep()) sim::for_each_measure(measures, reading(row));
    return measures;
}

void insert_creations(SQLite::Database& database, std::int64_t run,
                      const std::vector<sim::GeneCreation>& creations) {
    SQLite::Statement insert(database, "INSERT INTO creation VALUES (?, ?, ?, ?, ?, ?)");
    std::int64_t position = 0;
    for (const sim::GeneCreation& creation : creations) {
        SQLite::bind(insert, run, position++, as_integer(creation.mark.counter),
                     static_cast<std::int64_t>(creation.mark.robot),
                     static_cast<std::int64_t>(creation.robot), creation.cycle);
        insert.exec();
        insert.reset();
    }
}

std::vector<sim::GeneCreation> read_creations(SQLite::Database& database, std::int64_t run) {
    std::vector<sim::GeneCreation> creations;
    SQLite::Statement rows(database,
                           "SELECT counter, mark_robot, robot, cycle FROM creation "
                           "WHERE run = ? ORDER BY position");
    rows.bind(1, run);
    while (rows.executeStep()) {
        const InnovationNumber mark{static_cast<std::uint64_t>(rows.getColumn(0).getInt64()),
                                    static_cast<RobotId>(rows.getColumn(1).getInt64())};
        creations.push_back({mark, static_cast<RobotId>(rows.getColumn(2).getInt64()),
                             rows.getColumn(3).getDouble()});
    }
    return creations;
}

/// The run of a row of the table run.
RunRecord read_run(SQLite::Database& database, SQLite::Statement& row) {
    RunRecord record;
    record.settings_hash = row.getColumn("settings_hash").getString();
    record.seed = unsigned_column(row, "seed");
    sim::for_each_counter(record.result.counters, reading(row));
    record.result.trajectory_hash = parse_hexadecimal(row.getColumn("trajectory_hash").getString());
    record.result.robot_steps = unsigned_column(row, "robot_steps");
    record.result.cpu_seconds = row.getColumn("cpu_seconds").getDouble();
    const std::int64_t run = row.getColumn("id").getInt64();
    record.result.samples = read_samples(database, run);
    record.result.chronology = read_chronology(database, run);
    record.result.creations = read_creations(database, run);
    record.wall_seconds = row.getColumn("wall_seconds").getDouble();
    record.finished_at = row.getColumn("finished_at").getString();
    record.program_version = row.getColumn("program_version").getString();
    return record;
}

std::vector<StoredArm> read_arms(SQLite::Database& database, const std::string& study) {
    std::vector<StoredArm> arms;
    SQLite::Statement rows(database, "SELECT * FROM arm WHERE study = ? ORDER BY position");
    rows.bind(1, study);
    while (rows.executeStep()) {
        StoredArm arm;
        arm.name = rows.getColumn("name").getString();
        arm.profile = rows.getColumn("profile").getString();
        arm.parameters = rows.getColumn("parameters").getString();
        arm.settings_hash = rows.getColumn("settings_hash").getString();
        const auto json =
            nlohmann::json::parse(rows.getColumn("settings").getString(), nullptr, false);
        arm.settings = settings_from_json(
            json, {fmt::format("{}, study {}, arm {}", database.getFilename(), study, arm.name)});
        arms.push_back(std::move(arm));
    }
    return arms;
}

std::optional<ContrastTable> read_contrast(SQLite::Database& database, const std::string& study) {
    if (!database.tableExists("contrast")) return std::nullopt;
    SQLite::Statement row(database, "SELECT baselines FROM contrast WHERE study = ?");
    row.bind(1, study);
    if (!row.executeStep()) return std::nullopt;
    return contrast_table_from(row.getColumn(0).getString(),
                               fmt::format("{}, study {}", database.getFilename(), study));
}

}  // namespace

/// Calls a function; what SQLite complains of then names the file. Throws InputError where that is
/// damaged, else std::runtime_error.
template <typename Function>
auto Store::naming_file(Function&& function) const {
    try {
        return function();
    } catch (const SQLite::Exception& error) {
        throw_named(database_->getFilename(), error);
    }
}

Store::Store(std::unique_ptr<SQLite::Database> database) : database_(std::move(database)) {
    database_->exec("PRAGMA foreign_keys = ON");
}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Store Store::open_for_writing(const std::filesystem::path& file) {
    Store store(open_store_for_writing(file));
    store.take_over_new_keys();
    return store;
}

Store Store::open_for_reading(const std::filesystem::path& file) {
    return Store(open_store_for_reading(file));
}

void Store::take_over_new_keys() {
    naming_file([&] {
        std::vector<std::pair<std::string, std::string>> extended;  // old hash, new text
        SQLite::Statement rows(*database_, "SELECT hash, canonical FROM settings");
        while (rows.executeStep()) {
            auto [text, added] =
                with_new_keys(rows.getColumn(1).getString(), {database_->getFilename()});
            if (added.empty()) continue;
            extended.emplace_back(rows.getColumn(0).getString(), std::move(text));
            new_keys_ = std::move(added);
        }
        rows.reset();
        SQLite::Transaction transaction(*database_);
        for (const auto& [hash, text] : extended) {
            execute(*database_, "UPDATE settings SET hash = ?, canonical = ? WHERE hash = ?",
                    hash_of(text), text, hash);
        }
        transaction.commit();
    });
}

void Store::put_study(const Study& study) {
    naming_file([&] {
        StoredStudy stored{study.name,  study.title, study.description, study.first_seed,
                           study.seeds, {},          study.contrast};
        SQLite::Transaction transaction(*database_);
        for (const Arm& arm : study.arms) {
            execute(*database_, "INSERT OR IGNORE INTO settings VALUES (?, ?)", arm.settings_hash,
                    arm.canonical);
            stored.arms.push_back(
                {arm.name, arm.profile, arm.parameters, arm.settings_hash, arm.settings});
        }
        execute(*database_, "DELETE FROM study WHERE name = ?", study.name);
        insert_study(stored);
        transaction.commit();
    });
}

void Store::insert_study(const StoredStudy& study) {
    execute(*database_, "INSERT INTO study VALUES (?, ?, ?, ?, ?)", study.name, study.title,
            study.description, as_integer(study.first_seed), study.seeds);
    std::int64_t position = 0;
    for (const StoredArm& arm : study.arms) {
        execute(*database_, "INSERT INTO arm VALUES (?, ?, ?, ?, ?, ?, ?)", study.name, position++,
                arm.name, arm.profile, arm.parameters, arm.settings_hash,
                to_json(arm.settings).dump());
    }
    if (study.contrast) {
        execute(*database_, "INSERT INTO contrast VALUES (?, ?)", study.name,
                to_text(*study.contrast));
    }
}

void Store::put_run(const RunRecord& record) {
    naming_file([&] {
        SQLite::Transaction transaction(*database_);
        insert_run(record);
        transaction.commit();
    });
}

void Store::insert_run(const RunRecord& record) {
    const sim::RunResult& result = record.result;
    const auto [columns, places] =
        columns_of([&](auto visit) { sim::for_each_counter(result.counters, visit); });
    SQLite::Statement insert(
        *database_,
        fmt::format("INSERT INTO run (settings_hash, seed, trajectory_hash, robot_steps, "
                    "cpu_seconds, wall_seconds, finished_at, program_version{}) "
                    "VALUES (?, ?, ?, ?, ?, ?, ?, ?{})",
                    columns, places));
    SQLite::bind(insert, record.settings_hash, as_integer(record.seed),
                 hexadecimal(result.trajectory_hash), as_integer(result.robot_steps),
                 result.cpu_seconds, record.wall_seconds, record.finished_at,
                 record.program_version);
    int position = 8;
    sim::for_each_counter(result.counters, [&](const char*, std::uint64_t value) {
        bind_value(insert, ++position, value);
    });
    insert.exec();
    const std::int64_t run = database_->getLastInsertRowid();
    insert_samples(*database_, run, result.samples);
    insert_chronology(*database_, run, result.chronology);
    insert_creations(*database_, run, result.creations);
}

std::size_t Store::take_over(const std::vector<std::filesystem::path>& stores) {
    return naming_file([&] {
        SQLite::Transaction transaction(*database_);
        std::size_t entered = 0;
        for (const auto& file : stores) entered += insert_missing_from(open_for_reading(file));
        transaction.commit();
        return entered;
    });
}

std::size_t Store::insert_missing_from(const Store& other) {
    const auto hashes = other.current_hashes();
    SQLite::Statement settings(*other.database_, "SELECT canonical FROM settings");
    while (settings.executeStep()) {
        const auto [text, added] =
            with_new_keys(settings.getColumn(0).getString(), {other.database_->getFilename()});
        execute(*database_, "INSERT OR IGNORE INTO settings VALUES (?, ?)", hash_of(text), text);
    }
    SQLite::Statement known(*database_, "SELECT 1 FROM study WHERE name = ?");
    for (StoredStudy& study : other.studies()) {
        known.bind(1, study.name);
        const bool is_known = known.executeStep();
        known.reset();
        if (is_known) continue;
        for (StoredArm& arm : study.arms) arm.settings_hash = hashes.at(arm.settings_hash);
        insert_study(study);
    }
    const auto present = finished();
    std::size_t entered = 0;
    SQLite::Statement rows(*other.database_, "SELECT * FROM run ORDER BY id");
    while (rows.executeStep()) {
        RunRecord record = read_run(*other.database_, rows);
        record.settings_hash = hashes.at(record.settings_hash);
        if (present.contains({record.settings_hash, record.seed})) continue;
        insert_run(record);
        ++entered;
    }
    return entered;
}

std::map<std::string, std::string> Store::current_hashes() const {
    return naming_file([&] {
        std::map<std::string, std::string> hashes;
        SQLite::Statement rows(*database_, "SELECT hash, canonical FROM settings");
        while (rows.executeStep()) {
            const auto [text, added] =
                with_new_keys(rows.getColumn(1).getString(), {database_->getFilename()});
            const std::string hash = rows.getColumn(0).getString();
            hashes[hash] = added.empty() ? hash : hash_of(text);
        }
        return hashes;
    });
}

std::set<RunKey> Store::finished() const {
    return naming_file([&] {
        const auto hashes = current_hashes();
        std::set<RunKey> keys;
        SQLite::Statement rows(*database_, "SELECT settings_hash, seed FROM run");
        while (rows.executeStep()) {
            keys.emplace(hashes.at(rows.getColumn(0).getString()),
                         static_cast<std::uint64_t>(rows.getColumn(1).getInt64()));
        }
        return keys;
    });
}

std::map<RunKey, std::uint64_t> Store::trajectory_hashes() const {
    return naming_file([&] {
        const auto current = current_hashes();
        std::map<RunKey, std::uint64_t> hashes;
        SQLite::Statement rows(*database_, "SELECT settings_hash, seed, trajectory_hash FROM run");
        while (rows.executeStep()) {
            const RunKey key{current.at(rows.getColumn(0).getString()),
                             static_cast<std::uint64_t>(rows.getColumn(1).getInt64())};
            hashes[key] = parse_hexadecimal(rows.getColumn(2).getString());
        }
        return hashes;
    });
}

std::map<std::string, RecordedTime> Store::recorded_times() const {
    return naming_file([&] {
        const auto hashes = current_hashes();
        std::map<std::string, RecordedTime> times;
        SQLite::Statement rows(
            *database_,
            "SELECT settings_hash, COUNT(*), SUM(robot_steps), SUM(wall_seconds) "
            "FROM run GROUP BY settings_hash");
        while (rows.executeStep()) {
            times[hashes.at(rows.getColumn(0).getString())] = {
                static_cast<std::size_t>(rows.getColumn(1).getInt64()),
                static_cast<std::uint64_t>(rows.getColumn(2).getInt64()),
                rows.getColumn(3).getDouble()};
        }
        return times;
    });
}

std::vector<StoredStudy> Store::studies() const {
    return naming_file([&] {
        std::vector<StoredStudy> studies;
        SQLite::Statement rows(*database_, "SELECT * FROM study ORDER BY name");
        while (rows.executeStep()) {
            StoredStudy study;
            study.name = rows.getColumn("name").getString();
            study.title = rows.getColumn("title").getString();
            study.description = rows.getColumn("description").getString();
            study.first_seed = unsigned_column(rows, "first_seed");
            study.seeds = rows.getColumn("seeds").getInt64();
            study.arms = read_arms(*database_, study.name);
            study.contrast = read_contrast(*database_, study.name);
            studies.push_back(std::move(study));
        }
        return studies;
    });
}

StoredStudy Store::study(const std::string& name) const {
    auto all = studies();
    std::vector<std::string> names;
    for (const StoredStudy& study : all) names.push_back(study.name);
    const std::string& file = database_->getFilename();
    if (all.empty())
        throw InputError(file + ": holds no study yet; fill it with `gene-clocks study`");
    if (name.empty()) {
        if (all.size() == 1) return std::move(all.front());
        throw InputError(
            fmt::format("{}: holds {} studies; name one: {}", file, all.size(), one_of(names)));
    }
    const auto found = std::ranges::find(all, name, &StoredStudy::name);
    if (found == all.end()) {
        throw InputError(
            fmt::format("{}: holds no study \"{}\"; there is {}", file, name, one_of(names)));
    }
    return std::move(*found);
}

std::vector<RunRecord> Store::runs(const StoredStudy& study, const StoredArm& arm) const {
    return naming_file([&] {
        std::vector<RunRecord> records;
        SQLite::Statement rows(
            *database_,
            "SELECT * FROM run WHERE settings_hash = ? AND seed >= ? AND seed < ? ORDER BY seed");
        SQLite::bind(rows, arm.settings_hash, as_integer(study.first_seed),
                     as_integer(study.first_seed) + study.seeds);
        while (rows.executeStep()) {
            records.push_back(read_run(*database_, rows));
        }
        return records;
    });
}

std::int64_t Store::runs_of_other_versions() const {
    return naming_file([&] {
        SQLite::Statement count(*database_, "SELECT COUNT(*) FROM run WHERE program_version <> ?");
        count.bind(1, program_version());
        count.executeStep();
        return count.getColumn(0).getInt64();
    });
}

}  // namespace gene_clocks::experiment
