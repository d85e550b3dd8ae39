#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/wire_messages.hpp"

// The test vectors of the wire format, off their file.

namespace gene_clocks::test {

struct WireVectors {
    WireLimits limits;
    std::vector<nlohmann::json> all;
    std::vector<nlohmann::json> sealed;
    std::vector<std::uint8_t> key;  // of the sealed frames
};

inline std::vector<std::uint8_t> from_hex(std::string_view text) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
        bytes.push_back(
            static_cast<std::uint8_t>(std::stoul(std::string(text.substr(i, 2)), nullptr, 16)));
    }
    return bytes;
}

inline float float_of(const nlohmann::json& bits) {
    return std::bit_cast<float>(bits.get<std::uint32_t>());
}

/// The message that a vector's value describes.
inline WireMessage message_of(const nlohmann::json& value) {
    constexpr std::array<std::string_view, 5> kind_names{"input", "bias", "output", "hidden",
                                                         "connection"};
    WireMessage message;
    message.sender = RobotId{value["sender"].get<std::uint32_t>()};
    message.stamp = {value["stamp"].get<std::uint64_t>()};
    message.energy = float_of(value["energy_bits"]);
    const nlohmann::json& genome = value["genome"];
    message.genome.robot = genome["robot"];
    message.genome.birth = genome["birth"];
    for (const nlohmann::json& described : genome["genes"]) {
        kernel::gene_clocks_gene gene{};
        gene.mark = {described["counter"].get<std::uint64_t>(),
                     described["robot"].get<std::uint32_t>()};
        const auto kind =
            std::find(kind_names.begin(), kind_names.end(), described["kind"].get<std::string>());
        gene.kind = static_cast<kernel::gene_clocks_gene_kind>(kind - kind_names.begin());
        if (gene.kind == kernel::gene_clocks_connection) {
            gene.is_enabled = described["enabled"];
            gene.is_recurrent = described["recurrent"];
            gene.ends = {described["source"].get<std::uint16_t>(),
                         described["target"].get<std::uint16_t>()};
            gene.weight = float_of(described["weight_bits"]);
            ++message.genome.connections;
        } else {
            ++message.genome.neurons;
        }
        message.genes.push_back(gene);
    }
    return message;
}

inline WireVectors read_wire_vectors(const std::string& path) {
    std::ifstream file(path);
    const nlohmann::json document = nlohmann::json::parse(file);
    const nlohmann::json& limits = document["limits"];
    return {
        {limits["frame_bytes"], limits["genesis_count"], limits["neurons"], limits["connections"],
         float_of(limits["energy_bits"]), float_of(limits["weight_bits"])},
        document["vectors"],
        document["sealed"],
        from_hex(document["key"].get<std::string>())};
}

}  // namespace gene_clocks::test
