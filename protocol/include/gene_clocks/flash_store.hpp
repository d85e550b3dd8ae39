#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/stored_counter.hpp>
#include <span>
#include <utility>

namespace gene_clocks {

/// Two sectors of flash memory, 0 and 1, as a driver offers them. Each call returns false where the
/// memory reports an error.
///
/// `erase` sets all bytes of a sector to 0xff. `program` clears bits, of bytes that have been
/// erased and not programmed since; offset and size are multiples of `program_unit`, the number of
/// bytes that the memory programs at once (a power of two, at most 32). A read that fails, as
/// memory with error correction makes it fail after an interrupted program, is taken for a damaged
/// record.
template <class Flash>
concept FlashSectors = requires(Flash& flash, std::size_t sector, std::size_t offset,
                                std::span<std::byte> bytes) {
    { Flash::program_unit } -> std::convertible_to<std::size_t>;
    { Flash::sector_size } -> std::convertible_to<std::size_t>;
    { flash.read(sector, offset, bytes) } -> std::same_as<bool>;
    { flash.program(sector, offset, std::span<const std::byte>{bytes}) } -> std::same_as<bool>;
    { flash.erase(sector) } -> std::same_as<bool>;
};

/// A robot's counter in two sectors of flash memory: a log of records, each written twice before
/// `store()` succeeds. No allocation, no exceptions.
///
/// Records are appended to one sector until it is full; then the other is erased and goes on. The
/// sector that holds the newest pair is never erased. docs/durability-and-hostile-peers.md has the
/// reasoning. One owner.
template <FlashSectors Flash>
class FlashStore {
public:
    /// Bytes that one record takes.
    static constexpr std::size_t slot_size =
        (counter_record_size + Flash::program_unit - 1) / Flash::program_unit * Flash::program_unit;
    static constexpr std::size_t slots_per_sector = Flash::sector_size / slot_size;
    static_assert(slots_per_sector >= 8, "a sector must hold some records");

    FlashStore(Flash flash, RobotId robot) : flash_(std::move(flash)), robot_(robot) {}
    /// What is left behind is `not_open`: of two that append, each would write over the other.
    FlashStore(FlashStore&& other) noexcept
        : flash_(std::move(other.flash_)),
          robot_(other.robot_),
          sectors_(other.sectors_),
          home_(other.home_),
          stored_(std::exchange(other.stored_, 0)),
          flushes_(other.flushes_),
          erasures_(other.erasures_) {}
    FlashStore& operator=(FlashStore&&) = delete;

    /// First use: stores `counter` where nothing is stored yet. Only for a robot id that has never
    /// been used, since a fresh clock repeats marks. Both sectors must be erased, or hold no more
    /// than what an interrupted `create()` leaves.
    StorageStatus create(std::uint64_t counter) {
        if (counter == 0) return {StorageError::bad_counter};
        if (const auto status = scan(); status.error != StorageError::missing) {
            return status ? StorageStatus{StorageError::exists} : status;
        }
        for (std::size_t sector = 0; sector < 2; ++sector) {
            if (sectors_[sector].written > 0 && !erase(sector)) return {StorageError::device};
        }
        return write(counter);
    }

    /// Every later use: reads back what was stored, and writes it again before it is relied on,
    /// since a record that was interrupted may read well today and badly tomorrow.
    StorageStatus open() {
        if (const auto status = scan(); !status) return status;
        return write(merge(sectors_[0].newest, sectors_[1].newest).counter);
    }

    /// Returns success when `counter`, or a larger one, is in flash memory for good. After a
    /// failure, what was stored before still is, and `store()` may be tried again.
    StorageStatus store(std::uint64_t counter) {
        if (stored_ == 0) return {StorageError::not_open};
        return counter <= stored_ ? StorageStatus{} : write(counter);
    }

    /// The counter in flash memory; 0 before `create()` or `open()` has succeeded.
    [[nodiscard]] std::uint64_t stored() const { return stored_; }
    /// How often a counter, and how often a sector, was written (of wear, the second counts).
    [[nodiscard]] std::uint64_t flushes() const { return flushes_; }
    [[nodiscard]] std::uint64_t erasures() const { return erasures_; }

private:
    using Slot = std::array<std::byte, slot_size>;

