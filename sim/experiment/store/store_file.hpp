#pragma once

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>

#include <filesystem>
#include <memory>

namespace gene_clocks::experiment {

/// Opens the SQLite file of a store for writing, for this process alone, and makes it, with its
/// tables, where it does not exist. Throws InputError, and leaves the file as it was, if it is not
/// a store, one of another version, not writable, or in use.
std::unique_ptr<SQLite::Database> open_store_for_writing(const std::filesystem::path& file);

/// Opens the SQLite file of a store that exists, for reading. Throws InputError as above.
std::unique_ptr<SQLite::Database> open_store_for_reading(const std::filesystem::path& file);

/// Throws what an error of an open store means: InputError where the file is damaged, else
/// std::runtime_error. Either names the file.
[[noreturn]] void throw_named(const std::filesystem::path& file, const SQLite::Exception& error);

}  // namespace gene_clocks::experiment
