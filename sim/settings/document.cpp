#include "sim/settings/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "sim/settings/embedded_files.hpp"
#include "sim/settings/suggestion.hpp"

namespace gene_clocks::experiment {
namespace {

constexpr std::uintmax_t file_bytes_maximum = 4U << 20U;
/// A key with as many parts, a.b.c.…, makes tables as deep, which are taken down by recursion.
constexpr std::ptrdiff_t key_dots_maximum = 10'000;

std::string read_file(const std::filesystem::path& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) {
        throw InputError(file.string() + ": there is no such file");
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw InputError(file.string() + ": is not a regular file");
    }
    if (std::filesystem::file_size(file, error) > file_bytes_maximum || error) {
        throw InputError(file.string() + ": is larger than the 4 MiB that a TOML file may have");
    }
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream) throw InputError(file.string() + ": cannot be read");
    return text;
}

/// The folder of the repository that the kind is built in from, and the kind's name in messages.
constexpr std::pair<std::string_view, std::string_view> describe(Builtin kind) {
    switch (kind) {
        case Builtin::arena:
            return {"arenas", "arena"};
        case Builtin::profile:
            return {"profiles", "profile"};
        case Builtin::study:
            return {"studies", "study"};
    }
    throw std::logic_error("unknown kind of built-in file");
}

/// "a real number", for messages.
std::string_view type_name(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "an array";
        case toml::node_type::string:
            return "a text";
        case toml::node_type::integer:
            return "a whole number";
        case toml::node_type::floating_point:
            return "a real number";
        case toml::node_type::boolean:
            return "a truth value";
        default:
            return "a date or time";
    }
}

InputError type_error(const toml::node& node, const Place& place, const std::string& key,
                      std::string_view expected) {
    return key_error(place, key, fmt::format("expected {}, found {}", expected, type_name(node)));
}

/// Dots join the parts of a key; those of numbers and texts join nothing.
std::ptrdiff_t most_dots_in_a_key(std::string_view line) {
    std::ptrdiff_t dots = 0, most = 0;
    char quote = '\0';
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char character = line[i];
        if (quote != '\0') {
            if (character == '\\' && quote == '"') ++i;
            if (character == quote) quote = '\0';
        } else if (character == '"' || character == '\'') {
            quote = character;
        } else if (character == '.') {
            most = std::max(most, ++dots);
        } else if (std::string_view("=,[]{}#").find(character) != std::string_view::npos) {
            dots = 0;
        }
    }
    return most;
}

void refuse_deep_keys(const Document& document) {
    std::istringstream stream(document.text);
    std::uint32_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        if (most_dots_in_a_key(line) > key_dots_maximum) {
            throw InputError(Place{document.name, number}.prefix() + "a key with more than " +
                             std::to_string(key_dots_maximum) + " dots");
        }
    }
}

}  // namespace

Document parse_document(std::string text, std::string name, std::filesystem::path directory) {
    Document document{std::move(name), std::move(directory), std::move(text), {}};
    refuse_deep_keys(document);
    try {
        document.table = toml::parse(document.text, document.name);
    } catch (const toml::parse_error& error) {
        const Place place{document.name, error.source().begin.line};
        throw InputError(place.prefix() + std::string(error.description()));
    }
    return document;
}

Document load_document(const std::filesystem::path& file) {
    auto directory = file.parent_path();
    return parse_document(read_file(file), file.string(), directory.empty() ? "." : directory);
}

std::vector<std::string> builtin_names(Builtin kind) {
    const std::string folder = std::string(describe(kind).first) + "/";
    std::vector<std::string> names;
    for (const EmbeddedFile& file : embedded_files()) {
        if (!file.path.starts_with(folder) || !is_file_name(file.path)) continue;
        auto name = file.path.substr(folder.size());
        name.remove_suffix(std::string_view(".toml").size());
        if (kind == Builtin::profile && name == "parameters") continue;
        names.emplace_back(name);
    }
    std::ranges::sort(names);
    return names;
}

bool is_file_name(std::string_view name) {
    return name.ends_with(".toml");
}

