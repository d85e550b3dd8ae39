#pragma once

#include <cstdint>
#include <gene_clocks/neat/agent.hpp>
#include <span>

namespace gene_clocks::sim {

/// A look at a swarm between two cycles; valid during the call that hands it over.
///
/// Lengths in pixels, x to the right, y down. All spans over robots are parallel, and so are those
/// over items.
struct SwarmView {
    std::int64_t cycle{};  ///< the one that comes next
    std::span<const neat::Agent> agents;
    std::span<const float> x_px, y_px;
    std::span<const float> heading_x, heading_y;  ///< cosine and sine of the heading
    std::span<const float> item_x_px, item_y_px;  ///< stale where the item is absent
    std::span<const std::uint8_t> item_is_present;
};

}  // namespace gene_clocks::sim
