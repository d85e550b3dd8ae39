#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <gene_clocks/sim/settings.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "tests/sim/core/naive_geometry.hpp"
#include "tests/sim/core/watched_run.hpp"

/// What robots sense, compute and ask for, written down again in the plainest way, in double
/// precision and from notes of a run (watched_run.hpp): rays against edges, sums over connections.
namespace gene_clocks::sim::naive {

struct Point {
    double x, y;
};

/// How far along a ray of unit length per `d` the edge from `a` to `b` is met; infinity if it is
/// not.
inline double distance_along(Point from, Point d, Point a, Point b) {
    const Point edge{b.x - a.x, b.y - a.y};
    const double cross = d.x * edge.y - d.y * edge.x;
    if (cross == 0.0) return std::numeric_limits<double>::infinity();
    const Point to{a.x - from.x, a.y - from.y};
    const double along = (to.x * edge.y - to.y * edge.x) / cross;
    const double share = (to.x * d.y - to.y * d.x) / cross;
    const bool meets = along >= 0.0 && share >= 0.0 && share <= 1.0;
    return meets ? along : std::numeric_limits<double>::infinity();
}

template <std::size_t N>
double distance_along(Point from, Point d, const std::array<Point, N>& corners) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < N; ++i) {
        nearest = std::min(nearest, distance_along(from, d, corners[i], corners[(i + 1) % N]));
    }
    return nearest;
}

inline std::array<Point, 4> corners_of(const ThickSegment& wall) {
    const double length = std::hypot(wall.x2_px - wall.x1_px, wall.y2_px - wall.y1_px);
    const double nx = -(wall.y2_px - wall.y1_px) / length * wall.thickness_px / 2;
    const double ny = (wall.x2_px - wall.x1_px) / length * wall.thickness_px / 2;
    return {Point{wall.x1_px + nx, wall.y1_px + ny}, Point{wall.x2_px + nx, wall.y2_px + ny},
            Point{wall.x2_px - nx, wall.y2_px - ny}, Point{wall.x1_px - nx, wall.y1_px - ny}};
}

inline double wall_along(const Arena& arena, Point from, Point d) {
    const double right = arena.width_px - arena.frame_right_px;
    const double bottom = arena.height_px - arena.frame_bottom_px;
    double nearest = distance_along(
        from, d,
        std::array{Point{arena.frame_left_px, arena.frame_top_px}, Point{right, arena.frame_top_px},
                   Point{right, bottom}, Point{arena.frame_left_px, bottom}});
    for (const ThickSegment& wall : arena.walls) {
        nearest = std::min(nearest, distance_along(from, d, corners_of(wall)));
    }
    return nearest;
}

inline double disc_along(Point from, Point d, Point centre, double radius) {
    const double along = (centre.x - from.x) * d.x + (centre.y - from.y) * d.y;
    const double aside = (centre.x - from.x) * d.y - (centre.y - from.y) * d.x;
    if (along <= 0.0 || std::abs(aside) > radius) return std::numeric_limits<double>::infinity();
    return std::max(along - std::sqrt(radius * radius - aside * aside), 0.0);
}

/// What one ray meets first.
struct Met {
    double reading = 1.0;  // 0 touching … 1 nothing in range
    bool is_item = false;
    int robot = -1;
};

/// A robot's situation when it is about to act: what its rays met, and which items were there then.
struct Sight {
    std::array<Met, 8> rays;
    double nearest_obstacle = 1.0;
};

/// The items that stood there when the robots last looked: those that reappeared since do not
/// count.
inline std::vector<Point> items_seen(const watched::Run& run, std::size_t t) {
    std::vector<Point> seen;
    for (std::size_t i = 0; i < run.moments[t].items.size(); ++i) {
        const watched::Item& now = run.moments[t].items[i];
        if (!now.is_present) continue;
        if (t > 0) {
            const watched::Item& before = run.moments[t - 1].items[i];
            const bool stood =
                before.is_present && before.x_px == now.x_px && before.y_px == now.y_px;
            if (!stood) continue;
        }
        seen.push_back({now.x_px, now.y_px});
    }
    return seen;
}

