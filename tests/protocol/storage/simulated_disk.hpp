#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/stored_counter.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gene_clocks::test {

/// A folder on a disk with a cache, as a value.
///
/// POSIX promises little: until a file has been synchronised any part of its contents may be lost,
/// and until the folder has been, any subset of the changes of its entries, in whatever order they
/// were made. This disk makes use of all of that freedom.
struct Disk {
    struct File {
        std::string on_disk;
        std::string cached;
        friend auto operator<=>(const File&, const File&) = default;
    };
    /// Entry `name` becomes `file`; no file: the entry goes away.
    struct Change {
        std::string name;
        std::optional<std::size_t> file;
        /// The next change is part of this one, unless renames may tear.
        bool is_joined = false;
        /// A synchronisation has failed since: it is lost or not, and no later one will tell.
        bool is_doubtful = false;
        friend auto operator<=>(const Change&, const Change&) = default;
    };
    using Entries = std::map<std::string, std::size_t>;

    std::vector<File> files;
    Entries on_disk;
    Entries cached;
    std::vector<Change> pending;  ///< changes of entries that may not have reached the disk

    friend auto operator<=>(const Disk&, const Disk&) = default;

    static void apply(Entries& entries, const Change& change) {
        if (change.file) {
            entries[change.name] = *change.file;
        } else {
            entries.erase(change.name);
        }
    }
    void change(Change made) {
        apply(cached, made);
        pending.push_back(std::move(made));
    }
    void sync_entries() {
        std::vector<Change> left;
        for (const Change& made : pending) {
            if (made.is_doubtful) {
                left.push_back(made);
            } else {
                apply(on_disk, made);
                std::erase_if(left, [&](const Change& old) { return old.name == made.name; });
            }
        }
        pending = std::move(left);
    }
};

/// What of a file's contents there may be after a loss of power: all, nothing new, or a part of it
/// with the rest missing, zero or as it was.
inline std::vector<std::string> contents_after_power_loss(const Disk::File& file) {
    if (file.on_disk == file.cached) return {file.cached};
    std::vector<std::string> contents{file.on_disk, file.cached};
    for (std::size_t size = 0; size < file.cached.size(); ++size) {
        const std::string front = file.cached.substr(0, size);
        const std::string back = file.cached.substr(size);
        contents.push_back(front);
        contents.push_back(front + std::string(back.size(), '\0'));
        contents.push_back(std::string(front.size(), '\0') + back);
        if (file.on_disk.size() > size) contents.push_back(front + file.on_disk.substr(size));
    }
    return contents;
}

/// Calls `visit(disk)` for every disk that there may be after a loss of power, of which only the
/// files in `names` are looked at.
template <std::size_t Count, class Visit>
void for_each_power_loss(const Disk& disk, const std::array<const char*, Count>& names,
                         bool renames_tear, Visit visit) {
    // The changes that stand or fall together.
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < disk.pending.size(); ++i) {
        if (renames_tear || !disk.pending[i].is_joined) ends.push_back(i + 1);
    }
    for (std::size_t kept = 0; kept < std::size_t{1} << ends.size(); ++kept) {
        Disk::Entries entries = disk.on_disk;
        for (std::size_t group = 0, i = 0; group < ends.size(); i = ends[group++]) {
            if ((kept >> group & 1) == 0) continue;
            for (std::size_t change = i; change < ends[group]; ++change) {
                Disk::apply(entries, disk.pending[change]);
            }
        }
        const auto with = [&](auto& self, std::size_t at, Disk& result) -> void {
            if (at == names.size()) return visit(std::as_const(result));
            const auto entry = entries.find(names[at]);
            if (entry == entries.end()) return self(self, at + 1, result);
            for (const auto& contents : contents_after_power_loss(disk.files[entry->second])) {
                Disk next = result;
                next.on_disk[names[at]] = next.cached[names[at]] = next.files.size();
                next.files.push_back({contents, contents});
                self(self, at + 1, next);
            }
        };
        Disk empty;
        with(with, 0, empty);
    }
}

/// Ways to get it wrong. Each is a file system that does not do what the store asks it to, which
/// comes to the same as a store that does not ask.
enum class Slip {
    none,
    no_file_sync,          ///< the temporary file is not synchronised
    no_folder_sync,        ///< the folder is not synchronised
    renamed_before_sync,   ///< the temporary file is synchronised after its renaming
    checksum_ignored,      ///< a record with a bad checksum is accepted
    one_copy,              ///< there is no second copy
    both_copies_at_once,   ///< the folder is synchronised once, for both copies
    one_acknowledges,      ///< the second copy keeps the counter before: two generations
    older_generation,      ///< … and the older generation is used
    open_does_not_settle,  ///< what a killed process began is left unfinished
    open_does_not_write,   ///< what was read is relied on as it is
};

/// Thrown at the operation at which the process ends.
struct Ends {};

/// One life of a process on a disk. At one operation something may go wrong, at one it ends.
struct Life {
    enum class Fault {
        none,
        fails_undone,
        fails_done,
        first_copy_rots,
        second_copy_rots,
        first_copy_unread,  ///< it cannot be read in this life, at whatever operation
        second_copy_unread
    };

    Disk disk;
    Slip slip = Slip::none;
    Fault fault = Fault::none;
    int fault_at = -1;
    int end_at = -1;

    int operations = 0;
    bool is_opening = true;
    int renames = 0;
    std::optional<std::string> previous{};  // the record before the one that is being written
    std::string current{};
    bool has_rotten = false;
    bool has_failed = false;

