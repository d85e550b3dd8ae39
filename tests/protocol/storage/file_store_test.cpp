// The store on a real file system: what is refused and with which error.
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/storage/file_store.hpp>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace {

/// What the store has synchronised and renamed so far, while it is watched.
std::vector<std::string>* watched = nullptr;

}  // namespace

// In the place of the C library's: whether a file was synchronised shows nowhere else but after a
// loss of power.
extern "C" int fsync(int descriptor) {
    if (watched) {
        const auto file =
            std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor));
        watched->push_back("sync " + (std::filesystem::is_directory(file)
                                          ? std::string{"folder"}
                                          : file.filename().string()));
    }
    return static_cast<int>(::syscall(SYS_fsync, descriptor));
}
extern "C" int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
    if (watched) watched->push_back(std::string{from} + " to " + to);
    return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, 0));
}

namespace gene_clocks::storage {
namespace {

constexpr RobotId robot{7};

class FileStoreTest : public testing::Test {
protected:
    FileStore store(RobotId id = robot) const { return {PosixFiles{folder_.path().string()}, id}; }
    std::filesystem::path copy(int number) const {
        return folder_.path() / ("counter." + std::to_string(number));
    }
    static std::string contents(const std::filesystem::path& file) {
        std::ifstream in{file, std::ios::binary};
        return {std::istreambuf_iterator<char>{in}, {}};
    }
    static void write(const std::filesystem::path& file, const std::string& bytes) {
        std::ofstream{file, std::ios::binary} << bytes;
    }
    StorageStatus reopened(std::uint64_t& counter) const {
        auto again = store();
        const auto status = again.open();
        counter = again.stored();
        return status;
    }

    test::TemporaryFolder folder_{std::filesystem::temp_directory_path()};
};

TEST_F(FileStoreTest, ReadsBackWhatItStored) {
    {
        auto first = store();
        EXPECT_EQ(first.stored(), 0u);
        EXPECT_EQ(first.open().error, StorageError::missing);
        EXPECT_EQ(first.create(23).error, StorageError::none);
        EXPECT_EQ(first.stored(), 23u);
        EXPECT_TRUE(first.store(40));
        EXPECT_TRUE(first.store(39)) << "a smaller counter is covered";
        EXPECT_TRUE(first.store(40)) << "and so is the same";
        EXPECT_EQ(first.stored(), 40u);
        EXPECT_EQ(first.flushes(), 2u);
    }
    std::uint64_t counter = 0;
    EXPECT_TRUE(reopened(counter));
    EXPECT_EQ(counter, 40u);
    EXPECT_EQ(contents(copy(1)), contents(copy(2)));
    EXPECT_EQ(contents(copy(1)).size(), counter_record_size);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "counter.new"));
}

TEST_F(FileStoreTest, SynchronisesAFileBeforeItsNameAndTheFolderAfterIt) {
    const auto during = [](auto call) {
        std::vector<std::string> events;
        watched = &events;
        EXPECT_TRUE(call());
        watched = nullptr;
        return events;
    };
    const std::vector<std::string> both{
        "sync counter.new", "counter.new to counter.1", "sync folder",
        "sync counter.new", "counter.new to counter.2", "sync folder"};
    {
        auto first = store();
        ASSERT_TRUE(first.create(23));
        EXPECT_EQ(during([&] { return first.store(40); }), both);
    }
    // What an earlier process renamed may not be durable yet.
    auto expected = both;
    expected.insert(expected.begin(), "sync folder");
    auto again = store();
    EXPECT_EQ(during([&] { return again.open(); }), expected);
}

TEST_F(FileStoreTest, IsWrittenOnlyAfterItWasOpened) {
    auto closed = store();
    EXPECT_EQ(closed.store(5).error, StorageError::not_open);
    EXPECT_EQ(closed.create(0).error, StorageError::bad_counter);
    EXPECT_FALSE(std::filesystem::exists(copy(1)));
}

TEST_F(FileStoreTest, IsCreatedOnce) {
    ASSERT_TRUE(store().create(5));
    EXPECT_EQ(store().create(1).error, StorageError::exists);
    std::filesystem::remove(copy(1));
    EXPECT_EQ(store().create(1).error, StorageError::exists);
    write(copy(2), "torn");
    EXPECT_EQ(store().create(1).error, StorageError::damaged);
}

TEST_F(FileStoreTest, BelongsToOneProcess) {
    auto first = store();
    ASSERT_TRUE(first.create(5));
    const auto status = store().open();
    EXPECT_EQ(status.error, StorageError::in_use);
    EXPECT_EQ(status.system_error, EWOULDBLOCK);
}

TEST_F(FileStoreTest, IsHeldWhateverBecomesOfItsFilesAndItsName) {
    auto first = store();
    ASSERT_TRUE(first.create(5));
    for (const auto& file : std::filesystem::directory_iterator{folder_.path()}) {
        std::filesystem::remove(file);
    }
    EXPECT_EQ(store().open().error, StorageError::in_use);
    EXPECT_EQ(store().create(1).error, StorageError::in_use);

    const auto elsewhere = std::filesystem::path{folder_.path()} += "-renamed";
    std::filesystem::rename(folder_.path(), elsewhere);
    FileStore renamed{PosixFiles{elsewhere.string()}, robot};
    EXPECT_EQ(renamed.create(1).error, StorageError::in_use);
    EXPECT_TRUE(first.store(6)) << "its owner goes on";
    std::filesystem::rename(elsewhere, folder_.path());
}

