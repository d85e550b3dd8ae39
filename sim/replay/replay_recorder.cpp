#include "sim/replay/replay_recorder.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace gene_clocks::replay {
namespace {

/// The largest whole number up to which JavaScript's are exact.
constexpr std::uint64_t number_limit = (std::uint64_t{1} << 53U) - 1;

/// A tenth of a pixel; in huge arenas more, so that a place takes two bytes at most as a difference
/// of frames.
double place_quantum_px(double size_px) {
    return std::max(0.1, size_px / 65535.0);
}

std::size_t count(std::int64_t value) {
    return static_cast<std::size_t>(value);
}

}  // namespace

ReplayRecorder::ReplayRecorder(const sim::Settings& settings, double size_px,
                               const FrameChoice& frames)
    : frames_(frames),
      quanta_{place_quantum_px(size_px), settings.odneat.energy_maximum / 200.0},
      x_(count(settings.world.robots)),
      y_(count(settings.world.robots)),
      heading_(count(settings.world.robots)),
      energy_(count(settings.world.robots)),
      clock_(count(settings.world.robots)),
      messages_(2) {
    assert(frames.from >= 0 && frames.from < frames.to && frames.every >= 1);
}

void ReplayRecorder::gene_marked(RobotId robot, InnovationNumber mark, double now_cycles) {
    genes_.gene_marked(robot, mark, now_cycles);
}

void ReplayRecorder::message_sent(RobotId robot, Stamp, InnovationNumber) {
    senders_.push_back(static_cast<std::uint32_t>(robot) - 1);
}

void ReplayRecorder::message_admitted(RobotId robot, std::uint64_t message, Stamp) {
    ++received_;
    heard_now_.push_back(senders_[message] * x_.columns() + static_cast<std::uint32_t>(robot) - 1);
}

void ReplayRecorder::between_cycles(const sim::SwarmView& swarm) {
    genes_.between_cycles(swarm);
    if (frames_.includes(swarm.cycle)) {
        put_robots(swarm);
        put_heard();
        put_items(swarm);
        row_.assign({static_cast<std::int64_t>(senders_.size()), received_});
        messages_.put_row(row_);
    }
    // Before the first frame and after the last one nobody asks.
    if (swarm.cycle < frames_.from || swarm.cycle >= frames_.to) heard_now_.clear();
}

void ReplayRecorder::put_robots(const sim::SwarmView& swarm) {
    const std::size_t robots = swarm.agents.size();
    const auto put = [&](RowStream& stream, auto value_of) {
        row_.resize(robots);
        for (std::size_t i = 0; i < robots; ++i) row_[i] = value_of(i);
        stream.put_row(row_);
    };
    put(x_, [&](std::size_t i) { return std::llround(swarm.x_px[i] / quanta_.place_px); });
    put(y_, [&](std::size_t i) { return std::llround(swarm.y_px[i] / quanta_.place_px); });
    put(heading_, [&](std::size_t i) {
        const double turns =
            std::atan2(swarm.heading_y[i], swarm.heading_x[i]) / (2.0 * std::numbers::pi);
        return std::llround(turns * Quanta::headings) & (Quanta::headings - 1);
    });
    put(energy_,
        [&](std::size_t i) { return std::llround(swarm.agents[i].energy() / quanta_.energy); });
    put(clock_, [&](std::size_t i) {
        const std::uint64_t stamp = swarm.agents[i].source().stamp().value;
        return static_cast<std::int64_t>(std::min(stamp, number_limit));
    });
}

void ReplayRecorder::put_heard() {
    std::ranges::sort(heard_now_);
    const auto repeated = std::ranges::unique(heard_now_);
    heard_now_.erase(repeated.begin(), repeated.end());
    heard_.put(heard_now_.size());
    std::uint64_t before = 0;
    for (const std::uint64_t pair : heard_now_) {
        heard_.put(pair - before);
        before = pair;
    }
    heard_now_.clear();
}

void ReplayRecorder::put_items(const sim::SwarmView& swarm) {
    const std::size_t items = swarm.item_is_present.size();
    item_places_.resize(items);
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < items; ++i) {
        ItemPlace place;
        if (swarm.item_is_present[i] != 0) {
            place = {std::llround(swarm.item_x_px[i] / quanta_.place_px),
                     std::llround(swarm.item_y_px[i] / quanta_.place_px)};
        }
        if (place == item_places_[i]) continue;
        item_places_[i] = place;
        changed.push_back(i);
    }
    items_.put(changed.size());
    for (const std::size_t i : changed) {
        items_.put(i);
        const ItemPlace& place = item_places_[i];
        items_.put(place.x >= 0 ? 1 : 0);
        if (place.x < 0) continue;
        items_.put(static_cast<std::uint64_t>(place.x));
        items_.put(static_cast<std::uint64_t>(place.y));
    }
}

}  // namespace gene_clocks::replay
