// Property: whatever payload arrives, decoding a general genome ends with a genome or with a fault
// within it, and allocates no more than a multiple of its bytes; what is read is written again as
// the very same bytes; every mark of what is read lies below the stamp, and every end within the
// genes before. The first byte picks the schema and the stamp, the second bytes' fingerprint is
// mended, or nothing behind it would be reached.

#include <algorithm>
#include <array>
#include <gene_clocks/general_genome.hpp>
#include <vector>

#include "fuzz/require.hpp"

namespace {

using namespace gene_clocks;

constexpr std::uint32_t genes_max = 64;

/// Between them all types, both kinds of ends, genes with and without marks.
const std::array<Schema, 4>& schemas() {
    static const std::array<Schema, 4> all{
        *Schema::make(1, {{"node", true, Ends::none, {Attribute::float32("bias", 30.0f)}},
                          {"link",
                           true,
                           Ends::by_index,
                           {Attribute::float32("weight", 30.0f), Attribute::flag("enabled")}}}),
        *Schema::make(0,
                      {{"node", true, Ends::none, {Attribute::integer("kind", -3, 255)}},
                       {"link", false, Ends::by_index, {Attribute::float64("weight")}}},
                      {Attribute::float64("fitness"), Attribute::flag("has_fitness")}),
        *Schema::make(2, {{"link", true, Ends::by_mark, {Attribute::float32("weight")}},
                          {"module", false, Ends::by_mark, {Attribute::flag("on")}}}),
        *Schema::make(3, {{"node",
                           true,
                           Ends::none,
                           {Attribute::enumeration("a", {"p", "q", "r"}), Attribute::flag("f"),
                            Attribute::integer("i", INT64_MIN, INT64_MAX),
                            Attribute::enumeration("b", {"u", "v", "w", "x", "y"})}}})};
    return all;
}

void require_in_order(const GeneralGenome& genome, Stamp stamp, const Schema& schema) {
    std::size_t before = 0;
    for (std::size_t i = 0; i < genome.classes.size(); ++i) {
        const GeneClass& gene_class = schema.classes()[i];
        const auto& genes = genome.classes[i].genes;
        for (std::size_t j = 0; j < genes.size(); ++j) {
            const auto mark = [&](std::size_t k) {
                return InnovationNumber{genes[k].counter, RobotId{genes[k].robot}};
            };
            if (gene_class.is_marked) {
                GENE_CLOCKS_REQUIRE(genes[j].counter > 0 && genes[j].counter < stamp.value);
                GENE_CLOCKS_REQUIRE(j == 0 || mark(j - 1) < mark(j));
            }
            if (gene_class.ends == Ends::by_index) {
                GENE_CLOCKS_REQUIRE(genes[j].source.index < before);
                GENE_CLOCKS_REQUIRE(genes[j].target.index < before);
            }
        }
        GENE_CLOCKS_REQUIRE(genome.classes[i].values.size() ==
                            genes.size() * gene_class.attributes.size());
        before += genes.size();
    }
    GENE_CLOCKS_REQUIRE(before <= genes_max);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const Schema& schema = schemas()[data[0] % 4];
    const Stamp stamp{data[0] < 200 ? 1u + data[0] / 4u : UINT64_MAX};
    std::vector<std::uint8_t> payload(data + 1, data + size);
    for (std::size_t i = 1; i < std::min<std::size_t>(payload.size(), 5); ++i) {
        payload[i] = static_cast<std::uint8_t>(schema.fingerprint() >> 8 * (i - 1) & 0xffu);
    }
    payload.shrink_to_fit();
    const auto genome = decode_general_genome(payload, stamp, schema, genes_max);
    if (!genome) {
        GENE_CLOCKS_REQUIRE(genome.fault().offset <= payload.size());
        GENE_CLOCKS_REQUIRE(genome.fault().gene_class <= schema.classes().size());
        return 0;
    }
    require_in_order(*genome, stamp, schema);
    const auto again = encode_general_genome(*genome, stamp, schema, genes_max);
    GENE_CLOCKS_REQUIRE(again && *again == payload);
    return 0;
}
