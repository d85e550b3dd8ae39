#include "sim/replay/number_stream.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string_view>

#include "tests/sim/replay/decoded.hpp"

namespace gene_clocks::replay {
namespace {

TEST(NumberStreamTest, NumbersComeBack) {
    constexpr std::array<std::uint64_t, 9> values{0,
                                                  1,
                                                  127,
                                                  128,
                                                  300,
                                                  16383,
                                                  16384,
                                                  std::uint64_t{1} << 53U,
                                                  std::numeric_limits<std::uint64_t>::max()};
    NumberStream stream;
    for (const std::uint64_t value : values) stream.put(value);
    decoded::Reader reader(stream.bytes());
    for (const std::uint64_t value : values) EXPECT_EQ(reader.next(), value);
    EXPECT_TRUE(reader.is_at_end());
}

TEST(NumberStreamTest, SignedNumbersComeBackAndSmallOnesAreShort) {
    constexpr std::array<std::int64_t, 9> values{0,
                                                 -1,
                                                 1,
                                                 63,
                                                 -64,
                                                 64,
                                                 -65,
                                                 std::numeric_limits<std::int64_t>::min(),
                                                 std::numeric_limits<std::int64_t>::max()};
    NumberStream stream;
    std::size_t bytes = 0;
    for (const std::int64_t value : values) {
        stream.put_signed(value);
        const std::size_t length = stream.bytes().size() - bytes;
        EXPECT_EQ(length == 1, value >= -64 && value < 64) << value;
        bytes += length;
    }
    decoded::Reader reader(stream.bytes());
    for (const std::int64_t value : values) EXPECT_EQ(reader.next_signed(), value);
    EXPECT_TRUE(reader.is_at_end());
}

TEST(NumberStreamTest, RowsComeBack) {
    RowStream stream(3);
    const std::vector<std::vector<std::int64_t>> rows{
        {5120, 0, -7}, {5121, 0, 7}, {0, 1, std::int64_t{1} << 53U}, {0, 0, 0}};
    for (const auto& row : rows) stream.put_row(row);
    EXPECT_EQ(decoded::rows(stream.bytes(), 3), rows);
}

// RFC 4648, section 10.
TEST(NumberStreamTest, Base64IsThatOfTheStandard) {
    const auto encode = [](std::string_view text) {
        const std::vector<std::uint8_t> bytes(text.begin(), text.end());
        return base64(bytes);
    };
    EXPECT_EQ(encode(""), "");
    EXPECT_EQ(encode("f"), "Zg==");
    EXPECT_EQ(encode("fo"), "Zm8=");
    EXPECT_EQ(encode("foo"), "Zm9v");
    EXPECT_EQ(encode("foob"), "Zm9vYg==");
    EXPECT_EQ(encode("fooba"), "Zm9vYmE=");
    EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
    EXPECT_EQ(encode("\xff\xfb\xbf"), "//u/");
}

}  // namespace
}  // namespace gene_clocks::replay
