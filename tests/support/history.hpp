#pragma once

#include <rapidcheck.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/breadth_first_search.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include "tests/support/marks.hpp"

/// What an observer who sees the whole swarm writes down, and what must hold of it. Nothing here
/// looks at a clock.
namespace gene_clocks::test {

inline constexpr std::size_t no_event = std::numeric_limits<std::size_t>::max();

/// Something that happened at a robot.
struct Event {
    std::size_t robot = 0;
    std::uint64_t counter_after = 0;         ///< the robot's next unused counter thereafter
    std::optional<InnovationNumber> minted;  ///< the gene that it created
    std::size_t received_from = no_event;    ///< the sending that it received
    bool is_sending = false;
    bool is_undone = false;  ///< by a crash, before its traces were stored
};
using History = std::vector<Event>;

/// Happened-before as a graph: an edge from each event to the next of its robot that survived, and
/// from each sending to its receptions (Lamport 1978).
using EventGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;

inline EventGraph event_graph(const History& history, std::size_t robots) {
    EventGraph graph(history.size());
    std::vector<std::size_t> latest(robots, no_event);
    for (std::size_t e = 0; e < history.size(); ++e) {
        const Event& event = history[e];
        if (event.is_undone) continue;
        if (latest[event.robot] != no_event) add_edge(latest[event.robot], e, graph);
        latest[event.robot] = e;
        if (event.received_from != no_event) add_edge(event.received_from, e, graph);
    }
    return graph;
}

/// No two creations that survive have the same mark.
inline void assert_marks_unique(const History& history) {
    std::set<InnovationNumber> seen;
    for (const Event& event : history) {
        if (event.minted && !event.is_undone) RC_ASSERT(seen.insert(*event.minted).second);
    }
}

/// Whatever can be reached from a creation along happened-before has a larger counter.
inline void assert_clock_condition(const History& history, std::size_t robots) {
    struct Reached : boost::default_bfs_visitor {
        const History* history;
        std::size_t start;
        void discover_vertex(std::size_t e, const EventGraph&) const {
            if (e == start || !(*history)[e].minted) return;
            RC_ASSERT((*history)[start].minted->counter < (*history)[e].minted->counter);
            RC_ASSERT(*(*history)[start].minted < *(*history)[e].minted);
        }
    };
    const EventGraph graph = event_graph(history, robots);
    for (std::size_t e = 0; e < history.size(); ++e) {
        if (!history[e].minted || history[e].is_undone) continue;
        Reached visitor;
        visitor.history = &history;
        visitor.start = e;
        boost::breadth_first_search(graph, e, boost::visitor(visitor));
    }
}

/// What a robot has sent, no crash can undo.
inline void assert_nothing_sent_is_forgotten(const History& history) {
    for (const Event& event : history) RC_ASSERT(!(event.is_sending && event.is_undone));
}

}  // namespace gene_clocks::test