Document find_document(Builtin kind, const std::string& name) {
    if (is_file_name(name)) return load_document(name);
    const auto [folder, word] = describe(kind);
    const auto names = builtin_names(kind);
    if (std::ranges::find(names, name) == names.end()) {
        const std::string near = suggestion(name, names);
        throw InputError(
            fmt::format("{} \"{}\": there is none of that name{} Built in: {}; or give a "
                        "file ending in .toml",
                        word, name, near.empty() ? "." : near, one_of(names)));
    }
    return parse_document(std::string(embedded_text(fmt::format("{}/{}.toml", folder, name))),
                          fmt::format("built-in {} {}", word, name));
}

TableReader::TableReader(const Document& document, const toml::table& table, std::string path)
    : document_(document), table_(table), path_(std::move(path)) {}

const toml::node* TableReader::find(const std::string& key) {
    known_.push_back(key);
    return table_.get(key);
}

std::string TableReader::full(const std::string& key) const {
    return path_.empty() ? key : path_ + "." + key;
}

InputError TableReader::error(const std::string& key, const std::string& message) const {
    const toml::node* node = table_.get(key);
    const Place place = node != nullptr ? document_.place_of(*node) : document_.place_of(table_);
    return key_error(place, full(key), message);
}

std::optional<std::string> TableReader::text(const std::string& key) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    return read_text(*node, document_.place_of(*node), full(key));
}

std::optional<double> TableReader::real(const std::string& key, const Range& range) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    return read_real(*node, range, document_.place_of(*node), full(key));
}

std::optional<std::int64_t> TableReader::integer(const std::string& key, const Range& range) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    return read_integer(*node, range, document_.place_of(*node), full(key));
}

const toml::table* TableReader::table(const std::string& key) {
    const toml::node* node = find(key);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) {
        throw type_error(*node, document_.place_of(*node), full(key), "a table");
    }
    return node->as_table();
}

const toml::array& TableReader::array(const std::string& key) {
    const toml::node* node = find(key);
    if (node == nullptr) throw error(key, "is missing");
    if (!node->is_array()) {
        throw type_error(*node, document_.place_of(*node), full(key), "an array");
    }
    return *node->as_array();
}

std::vector<const toml::table*> TableReader::tables(const std::string& key) {
    const toml::node* node = find(key);
    if (node == nullptr) return {};
    if (!node->is_array_of_tables()) {
        throw type_error(*node, document_.place_of(*node), full(key),
                         "tables [[" + full(key) + "]]");
    }
    std::vector<const toml::table*> tables;
    for (const toml::node& element : *node->as_array()) tables.push_back(element.as_table());
    return tables;
}

std::string TableReader::required_text(const std::string& key) {
    if (auto value = text(key)) return *std::move(value);
    throw error(key, "is missing");
}

double TableReader::required_real(const std::string& key, const Range& range) {
    if (const auto value = real(key, range)) return *value;
    throw error(key, "is missing");
}

void TableReader::refuse_other_keys() const {
    for (const auto& [key, node] : table_) {
        const std::string name(key.str());
        if (std::ranges::find(known_, name) != known_.end()) continue;
        throw key_error(document_.place_of(key), full(name),
                        "unknown key" + suggestion(name, known_));
    }
}

double read_real(const toml::node& node, const Range& range, const Place& place,
                 const std::string& key) {
    if (!node.is_number()) throw type_error(node, place, key, "a real number");
    const double value = node.value<double>().value();
    if (!range.contains(value)) {
        throw key_error(place, key, fmt::format("{} is outside {}", value, range.text()));
    }
    return value + 0.0;  // turns -0.0 into 0.0, so that equal settings have one text
}

std::int64_t read_integer(const toml::node& node, const Range& range, const Place& place,
                          const std::string& key) {
    if (!node.is_integer()) throw type_error(node, place, key, "a whole number");
    const auto value = node.value<std::int64_t>().value();
    if (!range.contains(static_cast<double>(value))) {
        throw key_error(place, key, fmt::format("{} is outside {}", value, range.text()));
    }
    return value;
}

std::string read_text(const toml::node& node, const Place& place, const std::string& key) {
    if (!node.is_string()) throw type_error(node, place, key, "a text");
    return node.value<std::string>().value();
}

bool read_flag(const toml::node& node, const Place& place, const std::string& key) {
    if (!node.is_boolean()) throw type_error(node, place, key, "true or false");
    return node.value<bool>().value();
}

}  // namespace gene_clocks::experiment
