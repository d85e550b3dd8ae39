#include "sim/core/src/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gene_clocks::sim {
namespace {

constexpr int placement_tries = 100000;

float square(float value) {
    return value * value;
}

/// How far apart two robots can be and still sense each other.
float neighbour_reach_px(const WorldSettings& world) {
    return static_cast<float>(world.sensor_range_px + 2 * world.robot_radius_px);
}

/// How far an item's centre can be from a robot's and still matter to it.
float item_reach_px(const WorldSettings& world) {
    const double seen = world.sensor_range_px + world.robot_radius_px + world.item_radius_px;
    return static_cast<float>(std::max(seen, world.item_reach_px));
}

}  // namespace

World::World(const Settings& settings, std::shared_ptr<const ArenaMap> map,
             neat::RandomStream& random)
    : settings_(settings.world),
      has_items_(settings.task == Task::collection),
      range_px_(static_cast<float>(settings_.sensor_range_px)),
      radio_range_px_(static_cast<float>(settings.radio.range_px)),
      radius_px_(static_cast<float>(settings_.robot_radius_px)),
      meeting_px_(static_cast<float>(2 * (settings_.robot_radius_px + settings_.translation_px))),
      item_radius_px_(static_cast<float>(settings_.item_radius_px)),
      item_reach_px_(static_cast<float>(settings_.item_reach_px)),
      map_(std::move(map)),
      neighbours_(static_cast<std::size_t>(settings_.robots), map_->width_px(), map_->height_px(),
                  neighbour_reach_px(settings_), static_cast<float>(settings_.translation_px)),
      items_(has_items_ ? static_cast<std::size_t>(settings_.items) : 0, map_->width_px(),
             map_->height_px(), sim::item_reach_px(settings_)) {
    const auto robots = static_cast<std::size_t>(settings_.robots);
    for (auto* values :
         {&x_px_, &y_px_, &cosine_, &sine_, &translation_px_, &planned_x_px_, &planned_y_px_}) {
        values->assign(robots, 0.0f);
    }
    senses_.resize(robots);
    near_.resize(robots);
    for (std::size_t item = 0; item < items_.size(); ++item) {
        if (!put_item(item, random))
            throw std::runtime_error("the arena has no free place for an item");
    }
    place_robots(random);
    planned_x_px_ = x_px_;
    planned_y_px_ = y_px_;
    neighbours_.update(x_px_, y_px_);
    sense();
}

template <class IsFree>
std::optional<World::Place> World::find_place(neat::RandomStream& random, IsFree is_free) const {
    for (int attempt = 0; attempt < placement_tries; ++attempt) {
        const auto x = static_cast<float>(random.uniform(0.0, map_->width_px()));
        const auto y = static_cast<float>(random.uniform(0.0, map_->height_px()));
        if (is_free(x, y)) return Place{x, y};
    }
    return std::nullopt;
}

void World::place_robots(neat::RandomStream& random) {
    for (std::size_t i = 0; i < robots(); ++i) {
        const auto place =
            find_place(random, [&](float x, float y) { return is_free_for_robot(x, y, i); });
        if (!place) throw std::runtime_error("the arena has no free place for a robot");
        x_px_[i] = place->x_px;
        y_px_[i] = place->y_px;
        // A uniform direction from the unit disc, since libraries' sines differ.
        double dx = 0.0;
        double dy = 0.0;
        double length = 0.0;
        do {
            dx = random.uniform(-1.0, 1.0);
            dy = random.uniform(-1.0, 1.0);
            length = std::sqrt(dx * dx + dy * dy);
        } while (!(length <= 1.0 && length > 1e-3));
        cosine_[i] = static_cast<float>(dx / length);
        sine_[i] = static_cast<float>(dy / length);
    }
}

bool World::is_free_for_robot(float x, float y, std::size_t placed) const {
    if (map_->robot_touches_wall(x, y)) return false;
    for (std::size_t j = 0; j < placed; ++j) {
        if (std::abs(x_px_[j] - x) + std::abs(y_px_[j] - y) < 2 * radius_px_) return false;
    }
    for (std::size_t item = 0; item < items_.size(); ++item) {
        if (items_.is_present(item) &&
            square(items_.x_px(item) - x) + square(items_.y_px(item) - y) <
                square(item_radius_px_ + radius_px_)) {
            return false;
        }
    }
    return true;
}

bool World::is_free_for_item(float x, float y) const {
    if (map_->disc_touches_wall(x, y, item_radius_px_)) return false;
    for (std::size_t j = 0; j < robots(); ++j) {
        if (square(x_px_[j] - x) + square(y_px_[j] - y) < square(item_radius_px_ + radius_px_)) {
            return false;
        }
    }
    for (std::size_t item = 0; item < items_.size(); ++item) {
        if (items_.is_present(item) &&
            square(items_.x_px(item) - x) + square(items_.y_px(item) - y) <
                square(2 * item_radius_px_)) {
            return false;
        }
    }
    return true;
}

bool World::put_item(std::size_t item, neat::RandomStream& random) {
    const auto place = find_place(random, [&](float x, float y) { return is_free_for_item(x, y); });
    if (place) items_.put(item, place->x_px, place->y_px);
    return place.has_value();
}