    /// The next operation. Whether it fails, and if so, whether it takes effect all the same.
    Fault step() {
        if (operations == end_at) throw Ends{};
        if (operations++ != fault_at) return Fault::none;
        if (fault == Fault::first_copy_unread || fault == Fault::second_copy_unread) {
            return Fault::none;
        }
        if (fault == Fault::fails_done || fault == Fault::fails_undone) {
            has_failed = true;
            return fault;
        }
        has_rotten = true;
        rot(fault == Fault::first_copy_rots ? "counter.1" : "counter.2");
        return Fault::none;
    }
    void rot(const char* name) {
        if (const auto entry = disk.cached.find(name); entry != disk.cached.end()) {
            auto& file = disk.files[entry->second];
            // A bit of the counter, which becomes another counter that looks as good.
            if (file.cached.size() > 14) file.cached[14] ^= '\x40';
            file.on_disk = file.cached;
        }
    }
};

/// The operations of PosixFiles, in a life.
class SimulatedFiles {
public:
    explicit SimulatedFiles(Life& life) : life_{&life} {}

    int acquire() { return 0; }
    [[nodiscard]] int check_owner() const { return 0; }

    int read(const char* name, std::span<std::byte> bytes, std::size_t& size) const {
        const Disk& disk = life_->disk;
        const bool is_first = std::string_view{name} == "counter.1";
        if (life_->fault ==
            (is_first ? Life::Fault::first_copy_unread : Life::Fault::second_copy_unread)) {
            return EIO;
        }
        std::string contents;
        if (life_->slip == Slip::older_generation) {
            if (!disk.cached.contains(name)) return ENOENT;
            std::uint64_t least = 0;
            for (const auto& [copy, file] : disk.cached) {
                const auto reading =
                    read_record(RobotId{7}, std::as_bytes(std::span{disk.files[file].cached}));
                if (copy == "counter.new" || reading.error != StorageError::none) continue;
                if (least == 0 || reading.counter < least) {
                    least = reading.counter;
                    contents = disk.files[file].cached;
                }
            }
        } else {
            const auto entry = disk.cached.find(name);
            if (entry == disk.cached.end()) return ENOENT;
            contents = disk.files[entry->second].cached;
        }
        size = std::min(bytes.size(), contents.size());
        std::ranges::copy(std::as_bytes(std::span{contents}).first(size), bytes.begin());
        if (life_->slip == Slip::checksum_ignored && size == counter_record_size) {
            gene_clocks::detail::put_little_endian(
                bytes.data() + 20,
                gene_clocks::detail::record_checksum(bytes.first<counter_record_size>()));
        }
        return 0;
    }

    int write_temporary(std::span<const std::byte> bytes) {
        if (is_left_out()) return 0;
        const auto fault = life_->step();
        if (fault == Life::Fault::fails_undone) return ENOSPC;
        Disk& disk = life_->disk;
        std::string record(bytes.size(), '\0');
        std::ranges::copy(bytes, std::as_writable_bytes(std::span{record}).begin());
        if (keeps_two_generations() && life_->renames % 2 == 1) {
            record = std::exchange(life_->previous, record).value_or(record);
        }
        disk.files.push_back({"", record});
        disk.change({"counter.new", disk.files.size() - 1});
        return fault == Life::Fault::none ? 0 : ENOSPC;
    }

    int sync_temporary() {
        if (is_left_out() || life_->slip == Slip::renamed_before_sync) return 0;
        return sync(life_->disk.cached.at("counter.new"));
    }

    int rename_temporary(const char* name) {
        if (is_left_out()) {
            ++life_->renames;
            return 0;
        }
        const auto fault = life_->step();
        if (fault == Life::Fault::fails_undone) return EIO;
        ++life_->renames;
        Disk& disk = life_->disk;
        const auto file = disk.cached.at("counter.new");
        disk.change({name, std::nullopt, true});
        disk.change({name, file, true});
        disk.change({"counter.new", std::nullopt});
        if (fault == Life::Fault::fails_done) return EIO;
        return life_->slip == Slip::renamed_before_sync ? sync(file) : 0;
    }

    int sync_folder() {
        if (life_->is_opening && life_->slip == Slip::open_does_not_write) return 0;
        if (life_->slip == Slip::no_folder_sync) return 0;
        if (life_->slip == Slip::open_does_not_settle && life_->renames == 0) return 0;
        if (life_->slip == Slip::both_copies_at_once && life_->renames % 2 == 1) return 0;
        const auto fault = life_->step();
        if (fault != Life::Fault::none) {
            for (auto& change : life_->disk.pending) change.is_doubtful = true;
            return EIO;
        }
        life_->disk.sync_entries();
        return 0;
    }

private:
    [[nodiscard]] bool keeps_two_generations() const {
        return life_->slip == Slip::one_acknowledges || life_->slip == Slip::older_generation;
    }
    [[nodiscard]] bool is_left_out() const {
        return (life_->slip == Slip::one_copy && life_->renames % 2 == 1) ||
               (life_->slip == Slip::open_does_not_write && life_->is_opening);
    }
    int sync(std::size_t file) {
        if (life_->slip == Slip::no_file_sync) return 0;
        if (life_->step() != Life::Fault::none) return EIO;
        life_->disk.files[file].on_disk = life_->disk.files[file].cached;
        return 0;
    }

    Life* life_;
};

}  // namespace gene_clocks::test
