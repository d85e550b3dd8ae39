// Every loss of power, at every operation, with every part of what was not synchronised lost, torn
// or out of order; every kill; every operation that fails; either copy rotten; any number of times,
// one after the other. Counters go from 1 to `largest`.
#include "tests/protocol/storage/simulated_disk.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <gene_clocks/storage/file_store.hpp>
#include <iostream>
#include <set>
#include <string>

namespace gene_clocks::test {
namespace {

constexpr RobotId robot{7};
constexpr std::array<const char*, 2> copies{"counter.1", "counter.2"};

/// What is left where a process has ended.
struct World {
    Disk disk{};
    std::uint64_t acknowledged = 0;  ///< the largest counter that the store has answered for
    bool has_rotten = false;         ///< a copy has, since both were last written
    bool has_failed = false;         ///< an operation has, since both copies were last written
    bool was_killed = false;         ///< since power was last lost
    friend auto operator<=>(const World&, const World&) = default;
};

struct Scope {
    std::uint64_t largest = 2;  ///< counter
    bool renames_tear = false;  ///< as on FAT: a file may be gone, or under both names
    bool copies_rot = false;
    bool operations_fail = false;
    bool reads_fail = false;  ///< one copy cannot be read in a life
};

struct Result {
    std::size_t worlds = 0;
    std::size_t lives = 0;
    std::string violation;
};

class Explorer {
public:
    Explorer(Slip slip, const Scope& scope) : slip_{slip}, scope_{scope} {}

    Result run() {
        discover({});
        while (!open_.empty() && result_.violation.empty()) {
            const World world = open_.front();
            open_.pop_front();
            using enum Life::Fault;
            const int operations = live(world, none, -1);
            if (scope_.reads_fail) {
                live(world, first_copy_unread, 0);
                live(world, second_copy_unread, 0);
            }
            for (int at = 0; at < operations; ++at) {
                if (scope_.operations_fail) {
                    live(world, fails_undone, at);
                    live(world, fails_done, at);
                }
                if (scope_.copies_rot && !world.has_rotten) {
                    live(world, first_copy_rots, at);
                    live(world, second_copy_rots, at);
                }
            }
        }
        result_.worlds = seen_.size();
        return result_;
    }

private:
    /// Without atomic renames, one thing is too much: an operation fails, the process that was told
    /// is killed before it has tried again, and then power is lost. Its successor reads what is in
    /// the cache and cannot know.
    [[nodiscard]] bool may_be_killed(const World& world) const {
        return !world.was_killed && !(scope_.renames_tear && world.has_failed);
    }

    /// A life with one fault, to its end and to every earlier one. Returns how many operations it
    /// has.
    int live(const World& world, Life::Fault fault, int fault_at) {
        int operations = 0;
        for (int end_at = 0;; ++end_at) {
            if (!result_.violation.empty()) return 0;
            World after = world;
            Life life{.disk = world.disk,
                      .slip = slip_,
                      .fault = fault,
                      .fault_at = fault_at,
                      .end_at = end_at};
            const bool has_ended = run(after, life);
            ++result_.lives;
            operations = life.operations;
            if (end_at >= fault_at) end(after, life.disk);
            if (!has_ended) return operations;
        }
    }

    /// Whether the life was cut off.
    bool run(World& world, Life& life) {
        storage::BasicFileStore<SimulatedFiles> store{SimulatedFiles{life}, robot};
        const auto answer = [&](const StorageStatus& status) {
            if (status) {
                world.acknowledged = std::max(world.acknowledged, store.stored());
                world.has_rotten = world.has_failed = false;
                life.has_failed = false;
            }
            world.has_failed |= life.has_failed;
            // Only now, since rot that strikes while both are being written may strike the second
            // after it has been.
            world.has_rotten |= life.has_rotten;
        };
        try {
            auto status = store.open();
            if (status.error == StorageError::missing && world.acknowledged == 0) {
                status = store.create(1);
            }
            check(world, status, store.stored());
            answer(status);
            life.is_opening = false;
            for (std::uint64_t counter = store.stored() + 1; status && counter <= scope_.largest;) {
                const auto stored = store.store(counter);
                answer(stored);
                // What failed once is tried again.
                if (stored) ++counter;
            }
            return false;
        } catch (const Ends&) {
            answer({StorageError::device});
            return true;
        }
    }

    void check(const World& world, StorageStatus status, std::uint64_t counter) {
        if (status.error == StorageError::device) return;
        if (status && counter < world.acknowledged) broken("an acknowledged counter is forgotten");
        if (status && counter > scope_.largest) broken("a counter that nobody stored");
        // Before the first answer there is nothing to lose; what is torn then is left to a person.
        if (!status && world.acknowledged > 0) {
            broken(status.error == StorageError::missing ? "an acknowledged counter is forgotten"
                                                         : "it cannot be opened again");
        }
    }
    void broken(const char* promise) {
        if (result_.violation.empty()) result_.violation = promise;
    }

