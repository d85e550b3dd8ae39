/* CRC-32C (Castagnoli), the checksum of iSCSI, ext4 and Btrfs, in C99 and in constexpr C++20.
 *
 * Own code, since firmware has no library at hand and protocol/ needs nothing but the standard
 * one. C, and C++ where GENE_CLOCKS_SMALL is defined, work by half bytes with a table of 64
 * bytes; other C++ takes eight bytes at a time, by the instruction of x86-64 processors that have
 * it, else with 8 KiB of tables. All give the same sums.
 */
#ifndef GENE_CLOCKS_CHECKSUM_H
#define GENE_CLOCKS_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#include <array>
#include <type_traits>
#define GENE_CLOCKS_FUNCTION constexpr
namespace gene_clocks::kernel {
#else
#define GENE_CLOCKS_FUNCTION static inline
#endif

#if !defined(__cplusplus) || defined(GENE_CLOCKS_SMALL)
/* Entry n is what four shifts make of n. */
#ifdef __cplusplus
inline constexpr
#else
static const
#endif
    uint32_t gene_clocks_crc32c_table[16] = {0x00000000u, 0x105ec76fu, 0x20bd8edeu, 0x30e349b1u,
                                             0x417b1dbcu, 0x5125dad3u, 0x61c69362u, 0x7198540du,
                                             0x82f63b78u, 0x92a8fc17u, 0xa24bb5a6u, 0xb21572c9u,
                                             0xc38d26c4u, 0xd3d3e1abu, 0xe330a81au, 0xf36e6f75u};

/* The CRC-32C of `size` bytes. */
GENE_CLOCKS_FUNCTION uint32_t gene_clocks_crc32c(const uint8_t* bytes, size_t size) {
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < size; ++i) {
        crc = gene_clocks_crc32c_table[(crc ^ bytes[i]) & 15u] ^ crc >> 4;
        crc = gene_clocks_crc32c_table[(crc ^ bytes[i] >> 4) & 15u] ^ crc >> 4;
    }
    return crc ^ 0xffffffffu;
}
#else
/* Entry [k][n] is the remainder of the byte n with k zero bytes after it. */
inline constexpr auto gene_clocks_crc32c_tables = [] {
    std::array<std::array<uint32_t, 256>, 8> tables{};
    for (uint32_t n = 0; n < 256; ++n) {
        uint32_t crc = n;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0x82f63b78u & (0u - (crc & 1u)));
        tables[0][n] = crc;
    }
    for (size_t k = 1; k < 8; ++k) {
        for (size_t n = 0; n < 256; ++n) {
            const uint32_t before = tables[k - 1][n];
            tables[k][n] = before >> 8 ^ tables[0][before & 255u];
        }
    }
    return tables;
}();

GENE_CLOCKS_FUNCTION uint32_t gene_clocks_crc32c_by_tables(const uint8_t* bytes, size_t size) {
    const auto& tables = gene_clocks_crc32c_tables;
    uint32_t crc = 0xffffffffu;
    for (; size >= 8; bytes += 8, size -= 8) {
        crc = tables[7][(crc ^ bytes[0]) & 255u] ^ tables[6][(crc >> 8 ^ bytes[1]) & 255u] ^
              tables[5][(crc >> 16 ^ bytes[2]) & 255u] ^ tables[4][crc >> 24 ^ bytes[3]] ^
              tables[3][bytes[4]] ^ tables[2][bytes[5]] ^ tables[1][bytes[6]] ^ tables[0][bytes[7]];
    }
    for (; size > 0; ++bytes, --size) crc = tables[0][(crc ^ *bytes) & 255u] ^ crc >> 8;
    return crc ^ 0xffffffffu;
}

#if defined(__GNUC__) && defined(__x86_64__) && __STDC_HOSTED__
#define GENE_CLOCKS_CRC32C_BY_INSTRUCTION 1

/* Precondition: the processor has SSE 4.2. */
[[gnu::target("sse4.2")]] inline uint32_t gene_clocks_crc32c_by_instruction(const uint8_t* bytes,
                                                                            size_t size) {
    uint64_t crc = 0xffffffffu;
    for (; size >= 8; bytes += 8, size -= 8) {
        uint64_t eight = 0;
        __builtin_memcpy(&eight, bytes, 8);
        crc = __builtin_ia32_crc32di(crc, eight);
    }
    uint32_t rest = (uint32_t)crc;
    for (; size > 0; ++bytes, --size) rest = __builtin_ia32_crc32qi(rest, *bytes);
    return rest ^ 0xffffffffu;
}
#endif

/* The CRC-32C of `size` bytes. */
GENE_CLOCKS_FUNCTION uint32_t gene_clocks_crc32c(const uint8_t* bytes, size_t size) {
#ifdef GENE_CLOCKS_CRC32C_BY_INSTRUCTION
    if (!std::is_constant_evaluated() && __builtin_cpu_supports("sse4.2")) {
        return gene_clocks_crc32c_by_instruction(bytes, size);
    }
#endif
    return gene_clocks_crc32c_by_tables(bytes, size);
}
#endif

#ifdef __cplusplus
} /* namespace gene_clocks::kernel */
#endif

#undef GENE_CLOCKS_FUNCTION

#endif /* GENE_CLOCKS_CHECKSUM_H */
