#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

namespace gene_clocks::sim {

/// Which genes each robot can have heard of: happened-before through messages (Lamport 1978), kept
/// as vector clocks that count the genes of each robot. Robots are indices.
class CausalPast {
public:
    CausalPast(std::size_t robots, std::int64_t delay_cycles);

    void created(std::uint32_t robot);

    /// A robot sent the message of that number. Numbers ascend by one, cycles do not descend.
    void sent(std::uint32_t robot, std::uint64_t message, std::int64_t cycle) {
        last_sender_ = robot;
        if (delay_cycles_ > 0) hold(message, cycle);
    }

    /// A robot admitted a message: the one that was sent last, or with a delay one that was sent
    /// at most so many cycles ago.
    void admitted(std::uint32_t receiver, std::uint64_t message) {
        if (delay_cycles_ > 0) return admit_held(receiver, message);
        heard_.push_back({last_sender_, receiver});
        if (heard_.size() == heard_most) catch_up();
    }

    /// How many genes of each robot this one can have heard of, its own included: the first ones.
    std::span<const std::int32_t> known(std::uint32_t robot) {
        catch_up();
        return {row(robot), robots_};
    }

private:
    using Vector = std::vector<std::int32_t>;

    /// A message that came without a delay.
    struct Hearing {
        std::uint32_t sender{};
        std::uint32_t receiver{};
    };
    /// A message that may still be admitted.
    struct Flight {
        std::uint32_t sender{};
        std::uint32_t epoch{};  // of the sender at sending
        std::int64_t cycle{};
        std::shared_ptr<const Vector> known;  // by the sender at sending
    };
    /// What messages of one robot and epoch share.
    struct Snapshot {
        std::uint32_t epoch{};
        std::shared_ptr<const Vector> known;  // null before the first
    };

    void hold(std::uint64_t message, std::int64_t cycle);
    void admit_held(std::uint32_t receiver, std::uint64_t message);
    /// Takes over what the messages in heard_ said. They come many times as often as genes, and
    /// cost least where all of them are looked at together.
    void catch_up();
    void admit(std::uint32_t receiver, std::uint32_t sender, std::uint32_t epoch,
               const std::int32_t* known);
    std::int32_t* row(std::uint32_t robot) { return known_.data() + robot * robots_; }
    std::shared_ptr<const Vector> snapshot(std::uint32_t robot);

    static constexpr std::size_t heard_most = 512;

    std::size_t robots_;
    std::int64_t delay_cycles_;
    Vector known_;                       // a row for each robot
    std::vector<std::uint32_t> epochs_;  // of each robot: goes up whenever its row changes
    std::vector<std::uint32_t> merged_;  // a row for each sender: its last epoch at each receiver
    std::uint32_t last_sender_ = 0;
    std::vector<Hearing> heard_;       // in order; fewer than heard_most
    std::vector<Snapshot> snapshots_;  // with a delay: one for each robot
    std::deque<Flight> in_flight_;     // with a delay: messages first_message_, …
    std::uint64_t first_message_ = 0;
};

}  // namespace gene_clocks::sim
