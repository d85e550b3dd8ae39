// General genomes against their test vectors, in C++ and in C; every way to damage a payload; what
// must not be written; and schemas.
#include <gtest/gtest.h>

#include <array>
#include <gene_clocks/general_genome.hpp>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include "tests/protocol/general_in_c.h"
#include "tests/support/allocations.hpp"
#include "tests/support/general_vectors.hpp"
#include "tests/support/property.hpp"

namespace gene_clocks {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

const test::GeneralVectors& vectors() {
    static const auto loaded = test::read_general_vectors(GENE_CLOCKS_GENERAL_VECTORS);
    return loaded;
}

const Schema& schema_named(const std::string& name) {
    return vectors().schemas.at(name);
}

/// Whatever the bytes: C and C++ agree, and what is read is written as the very same bytes.
std::optional<GeneFault> check(const Bytes& payload, Stamp stamp, const Schema& schema) {
    const auto genome = decode_general_genome(payload, stamp, schema, vectors().genes_max);
    Bytes written(payload.size());
    std::size_t size = 0, offset = 0;
    const int error =
        c_transcode_general(payload.data(), payload.size(), stamp.value, schema.layout().schema,
                            vectors().genes_max, written.data(), written.size(), &size, &offset);
    if (!genome) {
        EXPECT_EQ(static_cast<int>(genome.fault().error), error);
        EXPECT_EQ(genome.fault().offset, offset);
        EXPECT_LE(genome.fault().offset, payload.size());
        return genome.fault();
    }
    EXPECT_EQ(error, 0);
    EXPECT_EQ(size, payload.size());
    EXPECT_EQ(written, payload);
    const auto again = encode_general_genome(*genome, stamp, schema, vectors().genes_max);
    EXPECT_TRUE(again && *again == payload);
    return std::nullopt;
}

struct Valid {
    std::string name;
    Bytes payload;
    const Schema* schema;
    GeneralGenome genome;
};

std::vector<Valid> valid_payloads() {
    std::vector<Valid> valid;
    for (const json& vector : vectors().all) {
        if (!vector.contains("value")) continue;
        valid.push_back({vector["name"], test::from_hex(vector["payload"].get<std::string>()),
                         &schema_named(vector["schema"]),
                         test::general_genome_of(vector["value"])});
    }
    return valid;
}

TEST(GeneralVectors, AreReadAndWritten) {
    std::size_t valid = 0;
    std::set<std::string> errors;
    for (const json& vector : vectors().all) {
        SCOPED_TRACE(vector["name"].get<std::string>());
        const Bytes payload = test::from_hex(vector["payload"].get<std::string>());
        const Schema& schema = schema_named(vector["schema"]);
        const Stamp stamp = vectors().stamp_of(vector);
        const auto fault = check(payload, stamp, schema);
        if (vector.contains("value")) {
            ++valid;
            ASSERT_FALSE(fault) << name_of(fault->error) << " at " << fault->offset;
            const GeneralGenome expected = test::general_genome_of(vector["value"]);
            const auto read = decode_general_genome(payload, stamp, schema, vectors().genes_max);
            EXPECT_TRUE(test::same_general_genome(*read, expected));
            const auto written =
                encode_general_genome(expected, stamp, schema, vectors().genes_max);
            ASSERT_TRUE(written);
            EXPECT_EQ(*written, payload);
        } else {
            ASSERT_TRUE(fault);
            EXPECT_EQ(name_of(fault->error), vector["error"].get<std::string>());
            EXPECT_EQ(fault->offset, vector["offset"].get<std::size_t>());
            errors.emplace(name_of(fault->error));
        }
    }
    EXPECT_GE(valid, 20u);
    EXPECT_GE(errors.size(), 13u);
}

TEST(GeneralVectors, SchemasHaveTheseBytesAndFingerprintsInCToo) {
    for (const json& described : vectors().described_schemas) {
        SCOPED_TRACE(described["name"].get<std::string>());
        const auto schema = test::schema_of(described["value"]);
        ASSERT_TRUE(schema);
        const Bytes bytes = test::from_hex(described["bytes"].get<std::string>());
        EXPECT_EQ(schema->bytes(), bytes);
        EXPECT_EQ(schema->fingerprint(), described["fingerprint"].get<std::uint32_t>());
        EXPECT_EQ(schema->fingerprint(), kernel::gene_clocks_crc32c(bytes.data(), bytes.size()));
        Bytes in_c(bytes.size());
        std::size_t size = 0;
        std::uint32_t fingerprint = 0;
        EXPECT_EQ(c_lay_out(schema->layout().schema, in_c.data(), in_c.size(), &size, &fingerprint),
                  0);
        EXPECT_EQ(in_c, bytes);
        EXPECT_EQ(fingerprint, schema->fingerprint());
    }
}

TEST(GeneralDamage, ATruncatedPayloadIsRefusedWhereverItEnds) {
    for (const Valid& valid : valid_payloads()) {
        for (std::size_t size = 0; size < valid.payload.size(); ++size) {
            // A copy of exactly this size, so that AddressSanitizer sees a byte too far.
            const auto fault = check(
                {valid.payload.begin(), valid.payload.begin() + static_cast<std::ptrdiff_t>(size)},
                vectors().stamp, *valid.schema);
            ASSERT_TRUE(fault) << valid.name << " cut to " << size;
            EXPECT_EQ(fault->error, WireError::truncated) << valid.name << " cut to " << size;
        }
    }
}

TEST(GeneralDamage, AFlippedBitIsRefusedOrMeansSomethingElse) {
    std::set<WireError> errors;
    for (const Valid& valid : valid_payloads()) {
        for (std::size_t bit = 0; bit < 8 * valid.payload.size(); ++bit) {
            Bytes damaged = valid.payload;
            damaged[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
            if (const auto fault = check(damaged, vectors().stamp, *valid.schema)) {
                errors.insert(fault->error);
                continue;
            }
            const auto other =
                decode_general_genome(damaged, vectors().stamp, *valid.schema, vectors().genes_max);
            EXPECT_FALSE(test::same_general_genome(valid.genome, *other)) << valid.name;
        }
    }
    EXPECT_GE(errors.size(), 12u);
}

TEST(GeneralDamage, EveryPairOfBytesAtTheFrontIsTaken) {
    // Identity, counts and the first head: where lengths could lie.
    for (const Valid& valid : valid_payloads()) {
        for (std::size_t at = 5; at < std::min<std::size_t>(valid.payload.size(), 10); ++at) {
            for (unsigned byte = 0; byte < 256; ++byte) {
                Bytes damaged = valid.payload;
                damaged[at] = static_cast<std::uint8_t>(byte);
                if (at + 1 < damaged.size()) damaged[at + 1] = static_cast<std::uint8_t>(byte * 37);
                check(damaged, vectors().stamp, *valid.schema);
            }
        }
    }
}

TEST(GeneralDamage, CountsThatCannotBeCostNoMemory) {
    const Schema& schema = schema_named("as in the document");
    Bytes payload{0};
    for (unsigned i = 0; i < 4; ++i) {
        payload.push_back(static_cast<std::uint8_t>(schema.fingerprint() >> 8 * i & 0xffu));
    }
    // Robot 7, birth 0, 2^32 - 2 nodes, 1 link.
    for (const int byte : {7, 0, 0xfe, 0xff, 0xff, 0xff, 0x0f, 1}) {
        payload.push_back(static_cast<std::uint8_t>(byte));
    }
    payload.resize(2000);
    const auto before = test::allocations();
    const auto refused = decode_general_genome(payload, Stamp{1000}, schema, UINT32_MAX);
    EXPECT_EQ(refused.fault().error, WireError::truncated);
    EXPECT_LT(test::allocations().bytes - before.bytes, 4096u);
}

TEST(GeneralDamage, NothingIsAllocatedInC) {
    Bytes out(4096);
    for (const Valid& valid : valid_payloads()) {
        std::size_t size = 0, offset = 0;
        const auto before = test::allocations();
        c_transcode_general(valid.payload.data(), valid.payload.size(), 1000,
                            valid.schema->layout().schema, 40, out.data(), out.size(), &size,
                            &offset);
        EXPECT_EQ(test::allocations().count, before.count);
    }
}

TEST(GeneralGenomes, OneThatTravelsInAFrameIsNoGenomeOfVersion1AndTheOtherWayRound) {
    const Valid valid = valid_payloads().front();
    Bytes buffer(valid.payload.size() + frame_overhead_bytes);
    const auto frame =
        encode_frame({RobotId{7}, vectors().stamp, 1.0f, valid.payload}, buffer, WireLimits{});
    ASSERT_TRUE(frame);
    EXPECT_EQ(test::decode_message(*frame, WireLimits{}).fault().error, WireError::robot);
    const auto again = decode_frame(*frame, WireLimits{});
    EXPECT_TRUE(decode_general_genome(again->payload, again->stamp, *valid.schema));
}

/// The fault of what is not written.
GeneFault refused(const GeneralGenome& genome, const Schema& schema, Stamp stamp = {1000}) {
    const auto written = encode_general_genome(genome, stamp, schema, vectors().genes_max);
    EXPECT_FALSE(written);
    return written ? GeneFault{} : written.fault();
}

const Valid& split_connection() {
    static const Valid valid = [] {
        for (Valid& one : valid_payloads()) {
            if (one.name == "neat-python, a split connection") return one;
        }
        throw std::runtime_error("the vector is missing");
    }();
    return valid;
}

TEST(GeneralGenomes, WhatWouldBeRefusedIsNotWrittenAndTheGeneIsNamed) {
    const auto [name, payload, schema, whole] = split_connection();
    const auto fault_of = [&, schema = schema](auto change, Stamp stamp = {1000}) {
        GeneralGenome genome = split_connection().genome;
        change(genome);
        return refused(genome, *schema, stamp);
    };
    const auto in = [](WireError error, std::size_t gene_class, std::size_t gene, int part,
                       const GeneFault& fault) {
        EXPECT_EQ(fault.error, error) << name_of(fault.error);
        EXPECT_EQ(fault.gene_class, gene_class);
        EXPECT_EQ(fault.gene, gene);
        EXPECT_EQ(fault.part, static_cast<std::size_t>(part));
    };
    constexpr int attribute = gene_clocks_part_attribute;
    in(WireError::robot, 3, 0, 0, fault_of([](auto& g) { g.robot = RobotId{0}; }));
    in(WireError::attribute, 3, 0, attribute, fault_of([](auto& g) { g.values[0] = UINT64_MAX; }));
    in(WireError::attribute, 3, 0, attribute + 1, fault_of([](auto& g) { g.values[1] = 2; }));
    in(WireError::not_ascending, 2, 1, gene_clocks_part_mark,
       fault_of([](auto& g) { std::swap(g.classes[2].genes[0], g.classes[2].genes[1]); }));
    in(WireError::not_ascending, 0, 1, gene_clocks_part_mark,
       fault_of([](auto& g) { g.classes[0].genes[1].counter = 1; }));
    in(WireError::genesis, 1, 1, gene_clocks_part_mark,
       fault_of([](auto& g) { g.classes[1].genes[1].robot = 0; }));
    in(WireError::not_below, 2, 2, gene_clocks_part_mark, fault_of([](auto&) {}, Stamp{42}));
    in(WireError::ends, 2, 0, gene_clocks_part_source,
       fault_of([](auto& g) { g.classes[2].genes[0].source.index = 4; }));
    in(WireError::ends, 2, 0, gene_clocks_part_target,
       fault_of([](auto& g) { g.classes[2].genes[0].target.index = 4; }));
    in(WireError::ends, 2, 0, gene_clocks_part_target,
       fault_of([](auto& g) { g.classes[2].genes[0].target.counter = 1; }));
    in(WireError::ends, 1, 0, gene_clocks_part_source,
       fault_of([](auto& g) { g.classes[1].genes[0].source.index = 1; }));
    in(WireError::attribute, 1, 1, attribute + 2,
       fault_of([](auto& g) { g.classes[1].values[5 + 2] = 0x7ff0000000000000; }));
    in(WireError::attribute, 1, 0, attribute + 3,
       fault_of([](auto& g) { g.classes[1].values[3] = 18; }));
    in(WireError::attribute, 2, 1, attribute + 1,
       fault_of([](auto& g) { g.classes[2].values[2 + 1] = 2; }));
    in(WireError::too_many_genes, 0, 0, 0,
       fault_of([](auto& g) { g.classes[0].genes.resize(41); }));
}

TEST(GeneralGenomes, AMarkOfAGeneWithoutMarksIsNotLostInSilence) {
    const Schema& schema = schema_named("links without marks");
    GeneralGenome genome{RobotId{1}, 0, {}, {{{{1, 2, {}, {}}}, {0}}, {{{5, 1, {}, {}}}, {0}}}};
    EXPECT_EQ(refused(genome, schema).error, WireError::genesis);
    genome.classes[1].genes[0].counter = genome.classes[1].genes[0].robot = 0;
    EXPECT_TRUE(encode_general_genome(genome, Stamp{1000}, schema));
}

TEST(GeneralGenomes, NoMoreAndNoFewerGenesAreWrittenThanAnnounced) {
    const Schema& schema = schema_named("as in the document");
    for (const std::uint32_t announced : {1u, 3u}) {
        gene_clocks_general_writer writer{};
        const gene_clocks_general_header header{7, 0, {announced}};
        Bytes buffer(100);
        ASSERT_FALSE(gene_clocks_begin_general(&writer, buffer.data(), buffer.size(), &header,
                                               nullptr, 1000, &schema.layout(), 40)
                         .error);
        const std::uint64_t bias = 0;
        const gene_clocks_general_gene first{1, 0, {}, {}}, second{2, 1, {}, {}};
        ASSERT_FALSE(gene_clocks_put_general_gene(&writer, &first, &bias).error);
        const auto fault = gene_clocks_put_general_gene(&writer, &second, &bias);
        EXPECT_EQ(fault.error, announced == 1 ? gene_clocks_wire_gene_count : gene_clocks_wire_ok);
        EXPECT_EQ(gene_clocks_end_general(&writer).error,
                  announced == 1 ? gene_clocks_wire_ok : gene_clocks_wire_gene_count);
    }
}

TEST(GeneralGenomes, NothingIsWrittenBeyondTheBuffer) {
    for (const Valid& valid : valid_payloads()) {
        for (std::size_t capacity = 0; capacity < valid.payload.size(); ++capacity) {
            Bytes out(capacity + 4, 0xee);
            std::size_t size = 0, offset = 0;
            EXPECT_EQ(c_transcode_general(valid.payload.data(), valid.payload.size(), 1000,
                                          valid.schema->layout().schema, 40, out.data(), capacity,
                                          &size, &offset),
                      gene_clocks_wire_no_room);
            EXPECT_EQ(size, valid.payload.size()) << "as many as are needed";
            EXPECT_EQ(Bytes(out.end() - 4, out.end()), Bytes(4, 0xee));
        }
    }
}

TEST(GeneralGenomes, AreReadAtCompileTime) {
    constexpr bool is_read = [] {
        const gene_clocks_attribute weight[] = {GENE_CLOCKS_FLOAT32("w", 0x41f00000)};
        const gene_clocks_gene_class classes[] = {{"n", true, gene_clocks_no_ends, weight, 1}};
        const gene_clocks_schema schema{0, nullptr, 0, classes, 1};
        gene_clocks_layout layout{};
        if (gene_clocks_lay_out(&schema, &layout).error) return false;
        std::array<std::uint8_t, 32> buffer{};
        gene_clocks_general_writer writer{};
        const gene_clocks_general_header header{7, 9, {1}};
        const gene_clocks_general_gene gene{3, 7, {}, {}};
        std::uint64_t value = 0x3f800000;
        if (gene_clocks_begin_general(&writer, buffer.data(), 32, &header, nullptr, 10, &layout, 1)
                .error ||
            gene_clocks_put_general_gene(&writer, &gene, &value).error ||
            gene_clocks_end_general(&writer).error) {
            return false;
        }
        gene_clocks_general_reader reader{};
        gene_clocks_general_gene read{};
        value = 0;
        return !gene_clocks_open_general(&reader, buffer.data(), writer.bytes.size, 10, &layout, 1,
                                         nullptr)
                    .error &&
               !gene_clocks_next_general_gene(&reader, &read, &value).error && read.counter == 3 &&
               value == 0x3f800000;
    }();
    EXPECT_TRUE(is_read);
}

// ---- Schemas ------------------------------------------------------------------------------------

SchemaFault schema_fault(std::vector<GeneClass> classes, std::vector<Attribute> attributes = {}) {
    const auto schema = Schema::make(0, std::move(classes), std::move(attributes));
    EXPECT_FALSE(schema);
    return schema ? SchemaFault{} : schema.fault();
}

std::vector<Attribute> flags(std::size_t count) {
    std::vector<Attribute> list;
    for (std::size_t i = 0; i < count; ++i)
        list.push_back(Attribute::flag("f" + std::to_string(i)));
    return list;
}

std::vector<std::string> names(std::size_t count) {
    std::vector<std::string> list;
    for (std::size_t i = 0; i < count; ++i) list.push_back("v" + std::to_string(i));
    return list;
}

TEST(Schemas, ThatCannotBeAreRefusedWithThePlace) {
    const auto one = [](Attribute attribute) {
        return std::vector<GeneClass>{
            {"ok"}, {"node", true, Ends::none, {Attribute::flag("a"), std::move(attribute)}}};
    };
    const std::vector<std::pair<SchemaFault, std::vector<GeneClass>>> wrong{
        {{SchemaError::classes, 0, 0}, {}},
        {{SchemaError::classes, 9, 0}, std::vector<GeneClass>(9, {"node"})},
        {{SchemaError::name, 0, 0}, {{""}}},
        {{SchemaError::name, 0, 0}, {{"a node"}}},
        {{SchemaError::name, 0, 0}, {{"n\xc3\xb6"}}},
        {{SchemaError::name, 0, 0}, {{std::string("a\0b", 3)}}},
        {{SchemaError::name, 0, 0}, {{std::string(64, 'n')}}},
        {{SchemaError::repeated, 1, 0}, {{"node"}, {"node"}}},
        {{SchemaError::identity, 0, 0}, {{"node", false}}},
        {{SchemaError::ends, 0, 0}, {{"link", true, Ends::by_index}}},
        {{SchemaError::type, 0, 0}, {{"link", true, static_cast<Ends>(3)}}},
        {{SchemaError::attributes, 0, 33}, {{"node", true, Ends::none, flags(33)}}},
        {{SchemaError::name, 1, 1}, one(Attribute::flag(""))},
        {{SchemaError::repeated, 1, 1}, one(Attribute::flag("a"))},
        {{SchemaError::type, 1, 1}, one({"b", static_cast<AttributeType>(5)})},
        {{SchemaError::values, 1, 1}, one(Attribute::enumeration("b", names(1)))},
        {{SchemaError::values, 1, 1}, one(Attribute::enumeration("b", names(257)))},
        {{SchemaError::values, 1, 1}, one(Attribute::enumeration("b", names(65536 + 4)))},
        {{SchemaError::repeated, 1, 1}, one(Attribute::enumeration("b", {"x", "y", "x"}))},
        {{SchemaError::name, 1, 1}, one(Attribute::enumeration("b", {"x", " "}))},
        {{SchemaError::bounds, 1, 1}, one(Attribute::integer("b", 1, 0))},
        {{SchemaError::bounds, 1, 1}, one(Attribute::float32("b", 0.0f))},
        {{SchemaError::bounds, 1, 1}, one(Attribute::float32("b", -1.0f))},
        {{SchemaError::bounds, 1, 1},
         one(Attribute::float32("b", std::numeric_limits<float>::infinity()))},
        {{SchemaError::bounds, 1, 1},
         one(Attribute::float64("b", std::numeric_limits<double>::infinity()))},
        {{SchemaError::bounds, 1, 1},
         one(Attribute::float64("b", std::numeric_limits<double>::quiet_NaN()))},
    };
    for (const auto& [expected, classes] : wrong) {
        const SchemaFault fault = schema_fault(classes);
        EXPECT_EQ(fault, expected) << name_of(fault.error) << ' ' << fault.gene_class << ' '
                                   << fault.attribute << ", not " << name_of(expected.error);
    }
    std::vector<Attribute> many{Attribute::enumeration("e0", names(256))};
    for (int i = 1; i < 7; ++i) {
        many.push_back(Attribute::enumeration("e" + std::to_string(i), names(256)));
    }
    EXPECT_TRUE(Schema::make(0, {{"node", true, Ends::none, many}}));
    many.push_back(Attribute::flag("one_too_many"));
    EXPECT_EQ(schema_fault({{"node", true, Ends::none, many}}),
              (SchemaFault{SchemaError::bits, 0, 7}));
    EXPECT_EQ(schema_fault({{"node"}}, {Attribute::integer("fitness", 2, 1)}),
              (SchemaFault{SchemaError::bounds, 1, 0}));
}

TEST(Schemas, AnyDifferenceGivesAnotherFingerprint) {
    const auto make = [](auto change) {
        std::uint64_t genesis = 3;
        std::vector<Attribute> own{Attribute::float64("fitness")};
        std::vector<GeneClass> classes{
            {"node", true, Ends::none, {Attribute::enumeration("kind", {"tanh", "relu"})}},
            {"link",
             true,
             Ends::by_index,
             {Attribute::float32("weight", 30.0f), Attribute::integer("age", -1, 9)}}};
        change(genesis, classes, own);
        return Schema::make(genesis, classes, own)->fingerprint();
    };
    std::set<std::uint32_t> prints{make([](auto&...) {})};
    std::size_t changes = 0;
    const auto differs = [&](auto change) {
        prints.insert(make(change));
        ++changes;
    };
    differs([](auto& genesis, auto&, auto&) { ++genesis; });
    differs([](auto&, auto& classes, auto&) { classes[0].name = "Node"; });
    differs([](auto&, auto& classes, auto&) { classes[1].ends = Ends::by_mark; });
    differs([](auto&, auto& classes, auto&) { classes[1].is_marked = false; });
    differs([](auto&, auto& classes, auto&) { classes.push_back({"more"}); });
    differs([](auto&, auto& classes, auto&) {
        std::swap(classes[0].attributes[0].values[0], classes[0].attributes[0].values[1]);
    });
    differs([](auto&, auto& classes, auto&) { classes[1].attributes[0].limit = 29.0; });
    differs([](auto&, auto& classes, auto&) {
        classes[1].attributes[0].type = AttributeType::float64;
    });
    differs([](auto&, auto& classes, auto&) { classes[1].attributes[1].minimum = 0; });
    differs([](auto&, auto& classes, auto&) { classes[1].attributes[1].maximum = 10; });
    differs([](auto&, auto& classes, auto&) {
        std::swap(classes[1].attributes[0], classes[1].attributes[1]);
    });
    differs([](auto&, auto&, auto& own) { own.clear(); });
    EXPECT_EQ(prints.size(), changes + 1);
}

// ---- Properties ---------------------------------------------------------------------------------

Attribute draw_attribute(std::size_t number) {
    const std::string name = "a" + std::to_string(number);
    switch (*rc::gen::inRange(0, 5)) {
        case 0:
            return Attribute::flag(name);
        case 1:
            return Attribute::enumeration(name, names(*rc::gen::inRange<std::size_t>(2, 20)));
        case 2: {
            const auto some = *rc::gen::pair(rc::gen::arbitrary<std::int64_t>(),
                                             rc::gen::arbitrary<std::int64_t>());
            return Attribute::integer(name, std::min(some.first, some.second),
                                      std::max(some.first, some.second));
        }
        case 3:
            return Attribute::float32(name, 30.0f);
        default:
            return Attribute::float64(name);
    }
}

std::uint64_t draw_value(const Attribute& attribute) {
    switch (attribute.type) {
        case AttributeType::flag:
            return *rc::gen::inRange<std::uint64_t>(0, 2);
        case AttributeType::enumeration:
            return *rc::gen::inRange<std::uint64_t>(0, attribute.values.size());
        case AttributeType::integer:
            return gene_clocks_value_of_integer(*rc::gen::element(
                attribute.minimum, attribute.maximum,
                std::clamp<std::int64_t>(0, attribute.minimum, attribute.maximum)));
        case AttributeType::float32:
            return gene_clocks_value_of_float32(static_cast<float>(*rc::gen::inRange(-2999, 3000)) /
                                                100.0f);
        case AttributeType::float64:
            break;
    }
    return gene_clocks_value_of_float64(*rc::gen::arbitrary<int>() / 7.0);
}

Schema draw_schema() {
    std::vector<GeneClass> classes;
    const auto attributes = [] {
        std::vector<Attribute> list;
        const auto count = *rc::gen::inRange<std::size_t>(0, 8);
        for (std::size_t i = 0; i < count; ++i) list.push_back(draw_attribute(i));
        return list;
    };
    const auto count = *rc::gen::inRange<std::size_t>(1, 5);
    for (std::size_t i = 0; i < count; ++i) {
        const auto ends = *rc::gen::element(Ends::none, Ends::by_index, Ends::by_mark);
        const bool has_ends = ends != Ends::none && (i > 0 || ends == Ends::by_mark);
        classes.push_back({"c" + std::to_string(i), !has_ends || *rc::gen::arbitrary<bool>(),
                           has_ends ? ends : Ends::none, attributes()});
    }
    return *Schema::make(*rc::gen::inRange<std::uint64_t>(0, 6), classes, attributes());
}

/// A mark above ⟨counter, robot⟩.
void advance(std::uint64_t& counter, std::uint32_t& robot, std::uint64_t genesis) {
    counter += *rc::gen::element<std::uint64_t>(1, 1, 2, 6, 7, 8, 62, 63, 64, 126, 127, 128, 5000);
    robot = counter <= genesis ? 0 : *rc::gen::element<std::uint32_t>(1, 2, 200, 4294967295u);
}

GeneralGenome draw_genome(const Schema& schema) {
    GeneralGenome genome{
        RobotId{*rc::gen::nonZero<std::uint32_t>()}, *rc::gen::arbitrary<std::uint64_t>(), {}, {}};
    for (const auto& attribute : schema.attributes())
        genome.values.push_back(draw_value(attribute));
    std::uint32_t before = 0;
    for (const GeneClass& gene_class : schema.classes()) {
        ClassGenes& genes = genome.classes.emplace_back();
        auto count = *rc::gen::inRange<std::uint32_t>(0, 12);
        if (gene_class.ends == Ends::by_index && before == 0) count = 0;
        gene_clocks_general_gene gene{};
        for (std::uint32_t i = 0; i < count; ++i) {
            if (gene_class.is_marked) advance(gene.counter, gene.robot, schema.genesis_count());
            if (gene_class.ends == Ends::by_index) {
                gene.target.index = *rc::gen::inRange<std::uint32_t>(0, before);
                gene.source.index = gene_class.is_marked
                                        ? *rc::gen::inRange<std::uint32_t>(0, before)
                                        : gene.source.index + (i > 0 ? 1 : 0);
                if (gene.source.index >= before) break;
            } else if (gene_class.ends == Ends::by_mark) {
                advance(gene.source.counter, gene.source.robot, schema.genesis_count());
                advance(gene.target.counter, gene.target.robot, schema.genesis_count());
            }
            genes.genes.push_back(gene);
            for (const auto& attribute : gene_class.attributes) {
                genes.values.push_back(draw_value(attribute));
            }
        }
        before += static_cast<std::uint32_t>(genes.genes.size());
    }
    return genome;
}

GENE_CLOCKS_PROPERTY(GeneralProperty, WhatIsWrittenIsRead, ()) {
    const Schema schema = draw_schema();
    const GeneralGenome genome = draw_genome(schema);
    const auto payload = encode_general_genome(genome, Stamp{1000000}, schema);
    RC_ASSERT(static_cast<bool>(payload));
    const auto again = decode_general_genome(*payload, Stamp{1000000}, schema);
    RC_ASSERT(static_cast<bool>(again));
    RC_ASSERT(test::same_general_genome(*again, genome));
}

GENE_CLOCKS_PROPERTY(GeneralProperty, WhatIsReadIsWrittenAsTheSameBytes, ()) {
    const Schema schema = draw_schema();
    auto payload = *encode_general_genome(draw_genome(schema), Stamp{1000000}, schema, 40);
    const auto damages = *rc::gen::inRange(1, 4);
    for (int i = 0; i < damages; ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, payload.size());
        payload[at] = *rc::gen::arbitrary<std::uint8_t>();
    }
    const auto fault = check(payload, Stamp{1000000}, schema);
    RC_CLASSIFY(!fault, "still a genome");
    RC_ASSERT(!testing::Test::HasFailure());
}

}  // namespace
}  // namespace gene_clocks
