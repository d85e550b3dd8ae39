#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <gene_clocks/storage/posix_files.hpp>
#include <utility>

namespace gene_clocks::storage {
namespace {

constexpr const char* temporary_name = "counter.new";

/// Repeats what a signal interrupted. Returns 0 or an errno value.
template <class Call>
int checked(Call call) {
    while (call() < 0) {
        if (errno != EINTR) return errno;
    }
    return 0;
}

int open_in(int folder, const char* name, int flags, int& descriptor) {
    return checked([&] { return descriptor = ::openat(folder, name, flags | O_CLOEXEC, 0600); });
}

/// To stable storage, as far as the system lets a program see to it.
int synchronise(int descriptor) {
#ifdef F_FULLFSYNC  // macOS: its fsync() stops at the drive's cache
    if (checked([&] { return ::fcntl(descriptor, F_FULLFSYNC); }) == 0) return 0;
#endif
    return checked([&] { return ::fsync(descriptor); });
}

/// The last chance of the system to report what went wrong; after EINTR it is closed as well.
int close_checked(int& descriptor) {
    const bool is_closed = ::close(std::exchange(descriptor, -1)) == 0;
    return is_closed || errno == EINTR ? 0 : errno;
}

/// Where whatever it says about the file no longer matters.
void close_if_open(int& descriptor) {
    if (descriptor >= 0) close_checked(descriptor);
}

}  // namespace

PosixFiles::~PosixFiles() {
    close_if_open(temporary_descriptor_);
    close_if_open(folder_descriptor_);
}

int PosixFiles::acquire() {
    close_if_open(folder_descriptor_);
    if (const int error =
            open_in(AT_FDCWD, folder_.c_str(), O_RDONLY | O_DIRECTORY, folder_descriptor_)) {
        return error;
    }
    if (const int error = checked([&] { return ::flock(folder_descriptor_, LOCK_EX | LOCK_NB); })) {
        return error;
    }
    owner_ = ::getpid();
    return 0;
}

int PosixFiles::check_owner() const {
    return owner_ == ::getpid() ? 0 : EWOULDBLOCK;
}

int PosixFiles::read(const char* name, std::span<std::byte> bytes, std::size_t& size) const {
    int descriptor = -1;
    size = 0;
    if (const int error = open_in(folder_descriptor_, name, O_RDONLY, descriptor)) return error;
    int error = 0;
    while (error == 0 && size < bytes.size()) {
        ssize_t count = 0;
        error = checked(
            [&] { return count = ::read(descriptor, bytes.data() + size, bytes.size() - size); });
        if (count <= 0) break;
        size += static_cast<std::size_t>(count);
    }
    const int close_error = close_checked(descriptor);
    return error != 0 ? error : close_error;
}

int PosixFiles::write_temporary(std::span<const std::byte> bytes) {
    close_if_open(temporary_descriptor_);
    // Always a new file: never one that is still, or also, known under another name.
    const int unlinked = checked([&] { return ::unlinkat(folder_descriptor_, temporary_name, 0); });
    if (unlinked != 0 && unlinked != ENOENT) return unlinked;
    if (const int error = open_in(folder_descriptor_, temporary_name, O_WRONLY | O_CREAT | O_EXCL,
                                  temporary_descriptor_)) {
        return error;
    }
    while (!bytes.empty()) {
        ssize_t count = 0;
        if (const int error = checked([&] {
                return count = ::write(temporary_descriptor_, bytes.data(), bytes.size());
            })) {
            return error;
        }
        if (count == 0) return EIO;  // or this would never end
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return 0;
}

int PosixFiles::sync_temporary() {
    const int error = synchronise(temporary_descriptor_);
    const int close_error = close_checked(temporary_descriptor_);
    return error != 0 ? error : close_error;
}

int PosixFiles::rename_temporary(const char* name) {
    return checked(
        [&] { return ::renameat(folder_descriptor_, temporary_name, folder_descriptor_, name); });
}

int PosixFiles::sync_folder() {
    return synchronise(folder_descriptor_);
}

}  // namespace gene_clocks::storage
