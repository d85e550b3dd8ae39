// Every loss of power while flash memory is programmed or erased, at every bit; every record that
// rots; again and again.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <compare>
#include <deque>
#include <gene_clocks/flash_store.hpp>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gene_clocks::test {
namespace {

constexpr RobotId robot{7};
constexpr std::size_t slots = 8;

/// The memory: `slots` records in each of two sectors.
struct Memory {
    using Sector = std::array<unsigned char, slots * counter_record_size>;
    std::array<Sector, 2> sectors;

    Memory() {
        for (auto& sector : sectors) sector.fill(0xff);
    }
    friend auto operator<=>(const Memory&, const Memory&) = default;
};

enum class Slip {
    none,
    checksum_ignored,  ///< a record with a bad checksum is accepted
    one_copy,          ///< the second record of a pair is never written
};

struct Ends {};

/// One life of a robot with its memory. It ends at the program or erasure with number `end_at`,
/// which `interrupted` then describes.
struct Life {
    Memory memory;
    Slip slip = Slip::none;
    int end_at = -1;
    int fail_at = -1;
    int worn_slot = -1;  // of sector 0: one of its bits stays set, and the memory does not tell

    int operations = 0;
    std::size_t sector = 0;
    std::size_t offset = 0;
    std::vector<unsigned char> record{};  // empty: an erasure
    bool programs_twice = false;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<unsigned char>> pretended{};
    int programmed = 0;
};

class SimulatedFlash {
public:
    static constexpr std::size_t program_unit = 8;
    static constexpr std::size_t sector_size = slots * counter_record_size;

    explicit SimulatedFlash(Life& life) : life_{&life} {}

