// A robot in a process of its own is killed with SIGKILL at random points, a thousand times. All
// that is checked is what another process has seen of it: no mark twice, and the clock condition.
//
// A killed process loses its memory, and leaves files half replaced. It loses nothing that the
// kernel has; for a loss of power there is simulated_disk_test.cpp.
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <gene_clocks/gene_clock.hpp>
#include <gene_clocks/storage/file_store.hpp>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>

#include "tests/support/temporary_folder.hpp"

namespace gene_clocks {
namespace {

using storage::FileStore;
using storage::PosixFiles;

constexpr RobotId robot{7};

/// What leaves the robot: the newest of its marks, and its stamp. Small enough that a pipe carries
/// it whole or not at all.
struct Broadcast {
    std::uint64_t mark = 0;
    std::uint64_t stamp = 0;
};

/// How the robot goes about its work; the second is what the test must notice.
enum class Habit { stores_first, sends_first };

[[noreturn]] void die(const std::string& why) {
    (void)!::write(STDERR_FILENO, why.data(), why.size());
    ::_exit(1);
}

/// The robot's process. It reads stamps of others from `in`, which is polled, and broadcasts to
/// `out` until it is killed.
[[noreturn]] void live(const std::string& folder, std::uint64_t block, Habit habit, int in,
                       int out) {
    FileStore store{PosixFiles{folder}, robot};
    auto status = store.open();
    if (status.error == StorageError::missing) status = store.create(1);
    if (!status) die("the store cannot be opened\n");
    auto clock = GeneClock::restart(robot, store.stored(), 0, {.block = block});
    if (!clock) die("the clock does not come back\n");

    for (;;) {
        pollfd readable{in, POLLIN, 0};
        std::uint64_t stamp = 0;
        if (::poll(&readable, 1, 0) == 1 && ::read(in, &stamp, sizeof stamp) == sizeof stamp &&
            !clock->observe(Stamp{stamp})) {
            die("a stamp is refused\n");
        }
        const auto mark = clock->mint();
        if (!mark) die("exhausted\n");
        const Broadcast broadcast{mark->counter, clock->stamp().value};
        if (habit == Habit::stores_first && !store.store(clock->durable_needed())) {
            die("not stored\n");
        }
        if (::write(out, &broadcast, sizeof broadcast) != sizeof broadcast) die("not sent\n");
        if (habit == Habit::sends_first && !store.store(clock->durable_needed())) {
            die("not stored\n");
        }
    }
}

struct Pipe {
    Pipe() {
        if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    }
    ~Pipe() {
        for (const int end : ends) {
            if (end >= 0) ::close(end);
        }
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void close(int which) { ::close(std::exchange(ends[which], -1)); }
    int ends[2];
};

/// What another robot has seen of this one, over all its lives.
struct Witness {
    std::uint64_t floor = 1;  ///< everything that it makes from now on has at least this counter
    std::uint64_t broadcasts = 0;
    int silent_lives = 0;
    std::optional<std::string> broken{};

    void hear(const Broadcast& heard) {
        ++broadcasts;
        // All marks are of one robot, so an order without repetition is uniqueness and the clock
        // condition in one: each mark was made after the message before it had been sent.
        if (heard.mark < floor) {
            broken = "mark " + std::to_string(heard.mark) + " after stamp " + std::to_string(floor);
        }
        if (heard.stamp <= heard.mark) broken = "a stamp that does not cover its mark";
        floor = std::max(floor, heard.stamp);
    }
};

/// One life: start, listen, kill after a random time, hear what was still under way.
void watch_one_life(const std::string& folder, std::uint64_t block, Habit habit,
                    std::mt19937_64& random, Witness& witness) {
    Pipe to_robot;
    Pipe from_robot;
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) live(folder, block, habit, to_robot.ends[0], from_robot.ends[1]);
    from_robot.close(1);

    // Another robot runs ahead at times; its stamp takes the clock along.
    if (random() % 2 == 0) {
        const std::uint64_t stamp = witness.floor + random() % 100;
        ASSERT_EQ(::write(to_robot.ends[1], &stamp, sizeof stamp), ssize_t{sizeof stamp});
    }
    // A life that is to last waits for the first broadcast, others may end before it.
    const bool lasts = random() % 4 != 0;
    const auto before = witness.broadcasts;
    Broadcast heard;
    if (lasts && ::read(from_robot.ends[0], &heard, sizeof heard) == sizeof heard) {
        witness.hear(heard);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 1000));
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "it ended by itself";
    while (::read(from_robot.ends[0], &heard, sizeof heard) == sizeof heard) witness.hear(heard);
    if (witness.broadcasts == before) ++witness.silent_lives;
}

Witness watch(int lives, std::uint64_t block, Habit habit) {
    const test::TemporaryFolder folder{test::memory_folder()};
    std::mt19937_64 random{block};
    Witness witness;
    for (int life = 0; life < lives && !witness.broken && !testing::Test::HasFailure(); ++life) {
        watch_one_life(folder.path().string(), block, habit, random, witness);
    }
    return witness;
}

class KilledProcess : public testing::TestWithParam<std::uint64_t> {};

TEST_P(KilledProcess, NeverMakesAMarkTwiceInFiveHundredLives) {
    const Witness witness = watch(500, GetParam(), Habit::stores_first);
    EXPECT_EQ(witness.broken, std::nullopt);
    EXPECT_GT(witness.broadcasts, 500u);
    std::cout << witness.broadcasts << " broadcasts, " << witness.silent_lives << " silent lives\n";
}

INSTANTIATE_TEST_SUITE_P(Block, KilledProcess, testing::Values(0, 50),
                         testing::PrintToStringParamName());

// The control: the same witness, and a robot that breaks the rule.
TEST(KilledProcess, IsCaughtWhereItSendsBeforeItStores) {
    EXPECT_NE(watch(500, 0, Habit::sends_first).broken, std::nullopt);
}

}  // namespace
}  // namespace gene_clocks
