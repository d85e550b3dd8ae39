#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace gene_clocks::storage {

/// The few operations of a file system that a counter's two files need, in one folder. Each returns
/// 0 or an errno value.
///
/// Errors of a synchronisation are final for the file concerned: the kernel may have thrown away
/// what it could not write. So a file is always written anew and never synchronised again.
class PosixFiles {
public:
    explicit PosixFiles(std::string folder) : folder_(std::move(folder)) {}
    PosixFiles(PosixFiles&& other) noexcept
        : folder_(std::move(other.folder_)),
          folder_descriptor_(std::exchange(other.folder_descriptor_, -1)),
          owner_(std::exchange(other.owner_, 0)),
          temporary_descriptor_(std::exchange(other.temporary_descriptor_, -1)) {}
    PosixFiles& operator=(PosixFiles&&) = delete;
    ~PosixFiles();

    /// Opens the folder for this process alone, until destruction or death. EWOULDBLOCK where
    /// another has it. The lock is on the folder itself, which no removal of files undoes; the file
    /// system must have flock(), as local ones do.
    int acquire();

    /// EWOULDBLOCK in a process that has not acquired the folder itself: a child shares its
    /// parent's lock.
    [[nodiscard]] int check_owner() const;

    /// Reads at most bytes.size() bytes; `size` is how many there were. ENOENT where there is no
    /// file.
    int read(const char* name, std::span<std::byte> bytes, std::size_t& size) const;

    int write_temporary(std::span<const std::byte> bytes);
    int sync_temporary();
    int rename_temporary(const char* name);
    int sync_folder();

private:
    std::string folder_;
    int folder_descriptor_ = -1;
    std::intmax_t owner_ = 0;  // the process that has acquired it
    int temporary_descriptor_ = -1;
};

}  // namespace gene_clocks::storage
