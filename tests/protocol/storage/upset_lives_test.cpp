// Lives of a robot in which system calls go wrong at any one or two points, or ever after, or in
// which the process ends at any point. Whatever else happens, no mark leaves it twice, and none
// sorts before one that was sent earlier.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/storage/file_store.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/protocol/storage/system_calls.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gene_clocks::storage {
namespace {

using test::Plan;
using test::SystemCalls;
using test::Upset;

constexpr RobotId robot{7};
constexpr std::size_t genes_of_a_life = 3;

/// What has left the robot in one life, where another process can read it.
struct Sent {
    std::array<std::uint64_t, genes_of_a_life> marks;
    std::array<std::uint64_t, genes_of_a_life> stamps;
    std::size_t count;
};

/// Opens the store, or gives up; marks genes, and sends those that may leave.
void live(const std::string& folder, std::uint64_t block, Sent& sent) {
    FileStore store{PosixFiles{folder}, robot};
    auto status = store.open();
    if (status.error == StorageError::missing) status = store.create(1);
    if (!status) return;
    auto clock = GeneClock::restart(robot, store.stored(), 0, {.block = block});
    for (std::size_t gene = 0; gene < genes_of_a_life; ++gene) {
        const auto mark = clock->mint();
        if (!store.store(clock->durable_needed())) continue;
        sent.marks[sent.count] = mark->counter;
        sent.stamps[sent.count++] = clock->stamp().value;
    }
}

class UpsetLives : public testing::TestWithParam<std::uint64_t> {
protected:
    UpsetLives()
        : sent_{static_cast<Sent*>(::mmap(nullptr, sizeof(Sent), PROT_READ | PROT_WRITE,
                                          MAP_SHARED | MAP_ANONYMOUS, -1, 0))} {}
    ~UpsetLives() override { ::munmap(sent_, sizeof(Sent)); }

    /// A life in this process. Returns how many system calls it made.
    int live(std::vector<Plan> plans = {}) {
        *sent_ = {};
        int calls = 0;
        {
            const SystemCalls upset{std::move(plans)};
            storage::live(folder_->path().string(), GetParam(), *sent_);
            calls = static_cast<int>(upset.made().size());
        }
        hear();
        return calls;
    }
    /// A life in a process of its own, which may end in the middle of it.
    void live_apart(const Plan& plan) {
        *sent_ = {};
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            const SystemCalls upset{{plan}};
            storage::live(folder_->path().string(), GetParam(), *sent_);
            ::_exit(0);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        hear();
    }
    void hear() {
        for (std::size_t i = 0; i < sent_->count; ++i) {
            EXPECT_GE(sent_->marks[i], floor_) << "made again, or before an older one";
            floor_ = std::max(floor_, sent_->stamps[i]);
        }
        heard_ += sent_->count;
    }
    /// A robot that has not lived, or has once.
    void start_anew(bool is_new) {
        folder_.emplace(test::memory_folder());
        floor_ = 1;
        if (!is_new) live();
    }
    /// A life in which nothing goes wrong, which is what shows what was left.
    void expect_a_good_life() {
        live();
        EXPECT_EQ(sent_->count, genes_of_a_life);
    }

    Sent* sent_;
    std::optional<test::TemporaryFolder> folder_;
    std::uint64_t floor_ = 1;
    std::size_t heard_ = 0;
};

TEST_P(UpsetLives, EndAtAnyCall) {
    for (const bool is_new : {true, false}) {
        start_anew(is_new);
        const int calls = live();
        for (int at = 0; at < calls && !HasFailure(); ++at) {
            for (const auto upset : {Upset::dies_before, Upset::dies_after}) {
                SCOPED_TRACE(at);
                start_anew(is_new);
                live_apart({upset, 0, at});
                expect_a_good_life();
            }
        }
    }
    EXPECT_GT(heard_, 100u);
}

TEST_P(UpsetLives, FailAtAnyTwoCalls) {
    for (const bool is_new : {true, false}) {
        start_anew(is_new);
        const int calls = live();
        for (int first = 0; first < calls; ++first) {
            for (int second = first + 1; second <= calls && !HasFailure(); ++second) {
                SCOPED_TRACE(std::to_string(first) + ", " + std::to_string(second));
                for (const auto one : {Upset::fails_undone, Upset::fails_done}) {
                    for (const auto two : {Upset::fails_undone, Upset::fails_done}) {
                        start_anew(is_new);
                        live({{one, EIO, first}, {two, EIO, second}});
                        expect_a_good_life();
                    }
                }
            }
        }
    }
}

TEST_P(UpsetLives, FailEverAfter) {
    for (const bool is_new : {true, false}) {
        start_anew(is_new);
        const int calls = live();
        // The last is to close the folder, when all has been sent.
        for (int first = 0; first + 1 < calls && !HasFailure(); ++first) {
            for (const int error : {EIO, ENOSPC, EROFS}) {
                SCOPED_TRACE(first);
                start_anew(is_new);
                live({{Upset::fails_undone, error, first, INT_MAX}});
                EXPECT_LT(sent_->count, genes_of_a_life);
                expect_a_good_life();
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Block, UpsetLives, testing::Values(0, 2),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace gene_clocks::storage
