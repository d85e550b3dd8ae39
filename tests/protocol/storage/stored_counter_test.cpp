#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <gene_clocks/stored_counter.hpp>
#include <vector>

namespace gene_clocks {
namespace {

constexpr RobotId robot{0x01020304};
constexpr std::uint64_t counter = 0x1112131415161718;
constexpr CounterRecord record = write_record(robot, counter);

TEST(StoredCounter, IsLaidOutAsDocumented) {
    constexpr unsigned char expected[] = {'G', 'C', 'L',  'K',  1,    0,    0,    0,    4,    3,
                                          2,   1,   0x18, 0x17, 0x16, 0x15, 0x14, 0x13, 0x12, 0x11};
    EXPECT_EQ(std::memcmp(record.data(), expected, sizeof expected), 0);
    EXPECT_EQ(read_record(robot, record).error, StorageError::none);
    EXPECT_EQ(read_record(robot, record).counter, counter);
}

TEST(StoredCounter, RefusesAnotherRobots) {
    EXPECT_EQ(read_record(RobotId{8}, record).error, StorageError::other_robot);
}

CounterRecord sealed(CounterRecord bytes) {
    detail::put_little_endian(bytes.data() + 20, detail::record_checksum(bytes));
    return bytes;
}

TEST(StoredCounter, TellsAnotherVersionFromDamage) {
    CounterRecord later = record;
    later[4] = std::byte{2};
    EXPECT_EQ(read_record(robot, later).error, StorageError::damaged);
    EXPECT_EQ(read_record(robot, sealed(later)).error, StorageError::unknown_version);
}

TEST(StoredCounter, RefusesWhatNoRobotWrites) {
    CounterRecord zero = write_record(robot, 0);
    EXPECT_EQ(read_record(robot, zero).error, StorageError::damaged);
    CounterRecord other_mark = record;
    other_mark[0] = std::byte{'g'};
    EXPECT_EQ(read_record(robot, sealed(other_mark)).error, StorageError::damaged);
}

TEST(StoredCounter, RefusesEveryLengthButOne) {
    std::vector<std::byte> bytes(record.begin(), record.end());
    bytes.push_back(std::byte{0});
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        const auto expected = size == record.size() ? StorageError::none : StorageError::damaged;
        EXPECT_EQ(read_record(robot, std::span{bytes}.first(size)).error, expected) << size;
    }
}

// A CRC-32 finds every burst of up to 32 bits; single, double and triple errors in 24 bytes as
// well.
TEST(StoredCounter, NoticesEveryOneAndTwoBitsFlipped) {
    const auto flip = [](CounterRecord& bytes, std::size_t bit) {
        bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    };
    for (std::size_t first = 0; first < 8 * record.size(); ++first) {
        for (std::size_t second = first; second < 8 * record.size(); ++second) {
            CounterRecord bytes = record;
            flip(bytes, first);
            if (second != first) flip(bytes, second);
            ASSERT_EQ(read_record(robot, bytes).error, StorageError::damaged) << first << second;
        }
    }
}

TEST(StoredCounter, NoticesEveryTearBetweenTwoRecordsAndEmptiness) {
    const CounterRecord before = write_record(robot, counter - 1);
    for (const auto& old : {before, CounterRecord{}, [] {
                                CounterRecord erased;
                                erased.fill(std::byte{0xff});
                                return erased;
                            }()}) {
        for (std::size_t size = 1; size < record.size(); ++size) {
            CounterRecord torn = old;
            std::ranges::copy(std::span{record}.first(size), torn.begin());
            if (torn == record || torn == old) continue;
            EXPECT_EQ(read_record(robot, torn).error, StorageError::damaged) << size;
        }
    }
}

TEST(StoredCounter, TheLargestOfTwoRecordsCounts) {
    using enum StorageError;
    const RecordReading five{none, 5}, six{none, 6}, bad{damaged}, absent{missing}, unread{device},
        foreign{other_robot}, newer{unknown_version};
    EXPECT_EQ(merge(five, six).counter, 6u);
    EXPECT_EQ(merge(six, five).counter, 6u);
    EXPECT_EQ(merge(five, bad).counter, 5u);
    EXPECT_EQ(merge(bad, five).counter, 5u);
    EXPECT_EQ(merge(absent, five).counter, 5u);
    EXPECT_EQ(merge(bad, absent).error, damaged);
    EXPECT_EQ(merge(absent, bad).error, damaged);
    EXPECT_EQ(merge(absent, absent).error, missing);
    EXPECT_EQ(merge(five, unread).counter, 5u);
    EXPECT_EQ(merge(unread, five).counter, 5u);
    for (const auto& other : {bad, absent, unread}) {
        EXPECT_EQ(merge(unread, other).error, device) << "it may be read another time";
        EXPECT_EQ(merge(other, unread).error, device);
    }
    EXPECT_EQ(merge(five, foreign).error, other_robot);
    EXPECT_EQ(merge(newer, five).error, unknown_version);
}

}  // namespace
}  // namespace gene_clocks