    bool read(std::size_t sector, std::size_t offset, std::span<std::byte> bytes) {
        const auto pretended = life_->pretended.find({sector, offset});
        const unsigned char* from = pretended != life_->pretended.end()
                                        ? pretended->second.data()
                                        : life_->memory.sectors[sector].data() + offset;
        std::ranges::copy(std::as_bytes(std::span{from, bytes.size()}), bytes.begin());
        const bool is_erased =
            std::ranges::all_of(bytes, [](std::byte byte) { return byte == std::byte{0xff}; });
        if (life_->slip == Slip::checksum_ignored && !is_erased) {
            gene_clocks::detail::put_little_endian(
                bytes.data() + 20,
                gene_clocks::detail::record_checksum(bytes.first<counter_record_size>()));
        }
        return true;
    }
    bool program(std::size_t sector, std::size_t offset, std::span<const std::byte> bytes) {
        std::vector<unsigned char> record(bytes.size());
        std::ranges::copy(bytes, std::as_writable_bytes(std::span{record}).begin());
        if (life_->slip == Slip::one_copy && life_->programmed++ % 2 == 1) {
            life_->pretended[{sector, offset}] = record;
            return true;
        }
        const auto slot = std::span{life_->memory.sectors[sector]}.subspan(offset, bytes.size());
        life_->programs_twice |= !std::ranges::all_of(slot, [](auto byte) { return byte == 0xff; });
        if (!step(sector, offset, record)) return false;
        for (std::size_t i = 0; i < slot.size(); ++i)
            slot[i] = static_cast<unsigned char>(slot[i] & record[i]);
        if (sector == 0 && static_cast<int>(offset / counter_record_size) == life_->worn_slot) {
            slot[12] |= 0x80;
        }
        return true;
    }
    bool erase(std::size_t sector) {
        if (!step(sector, 0, {})) return false;
        life_->memory.sectors[sector].fill(0xff);
        return true;
    }

private:
    bool step(std::size_t sector, std::size_t offset, std::vector<unsigned char> record) {
        life_->sector = sector;
        life_->offset = offset;
        life_->record = std::move(record);
        if (life_->operations == life_->end_at) throw Ends{};
        return life_->operations++ != life_->fail_at;
    }
    Life* life_;
};

using Store = FlashStore<SimulatedFlash>;
static_assert(CounterStorage<Store>);

using Slot = std::array<unsigned char, counter_record_size>;

std::span<const std::byte> bytes_of(const Slot& slot) {
    return std::as_bytes(std::span{slot});
}

/// A slot that is neither a record nor erased is as good as any other such slot: a store can only
/// tell these three apart.
Slot reduced(const Slot& slot) {
    const bool is_erased = std::ranges::all_of(slot, [](auto byte) { return byte == 0xff; });
    return !is_erased && read_record(robot, bytes_of(slot)).error == StorageError::damaged ? Slot{}
                                                                                           : slot;
}

/// What an erased slot may read as after power was lost while `record` was programmed: its bits
/// have changed one after the other, from either end.
std::vector<Slot> interrupted_program(const Slot& record) {
    std::vector<Slot> slots;
    for (std::size_t size = 0; size <= 8 * record.size(); ++size) {
        for (const bool from_the_end : {false, true}) {
            Slot slot;
            slot.fill(0xff);
            for (std::size_t i = 0; i < size; ++i) {
                const std::size_t bit = from_the_end ? 8 * record.size() - 1 - i : i;
                const auto kept = ~(1u << (bit % 8)) | record[bit / 8];
                slot[bit / 8] = static_cast<unsigned char>(slot[bit / 8] & kept);
            }
            slots.push_back(slot);
        }
    }
    return slots;
}

/// What a sector may read as after power was lost while it was erased: its bytes have changed one
/// after the other, from either end; and before that they may have been programmed to zero.
std::vector<Memory::Sector> interrupted_erasure(const Memory::Sector& before) {
    std::vector<Memory::Sector> sectors;
    for (std::size_t size = 0; size <= before.size(); ++size) {
        for (const unsigned char fill : std::array<unsigned char, 2>{0xff, 0x00}) {
            auto& from_the_front = sectors.emplace_back(before);
            std::fill_n(from_the_front.begin(), size, fill);
            auto& from_the_end = sectors.emplace_back(before);
            std::fill_n(from_the_end.rbegin(), size, fill);
        }
    }
    return sectors;
}

/// The memories that there may be after power was lost during the operation that ended `life`.
class PowerLoss {
public:
    template <class Visit>
    void for_each(const Life& life, Visit visit) {
        Memory after = life.memory;
        auto& sector = after.sectors[life.sector];
        if (life.record.empty()) {
            std::set<Memory::Sector> distinct;
            for (auto& left : interrupted_erasure(sector)) {
                for (std::size_t offset = 0; offset < left.size(); offset += counter_record_size) {
                    Slot slot;
                    std::copy_n(left.begin() + std::ptrdiff_t(offset), slot.size(), slot.begin());
                    // Every byte position is tried, but most slots are seen again and again.
                    const auto known = reduced_.try_emplace(slot);
                    if (known.second) known.first->second = reduced(slot);
                    std::ranges::copy(known.first->second, left.begin() + std::ptrdiff_t(offset));
                }
                distinct.insert(left);
            }
            for (const auto& left : distinct) {
                sector = left;
                visit(std::as_const(after));
            }
            return;
        }
        Slot record;
        std::ranges::copy(life.record, record.begin());
        auto& slots = programs_[record];
        if (slots.empty()) {
            for (const Slot& slot : interrupted_program(record)) slots.insert(reduced(slot));
        }
        for (const Slot& slot : slots) {
            std::ranges::copy(slot, sector.begin() + std::ptrdiff_t(life.offset));
            visit(std::as_const(after));
        }
    }

private:
    std::map<Slot, Slot> reduced_;
    std::map<Slot, std::set<Slot>> programs_;
};

struct World {
    Memory memory{};
    std::uint64_t acknowledged = 0;
    int interruptions = 0;
    bool has_rotten = false;  ///< a record has
    friend auto operator<=>(const World&, const World&) = default;
};

struct Scope {
    std::uint64_t largest = 5;  ///< counter; four pairs fill a sector
    int interruptions = 1;      ///< losses of power, at most
    bool records_rot = false;
    bool operations_fail = false;
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
            const int operations = live(world, -1);
            for (int fail_at = 0; scope_.operations_fail && fail_at < operations; ++fail_at) {
                live(world, fail_at);
            }
            if (scope_.records_rot && !world.has_rotten) rot(world);
        }
        result_.worlds = seen_.size();
        return result_;
    }

