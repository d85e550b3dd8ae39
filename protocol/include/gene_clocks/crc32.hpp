#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gene_clocks {

/// The CRC-32 of IEEE 802.3 and zlib (reflected, polynomial 0x04c11db7). 64 bytes of table, so that
/// firmware can afford it.
constexpr std::uint32_t crc32(std::span<const std::byte> bytes) {
    constexpr auto table = [] {
        std::array<std::uint32_t, 16> remainders{};
        for (std::uint32_t nibble = 0; nibble < 16; ++nibble) {
            std::uint32_t remainder = nibble;
            for (int bit = 0; bit < 4; ++bit) {
                remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? 0xedb88320u : 0u);
            }
            remainders[nibble] = remainder;
        }
        return remainders;
    }();
    std::uint32_t crc = 0xffffffffu;
    for (const std::byte byte : bytes) {
        crc ^= std::to_integer<std::uint32_t>(byte);
        crc = (crc >> 4) ^ table[crc & 15];
        crc = (crc >> 4) ^ table[crc & 15];
    }
    return ~crc;
}

}  // namespace gene_clocks
