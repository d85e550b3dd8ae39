#pragma once

#include <tsl/robin_set.h>
#include <xxhash.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/model/swarm.hpp"

namespace gene_clocks::model {

/// What an exploration found.
struct Result {
    std::uint64_t states = 0;        ///< distinct worlds
    std::uint64_t transitions = 0;   ///< actions carried out
    std::uint64_t depth = 0;         ///< steps to the farthest world
    std::string violation;           ///< empty: every promise holds in every world
    std::vector<std::string> trace;  ///< the shortest run into the violation, a line per step
};

/// Visits every world that can be reached, breadth first, so that the first violation is a nearest.
///
/// Worlds are compared by their full 128 bits, never by a hash alone. Takes about 40 bytes a world.
template <class Rules>
class Explorer {
public:
    explicit Explorer(const Scope& scope) : swarm_{scope}, seen_{1024, Hash{this}, Equal{this}} {
        seen_.max_load_factor(0.8f);
    }
    Explorer(const Explorer&) = delete;
    Explorer& operator=(const Explorer&) = delete;

    Result run() {
        Result result;
        discover(swarm_.pack(swarm_.initial()), 0);
        std::size_t level_end = worlds_.size();
        for (std::size_t current = 0; current < worlds_.size(); ++current) {
            if (current == level_end) {
                level_end = worlds_.size();
                ++result.depth;
            }
            const World world = swarm_.unpack(worlds_[current]);
            const char* broken = nullptr;
            Action breaking{};
            swarm_.for_each_action(world, [&](const Action& action) {
                if (broken) return;
                World next = world;
                broken = swarm_.step(next, action);
                breaking = action;
                ++result.transitions;
                if (!broken) discover(swarm_.pack(next), static_cast<Index>(current));
            });
            if (broken) {
                result.violation = broken;
                result.trace = trace_to(static_cast<Index>(current));
                result.trace.push_back(swarm_.describe(world, breaking));
                break;
            }
        }
        result.states = worlds_.size();
        return result;
    }

private:
    using Index = std::uint32_t;

    struct Hash {
        const Explorer* explorer;
        std::size_t operator()(Index index) const {
            return XXH3_64bits(&explorer->worlds_[index], sizeof(Packed));
        }
    };
    struct Equal {
        const Explorer* explorer;
        bool operator()(Index a, Index b) const {
            return explorer->worlds_[a] == explorer->worlds_[b];
        }
    };

    void discover(Packed world, Index parent) {
        if (worlds_.size() > std::numeric_limits<Index>::max()) {
            throw std::length_error("more worlds than can be numbered");
        }
        worlds_.push_back(world);
        if (seen_.insert(static_cast<Index>(worlds_.size() - 1)).second) {
            parents_.push_back(parent);
        } else {
            worlds_.pop_back();
        }
    }

    /// The run from the initial world to `world`, found again by looking which action led there.
    std::vector<std::string> trace_to(Index world) const {
        if (world == 0) return {};
        auto trace = trace_to(parents_[world]);
        const World before = swarm_.unpack(worlds_[parents_[world]]);
        std::string step;
        swarm_.for_each_action(before, [&](const Action& action) {
            World after = before;
            swarm_.step(after, action);
            if (step.empty() && swarm_.pack(after) == worlds_[world]) {
                step = swarm_.describe(before, action);
            }
        });
        trace.push_back(step);
        return trace;
    }

    Swarm<Rules> swarm_;
    std::vector<Packed> worlds_;  // in the order of discovery
    std::vector<Index> parents_;  // parents_[i]: the world from which worlds_[i] was reached
    // Of indices into worlds_, which hash and compare as the worlds themselves do.
    tsl::robin_set<Index, Hash, Equal, std::allocator<Index>, /*StoreHash=*/true> seen_;
};

template <class Rules>
Result explore(const Scope& scope) {
    return Explorer<Rules>{scope}.run();
}

}  // namespace gene_clocks::model
