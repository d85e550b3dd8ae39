#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gene_clocks::fuzz {

/// Draws a fuzzer's decisions from its bytes; zeros once they are used up.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool empty() const { return bytes_.empty(); }

    std::uint8_t byte() {
        if (bytes_.empty()) return 0;
        const std::uint8_t first = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return first;
    }

    /// In [0, bound); precondition: 0 < bound ≤ 256.
    std::size_t below(std::size_t bound) { return byte() % bound; }

    std::uint64_t word() {
        std::uint64_t value = 0;
        for (int i = 0; i < 8; ++i) value = value << 8 | byte();
        return value;
    }

private:
    std::span<const std::uint8_t> bytes_;
};

}  // namespace gene_clocks::fuzz
