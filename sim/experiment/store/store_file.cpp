#include "sim/experiment/store/store_file.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <stdexcept>
#include <string>
#include <system_error>

#include "sim/experiment/store/store.hpp"
#include "sim/settings/embedded_files.hpp"
#include "sim/settings/input_error.hpp"
#include "sim/settings/program_version.hpp"

namespace gene_clocks::experiment {
namespace {

/// Marks the file as ours: "GnCk". Tools such as file(1) show it.
constexpr int application_id = 0x476e436b;
/// Raised whenever the tables change.
constexpr int format_version = 2;

InputError unfit(const std::filesystem::path& file, const std::string& why) {
    return InputError(file.string() + ": " + why);
}

/// What SQLite's complaint on opening a file means to the user.
InputError explain(const std::filesystem::path& file, const SQLite::Exception& error) {
    switch (error.getErrorCode()) {
        case SQLITE_NOTADB:
            return unfit(file, "is not a store of runs (it is no SQLite file)");
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return unfit(file, "is in use by another process; try again when it has ended");
        case SQLITE_READONLY:
            return unfit(file, "cannot be written: it is read-only");
        case SQLITE_CANTOPEN:
            return unfit(file, "cannot be opened or created there");
        case SQLITE_CORRUPT:
            return unfit(file, "is damaged");
        default:
            return unfit(file, error.what());
    }
}

int pragma(SQLite::Database& database, const char* name) {
    return database.execAndGet(fmt::format("PRAGMA {}", name)).getInt();
}

/// Whether the file holds nothing at all, as one does whose making was cut short.
bool is_empty(SQLite::Database& database) {
    return pragma(database, "page_count") == 0;
}

/// Throws InputError if the database is not a store of this version.
void check_identity(const std::filesystem::path& file, SQLite::Database& database) {
    if (pragma(database, "application_id") != application_id) {
        throw unfit(file, "is not a store of runs (it is another program's SQLite file)");
    }
    if (const int version = pragma(database, "user_version"); version != format_version) {
        throw unfit(file, fmt::format("is a store of format {}; gene-clocks {} uses format {}",
                                      version, program_version(), format_version));
    }
}

void check_path(const std::filesystem::path& file, bool must_exist) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (std::filesystem::is_directory(status))
        throw unfit(file, "is a folder, not a store of runs");
    if (must_exist && !std::filesystem::exists(status)) throw unfit(file, "there is no such store");
    const auto folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, error)) {
        throw unfit(file, fmt::format("the folder {} does not exist", folder.string()));
    }
}

void create_tables(SQLite::Database& database) {
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::EXCLUSIVE);
    database.exec(fmt::format("PRAGMA application_id = {}", application_id));
    database.exec(fmt::format("PRAGMA user_version = {}", format_version));
    database.exec(std::string(embedded_text("experiment/store/store_schema.sql")));
    transaction.commit();
}

/// Takes the lock even where nothing is to be written yet.
void take_lock(SQLite::Database& database) {
    SQLite::Transaction(database, SQLite::TransactionBehavior::EXCLUSIVE).commit();
}

}  // namespace

std::unique_ptr<SQLite::Database> open_store_for_writing(const std::filesystem::path& file) {
    check_path(file, false);
    try {
        auto database = std::make_unique<SQLite::Database>(
            file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        // Before the first read: the lock is held until the database is closed, and given back by
        // the system if the process is killed.
        database->exec("PRAGMA locking_mode = EXCLUSIVE");
        // The tables and the version are there, or the file is empty: they come in one transaction
        // of the ordinary journal, before the file is one with a write-ahead log.
        if (is_empty(*database)) {
            create_tables(*database);
        } else {
            check_identity(file, *database);
        }
        database->exec("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
        take_lock(*database);
        database->exec(std::string(embedded_text("experiment/store/contrast_schema.sql")));
        return database;
    } catch (const SQLite::Exception& error) {
        throw explain(file, error);
    }
}

std::unique_ptr<SQLite::Database> open_store_for_reading(const std::filesystem::path& file) {
    check_path(file, true);
    try {
        // Not OPEN_READONLY: that would leave the files of the write-ahead log behind. SQLite
        // itself falls back to it where the file is write-protected.
        auto database = std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READWRITE);
        database->exec("PRAGMA query_only = ON");
        check_identity(file, *database);
        return database;
    } catch (const SQLite::Exception& error) {
        throw explain(file, error);
    }
}

void throw_named(const std::filesystem::path& file, const SQLite::Exception& error) {
    const int code = error.getErrorCode();
    if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) throw explain(file, error);
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
}

}  // namespace gene_clocks::experiment
