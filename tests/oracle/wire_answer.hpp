#pragma once

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "proofs/oracle/in_process.h"
#include "tests/support/wire_messages.hpp"

// The wire format's two decoders side by side: the shipped one and the proved one.

namespace gene_clocks::test {

/// What the shipped decoder says of a frame, in the words of proofs/oracle/wire.ml.
inline std::string shipped_answer(std::span<const std::uint8_t> frame, const WireLimits& limits) {
    constexpr std::array<std::string_view, 4> kinds{"input", "bias", "output", "hidden"};
    const auto message = decode_message(frame, limits);
    if (!message) return "refused";
    std::string answer =
        fmt::format("message {} {} {} {} {}", static_cast<std::uint32_t>(message->sender),
                    message->stamp.value, std::bit_cast<std::uint32_t>(message->energy),
                    message->genome.robot, message->genome.birth);
    for (const auto& gene : message->genes) {
        answer += fmt::format("; {},{} ", gene.mark.counter, gene.mark.robot);
        if (gene.kind != kernel::gene_clocks_connection) {
            answer += kinds[gene.kind];
            continue;
        }
        answer +=
            fmt::format("{}>{} {}{}{}", gene.ends.source, gene.ends.target,
                        std::bit_cast<std::uint32_t>(gene.weight),
                        gene.is_enabled ? " enabled" : "", gene.is_recurrent ? " recurrent" : "");
    }
    return answer;
}

/// What the proved decoder says of it. Precondition: gene_clocks_oracle_start() was called.
inline std::string proved_answer(std::span<const std::uint8_t> frame, const WireLimits& limits) {
    std::string command =
        fmt::format("wire {} {} {} {} {} {} x", limits.frame_bytes, limits.genesis_count,
                    limits.neurons, limits.connections, std::bit_cast<std::uint32_t>(limits.energy),
                    std::bit_cast<std::uint32_t>(limits.weight));
    for (const std::uint8_t byte : frame) command += fmt::format("{:02x}", byte);
    return gene_clocks_oracle_answer(command.c_str());
}

}  // namespace gene_clocks::test
