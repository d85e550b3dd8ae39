// The test vectors of general genomes on the processor that this runs on, in C++ and in C (see
// vectors.cpp).
//
// Usage: general_vectors FILE
#include "tests/support/general_vectors.hpp"

#include <bit>
#include <cstdio>
#include <string>

#include "tests/protocol/general_in_c.h"

namespace {

using namespace gene_clocks;
using Bytes = std::vector<std::uint8_t>;

bool is_schema_right(const nlohmann::json& described) {
    const auto schema = test::schema_of(described["value"]);
    return schema && schema->bytes() == test::from_hex(described["bytes"].get<std::string>()) &&
           schema->fingerprint() == described["fingerprint"].get<std::uint32_t>();
}

bool is_vector_right(const nlohmann::json& vector, const test::GeneralVectors& vectors) {
    const Bytes payload = test::from_hex(vector["payload"].get<std::string>());
    const Schema& schema = vectors.schemas.at(vector["schema"]);
    const Stamp stamp = vectors.stamp_of(vector);
    const auto genome = decode_general_genome(payload, stamp, schema, vectors.genes_max);
    Bytes written(payload.size());
    std::size_t size = 0, offset = 0;
    const int error =
        c_transcode_general(payload.data(), payload.size(), stamp.value, schema.layout().schema,
                            vectors.genes_max, written.data(), written.size(), &size, &offset);
    if (!vector.contains("value")) {
        return !genome && name_of(genome.fault().error) == vector["error"].get<std::string>() &&
               genome.fault().offset == vector["offset"].get<std::size_t>() &&
               error == static_cast<int>(genome.fault().error) && offset == genome.fault().offset;
    }
    if (!genome || error) return false;
    const auto again = encode_general_genome(*genome, stamp, schema, vectors.genes_max);
    return test::same_general_genome(*genome, test::general_genome_of(vector["value"])) && again &&
           *again == payload && written == payload;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto vectors = test::read_general_vectors(argv[1]);
    int wrong = 0, payloads = 0, refused = 0;
    for (const auto& described : vectors.described_schemas) {
        if (is_schema_right(described)) continue;
        std::printf("wrong: schema %s\n", described["name"].get<std::string>().c_str());
        ++wrong;
    }
    for (const auto& vector : vectors.all) {
        ++(vector.contains("value") ? payloads : refused);
        if (is_vector_right(vector, vectors)) continue;
        std::printf("wrong: %s\n", vector["name"].get<std::string>().c_str());
        ++wrong;
    }
    if (payloads < 20 || refused < 60) {
        std::printf("wrong: vectors are missing\n");
        ++wrong;
    }
    std::printf("%zu bits, %s endian: %d payloads, %d refused, %d wrong\n", 8 * sizeof(void*),
                std::endian::native == std::endian::big ? "big" : "little", payloads, refused,
                wrong);
    return wrong == 0 ? 0 : 1;
}
