#pragma once

#include <cstdint>
#include <fstream>
#include <gene_clocks/general_genome.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/wire_vectors.hpp"

// The test vectors of general genomes, off their file.

namespace gene_clocks::test {

inline Attribute attribute_of(const nlohmann::json& described) {
    const std::string name = described["name"], type = described["type"];
    if (type == "flag") return Attribute::flag(name);
    if (type == "enumeration") return Attribute::enumeration(name, described["values"]);
    if (type == "integer") {
        return Attribute::integer(name, described["minimum"], described["maximum"]);
    }
    if (type == "float32") return Attribute::float32(name, float_of(described["limit_bits"]));
    return Attribute::float64(
        name, gene_clocks_float64_of_value(described["limit_bits"].get<std::uint64_t>()));
}

inline std::vector<Attribute> attributes_of(const nlohmann::json& described) {
    std::vector<Attribute> attributes;
    for (const auto& one : described) attributes.push_back(attribute_of(one));
    return attributes;
}

inline WireResult<Schema, SchemaFault> schema_of(const nlohmann::json& described) {
    std::vector<GeneClass> classes;
    for (const auto& one : described["classes"]) {
        const std::string ends = one["ends"];
        classes.push_back({one["name"], one["marked"],
                           ends == "none"    ? Ends::none
                           : ends == "index" ? Ends::by_index
                                             : Ends::by_mark,
                           attributes_of(one["attributes"])});
    }
    return Schema::make(described["genesis_count"], std::move(classes),
                        attributes_of(described["attributes"]));
}

inline std::vector<std::uint64_t> values_of(const nlohmann::json& described) {
    std::vector<std::uint64_t> values;
    for (const auto& value : described) {
        values.push_back(value.is_number_unsigned() ? value.get<std::uint64_t>()
                                                    : gene_clocks_value_of_integer(value));
    }
    return values;
}

inline gene_clocks_gene_end end_of(const nlohmann::json& gene, const char* side) {
    if (!gene.contains(side)) return {};
    const auto& end = gene[side];
    if (end.is_array()) return {end[0].get<std::uint64_t>(), end[1].get<std::uint32_t>(), 0};
    return {0, 0, end.get<std::uint32_t>()};
}

/// The genome that a vector's value describes.
inline GeneralGenome general_genome_of(const nlohmann::json& value) {
    GeneralGenome genome{RobotId{value["robot"].get<std::uint32_t>()},
                         value["birth"],
                         values_of(value["values"]),
                         {}};
    for (const auto& described : value["classes"]) {
        ClassGenes& genes = genome.classes.emplace_back();
        for (const auto& gene : described) {
            gene_clocks_general_gene one{};
            if (gene.contains("mark")) {
                one.counter = gene["mark"][0];
                one.robot = gene["mark"][1];
            }
            one.source = end_of(gene, "source");
            one.target = end_of(gene, "target");
            genes.genes.push_back(one);
            const auto values = values_of(gene["values"]);
            genes.values.insert(genes.values.end(), values.begin(), values.end());
        }
    }
    return genome;
}

inline bool same_end(const gene_clocks_gene_end& a, const gene_clocks_gene_end& b) {
    return a.counter == b.counter && a.robot == b.robot && a.index == b.index;
}

inline bool same_general_genome(const GeneralGenome& a, const GeneralGenome& b) {
    if (a.robot != b.robot || a.birth != b.birth || a.values != b.values ||
        a.classes.size() != b.classes.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.classes.size(); ++i) {
        const auto& left = a.classes[i].genes;
        const auto& right = b.classes[i].genes;
        if (left.size() != right.size() || a.classes[i].values != b.classes[i].values) return false;
        for (std::size_t j = 0; j < left.size(); ++j) {
            if (left[j].counter != right[j].counter || left[j].robot != right[j].robot ||
                !same_end(left[j].source, right[j].source) ||
                !same_end(left[j].target, right[j].target)) {
                return false;
            }
        }
    }
    return true;
}

struct GeneralVectors {
    Stamp stamp;
    std::uint32_t genes_max{};
    std::map<std::string, Schema> schemas;
    std::vector<nlohmann::json> described_schemas;
    std::vector<nlohmann::json> all;

    Stamp stamp_of(const nlohmann::json& vector) const {
        return vector.contains("stamp") ? Stamp{vector["stamp"].get<std::uint64_t>()} : stamp;
    }
};

inline GeneralVectors read_general_vectors(const std::string& path) {
    std::ifstream file(path);
    const nlohmann::json document = nlohmann::json::parse(file);
    GeneralVectors vectors{{document["stamp"].get<std::uint64_t>()},
                           document["genes_max"],
                           {},
                           document["schemas"],
                           document["vectors"]};
    for (const auto& described : vectors.described_schemas) {
        // A schema that is refused is missed where it is used.
        if (const auto schema = schema_of(described["value"])) {
            vectors.schemas.emplace(described["name"].get<std::string>(), *schema);
        }
    }
    return vectors;
}

}  // namespace gene_clocks::test