TEST_F(FileStoreTest, AcknowledgesNothingInAFolderThatIsGone) {
    auto first = store();
    ASSERT_TRUE(first.create(5));
    std::filesystem::remove_all(folder_.path());
    EXPECT_EQ(first.store(6), (StorageStatus{StorageError::device, ENOENT}));
}

TEST_F(FileStoreTest, StaysWithTheParentAfterAFork) {
    auto store_of_parent = store();
    ASSERT_TRUE(store_of_parent.create(5));
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const auto is_refused = [](StorageStatus status) {
            return status == StorageStatus{StorageError::in_use, EWOULDBLOCK};
        };
        auto anew = store();
        const bool all_are = is_refused(store_of_parent.store(9)) &&
                             is_refused(store_of_parent.store(5)) &&  // also what needs no writing
                             is_refused(store_of_parent.open()) &&
                             is_refused(store_of_parent.create(1)) && is_refused(anew.open());
        ::_exit(all_are ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    EXPECT_TRUE(store_of_parent.store(9));
    EXPECT_EQ(store().open().error, StorageError::in_use) << "the child's end released nothing";
}

TEST_F(FileStoreTest, IsHandedOnWhole) {
    auto first = store();
    ASSERT_TRUE(first.create(5));
    auto second = std::move(first);
    EXPECT_EQ(first.store(5).error, StorageError::in_use);  // NOLINT(bugprone-use-after-move)
    EXPECT_TRUE(second.store(6));
}

TEST_F(FileStoreTest, BelongsToOneRobot) {
    ASSERT_TRUE(store().create(5));
    EXPECT_EQ(store(RobotId{8}).open().error, StorageError::other_robot);
    EXPECT_EQ(store(RobotId{8}).create(1).error, StorageError::other_robot);
    std::uint64_t counter = 0;
    EXPECT_TRUE(reopened(counter)) << "the refusal changed nothing";
    EXPECT_EQ(counter, 5u);
}

TEST_F(FileStoreTest, OutlivesTheLossOfEitherCopy) {
    for (const int lost : {1, 2}) {
        for (const std::string& left : {std::string{}, std::string{"x"}, std::string(24, '\xff'),
                                        std::string(25, '\0'), std::string(100'000, 'G')}) {
            std::filesystem::remove(copy(1));
            std::filesystem::remove(copy(2));
            ASSERT_TRUE(store().create(77));
            write(copy(lost), left);
            std::uint64_t counter = 0;
            EXPECT_TRUE(reopened(counter));
            EXPECT_EQ(counter, 77u);
            EXPECT_EQ(contents(copy(1)), contents(copy(2))) << "it was mended";
        }
    }
}

TEST_F(FileStoreTest, DoesNotGuessWhereBothCopiesAreLost) {
    ASSERT_TRUE(store().create(77));
    write(copy(1), "");
    write(copy(2), std::string(24, '\0'));
    EXPECT_EQ(store().open().error, StorageError::damaged);
    std::filesystem::remove(copy(1));
    EXPECT_EQ(store().open().error, StorageError::damaged);
    EXPECT_EQ(contents(copy(2)), std::string(24, '\0')) << "the evidence is left alone";
}

TEST_F(FileStoreTest, SaysWhatTheSystemSays) {
    FileStore nowhere{PosixFiles{(folder_.path() / "missing").string()}, robot};
    EXPECT_EQ(nowhere.open(), (StorageStatus{StorageError::device, ENOENT}));

    ASSERT_TRUE(store().create(5));
    std::filesystem::remove(copy(1));
    std::filesystem::create_directory(copy(1));
    EXPECT_EQ(store().open(), (StorageStatus{StorageError::device, EISDIR}));
}

// A store that cannot be written keeps what it has, and may be tried again.
TEST_F(FileStoreTest, KeepsTheOldCounterWhereTheNewOneCannotBeWritten) {
    auto full = store();
    ASSERT_TRUE(full.create(5));
    std::filesystem::create_directory(folder_.path() / "counter.new");
    EXPECT_EQ(full.store(6), (StorageStatus{StorageError::device, EISDIR}));
    EXPECT_EQ(full.stored(), 5u);
    std::filesystem::remove(folder_.path() / "counter.new");
    EXPECT_TRUE(full.store(6));
    EXPECT_EQ(full.stored(), 6u);
}

TEST_F(FileStoreTest, ARestartedClockGoesOnAboveAllThatItSent) {
    InnovationNumber before;
    {
        auto durable = store();
        ASSERT_TRUE(durable.create(23));
        GeneClock clock{robot, 22, {.block = 10}};
        before = clock.mint().value();
        ASSERT_TRUE(durable.store(clock.durable_needed()));
    }
    auto durable = store();
    ASSERT_TRUE(durable.open());
    auto clock = GeneClock::restart(robot, durable.stored(), 0);
    ASSERT_TRUE(clock);
    EXPECT_LT(before, clock->mint());
}

}  // namespace
}  // namespace gene_clocks::storage
