#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gene_clocks::replay {

/// Whole numbers as bytes: little-endian base-128 varints (LEB128), so that small ones take one
/// byte. Signed numbers are folded first: 0, −1, 1, −2 … become 0, 1, 2, 3 …
/// page/streams.js reads them.
class NumberStream {
public:
    void put(std::uint64_t value);
    void put_signed(std::int64_t value);

    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

/// Rows of numbers, each as its difference from the one above; the first row, from 0.
class RowStream {
public:
    explicit RowStream(std::size_t columns) : above_(columns, 0) {}

    /// One value for each column, of at most 2^53 − 1 in size, as far as JavaScript counts.
    void put_row(std::span<const std::int64_t> row);

    std::size_t columns() const { return above_.size(); }
    const std::vector<std::uint8_t>& bytes() const { return stream_.bytes(); }

private:
    std::vector<std::int64_t> above_;
    NumberStream stream_;
};

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace gene_clocks::replay
