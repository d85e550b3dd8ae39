#pragma once

#include <cstdint>
#include <gene_clocks/sim/run_observer.hpp>
#include <gene_clocks/sim/settings.hpp>
#include <gene_clocks/sim/swarm_view.hpp>
#include <vector>

#include "sim/replay/gene_history.hpp"
#include "sim/replay/number_stream.hpp"

namespace gene_clocks::replay {

/// Which cycles of a run become frames: from, from + every, …, and always the last one, `to`.
struct FrameChoice {
    std::int64_t from{};
    std::int64_t to{};       ///< invariant: from < to ≤ the run's cycles
    std::int64_t every = 1;  ///< invariant: ≥ 1

    std::int64_t frames() const { return (to - from + every - 1) / every + 1; }
    bool includes(std::int64_t cycle) const {
        return cycle >= from && cycle <= to && ((cycle - from) % every == 0 || cycle == to);
    }
};

/// Whole numbers stand for real ones in frames; this is what one of them is worth.
struct Quanta {
    double place_px{};
    double energy{};
    static constexpr int headings = 64;  ///< to a full turn
};

/// Records a run for a page that shows it again: frames of chosen cycles, and the history of all
/// genes over the whole run. Changes nothing in the run.
class ReplayRecorder final : public sim::RunObserver {
public:
    /// `frames` must hold its invariants; `size_px` is the arena's longer side.
    ReplayRecorder(const sim::Settings& settings, double size_px, const FrameChoice& frames);

    void gene_marked(RobotId robot, InnovationNumber mark, double now_cycles) override;
    void message_sent(RobotId robot, Stamp stamp, InnovationNumber newest) override;
    void message_admitted(RobotId robot, std::uint64_t message, Stamp stamp) override;
    void between_cycles(const sim::SwarmView& swarm) override;

    const FrameChoice& frame_choice() const { return frames_; }
    const Quanta& quanta() const { return quanta_; }
    const GeneHistory& genes() const { return genes_; }

    // One row for each frame, one column for each robot.
    const RowStream& x() const { return x_; }
    const RowStream& y() const { return y_; }
    const RowStream& heading() const { return heading_; }
    const RowStream& energy() const { return energy_; }
    const RowStream& clock() const {
        return clock_;
    }  ///< what the robot would stamp a message with

    /// One row for each frame: messages sent so far, and received.
    const RowStream& messages() const { return messages_; }

    /// For each frame: how many pairs, then these as sender · robots + receiver, ascending, as
    /// differences: who has heard whom since the frame before. Robots count from 0.
    const NumberStream& heard() const { return heard_; }

    /// For each frame: how many items have changed since the frame before, then each as its index,
    /// and 0 if it is absent or 1 and its place.
    const NumberStream& items() const { return items_; }

private:
    struct ItemPlace {
        std::int64_t x = -1, y = -1;  // quanta; −1: absent
        bool operator==(const ItemPlace&) const = default;
    };

    void put_robots(const sim::SwarmView& swarm);
    void put_heard();
    void put_items(const sim::SwarmView& swarm);

    FrameChoice frames_;
    Quanta quanta_;
    GeneHistory genes_;
    RowStream x_, y_, heading_, energy_, clock_, messages_;
    NumberStream heard_, items_;

    std::vector<std::uint32_t> senders_;  // by number of the message; index from 0
    std::int64_t received_ = 0;
    std::vector<std::uint64_t> heard_now_;  // pairs since the last frame, repeated ones included
    std::vector<ItemPlace> item_places_;    // as of the last frame
    std::vector<std::int64_t> row_;         // room for one
};

}  // namespace gene_clocks::replay
