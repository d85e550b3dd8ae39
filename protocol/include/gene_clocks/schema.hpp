#pragma once

#include <gene_clocks/general_checks.h>
#include <gene_clocks/schema.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/wire.hpp>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gene_clocks {

/// What an attribute of a gene, or of a genome, may hold.
enum class AttributeType : std::uint8_t {
    flag = gene_clocks_flag,
    enumeration = gene_clocks_enumeration,
    integer = gene_clocks_integer,
    float32 = gene_clocks_float32,
    float64 = gene_clocks_float64,
};

/// An attribute. Names, here and of classes and values, are 1 to 63 characters of printable ASCII
/// without spaces.
struct Attribute {
    std::string name;
    AttributeType type{};
    std::vector<std::string> values{};  ///< of enumerations: 2 to 256 names
    std::int64_t minimum = 0;           ///< of integers
    std::int64_t maximum = 0;           ///< of integers
    double limit = 0.0;                 ///< of floats: the largest magnitude

    static Attribute flag(std::string name) { return {std::move(name), AttributeType::flag}; }
    static Attribute enumeration(std::string name, std::vector<std::string> values) {
        return {std::move(name), AttributeType::enumeration, std::move(values)};
    }
    static Attribute integer(std::string name, std::int64_t minimum, std::int64_t maximum) {
        return {std::move(name), AttributeType::integer, {}, minimum, maximum};
    }
    static Attribute float32(std::string name, float limit = std::numeric_limits<float>::max()) {
        return {std::move(name), AttributeType::float32, {}, 0, 0, double{limit}};
    }
    static Attribute float64(std::string name, double limit = std::numeric_limits<double>::max()) {
        return {std::move(name), AttributeType::float64, {}, 0, 0, limit};
    }
    friend bool operator==(const Attribute&, const Attribute&) = default;
};

/// How a gene names the two genes that it joins.
enum class Ends : std::uint8_t {
    none = gene_clocks_no_ends,
    by_index = gene_clocks_ends_by_index,  ///< among the genes of all classes before, from 0
    by_mark = gene_clocks_ends_by_mark,    ///< of genes that need not be in the genome
};

/// One kind of genes. They are told apart, and sorted, by their marks or, where they have none, by
/// their ends.
struct GeneClass {
    std::string name;
    bool is_marked = true;
    Ends ends = Ends::none;
    std::vector<Attribute> attributes{};
    friend bool operator==(const GeneClass&, const GeneClass&) = default;
};

/// Why a schema is refused.
enum class SchemaError : std::uint8_t {
    classes = gene_clocks_schema_classes,        ///< none, or more than 8
    attributes = gene_clocks_schema_attributes,  ///< more than 32
    name = gene_clocks_schema_name,              ///< empty, too long, or with other characters
    repeated = gene_clocks_schema_repeated,      ///< a name that stands beside it already
    identity = gene_clocks_schema_identity,      ///< genes that have neither marks nor ends
    ends = gene_clocks_schema_ends,              ///< ends by index with no class before
    type = gene_clocks_schema_type,              ///< no such type, or kind of ends
    values = gene_clocks_schema_values,          ///< not 2 to 256 values
    bounds = gene_clocks_schema_bounds,          ///< minimum above maximum; limit 0 or not finite
    bits = gene_clocks_schema_bits,              ///< flags and enumerations of more than 56 bits
};

/// The error's name.
constexpr std::string_view name_of(SchemaError error) {
    constexpr std::string_view names[] = {"ok",       "classes",  "attributes", "name",
                                          "repeated", "identity", "ends",       "type",
                                          "values",   "bounds",   "bits"};
    const auto index = static_cast<std::size_t>(error);
    return index < std::size(names) ? names[index] : "unknown";
}

/// What is wrong with a schema, and where.
struct SchemaFault {
    SchemaError error{};
    std::size_t gene_class{};  ///< the number of classes where it is the genome itself
    std::size_t attribute{};   ///< the number of attributes where it is the class itself
    friend bool operator==(SchemaFault, SchemaFault) = default;
};

