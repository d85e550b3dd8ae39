#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/settings/input_error.hpp"
#include "sim/settings/settings_table.hpp"

namespace gene_clocks::experiment {

/// A parsed TOML text that knows where it came from.
struct Document {
    std::string name;                 ///< the file, or what stands for it; for messages
    std::filesystem::path directory;  ///< relative paths in the text start here; empty if built in
    std::string text;
    toml::table table;

    [[nodiscard]] Place place_of(const toml::node& node) const {
        return {name, node.source().begin.line};
    }
    [[nodiscard]] Place place_of(const toml::key& key) const {
        return {name, key.source().begin.line};
    }
};

/// Parses TOML. Throws InputError, with the line, where it is none.
Document parse_document(std::string text, std::string name, std::filesystem::path directory = {});

/// Reads a TOML file of at most 4 MiB. Throws InputError where there is none to read.
Document load_document(const std::filesystem::path& file);

/// What comes built in, or from a file instead.
enum class Builtin { arena, profile, study };

/// The names of what is built in, sorted.
std::vector<std::string> builtin_names(Builtin kind);

/// A name that ends in ".toml" is a file; any other is built in.
/// Throws InputError, with what there is, where it is neither.
Document find_document(Builtin kind, const std::string& name);

/// Whether find_document would take the name for a file.
bool is_file_name(std::string_view name);

/// Reads one TOML table key by key, and knows which keys nobody asked for.
/// Every error is an InputError with file, line and key.
class TableReader {
public:
    /// `path` is the table's key in the document; empty for the document's own table.
    /// Both references must outlive the reader.
    TableReader(const Document& document, const toml::table& table, std::string path = {});

    /// Whatever stands under that key; null where nothing does.
    const toml::node* find(const std::string& key);
    std::optional<std::string> text(const std::string& key);
    std::optional<double> real(const std::string& key, const Range& range);
    std::optional<std::int64_t> integer(const std::string& key, const Range& range);
    /// Null where there is no such table.
    const toml::table* table(const std::string& key);
    /// The array of that key, which must be there.
    const toml::array& array(const std::string& key);
    /// The tables of an array of tables; empty where there is no such array.
    std::vector<const toml::table*> tables(const std::string& key);

    std::string required_text(const std::string& key);
    double required_real(const std::string& key, const Range& range);

    /// Throws for the first key that was not asked for, with a suggestion.
    void refuse_other_keys() const;

    /// An error at a key of this table, or at the table itself where it lacks the key.
    [[nodiscard]] InputError error(const std::string& key, const std::string& message) const;

private:
    [[nodiscard]] std::string full(const std::string& key) const;

    const Document& document_;
    const toml::table& table_;
    std::string path_;
    std::vector<std::string> known_;  ///< every key that was asked for
};

/// The number in a node; whole numbers pass for reals, not the reverse.
double read_real(const toml::node& node, const Range& range, const Place& place,
                 const std::string& key);
std::int64_t read_integer(const toml::node& node, const Range& range, const Place& place,
                          const std::string& key);
std::string read_text(const toml::node& node, const Place& place, const std::string& key);
bool read_flag(const toml::node& node, const Place& place, const std::string& key);

}  // namespace gene_clocks::experiment
