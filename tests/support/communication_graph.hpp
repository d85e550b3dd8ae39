#pragma once

#include <rapidcheck.h>

#include <array>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/erdos_renyi_generator.hpp>
#include <boost/graph/mesh_graph_generator.hpp>
#include <boost/graph/small_world_generator.hpp>
#include <boost/random/linear_congruential.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ostream>

namespace gene_clocks::test {

/// Who hears whom.
using CommunicationGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;

enum class Topology : std::uint8_t { random, small_world, ring, star, grid, disconnected };

inline std::ostream& operator<<(std::ostream& out, Topology topology) {
    constexpr std::array names{"random", "small world", "ring", "star", "grid", "disconnected"};
    return out << names.at(static_cast<std::size_t>(topology));
}

inline rc::Gen<Topology> topologies() {
    return rc::gen::element(Topology::ring, Topology::star, Topology::grid, Topology::random,
                            Topology::small_world, Topology::disconnected);
}

/// A graph over `robots` vertices. The same arguments give the same graph.
inline CommunicationGraph make_graph(Topology topology, std::size_t robots, std::uint32_t seed) {
    boost::minstd_rand random(seed % 2147483646u + 1);
    const auto random_graph = [&](double edges_each) {
        using Iterator = boost::erdos_renyi_iterator<boost::minstd_rand, CommunicationGraph>;
        const double probability = std::fmin(1.0, edges_each / static_cast<double>(robots));
        return CommunicationGraph(Iterator(random, robots, probability), Iterator(), robots);
    };
    const auto ring = [&](std::size_t neighbours, double rewired) {
        using Iterator = boost::small_world_iterator<boost::minstd_rand, CommunicationGraph>;
        return CommunicationGraph(Iterator(random, robots, neighbours, rewired), Iterator(),
                                  robots);
    };
    CommunicationGraph graph(robots);
    switch (topology) {
        case Topology::random:
            return random_graph(4.0);
        case Topology::small_world:
            if (robots > 6) return ring(4, 0.1);
            break;
        case Topology::ring:
            if (robots > 3) return ring(2, 0.0);
            break;
        case Topology::star:
            for (std::size_t leaf = 1; leaf < robots; ++leaf) add_edge(0, leaf, graph);
            return graph;
        case Topology::grid:  // as many full rows as there are robots for; the rest are alone
            if (robots > 3) {
                using Iterator = boost::mesh_iterator<CommunicationGraph>;
                const auto width = static_cast<std::size_t>(std::sqrt(static_cast<double>(robots)));
                return CommunicationGraph(Iterator(width, robots / width, false), Iterator(),
                                          robots);
            }
            break;
        case Topology::disconnected:
            return random_graph(0.7);
    }
    for (std::size_t a = 0; a < robots; ++a) {  // too few for the shape: everyone hears everyone
        for (std::size_t b = a + 1; b < robots; ++b) add_edge(a, b, graph);
    }
    return graph;
}

}  // namespace gene_clocks::test