/// What the genes of a fleet have in them, which all its members agree on once
/// (docs/wire-format.md, general genomes). Cheap to copy; immutable.
class Schema {
public:
    /// `genesis_count`: genesis marks 1…genesis_count, the same in the whole fleet. `classes`: 1 to
    /// 8. `attributes`: of a genome as a whole.
    static WireResult<Schema, SchemaFault> make(std::uint64_t genesis_count,
                                                std::vector<GeneClass> classes,
                                                std::vector<Attribute> attributes = {}) {
        auto text = std::make_shared<Text>();
        text->classes = std::move(classes);
        text->attributes = std::move(attributes);
        // Beyond what the fields of the C structure hold.
        if (text->classes.size() > gene_clocks_classes_max) {
            return SchemaFault{SchemaError::classes, text->classes.size(), 0};
        }
        for (std::size_t i = 0; i <= text->classes.size(); ++i) {
            const auto& list =
                i < text->classes.size() ? text->classes[i].attributes : text->attributes;
            if (list.size() > gene_clocks_attributes_max) {
                return SchemaFault{SchemaError::attributes, i, list.size()};
            }
        }
        text->build(genesis_count);
        const auto fault = gene_clocks_lay_out(&text->schema, &text->layout);
        if (fault.error) {
            return SchemaFault{static_cast<SchemaError>(fault.error), fault.gene_class,
                               fault.attribute};
        }
        return Schema{std::move(text)};
    }

    [[nodiscard]] const std::vector<GeneClass>& classes() const { return text_->classes; }
    [[nodiscard]] const std::vector<Attribute>& attributes() const { return text_->attributes; }
    [[nodiscard]] std::uint64_t genesis_count() const { return text_->schema.genesis_count; }

    /// What goes with every genome, so that other schemas are noticed.
    [[nodiscard]] std::uint32_t fingerprint() const { return text_->layout.fingerprint; }

    /// The one encoding of this schema.
    [[nodiscard]] std::vector<std::uint8_t> bytes() const {
        std::size_t size = 0;
        gene_clocks_write_schema(&text_->schema, nullptr, 0, &size);
        std::vector<std::uint8_t> bytes(size);
        gene_clocks_write_schema(&text_->schema, bytes.data(), size, &size);
        return bytes;
    }

    /// What the C functions take. Valid as long as a copy of the schema lives.
    [[nodiscard]] const gene_clocks_layout& layout() const { return text_->layout; }

private:
    /// The strings, and the C structures that point to them.
    struct Text {
        std::vector<GeneClass> classes;
        std::vector<Attribute> attributes;
        std::vector<std::vector<const char*>> values;
        std::vector<std::vector<gene_clocks_attribute>> lists;  // of each class, then the genome's
        std::vector<gene_clocks_gene_class> kernel_classes;
        gene_clocks_schema schema{};
        gene_clocks_layout layout{};

        Text() = default;
        Text(const Text&) = delete;  // it points into itself
        Text& operator=(const Text&) = delete;

        void build(std::uint64_t genesis_count) {
            for (const GeneClass& gene_class : classes) {
                lists.push_back(kernel_list(gene_class.attributes));
            }
            lists.push_back(kernel_list(attributes));
            for (std::size_t i = 0; i < classes.size(); ++i) {
                kernel_classes.push_back({whole(classes[i].name), classes[i].is_marked,
                                          static_cast<gene_clocks_ends_kind>(classes[i].ends),
                                          lists[i].data(),
                                          static_cast<std::uint8_t>(lists[i].size())});
            }
            schema = {genesis_count, lists.back().data(),
                      static_cast<std::uint8_t>(lists.back().size()), kernel_classes.data(),
                      static_cast<std::uint8_t>(kernel_classes.size())};
        }

        std::vector<gene_clocks_attribute> kernel_list(const std::vector<Attribute>& list) {
            std::vector<gene_clocks_attribute> result;
            for (const Attribute& attribute : list) {
                // More values than the field holds are too many all the same.
                std::vector<const char*> names;
                for (const std::string& value : attribute.values) {
                    names.push_back(whole(value));
                }
                values.push_back(std::move(names));
                const auto count = std::min<std::size_t>(values.back().size(), UINT16_MAX);
                result.push_back({whole(attribute.name),
                                  static_cast<gene_clocks_attribute_type>(attribute.type),
                                  static_cast<std::uint16_t>(count), values.back().data(),
                                  attribute.minimum, attribute.maximum, limit_of(attribute)});
            }
            return result;
        }

        /// Empty, which is refused, where a zero would cut the name short without a word.
        static const char* whole(const std::string& name) {
            return name.find('\0') == std::string::npos ? name.c_str() : "";
        }

        /// 0, which is refused, for what is no limit.
        static std::uint64_t limit_of(const Attribute& attribute) {
            if (!(attribute.limit > 0.0)) return 0;
            if (attribute.type == AttributeType::float64) {
                return gene_clocks_value_of_float64(attribute.limit);
            }
            if (attribute.limit > double{std::numeric_limits<float>::max()}) return 0;
            return gene_clocks_value_of_float32(static_cast<float>(attribute.limit));
        }
    };

    explicit Schema(std::shared_ptr<const Text> text) : text_(std::move(text)) {}

    std::shared_ptr<const Text> text_;
};

}  // namespace gene_clocks