private:
    /// A life to its end, and to every earlier one. Returns how many operations it has.
    int live(const World& world, int fail_at) {
        for (int end_at = 0; result_.violation.empty(); ++end_at) {
            World after = world;
            Life life{.memory = world.memory, .slip = slip_, .end_at = end_at, .fail_at = fail_at};
            ++result_.lives;
            const bool has_ended = run(after, life);
            if (life.programs_twice) broken("a record is programmed over another");
            if (!has_ended) {
                after.memory = life.memory;
                discover(after);
                return life.operations;
            }
            if (++after.interruptions > scope_.interruptions) continue;
            power_loss_.for_each(life, [&](const Memory& left) {
                after.memory = left;
                discover(after);
            });
        }
        return 0;
    }

    bool run(World& world, Life& life) {
        Store store{SimulatedFlash{life}, robot};
        const auto answer = [&](const StorageStatus& status) {
            if (!status) return;
            world.acknowledged = std::max(world.acknowledged, store.stored());
        };
        try {
            auto status = store.open();
            if (status.error == StorageError::missing && world.acknowledged == 0) {
                status = store.create(1);
            }
            check(world, status, store.stored());
            answer(status);
            for (std::uint64_t counter = store.stored() + 1; status && counter <= scope_.largest;) {
                const auto stored = store.store(counter);
                answer(stored);
                if (stored) ++counter;
            }
            return false;
        } catch (const Ends&) {
            return true;
        }
    }

    void check(const World& world, StorageStatus status, std::uint64_t counter) {
        if (status && counter < world.acknowledged) broken("an acknowledged counter is forgotten");
        if (status && counter > scope_.largest) broken("a counter that nobody stored");
        if (!status && status.error != StorageError::device && world.acknowledged > 0) {
            broken(status.error == StorageError::missing ? "an acknowledged counter is forgotten"
                                                         : "it cannot be opened again");
        }
        if (status.error == StorageError::device && !scope_.operations_fail) {
            broken("it cannot be opened again");
        }
    }
    void broken(const char* promise) {
        if (result_.violation.empty()) result_.violation = promise;
    }

    /// One bit of one record.
    void rot(World world) {
        world.has_rotten = true;
        for (std::size_t s = 0; s < 2; ++s) {
            for (std::size_t slot = 0; slot < slots; ++slot) {
                unsigned char& byte = world.memory.sectors[s][slot * counter_record_size + 14];
                if (byte != 0) continue;
                World rotten = world;
                rotten.memory.sectors[s][slot * counter_record_size + 14] = 0x40;
                discover(rotten);
            }
        }
    }
    void discover(const World& world) {
        if (seen_.insert(world).second) open_.push_back(world);
    }

    Slip slip_;
    Scope scope_;
    PowerLoss power_loss_;
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

class FlashLosesNothing : public testing::TestWithParam<RecordedScope> {};

TEST_P(FlashLosesNothing, WhateverHappensToPower) {
    const Result result = explore(Slip::none, GetParam().scope);
    EXPECT_EQ(result.violation, "");
    EXPECT_EQ(result.worlds, GetParam().worlds);
    EXPECT_EQ(result.lives, GetParam().lives);
}

const auto name_of = [](const auto& info) { return std::string{info.param.name}; };
INSTANTIATE_TEST_SUITE_P(SimulatedFlash, FlashLosesNothing,
                         testing::Values(RecordedScope{"PowerOnce", {.largest = 13}, 313, 2961}),
                         name_of);
#ifndef GENE_CLOCKS_SANITIZED  // there the small one has to do
INSTANTIATE_TEST_SUITE_P(
    SimulatedFlashWithFaults, FlashLosesNothing,
    testing::Values(RecordedScope{"PowerThreeTimes", {.interruptions = 3}, 20797, 97886},
                    RecordedScope{
                        "OneRecordRots", {.interruptions = 2, .records_rot = true}, 38587, 169633},
                    RecordedScope{"OperationsFail", {.operations_fail = true}, 6869, 118750}),
    name_of);
#endif

TEST(SimulatedFlashRefutes, ABadChecksumThatIsAccepted) {
    EXPECT_EQ(explore(Slip::checksum_ignored, {.records_rot = true}).violation,
              "a counter that nobody stored");
}
TEST(SimulatedFlashRefutes, OneRecord) {
    EXPECT_EQ(explore(Slip::one_copy, {.records_rot = true}).violation,
              "it cannot be opened again");
}

// What the exploration takes for granted when it reduces slots: bit by bit, an interrupted program
// leaves a slot that reads as erased, as damaged, or as the record itself.
TEST(FlashRecord, IsNeverTakenForAnotherWhileItIsProgrammed) {
    for (const std::uint64_t counter : {1ull, 0x0102030405060708ull, ~0ull}) {
        Slot record;
        std::ranges::copy(write_record(robot, counter),
                          std::as_writable_bytes(std::span{record}).begin());
        for (const Slot& slot : interrupted_program(record)) {
            EXPECT_TRUE(slot == record ||
                        read_record(robot, bytes_of(slot)).error == StorageError::damaged);
        }
    }
}