void World::replace_items(neat::RandomStream& random) {
    if (items_.absent() == 0) return;
    for (std::size_t item = 0; item < items_.size(); ++item) {
        if (items_.count_down(item)) put_item(item, random);
    }
}

bool World::pick_up(std::size_t robot) {
    if (!senses_[robot].reaches_item) return false;
    const float x = x_px_[robot];
    const float y = y_px_[robot];
    std::optional<std::size_t> found;
    items_.visit_near(x, y, [&](std::size_t item) {
        const float distance_square = square(items_.x_px(item) - x) + square(items_.y_px(item) - y);
        if (!found && distance_square < square(item_reach_px_)) found = item;
    });
    if (found) items_.take(*found, settings_.item_absence_cycles);
    return found.has_value();
}

namespace {

/// What turn_and_plan works on: arrays with one entry for each robot.
struct Motion {
    std::size_t robots;
    float translation_max_px, acceleration_px, rotation_max_rad;
    const float* translation;
    const float* rotation;
    const float* x_px;
    const float* y_px;
    float* cosine;
    float* sine;
    float* translation_px;
    float* planned_x_px;
    float* planned_y_px;
};

}  // namespace

/// Turns all headings and plans where each robot would be, were there nothing in its way.
GENE_CLOCKS_MULTIVERSION
static void turn_and_plan(const Motion& motion) {
    const std::size_t robots = motion.robots;
    const float* __restrict translation = motion.translation;
    const float* __restrict rotation = motion.rotation;
    const float* __restrict x_px = motion.x_px;
    const float* __restrict y_px = motion.y_px;
    float* __restrict cosine = motion.cosine;
    float* __restrict sine = motion.sine;
    float* __restrict translation_px = motion.translation_px;
    float* __restrict planned_x_px = motion.planned_x_px;
    float* __restrict planned_y_px = motion.planned_y_px;
    for (std::size_t i = 0; i < robots; ++i) {
        // Taylor polynomials, good to 1e-6 for angles up to 60°.
        const float angle = rotation[i] * motion.rotation_max_rad;
        const float a2 = angle * angle;
        const float s = angle * (1.0f + a2 * (-1.0f / 6 + a2 * (1.0f / 120 + a2 * (-1.0f / 5040))));
        const float c =
            1.0f + a2 * (-0.5f + a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 * (1.0f / 40320))));
        const float turned_cosine = cosine[i] * c - sine[i] * s;
        const float turned_sine = sine[i] * c + cosine[i] * s;
        // One Newton step of 1/√ keeps the length at 1.
        const float norm =
            1.5f - 0.5f * (turned_cosine * turned_cosine + turned_sine * turned_sine);
        cosine[i] = turned_cosine * norm;
        sine[i] = turned_sine * norm;

        float step = translation[i] * motion.translation_max_px;
        const float slowest = translation_px[i] - motion.acceleration_px;
        const float fastest = translation_px[i] + motion.acceleration_px;
        step = step < slowest ? slowest : step;
        step = step > fastest ? fastest : step;
        translation_px[i] = step;
        planned_x_px[i] = x_px[i] + step * cosine[i];
        planned_y_px[i] = y_px[i] + step * sine[i];
    }
}

bool World::collides(std::size_t robot, float x, float y) const {
    bool hit = map_->robot_touches_wall(x, y);
    if (senses_[robot].meets_robot) {
        for (const std::uint32_t other : neighbours_.near(robot)) {
            hit |= std::abs(x_px_[other] - x) + std::abs(y_px_[other] - y) < 2 * radius_px_;
        }
    }
    if (has_items_) {
        items_.visit_near(x, y, [&](std::size_t item) {
            // Distance from the disc's centre to the diamond, a square in (u, v).
            const float dx = items_.x_px(item) - x;
            const float dy = items_.y_px(item) - y;
            const float u = std::max(std::abs(dx + dy) - radius_px_, 0.0f);
            const float v = std::max(std::abs(dy - dx) - radius_px_, 0.0f);
            hit |= u * u + v * v < 2 * square(item_radius_px_);
        });
    }
    return hit;
}

std::uint64_t World::move(std::span<const float> translation, std::span<const float> rotation,
                          std::span<const std::uint32_t> order) {
    turn_and_plan({robots(), static_cast<float>(settings_.translation_px),
                   static_cast<float>(settings_.acceleration_px),
                   static_cast<float>(settings_.rotation_deg * std::numbers::pi / 180),
                   translation.data(), rotation.data(), x_px_.data(), y_px_.data(), cosine_.data(),
                   sine_.data(), translation_px_.data(), planned_x_px_.data(),
                   planned_y_px_.data()});
    neighbours_.update(x_px_, y_px_);
    std::uint64_t collisions = 0;
    for (const std::uint32_t i : order) {
        if (collides(i, planned_x_px_[i], planned_y_px_[i])) {
            translation_px_[i] = 0.0f;
            ++collisions;
        } else {
            x_px_[i] = planned_x_px_[i];
            y_px_[i] = planned_y_px_[i];
        }
    }
    return collisions;
}

}  // namespace gene_clocks::sim
