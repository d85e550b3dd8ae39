// Every system call of the store goes wrong, at every point: it fails with each error that it may
// give, done or not, is interrupted, or is cut short. No error may be swallowed, and what failed
// may be tried again.
#include "tests/protocol/storage/system_calls.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gene_clocks/storage/file_store.hpp>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::storage {
namespace {

using test::Call;
using test::Plan;
using test::SystemCalls;
using test::Upset;

constexpr RobotId robot{7};

/// What POSIX and Linux say that a call may give, beside EINTR.
std::vector<int> errors_of(Call call) {
    switch (call) {
        case Call::openat:
            return {EACCES, EIO,    ELOOP, EMFILE, ENAMETOOLONG, ENFILE, ENOENT, ENOMEM,
                    ENOSPC, ENODEV, ENXIO, EPERM,  EROFS,        EDQUOT, ESTALE};
        case Call::flock:
            return {EBADF, EINVAL, ENOLCK, EWOULDBLOCK};
        case Call::read:
            return {EAGAIN, EBADF, EINVAL, EIO, EISDIR, ENOMEM, ESTALE};
        case Call::write:
            return {EAGAIN, EBADF, EDQUOT, EFBIG, EINVAL, EIO, ENOSPC, EPERM, EPIPE, ESTALE};
        case Call::fsync:
            return {EBADF, EDQUOT, EINVAL, EIO, ENOSPC, EROFS, ESTALE};
        case Call::renameat:
            return {EACCES, EBUSY,     EDQUOT, EIO,   EISDIR, ENOENT, ENOMEM,
                    ENOSPC, ENOTEMPTY, EPERM,  EROFS, EXDEV,  ESTALE};
        case Call::unlinkat:
            return {EACCES, EBUSY, EIO, EISDIR, ENOENT, ENOMEM, EPERM, EROFS};
        case Call::close:
            return {EDQUOT, EIO, ENOSPC, ESTALE};
    }
    return {};
}

/// The part of a robot's life in which a call is made.
enum class Part { creates, opens, stores };

class SystemCallsTest : public testing::TestWithParam<Part> {
protected:
    FileStore store() const { return {PosixFiles{folder_.path().string()}, robot}; }
    std::string contents(int copy) const {
        std::ifstream in{folder_.path() / ("counter." + std::to_string(copy)), std::ios::binary};
        return {std::istreambuf_iterator<char>{in}, {}};
    }

    /// A store as it is before the part, and what was acknowledged.
    std::unique_ptr<FileStore> before() {
        for (const auto& file : std::filesystem::directory_iterator{folder_.path()}) {
            std::filesystem::remove_all(file);
        }
        acknowledged_ = 0;
        if (GetParam() != Part::creates) acknowledge(store().create(5), 5);
        auto prepared = std::make_unique<FileStore>(store());
        if (GetParam() == Part::stores) acknowledge(prepared->open(), 5);
        return prepared;
    }
    /// The part itself.
    StorageStatus act(FileStore& on) const {
        switch (GetParam()) {
            case Part::creates:
                return on.create(5);
            case Part::opens:
                return on.open();
            case Part::stores:
                return on.store(9);
        }
        return {};
    }
    std::uint64_t counter() const { return GetParam() == Part::stores ? 9 : 5; }

    /// The calls of the part when nothing goes wrong.
    std::vector<Call> calls() {
        const auto whole = before();
        const SystemCalls watched;
        EXPECT_TRUE(act(*whole));
        return watched.made();
    }

    /// Tries again what has failed, as the documents say, and looks at what there is in the end.
    void expect_recovery(FileStore& failed) {
        auto status = failed.stored() > 0 ? failed.store(counter()) : failed.open();
        if (status.error == StorageError::missing && acknowledged_ == 0) {
            status = failed.create(counter());
        }
        EXPECT_TRUE(status) << "tried again, it gives " << int(status.error);
        EXPECT_GE(failed.stored(), GetParam() == Part::stores ? counter() : acknowledged_);
    }
    /// Both copies hold what was acknowledged last, before and after they are opened again.
    void expect_whole(std::unique_ptr<FileStore> used) {
        const std::uint64_t last = used->stored();
        EXPECT_EQ(contents(1), contents(2));
        EXPECT_EQ(contents(1).size(), counter_record_size);
        used.reset();
        auto again = store();
        EXPECT_TRUE(again.open());
        EXPECT_EQ(again.stored(), last);
        EXPECT_EQ(contents(1), contents(2));
    }

    void acknowledge(StorageStatus status, std::uint64_t counter) {
        ASSERT_TRUE(status);
        acknowledged_ = counter;
    }

