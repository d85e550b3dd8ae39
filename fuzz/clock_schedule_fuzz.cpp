// Property: under any schedule of minting, sending, delivery (late, twice, never), forged stamps,
// flushes and crashes, no mark is given twice, a new mark has a larger counter than every gene that
// its robot knows, and no counter passes the maximum. 8-bit counters, so that the end is near.

#include <algorithm>
#include <gene_clocks/gene_clock.hpp>
#include <set>
#include <vector>

#include "fuzz/byte_reader.hpp"
#include "fuzz/require.hpp"

namespace {

using namespace gene_clocks;
using Clock = BasicGeneClock<std::uint8_t>;
using Mark = Clock::Mark;

struct Message {
    Clock::StampType stamp;
    std::set<Mark> genes;
};

/// A robot with memory and disk. Nothing leaves it before the disk holds what must be durable.
struct Robot {
    Clock clock;
    std::uint8_t disk;       // the counter on stable storage
    std::set<Mark> known{};  // genes in memory
};

class Schedule {
public:
    explicit Schedule(fuzz::ByteReader bytes) : bytes_(bytes) {
        limits_.maximum = static_cast<std::uint8_t>(8 + bytes_.below(248));
        limits_.block = bytes_.byte();
        limits_.window = bytes_.byte();
        for (std::uint32_t i = 1; i <= 4; ++i) add_robot(i);
    }

    void run() {
        while (!bytes_.empty()) step();
    }

private:
    static constexpr std::uint8_t genesis_count = 2;

    void add_robot(std::uint32_t id) {
        Clock clock(RobotId{id}, genesis_count, limits_);
        const auto stored = clock.durable_needed();
        robots_.push_back({std::move(clock), stored});
    }

    void step() {
        Robot& robot = robots_[bytes_.below(robots_.size())];
        switch (bytes_.below(6)) {
            case 0:
                mint(robot);
                break;
            case 1:
                robot.disk = robot.clock.durable_needed();
                break;
            case 2:
                send(robot);
                break;
            case 3:
                deliver(robot);
                break;
            case 4:
                forge(robot);
                break;
            default:
                crash(robot);
                break;
        }
        GENE_CLOCKS_REQUIRE(robot.clock.stamp().value <= robot.clock.durable_needed());
        GENE_CLOCKS_REQUIRE(robot.clock.durable_needed() <= limits_.maximum);
    }

    void mint(Robot& robot) {
        const auto count = static_cast<std::uint8_t>(bytes_.below(4));
        const auto before = robot.clock.state();
        const auto marks = robot.clock.mint(count);
        if (!marks) {
            GENE_CLOCKS_REQUIRE(robot.clock.state() == before);
            GENE_CLOCKS_REQUIRE(limits_.maximum - before.next < count);
            return;
        }
        for (std::uint8_t i = 0; i < count; ++i) {
            const Mark mark = (*marks)[i];
            GENE_CLOCKS_REQUIRE(mark.counter > genesis_count && mark.counter < limits_.maximum);
            for (const Mark known : robot.known) {
                GENE_CLOCKS_REQUIRE(known.counter < mark.counter && known < mark);
            }
            robot.known.insert(mark);
            GENE_CLOCKS_REQUIRE(minted_.insert(mark).second);
        }
    }

    void send(Robot& robot) {
        if (robot.clock.durable_needed() > robot.disk) return;
        // What others have seen, and what a crash cannot undo, was created once and for all.
        for (const Mark mark : robot.known) {
            GENE_CLOCKS_REQUIRE(mark.counter < robot.clock.stamp().value);
            if (mark.robot == robot.clock.robot()) GENE_CLOCKS_REQUIRE(minted_.contains(mark));
        }
        messages_.push_back({robot.clock.stamp(), robot.known});
        for (const Mark mark : robot.known) seen_by_others_.insert(mark);
    }

    void deliver(Robot& robot) {
        if (messages_.empty()) return;
        const Message& message =
            messages_[bytes_.below(messages_.size() < 256 ? messages_.size() : 256)];
        const auto before = robot.clock.state();
        if (!robot.clock.observe(message.stamp)) {
            GENE_CLOCKS_REQUIRE(robot.clock.state() == before);
            return;
        }
        GENE_CLOCKS_REQUIRE(robot.clock.stamp() >= message.stamp);
        robot.known.insert(message.genes.begin(), message.genes.end());
    }

    void forge(Robot& robot) {
        const Clock::StampType stamp{bytes_.byte()};
        const auto before = robot.clock.state();
        const bool admitted = robot.clock.observe(stamp);
        GENE_CLOCKS_REQUIRE(robot.clock.stamp().value ==
                            (admitted ? std::max(before.next, stamp.value) : before.next));
        if (admitted) GENE_CLOCKS_REQUIRE(stamp.value <= limits_.maximum);
    }

    /// Memory is lost, the disk stays; genes that the disk does not cover were never seen by
    /// others.
    void crash(Robot& robot) {
        auto restored = Clock::from_state(robot.clock.robot(), {robot.disk, robot.disk}, limits_);
        GENE_CLOCKS_REQUIRE(restored.has_value());
        for (const Mark mark : robot.known) {
            if (mark.robot == robot.clock.robot() && mark.counter >= robot.disk) {
                GENE_CLOCKS_REQUIRE(!seen_by_others_.contains(mark));
                minted_.erase(mark);
            }
        }
        std::erase_if(robot.known, [&](Mark mark) { return mark.counter >= robot.disk; });
        robot.clock = *std::move(restored);
    }

    fuzz::ByteReader bytes_;
    Clock::Limits limits_;
    std::vector<Robot> robots_;
    std::vector<Message> messages_;
    std::set<Mark> minted_;  // less those that a crash undid before anybody saw them
    std::set<Mark> seen_by_others_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Schedule(gene_clocks::fuzz::ByteReader({data, size})).run();
    return 0;
}