/// Ray 0 points left of the heading, the others follow clockwise; y points down.
inline Sight look(const Settings& settings, const Arena& arena, const watched::Run& run,
                  std::size_t t, std::size_t robot) {
    const WorldSettings& world = settings.world;
    const double radius = world.robot_radius_px;
    const auto& robots = run.moments[t].robots;
    const watched::Robot& self = robots[robot];
    const Point from{self.x_px, self.y_px};
    const auto items = items_seen(run, t);
    Sight sight;
    for (std::size_t ray = 0; ray < sight.rays.size(); ++ray) {
        const double angle = std::atan2(self.heading_y, self.heading_x) +
                             (static_cast<double>(ray) - 2.0) * std::numbers::pi / 4;
        const Point d{std::cos(angle), std::sin(angle)};
        double nearest = wall_along(arena, from, d);
        Met& met = sight.rays[ray];
        for (std::size_t other = 0; other < robots.size(); ++other) {
            if (other == robot) continue;
            const double x = robots[other].x_px;
            const double y = robots[other].y_px;
            const double along =
                distance_along(from, d,
                               std::array{Point{x + radius, y}, Point{x, y + radius},
                                          Point{x - radius, y}, Point{x, y - radius}});
            if (along < nearest) nearest = along, met.robot = static_cast<int>(other);
        }
        for (const Point& item : items) {
            const double along = disc_along(from, d, item, world.item_radius_px);
            if (along < nearest) nearest = along, met.robot = -1, met.is_item = true;
        }
        met.reading = std::clamp((nearest - radius) / world.sensor_range_px, 0.0, 1.0);
        if (met.reading == 1.0) met.is_item = false;
        if (nearest - radius > settings.radio.range_px) met.robot = -1;
        if (!met.is_item) sight.nearest_obstacle = std::min(sight.nearest_obstacle, met.reading);
    }
    return sight;
}

/// The controller's inputs: eight obstacle readings, in collection eight item readings, the energy
/// as a share of its maximum, the bias. 1 is nothing in range.
inline std::vector<double> inputs_of(const Settings& settings, const Sight& sight, double energy) {
    std::vector<double> inputs;
    for (const Met& met : sight.rays) inputs.push_back(met.is_item ? 1.0 : met.reading);
    if (settings.task == Task::collection) {
        for (const Met& met : sight.rays) inputs.push_back(met.is_item ? met.reading : 1.0);
    }
    inputs.push_back(energy / settings.odneat.energy_maximum);
    inputs.push_back(1.0);
    return inputs;
}

/// Outputs of a genome without hidden neurons and recurrent connections, for given inputs.
inline std::array<double, 2> outputs_of(const neat::Genome& genome, double slope,
                                        const std::vector<double>& inputs) {
    std::array<double, 2> sums{};
    const neat::Topology& topology = *genome.topology;
    for (std::size_t i = 0; i < genome.connections(); ++i) {
        const auto source = topology.find_neuron(topology.connection_ends[i].source).value();
        const auto target = topology.find_neuron(topology.connection_ends[i].target).value();
        sums[target - inputs.size()] += static_cast<double>(genome.weights[i]) * inputs.at(source);
    }
    return {1.0 / (1.0 + std::exp(-slope * sums[0])), 1.0 / (1.0 + std::exp(-slope * sums[1]))};
}

/// What a robot asks for, as shares of the largest translation and rotation.
struct Asked {
    double translation, rotation;
};

inline Asked asked_by(const Settings& settings, const std::array<double, 2>& outputs) {
    if (settings.world.actuation == Actuation::translation_rotation) {
        return {2.0 * outputs[0] - 1.0, 2.0 * outputs[1] - 1.0};
    }
    const double left = 2.0 * outputs[0] - 1.0;
    const double right = 2.0 * outputs[1] - 1.0;
    return {(left + right) / 2.0, (left - right) / 2.0};
}

/// docs/deviations.md, and Equation 2 of the paper.
inline double navigation_energy_of(const Settings& settings, const Asked& asked, double nearest) {
    if (settings.energy.navigation == NavigationEnergy::equation_2) {
        return 2.0 * std::abs(asked.translation) * (1.0 - std::sqrt(std::abs(asked.rotation))) *
                   nearest -
               1.0;
    }
    const double left = (asked.translation + asked.rotation / 2) / 1.5;
    const double right = (asked.translation - asked.rotation / 2) / 1.5;
    return 2.0 * (std::abs((left + 1) / 2) + std::abs((right + 1) / 2)) *
               (1.0 - std::sqrt(std::abs(left - right))) * nearest -
           1.0;
}

}  // namespace gene_clocks::sim::naive
