#include "tests/protocol/storage/system_calls.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <utility>

namespace gene_clocks::test {
namespace {

SystemCalls* watching = nullptr;

}  // namespace

SystemCalls::SystemCalls(std::vector<Plan> plans) : plans_{std::move(plans)} {
    if (watching != nullptr) std::abort();
    watching = this;
}

SystemCalls::~SystemCalls() {
    watching = nullptr;
}

Plan SystemCalls::next(Call call) {
    const int number = static_cast<int>(made_.size());
    made_.push_back(call);
    for (const Plan& plan : plans_) {
        if (plan.at <= number && number <= (plan.last < 0 ? plan.at : plan.last)) {
            ++upset_;
            return plan;
        }
    }
    return {};
}

namespace {

/// Makes a call as planned. `done(portion)` makes it on so many bytes, where it has any.
template <class Done>
auto made(Call call, std::size_t bytes, Done done) -> decltype(done(bytes)) {
    if (watching == nullptr) return done(bytes);
    const Plan plan = watching->next(call);
    const bool is_transfer = call == Call::read || call == Call::write;
    switch (plan.upset) {
        case Upset::none:
            return done(bytes);
        case Upset::dies_before:
            ::_exit(0);
        case Upset::dies_after:
            done(bytes);
            ::_exit(0);
        case Upset::half:
            return done(is_transfer ? (bytes + 1) / 2 : bytes);
        case Upset::nothing:
            return is_transfer ? 0 : done(bytes);
        case Upset::fails_done:
            done(bytes);
            break;
        case Upset::fails_undone:
            break;
    }
    errno = plan.system_error;
    return -1;
}

}  // namespace
}  // namespace gene_clocks::test

using gene_clocks::test::Call;
using gene_clocks::test::watching;

extern "C" {

int __real_openat(int folder, const char* name, int flags, ...);
int __real_flock(int descriptor, int operation);
ssize_t __real_read(int descriptor, void* bytes, size_t count);
ssize_t __real_write(int descriptor, const void* bytes, size_t count);
int __real_fsync(int descriptor);
int __real_renameat(int from_folder, const char* from, int to_folder, const char* to);
int __real_unlinkat(int folder, const char* name, int flags);
int __real_close(int descriptor);

int __wrap_openat(int folder, const char* name, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = va_arg(rest, mode_t);  // given by every caller in the library
    va_end(rest);
    int opened = -1;
    const int result = gene_clocks::test::made(Call::openat, 0, [&](std::size_t) {
        return opened = __real_openat(folder, name, flags, mode);
    });
    // A call that is interrupted after all opens nothing that its caller could close.
    if (result < 0 && opened >= 0) __real_close(opened);
    if (result >= 0 && watching != nullptr) watching->count_descriptor(1);
    return result;
}

int __wrap_flock(int descriptor, int operation) {
    return gene_clocks::test::made(
        Call::flock, 0, [&](std::size_t) { return __real_flock(descriptor, operation); });
}

ssize_t __wrap_read(int descriptor, void* bytes, size_t count) {
    return gene_clocks::test::made(Call::read, count, [&](std::size_t portion) {
        return __real_read(descriptor, bytes, portion);
    });
}

ssize_t __wrap_write(int descriptor, const void* bytes, size_t count) {
    return gene_clocks::test::made(Call::write, count, [&](std::size_t portion) {
        return __real_write(descriptor, bytes, portion);
    });
}

int __wrap_fsync(int descriptor) {
    return gene_clocks::test::made(Call::fsync, 0,
                                   [&](std::size_t) { return __real_fsync(descriptor); });
}

int __wrap_renameat(int from_folder, const char* from, int to_folder, const char* to) {
    return gene_clocks::test::made(Call::renameat, 0, [&](std::size_t) {
        return __real_renameat(from_folder, from, to_folder, to);
    });
}

int __wrap_unlinkat(int folder, const char* name, int flags) {
    return gene_clocks::test::made(
        Call::unlinkat, 0, [&](std::size_t) { return __real_unlinkat(folder, name, flags); });
}

/// Linux closes the descriptor whatever it then reports, so that a failure always counts as done.
int __wrap_close(int descriptor) {
    int result = 0;
    bool is_closed = false;
    result = gene_clocks::test::made(Call::close, 0, [&](std::size_t) {
        is_closed = true;
        return __real_close(descriptor);
    });
    if (!is_closed) {
        const int reported = errno;
        __real_close(descriptor);
        errno = reported;
    }
    if (watching != nullptr) watching->count_descriptor(-1);
    return result;
}

}  // extern "C"