    test::TemporaryFolder folder_{test::memory_folder()};
    std::uint64_t acknowledged_ = 0;
};

/// Of the calls that read one of the two copies when a store is opened: that one is lost for now,
/// and the other is enough.
bool reads_a_copy(Part part, int at) {
    return part == Part::opens && at >= 2 && at < 10;
}

std::optional<StorageStatus> expected_of(Part part, Call call, int at, int error) {
    if (call == Call::unlinkat && error == ENOENT) return StorageStatus{};
    if (reads_a_copy(part, at)) return StorageStatus{};
    if (call == Call::flock && error == EWOULDBLOCK) {
        return StorageStatus{StorageError::in_use, error};
    }
    // A copy that is not there, when nothing has been created.
    if (part == Part::creates && (at == 2 || at == 3) && error == ENOENT) return StorageStatus{};
    return StorageStatus{StorageError::device, error};
}

TEST_P(SystemCallsTest, AreTheseAndNoOthers) {
    using enum Call;
    const std::vector<Call> replaces_a_copy{unlinkat, openat, write, fsync, close, renameat, fsync};
    std::vector<Call> expected;
    const auto add = [&](const std::vector<Call>& calls) {
        expected.insert(expected.end(), calls.begin(), calls.end());
    };
    if (GetParam() != Part::stores) add({openat, flock});
    if (GetParam() == Part::creates) add({openat, openat});
    if (GetParam() == Part::opens) {
        for (int copy = 0; copy < 2; ++copy) add({openat, read, read, close});
        add({fsync});
    }
    for (int copy = 0; copy < 2; ++copy) add(replaces_a_copy);
    EXPECT_EQ(calls(), expected);
}

TEST_P(SystemCallsTest, SwallowNoError) {
    const auto all = calls();
    for (int at = 0; at < static_cast<int>(all.size()); ++at) {
        for (const int error : errors_of(all.at(static_cast<std::size_t>(at)))) {
            for (const auto upset : {Upset::fails_undone, Upset::fails_done}) {
                SCOPED_TRACE("call " + std::to_string(at) + " errno " + std::to_string(error) +
                             (upset == Upset::fails_done ? " done" : " undone"));
                auto used = before();
                StorageStatus status;
                int left_open = 0;
                {
                    SystemCalls watched{{{upset, error, at}}};
                    status = act(*used);
                    EXPECT_EQ(watched.upset(), 1);
                    // The folder, and a temporary file that could not be finished.
                    left_open = watched.open_descriptors();
                }
                EXPECT_EQ(status,
                          expected_of(GetParam(), all.at(static_cast<std::size_t>(at)), at, error))
                    << int(status.error) << ' ' << status.system_error;
                EXPECT_LE(left_open, 2);
                if (!status) {
                    EXPECT_EQ(used->stored(), GetParam() == Part::stores ? 5 : 0);
                    expect_recovery(*used);
                }
                expect_whole(std::move(used));
                if (HasFailure()) return;
            }
        }
    }
}

// Then it may be a new robot, or not, and it may be read another time: nothing is decided.
TEST_P(SystemCallsTest, DecideNothingWhereNeitherCopyCanBeRead) {
    if (GetParam() != Part::opens) return;
    // Where the first fails, the second begins one call earlier than else.
    for (const auto& [first, second] : {std::pair{2, 3}, {3, 6}, {5, 9}}) {
        auto used = before();
        const std::string copies = contents(1) + contents(2);
        {
            SystemCalls watched{
                {{Upset::fails_undone, ESTALE, first}, {Upset::fails_undone, EIO, second}}};
            EXPECT_EQ(used->open(), (StorageStatus{StorageError::device, EIO})) << first;
            EXPECT_EQ(watched.upset(), 2);
        }
        {
            // The folder is open by now.
            const SystemCalls watched{
                {{Upset::fails_undone, EIO, first - 2}, {Upset::fails_undone, EIO, second - 2}}};
            EXPECT_EQ(used->create(1), (StorageStatus{StorageError::device, EIO})) << first;
        }
        EXPECT_EQ(used->stored(), 0u);
        EXPECT_EQ(contents(1) + contents(2), copies);
        expect_recovery(*used);
        expect_whole(std::move(used));
    }
}

TEST_P(SystemCallsTest, GoOnWhereASignalInterruptsThem) {
    const int calls_in_all = static_cast<int>(calls().size());
    for (int at = 0; at < calls_in_all; ++at) {
        auto used = before();
        {
            SystemCalls watched{{{Upset::fails_undone, EINTR, at}}};
            EXPECT_TRUE(act(*used)) << at;
            EXPECT_EQ(watched.upset(), 1);
        }
        EXPECT_EQ(used->stored(), counter());
        expect_whole(std::move(used));
    }
}

TEST_P(SystemCallsTest, GoOnWhereTheyAreCutShort) {
    const auto all = calls();
    for (int at = 0; at < static_cast<int>(all.size()); ++at) {
        for (const auto upset : {Upset::half, Upset::nothing}) {
            auto used = before();
            StorageStatus status;
            {
                const SystemCalls watched{{{upset, 0, at}}};
                status = act(*used);
            }
            if (all.at(static_cast<std::size_t>(at)) == Call::write && upset == Upset::nothing) {
                EXPECT_EQ(status, (StorageStatus{StorageError::device, EIO})) << at;
                expect_recovery(*used);
            } else {
                EXPECT_TRUE(status) << at;
            }
            expect_whole(std::move(used));
        }
    }
}

TEST_P(SystemCallsTest, LeaveNoDescriptorBehind) {
    const auto all = calls();
    for (int at = 0; at < static_cast<int>(all.size()); ++at) {
        auto used = before();
        used.reset();  // what was opened before is not counted
        SystemCalls watched{{{Upset::fails_undone, EIO, at}}};
        {
            auto counted = store();
            auto status = counted.open();
            if (status.error == StorageError::missing) status = counted.create(5);
            if (status) (void)counted.store(9);
        }
        EXPECT_EQ(watched.open_descriptors(), 0) << at;
    }
}

const auto name_of = [](const auto& info) {
    constexpr std::array names{"Create", "Open", "Store"};
    return std::string{names[static_cast<std::size_t>(info.param)]};
};
INSTANTIATE_TEST_SUITE_P(Each, SystemCallsTest,
                         testing::Values(Part::creates, Part::opens, Part::stores), name_of);

}  // namespace
}  // namespace gene_clocks::storage
