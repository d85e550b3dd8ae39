#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/storage/posix_files.hpp>
#include <gene_clocks/stored_counter.hpp>
#include <span>
#include <utility>

namespace gene_clocks::storage {

/// A robot's counter in two files, both of which hold it before `store()` succeeds.
///
/// Each file is replaced as a whole: a temporary file is written, synchronised and renamed, and the
/// folder is synchronised, before the other file is touched. So at every moment one of the two is
/// whole and holds at least what was acknowledged, even where a rename is not atomic (FAT) or one
/// file rots. docs/durability-and-hostile-peers.md has the reasoning.
///
/// One process has it at a time: a lock on the folder keeps others out, and a child that comes of
/// fork() is told `in_use` whatever it asks for. So a program that puts itself into the background
/// opens the store there.
///
/// `Files` is the file system: PosixFiles, or a simulated disk. Not thread-safe: one owner.
template <class Files>
class BasicFileStore {
public:
    BasicFileStore(Files files, RobotId robot) : files_(std::move(files)), robot_(robot) {}

    /// First use: stores `counter` where nothing is stored yet. Only for a robot id that has never
    /// been used, since a fresh clock repeats marks.
    StorageStatus create(std::uint64_t counter) {
        if (const auto status = acquire(); !status) return status;
        if (counter == 0) return {StorageError::bad_counter};
        if (const auto status = read(); status.error != StorageError::missing) {
            return status ? StorageStatus{StorageError::exists} : status;
        }
        return write(counter);
    }

    /// Every later use: reads back what was stored.
    ///
    /// It is written again before it is relied on. What a killed process left behind may be in the
    /// page cache only, where reading finds it and a loss of power takes it away.
    StorageStatus open() {
        if (const auto status = acquire(); !status) return status;
        if (const auto status = read(); !status) return status;
        // First what a killed process began: until its renaming is durable, the file that it
        // concerns may not be relied on while the other is replaced.
        if (const int error = files_.sync_folder()) return checked(error);
        return write(std::max(found_[0].counter, found_[1].counter));
    }

    /// Returns success when `counter`, or a larger one, is on stable storage. After a failure, what
    /// was stored before still is, and `store()` may be tried again.
    StorageStatus store(std::uint64_t counter) {
        if (stored_ == 0) return {StorageError::not_open};
        if (const auto status = acquire(); !status) return status;
        return counter <= stored_ ? StorageStatus{} : write(counter);
    }

    /// The counter on stable storage; 0 before `create()` or `open()` has succeeded.
    [[nodiscard]] std::uint64_t stored() const { return stored_; }
    /// How often storage was written.
    [[nodiscard]] std::uint64_t flushes() const { return flushes_; }

private:
    StorageStatus acquire() {
        const int error = is_acquired_ ? files_.check_owner() : files_.acquire();
        is_acquired_ |= error == 0;
        return error == EWOULDBLOCK ? StorageStatus{StorageError::in_use, error} : checked(error);
    }

    StorageStatus read() {
        int unread = 0;
        for (std::size_t copy : {0u, 1u}) {
            // One byte more than a record, so that a longer file is not taken for one.
            std::array<std::byte, counter_record_size + 1> bytes{};
            std::size_t size = 0;
            const int error = files_.read(names[copy], bytes, size);
            if (error == 0) {
                found_[copy] = read_record(robot_, std::span{bytes}.first(size));
            } else if (error == ENOENT) {
                found_[copy] = {StorageError::missing};
            } else {
                found_[copy] = {StorageError::device};
                unread = error;
            }
        }
        // The copy to write first is the one that can be spared.
        spare_ = found_[1].counter < found_[0].counter ? 1 : 0;
        const StorageError error = merge(found_[0], found_[1]).error;
        return {error, error == StorageError::device ? unread : 0};
    }

    StorageStatus write(std::uint64_t counter) {
        ++flushes_;
        for (int copies = 0; copies < 2; ++copies) {
            // Where this fails, the spare stays the spare: the other copy is good.
            if (const int error = replace(names[spare_], counter)) return checked(error);
            spare_ = 1 - spare_;
        }
        stored_ = counter;
        return {};
    }

    /// An errno value, or 0.
    int replace(const char* name, std::uint64_t counter) {
        if (const int error = files_.write_temporary(write_record(robot_, counter))) return error;
        if (const int error = files_.sync_temporary()) return error;
        if (const int error = files_.rename_temporary(name)) return error;
        return files_.sync_folder();
    }

    static StorageStatus checked(int error) {
        return error == 0 ? StorageStatus{} : StorageStatus{StorageError::device, error};
    }

    static constexpr std::array<const char*, 2> names{"counter.1", "counter.2"};

    Files files_;
    RobotId robot_;
    std::array<RecordReading, 2> found_{};
    // Invariant: once both copies have been written, or read, the other copy is whole and holds at
    // least stored_. Only the spare is ever replaced.
    std::size_t spare_ = 0;
    std::uint64_t stored_ = 0;
    std::uint64_t flushes_ = 0;
    bool is_acquired_ = false;
};

/// The same on a POSIX file system. The folder must exist and belong to this robot alone.
///
///     FileStore store{PosixFiles{"/var/lib/robot"}, RobotId{7}};
///     if (auto status = store.open(); !status) …
using FileStore = BasicFileStore<PosixFiles>;
static_assert(CounterStorage<FileStore>);

}  // namespace gene_clocks::storage
