#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gene_clocks/admission_gate.hpp>
#include <gene_clocks/gene_clock.hpp>
#include <limits>
#include <random>
#include <ranges>
#include <vector>

namespace gene_clocks::test {

/// What hostile robots put into their messages.
enum class Attack {
    arbitrary,  ///< any 64-bit number
    greedy,     ///< whatever advances the receiver most; they know its clock and its policy
};

struct FleetSettings {
    int robots = 100;
    int hostile = 0;  ///< of the robots; the others are honest
    Attack attack = Attack::arbitrary;
    std::uint64_t window = std::numeric_limits<std::uint64_t>::max();  ///< counters
    AdmissionGate::Policy admission{};
    int cycles = 100'000;
    int heard_per_cycle = 2;              ///< messages that a robot receives, of random senders
    std::uint64_t cycles_per_gene = 100;  ///< that an honest robot makes, on average
    std::uint64_t seed = 1;
    /// For the first cycles, the first tenth of the robots hears only itself.
    int partition_cycles = 0;
};

struct FleetResult {
    std::uint64_t smallest_clock = 0;  ///< of honest robots, after the last cycle
    std::uint64_t largest_clock = 0;
    std::uint64_t genes = 0;           ///< made by honest robots
    std::uint64_t genes_not_made = 0;  ///< since the clock was exhausted
    std::uint64_t honest_heard = 0;    ///< messages of honest robots to honest robots …
    std::uint64_t honest_refused = 0;  ///< … and how many of them were refused
    std::uint64_t hostile_heard = 0;
    std::uint64_t hostile_refused = 0;
};

/// Honest robots that mint and gossip, and hostile ones that send what they like.
class HostileFleet {
public:
    explicit HostileFleet(const FleetSettings& settings)
        : settings_{settings}, random_{settings.seed} {
        for (int r = 0; r < settings.robots - settings.hostile; ++r) {
            honest_.push_back(
                {GeneClock{
                     RobotId{static_cast<std::uint32_t>(r + 1)}, 0, {.window = settings.window}},
                 AdmissionGate{settings.admission}});
        }
    }

    FleetResult run() {
        for (int cycle = 0; cycle < settings_.cycles; ++cycle) {
            for (std::size_t r = 0; r < honest_.size(); ++r) {
                Robot& robot = honest_[r];
                robot.gate.elapse();
                if (random_() % settings_.cycles_per_gene == 0) {
                    ++(robot.clock.mint() ? result_.genes : result_.genes_not_made);
                }
                for (int i = 0; i < settings_.heard_per_cycle; ++i) hear(r, cycle);
            }
        }
        result_.smallest_clock = std::numeric_limits<std::uint64_t>::max();
        for (const Robot& robot : honest_) {
            const auto next = robot.clock.stamp().value;
            result_.smallest_clock = std::min(result_.smallest_clock, next);
            result_.largest_clock = std::max(result_.largest_clock, next);
        }
        return result_;
    }

private:
    struct Robot {
        GeneClock clock;
        AdmissionGate gate;
    };

    void hear(std::size_t receiver, int cycle) {
        const auto sender =
            static_cast<std::size_t>(random_() % static_cast<std::uint64_t>(settings_.robots));
        const bool is_hostile = sender >= honest_.size();
        const std::size_t tenth = honest_.size() / 10;
        if (cycle < settings_.partition_cycles && (sender < tenth) != (receiver < tenth)) return;
        Robot& robot = honest_[receiver];
        const Stamp stamp = is_hostile ? forged(robot) : honest_[sender].clock.stamp();
        const bool is_refused =
            robot.gate.admit(robot.clock, stamp, std::views::empty<InnovationNumber>) !=
            Admission::admitted;
        ++(is_hostile ? result_.hostile_heard : result_.honest_heard);
        (is_hostile ? result_.hostile_refused : result_.honest_refused) += is_refused;
    }

    Stamp forged(const Robot& robot) {
        if (settings_.attack == Attack::arbitrary) return {random_()};
        const auto next = robot.clock.stamp().value;
        const auto leap = std::min({settings_.window, robot.gate.allowance(),
                                    std::numeric_limits<std::uint64_t>::max() - next});
        return {next + leap};
    }

    FleetSettings settings_;
    std::mt19937_64 random_;
    std::vector<Robot> honest_;
    FleetResult result_;
};

}  // namespace gene_clocks::test
