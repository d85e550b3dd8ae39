#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace gene_clocks::replay::decoded {

/// Reads what number_stream.hpp says is written; knows nothing of how.
class Reader {
public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::uint64_t next() {
        std::uint64_t value = 0;
        for (unsigned shift = 0;; shift += 7) {
            if (at_ == bytes_.size()) throw std::out_of_range("cut short");
            const std::uint8_t byte = bytes_[at_++];
            value |= std::uint64_t{byte} % 128 << shift;
            if (byte < 128) return value;
        }
    }
    std::int64_t next_signed() {
        const std::uint64_t folded = next();
        const auto half = static_cast<std::int64_t>(folded / 2);
        return folded % 2 == 0 ? half : -half - 1;
    }
    bool is_at_end() const { return at_ == bytes_.size(); }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

/// All rows, each of so many columns.
inline std::vector<std::vector<std::int64_t>> rows(std::span<const std::uint8_t> bytes,
                                                   std::size_t columns) {
    Reader reader(bytes);
    std::vector<std::vector<std::int64_t>> all;
    std::vector<std::int64_t> row(columns, 0);
    while (!reader.is_at_end()) {
        for (std::int64_t& value : row) value += reader.next_signed();
        all.push_back(row);
    }
    return all;
}

}  // namespace gene_clocks::replay::decoded
