#pragma once

#include <gene_clocks/checksum.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/innovation_number.hpp>
#include <span>

namespace gene_clocks {

/// Why a counter could not be stored, or not be read back.
enum class StorageError : std::uint8_t {
    none,
    missing,          ///< nothing has been stored here: a new robot, or storage that was wiped
    exists,           ///< to be created, but something is stored here
    damaged,          ///< something was stored, and nothing of it can be trusted
    other_robot,      ///< it was stored by another robot
    unknown_version,  ///< it was stored by another version of this format
    in_use,           ///< another process has it open, this one's parent also
    not_open,         ///< to be written before it was opened or created
    bad_counter,      ///< no clock has it: zero, or beyond the maximum
    device,           ///< the file system or the flash memory reports an error
};

/// The outcome of an operation on storage.
struct [[nodiscard]] StorageStatus {
    StorageError error = StorageError::none;
    int system_error = 0;  ///< errno where the file system gave one, else 0

    constexpr explicit operator bool() const { return error == StorageError::none; }
    friend constexpr bool operator==(StorageStatus, StorageStatus) = default;
};

/// What keeps the one number that a clock needs after a crash.
///
/// Once `store(counter)` has succeeded, no crash and no loss of power makes `stored()` smaller.
template <class Storage>
concept CounterStorage = requires(Storage& storage, const Storage& opened, std::uint64_t counter) {
    { storage.store(counter) } -> std::same_as<StorageStatus>;
    { opened.stored() } -> std::same_as<std::uint64_t>;
};

// ---- The record, the same in files and in flash memory
// -------------------------------------------
//
//   offset  bytes
//        0      4  "GCLK"
//        4      4  version, 1
//        8      4  robot id, not 0
//       12      8  counter, not 0
//       20      4  CRC-32C of the 20 bytes before it
//
// Numbers are little-endian. Every later version keeps these places for mark, version and checksum,
// so that damage and another version can be told apart.

inline constexpr std::size_t counter_record_size = 24;
inline constexpr std::uint32_t counter_record_version = 1;
using CounterRecord = std::array<std::byte, counter_record_size>;

/// What one record says: a counter, or why there is none.
struct RecordReading {
    StorageError error = StorageError::missing;
    std::uint64_t counter = 0;
};

namespace detail {

inline constexpr std::uint32_t record_mark = 0x4b4c4347;  // "GCLK" in the order of its bytes

template <std::unsigned_integral Number>
constexpr void put_little_endian(std::byte* to, Number number) {
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
        to[i] = static_cast<std::byte>(number >> (8 * i));
    }
}

template <std::unsigned_integral Number>
constexpr Number take_little_endian(const std::byte* from) {
    Number number = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
        number |= static_cast<Number>(std::to_integer<Number>(from[i]) << (8 * i));
    }
    return number;
}

/// Of all bytes of a record before the checksum itself.
constexpr std::uint32_t record_checksum(std::span<const std::byte, counter_record_size> record) {
    std::array<std::uint8_t, counter_record_size - 4> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = std::to_integer<std::uint8_t>(record[i]);
    return kernel::gene_clocks_crc32c(bytes.data(), bytes.size());
}

}  // namespace detail

constexpr CounterRecord write_record(RobotId robot, std::uint64_t counter) {
    CounterRecord record{};
    detail::put_little_endian(record.data(), detail::record_mark);
    detail::put_little_endian(record.data() + 4, counter_record_version);
    detail::put_little_endian(record.data() + 8, static_cast<std::uint32_t>(robot));
    detail::put_little_endian(record.data() + 12, counter);
    detail::put_little_endian(record.data() + 20, detail::record_checksum(record));
    return record;
}

/// Bytes from storage are as little to be trusted as bytes from a wire: any may be given, and only
/// what `write_record` wrote for this robot is read as a counter.
constexpr RecordReading read_record(RobotId robot, std::span<const std::byte> bytes) {
    if (bytes.size() != counter_record_size ||
        detail::take_little_endian<std::uint32_t>(bytes.data() + 20) !=
            detail::record_checksum(bytes.first<counter_record_size>()) ||
        detail::take_little_endian<std::uint32_t>(bytes.data()) != detail::record_mark) {
        return {StorageError::damaged};
    }
    if (detail::take_little_endian<std::uint32_t>(bytes.data() + 4) != counter_record_version) {
        return {StorageError::unknown_version};
    }
    const auto counter = detail::take_little_endian<std::uint64_t>(bytes.data() + 12);
    if (counter == 0) return {StorageError::damaged};
    if (detail::take_little_endian<std::uint32_t>(bytes.data() + 8) !=
        static_cast<std::uint32_t>(robot)) {
        return {StorageError::other_robot};
    }
    return {StorageError::none, counter};
}

/// What all records together say.
///
/// The largest counter counts. That is safe because both stores acknowledge a counter only when
/// *two* records hold it or a larger one: damage to any one record, torn or rotten, leaves another.
/// Were one record enough, a damaged newest one could not be told from one that was never
/// acknowledged, and going back to the one before it could make marks again that others have seen.
/// For the same reason it does not matter whether one record is damaged or cannot be read at all.
/// Where neither says anything, one that could not be read may say it another time.
constexpr RecordReading merge(RecordReading a, RecordReading b) {
    const auto foreign = [](RecordReading reading) {
        return reading.error == StorageError::other_robot ||
               reading.error == StorageError::unknown_version;
    };
    if (foreign(a)) return a;
    if (foreign(b)) return b;
    if (a.error == StorageError::none && b.error == StorageError::none) {
        return a.counter < b.counter ? b : a;
    }
    if (a.error == StorageError::none) return a;
    if (b.error == StorageError::none) return b;
    for (const StorageError error : {StorageError::device, StorageError::damaged}) {
        if (a.error == error) return a;
        if (b.error == error) return b;
    }
    return a;
}

}  // namespace gene_clocks