TEST(FlashStore, KeepsACounterAndCountsItsWear) {
    Life life;
    {
        Store store{SimulatedFlash{life}, robot};
        EXPECT_EQ(store.store(3).error, StorageError::not_open);
        EXPECT_EQ(store.open().error, StorageError::missing);
        EXPECT_EQ(store.create(0).error, StorageError::bad_counter);
        EXPECT_TRUE(store.create(5));
        EXPECT_EQ(store.create(1).error, StorageError::exists);
        for (std::uint64_t counter = 6; counter <= 100; ++counter)
            EXPECT_TRUE(store.store(counter));
        EXPECT_TRUE(store.store(50)) << "a smaller counter is covered";
        EXPECT_EQ(store.flushes(), 96u);
        EXPECT_EQ(store.erasures(), 23u) << "of 96 pairs, four fill a sector";
    }
    Store store{SimulatedFlash{life}, robot};
    EXPECT_TRUE(store.open());
    EXPECT_EQ(store.stored(), 100u);
}

TEST(FlashStore, IsHandedOnWhole) {
    Life life;
    Store first{SimulatedFlash{life}, robot};
    ASSERT_TRUE(first.create(5));
    Store second{std::move(first)};
    EXPECT_EQ(first.stored(), 0u);  // NOLINT(bugprone-use-after-move): what is left is tested
    EXPECT_EQ(first.store(6).error, StorageError::not_open);
    EXPECT_EQ(second.stored(), 5u);
    EXPECT_TRUE(second.store(6));
    EXPECT_EQ(second.flushes(), 2u);
    Store third{SimulatedFlash{life}, robot};
    EXPECT_TRUE(third.open());
    EXPECT_EQ(third.stored(), 6u);
}
static_assert(!std::is_copy_constructible_v<Store>);

TEST(FlashStore, RefusesAnotherRobotsAndWhatItCannotRead) {
    Life life;
    ASSERT_TRUE((Store{SimulatedFlash{life}, robot}.create(5)));
    EXPECT_EQ((Store{SimulatedFlash{life}, RobotId{8}}.open().error), StorageError::other_robot);
    for (auto& sector : life.memory.sectors) sector.fill(0x5a);
    EXPECT_EQ((Store{SimulatedFlash{life}, robot}.open().error), StorageError::damaged);
    EXPECT_EQ((Store{SimulatedFlash{life}, robot}.create(1).error), StorageError::damaged);
}

int copies(const Memory& memory, std::uint64_t counter) {
    int count = 0;
    for (const auto& sector : memory.sectors) {
        for (std::size_t slot = 0; slot < slots; ++slot) {
            const auto bytes = std::span{sector}.subspan(slot * counter_record_size).first<24>();
            count += read_record(robot, std::as_bytes(bytes)).counter == counter;
        }
    }
    return count;
}

TEST(FlashStore, PassesOverASlotThatDoesNotTakeARecord) {
    for (int worn = 0; worn < static_cast<int>(slots); ++worn) {
        Life life;
        life.worn_slot = worn;
        Store store{SimulatedFlash{life}, robot};
        ASSERT_TRUE(store.create(1));
        for (std::uint64_t counter = 2; counter <= 9; ++counter) {
            ASSERT_TRUE(store.store(counter));
            EXPECT_GE(copies(life.memory, counter), 2) << counter;
        }
        Store reopened{SimulatedFlash{life}, robot};
        EXPECT_TRUE(reopened.open());
        EXPECT_EQ(reopened.stored(), 9u);
    }
}

// A record without a twin was never acknowledged, or its twin has rotted. Where no slot is left
// beside it, it cannot be told whether the other sector is still needed; then nothing is erased.
TEST(FlashStore, ErasesNothingThatMayBeNeeded) {
    Life life;
    const auto put = [&](std::size_t sector, std::size_t slot, std::uint64_t counter) {
        Slot record;
        std::ranges::copy(write_record(robot, counter),
                          std::as_writable_bytes(std::span{record}).begin());
        std::ranges::copy(record, life.memory.sectors[sector].begin() +
                                      std::ptrdiff_t(slot * counter_record_size));
    };
    for (std::size_t slot = 0; slot < slots; ++slot) put(0, slot, 5 + slot / 2);
    life.memory.sectors[1].fill(0);
    put(1, slots - 1, 9);
    const Memory before = life.memory;
    EXPECT_EQ((Store{SimulatedFlash{life}, robot}.open().error), StorageError::device);
    EXPECT_EQ(life.memory, before);

    // With a pair beside it, the other sector is superseded.
    put(1, slots - 2, 9);
    Store store{SimulatedFlash{life}, robot};
    EXPECT_TRUE(store.open());
    EXPECT_EQ(store.stored(), 9u);
}

}  // namespace
}  // namespace gene_clocks::test