    /// What may be left: the disk with its cache where the process was killed, and everything that
    /// a loss of power leaves.
    void end(World world, const Disk& disk) {
        if (may_be_killed(world)) {
            world.was_killed = true;
            world.disk = disk;
            discover(world);
        }
        world.was_killed = world.has_failed = false;
        for_each_power_loss(disk, copies, scope_.renames_tear, [&](const Disk& left) {
            world.disk = left;
            discover(world);
        });
    }
    void discover(const World& world) {
        if (seen_.insert(world).second) open_.push_back(world);
    }

    Slip slip_;
    Scope scope_;
    Result result_;
    std::set<World> seen_;
    std::deque<World> open_;
};

Result explore(Slip slip, const Scope& scope) {
    const Result result = Explorer{slip, scope}.run();
    std::cout << result.worlds << " worlds, " << result.lives << " lives; "
              << (result.violation.empty() ? "all promises hold" : result.violation) << '\n';
    return result;
}

struct RecordedScope {
    const char* name;
    Scope scope;
    std::size_t worlds;
    std::size_t lives;
    friend void PrintTo(const RecordedScope& scope, std::ostream* out) { *out << scope.name; }
};

class LosesNothing : public testing::TestWithParam<RecordedScope> {};

TEST_P(LosesNothing, WhateverHappensToTheDisk) {
    const Result result = explore(Slip::none, GetParam().scope);
    EXPECT_EQ(result.violation, "");
    EXPECT_EQ(result.worlds, GetParam().worlds);
    EXPECT_EQ(result.lives, GetParam().lives);
}

const auto name_of = [](const auto& info) { return std::string{info.param.name}; };
INSTANTIATE_TEST_SUITE_P(
    SimulatedDisk, LosesNothing,
    testing::Values(RecordedScope{"PowerAndKills", {.largest = 6}, 584, 14676},
                    RecordedScope{"RenamesTear", {.largest = 4, .renames_tear = true}, 473, 9150}),
    name_of);
#ifndef GENE_CLOCKS_SANITIZED  // there the small ones have to do
INSTANTIATE_TEST_SUITE_P(
    SimulatedDiskWithFaults, LosesNothing,
    testing::Values(
        RecordedScope{"OneCopyIsUnread", {.largest = 4, .reads_fail = true}, 526, 31619},
        RecordedScope{"OneCopyRotsAndOneIsUnread",
                      {.largest = 2, .copies_rot = true, .reads_fail = true},
                      585,
                      89001},
        RecordedScope{"OneCopyRots", {.largest = 3, .copies_rot = true}, 1090, 175836},
        RecordedScope{"OperationsFail", {.largest = 3, .operations_fail = true}, 1112, 393085},
        RecordedScope{"RenamesTearAndOperationsFail",
                      {.largest = 2, .renames_tear = true, .operations_fail = true},
                      171,
                      42478}),
    name_of);
#endif

constexpr Scope plain{.largest = 1};
constexpr Scope rot{.copies_rot = true};
constexpr Scope torn_renames{.renames_tear = true};
constexpr const char* forgotten = "an acknowledged counter is forgotten";
constexpr const char* lost = "it cannot be opened again";

#ifndef GENE_CLOCKS_SANITIZED
TEST(SimulatedDiskRefutes, AFileThatIsNotSynchronised) {
    EXPECT_EQ(explore(Slip::no_file_sync, plain).violation, lost);
}
TEST(SimulatedDiskRefutes, ARenamingBeforeTheSynchronisation) {
    EXPECT_EQ(explore(Slip::renamed_before_sync, rot).violation, lost);
}
#endif
TEST(SimulatedDiskRefutes, AFolderThatIsNotSynchronised) {
    EXPECT_EQ(explore(Slip::no_folder_sync, plain).violation, forgotten);
}
TEST(SimulatedDiskRefutes, ABadChecksumThatIsAccepted) {
    EXPECT_EQ(explore(Slip::checksum_ignored, rot).violation, "a counter that nobody stored");
}
TEST(SimulatedDiskRefutes, OneCopy) {
    EXPECT_EQ(explore(Slip::one_copy, rot).violation, lost);
    EXPECT_EQ(explore(Slip::one_copy, torn_renames).violation, forgotten);
}
TEST(SimulatedDiskRefutes, BothCopiesAtOnce) {
    EXPECT_EQ(explore(Slip::both_copies_at_once, torn_renames).violation, forgotten);
}
TEST(SimulatedDiskRefutes, TwoGenerationsWhereOneCopyRots) {
    EXPECT_EQ(explore(Slip::one_acknowledges, rot).violation, forgotten);
}
TEST(SimulatedDiskRefutes, GoingBackToTheOlderGeneration) {
    EXPECT_EQ(explore(Slip::older_generation, {}).violation, forgotten);
}
TEST(SimulatedDiskRefutes, OpeningBeforeAnUnfinishedRenamingIsDurable) {
    EXPECT_EQ(explore(Slip::open_does_not_settle, torn_renames).violation, forgotten);
}
TEST(SimulatedDiskRefutes, RelyingOnWhatWasReadWithoutWritingIt) {
    EXPECT_EQ(explore(Slip::open_does_not_write, plain).violation, forgotten);
}

}  // namespace
}  // namespace gene_clocks::test