    /// Invariant: slots from `used` on read as erased. One may have been touched by a program that
    /// power failed at once; what is then written there may rot, which the second record is there
    /// for.
    struct Sector {
        RecordReading newest{};
        std::size_t newest_copies = 0;
        std::size_t written = 0;  // slots that are not erased
        std::size_t used = 0;
        bool has_pair = false;
    };

    StorageStatus scan() {
        for (std::size_t sector = 0; sector < 2; ++sector) sectors_[sector] = scan(sector);
        const auto& [first, second] = sectors_;
        const RecordReading all = merge(first.newest, second.newest);
        // A counter is acknowledged with its second record, so a single damaged one is a creation
        // that did not come to its end.
        if (all.error == StorageError::damaged && first.written + second.written == 1) {
            return {StorageError::missing};
        }
        const auto rank = [](const Sector& sector) {
            return std::pair{sector.newest.counter, sector.newest_copies};
        };
        home_ = rank(first) < rank(second) ? 1 : 0;
        return {all.error};
    }

    Sector scan(std::size_t sector) {
        Sector found;
        std::uint64_t before = 0;
        for (std::size_t index = 0; index < slots_per_sector; ++index) {
            Slot slot;
            const bool is_read = flash_.read(sector, index * slot_size, slot);
            if (is_read && is_erased(slot)) continue;
            const RecordReading reading =
                is_read ? read_record(robot_, std::span{slot}.template first<counter_record_size>())
                        : RecordReading{StorageError::damaged};
            found.newest = merge(found.newest, reading);
            ++found.written;
            found.used = index + 1;
            if (reading.error != StorageError::none) continue;
            // Counters do not fall within a sector, so equal ones follow each other.
            found.newest_copies = reading.counter == before ? found.newest_copies + 1 : 1;
            found.has_pair |= reading.counter == before;
            before = reading.counter;
        }
        return found;
    }

    /// The other sector is erased only where nothing in it can be needed: whatever has been
    /// acknowledged is at least what a pair in this one says.
    StorageStatus write(std::uint64_t counter) {
        ++flushes_;
        if (!append(home_, counter)) {
            const bool is_superseded =
                sectors_[home_].has_pair || sectors_[1 - home_].newest.error != StorageError::none;
            if (!is_superseded || !erase(1 - home_) || !append(1 - home_, counter)) {
                return {StorageError::device};
            }
            home_ = 1 - home_;
        }
        stored_ = counter;
        return {};
    }

    /// Two records, each read back; a slot that does not take one is passed over.
    bool append(std::size_t sector, std::uint64_t counter) {
        Sector& log = sectors_[sector];
        Slot slot;
        slot.fill(std::byte{0xff});
        std::ranges::copy(write_record(robot_, counter), slot.begin());
        for (int copies = 0; log.used + 2 <= slots_per_sector + static_cast<std::size_t>(copies);) {
            const std::size_t offset = log.used++ * slot_size;
            Slot read_back;
            if (flash_.program(sector, offset, slot) && flash_.read(sector, offset, read_back) &&
                read_back == slot && ++copies == 2) {
                log.has_pair = true;
                return true;
            }
        }
        return false;
    }

    bool erase(std::size_t sector) {
        ++erasures_;
        if (!flash_.erase(sector)) return false;
        sectors_[sector] = {};
        return true;
    }

    static bool is_erased(const Slot& slot) {
        return std::ranges::all_of(slot, [](std::byte byte) { return byte == std::byte{0xff}; });
    }

    Flash flash_;
    RobotId robot_;
    std::array<Sector, 2> sectors_{};
    // Invariant: holds a record with at least stored_, and where stored_ > 0 a pair.
    std::size_t home_ = 0;
    std::uint64_t stored_ = 0;
    std::uint64_t flushes_ = 0;
    std::uint64_t erasures_ = 0;
};

}  // namespace gene_clocks
