#include "sim/replay/number_stream.hpp"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cassert>

namespace gene_clocks::replay {

void NumberStream::put(std::uint64_t value) {
    while (value >= 0x80) {
        bytes_.push_back(static_cast<std::uint8_t>(value | 0x80));
        value >>= 7U;
    }
    bytes_.push_back(static_cast<std::uint8_t>(value));
}

void NumberStream::put_signed(std::int64_t value) {
    const auto twice = static_cast<std::uint64_t>(value) << 1U;
    put(value < 0 ? ~twice : twice);
}

void RowStream::put_row(std::span<const std::int64_t> row) {
    assert(row.size() == above_.size());
    for (std::size_t column = 0; column < row.size(); ++column) {
        stream_.put_signed(row[column] - above_[column]);
        above_[column] = row[column];
    }
}

std::string base64(std::span<const std::uint8_t> bytes) {
    using boost::archive::iterators::base64_from_binary;
    using boost::archive::iterators::transform_width;
    // The iterator reads whole groups of three bytes.
    std::vector<std::uint8_t> padded(bytes.begin(), bytes.end());
    padded.resize((bytes.size() + 2) / 3 * 3);
    using Characters =
        base64_from_binary<transform_width<std::vector<std::uint8_t>::const_iterator, 6, 8>>;
    std::string text(Characters(padded.cbegin()), Characters(padded.cend()));
    const std::size_t padding = padded.size() - bytes.size();
    text.replace(text.size() - padding, padding, padding, '=');
    return text;
}

}  // namespace gene_clocks::replay
